// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "workingSet.hpp"

#include <algorithm>
#include <cstring>

namespace morph
{

namespace
{

// Candidates in the sample for each selected point, and at least. The more, the
// fewer sweeps over all candidates; the fewer, the cheaper each over the sample
constexpr double samplePerPoint = 30;
constexpr double leastSample = 16384;

// To what part of the tolerance an error takes a candidate in: those that are
// nearly out of it are so when others have been met
constexpr double near = 0.8;

// What a sample alone is met to, in tolerances
constexpr double coarse = 1.2;

// A set of more than this part of all candidates saves nothing
constexpr double largestPart = 0.7;


// A number from [0, 1) that the bits of a position decide (the finaliser of
// MurmurHash3, public domain)
float lot(const Vector3& x)
{
    std::uint64_t h = 0;
    for (int d = 0; d < 3; ++d)
    {
        const double value = x[d] == 0 ? 0 : x[d]; // of -0 and 0 the same
        std::uint64_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        h ^= bits;
        h ^= h >> 33;
        h *= 0xff51afd7ed558ccdull;
        h ^= h >> 33;
        h *= 0xc4ceb9fe1a85ec53ull;
        h ^= h >> 33;
    }
    return float(h >> 40) / float(1 << 24);
}

} // namespace


WorkingSet::WorkingSet(
    const ControlPoints& candidates, Communicator& communicator)
{
    const Index n = candidates.size();
    all_ = std::make_shared<PointCloud>(positions(candidates));
    total_ = communicator.sum({double(n)})[0];
    if (share(0) <= largestPart)
    {
        lots_.resize(n);
        for (Index i = 0; i < n; ++i)
        {
            lots_[i] = lot(candidates[i].position);
        }
        taken_.assign(n, 0);
    }
}


double WorkingSet::share(Index selected) const
{
    const double size =
        std::max(leastSample, samplePerPoint * double(selected));
    double share = 1;
    while (0.5 * share * total_ >= size)
    {
        share *= 0.5;
    }
    return share;
}


double WorkingSet::coarseness() const
{
    return !whole_ && alone_ ? coarse : 1;
}


void WorkingSet::reset()
{
    takeAll();
    alone_ = true;
    std::fill(taken_.begin(), taken_.end(), 0);
}


void WorkingSet::sample(
    const ControlPoints& candidates, Index selected, double least,
    Errors& errors, Communicator& communicator)
{
    share_ = share(selected);
    if (share_ > largestPart)
    {
        return;
    }

    double size = 0;
    double taken = 0;
    for (std::size_t i = 0; i < lots_.size(); ++i)
    {
        taken_[i] = taken_[i] || errors.norms[i] > near * least;
        size += has(i);
        taken += taken_[i];
    }
    const std::vector<double> all = communicator.sum({size, taken});
    whole_ = all[0] > largestPart * total_;
    if (whole_)
    {
        return;
    }
    alone_ = all[1] == 0;
    for (std::size_t i = 0; i < lots_.size(); ++i)
    {
        if (!has(i))
        {
            errors.norms[i] = 0;
        }
    }
    makePart(candidates);
}


void WorkingSet::grow(const ControlPoints& candidates, Index selected)
{
    if (whole_ || share(selected) == share_)
    {
        return;
    }
    share_ = share(selected);
    whole_ = share_ > largestPart;
    if (!whole_)
    {
        makePart(candidates);
    }
}


void WorkingSet::makePart(const ControlPoints& candidates)
{
    indices_.clear();
    for (std::size_t i = 0; i < lots_.size(); ++i)
    {
        if (has(i))
        {
            indices_.push_back(i);
        }
    }
    Vectors x(indices_.size(), 3);
    for (std::size_t i = 0; i < indices_.size(); ++i)
    {
        x.row(i) = candidates[indices_[i]].position.transpose();
    }
    part_ = std::make_shared<PointCloud>(x);
}

} // namespace morph
