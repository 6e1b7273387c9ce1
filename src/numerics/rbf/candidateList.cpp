// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "candidateList.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <unordered_set>

namespace morph
{

namespace
{

constexpr std::size_t packedSize = 22;


void pack(std::vector<double>& buffer, const Candidate& entry)
{
    const ControlPoint& p = entry.point;
    buffer.insert(buffer.end(), p.position.data(), p.position.data() + 3);
    buffer.push_back(p.k);
    buffer.insert(buffer.end(), p.directions.data(), p.directions.data() + 9);
    buffer.insert(buffer.end(), p.value.data(), p.value.data() + 3);
    buffer.insert(
        buffer.end(), entry.residual.data(), entry.residual.data() + 3);
    buffer.push_back(entry.error);
    buffer.push_back(entry.rank);
    buffer.push_back(double(entry.index));
}


Candidate unpack(const double* v)
{
    Candidate entry;
    entry.point.position = Eigen::Map<const Vector3>(v);
    entry.point.k = int(v[3]);
    entry.point.directions = Eigen::Map<const Eigen::Matrix3d>(v + 4);
    entry.point.value = Eigen::Map<const Vector3>(v + 13);
    entry.residual = Eigen::Map<const Vector3>(v + 16);
    entry.error = v[19];
    entry.rank = int(v[20]);
    entry.index = Index(v[21]);
    return entry;
}


// Lets through the first of each cell
class Thinning
{
public:
    explicit Thinning(double cell)
    : cell_(cell)
    {
    }

    bool first(const Vector3& x)
    {
        if (!(cell_ > 0))
        {
            return true;
        }
        Key key;
        for (int a = 0; a < 3; ++a)
        {
            key[a] = std::floor(x[a] / cell_);
        }
        return taken_.insert(key).second;
    }

private:
    using Key = std::array<double, 3>;

    struct Hash
    {
        std::size_t operator()(const Key& key) const
        {
            std::size_t h = 0;
            for (const double k : key)
            {
                h = 31 * h + std::hash<double>()(k);
            }
            return h;
        }
    };

    double cell_;
    std::unordered_set<Key, Hash> taken_;
};

// This rank's candidates with the largest errors, of each cell the first
std::vector<Index> worstFirst(
    const ControlPoints& candidates, const Errors& errors, double least,
    Index most, double cell)
{
    // A heap gives the worst first without sorting all of them. Without cells
    // one knows how many it takes
    struct Bad
    {
        double error;
        Index index;
    };
    std::vector<Bad> heap;
    heap.reserve(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        if (errors.available[i] && errors.norms[i] > least)
        {
            heap.push_back({errors.norms[i], Index(i)});
        }
    }
    const auto better = [&](const Bad& a, const Bad& b)
    {
        return a.error != b.error
            ? a.error < b.error
            : before(
                candidates[b.index].position, candidates[a.index].position);
    };
    if (!(cell > 0) && most < Index(heap.size()))
    {
        std::nth_element(
            heap.begin(), heap.begin() + most, heap.end(),
            [&](const Bad& a, const Bad& b) { return better(b, a); });
        heap.resize(most);
    }
    std::make_heap(heap.begin(), heap.end(), better);

    std::vector<Index> first;
    Thinning thinning(cell);
    while (Index(first.size()) < most && !heap.empty())
    {
        std::pop_heap(heap.begin(), heap.end(), better);
        const Index i = heap.back().index;
        heap.pop_back();
        if (thinning.first(candidates[i].position))
        {
            first.push_back(i);
        }
    }
    return first;
}


// The first of each cell, at most so many
std::vector<Candidate>
firstOfCells(const std::vector<Candidate>& sorted, double cell, Index most)
{
    std::vector<Candidate> list;
    Thinning thinning(cell);
    for (const Candidate& entry : sorted)
    {
        if (Index(list.size()) < most && thinning.first(entry.point.position))
        {
            list.push_back(entry);
        }
    }
    return list;
}


// Of a histogram of errors: four for each factor of two below the largest, and
// the last one for all that are smaller
constexpr int bins = 64;


int binOf(double error, double largest)
{
    // An error may be zero or so small that the quotient overflows, which
    // OpenFOAM traps
    const double below =
        error > 0 ? 4 * (std::log2(largest) - std::log2(error)) : bins;
    return below > 0 ? int(std::min(below, bins - 1.0)) : 0;
}


// How many candidates of all ranks there are in each bin
std::vector<double> histogram(
    const Errors& errors, const std::vector<Index>& which, double largest,
    Communicator& communicator)
{
    std::vector<double> counts(bins, 0.0);
    for (const Index i : which)
    {
        ++counts[binOf(errors.norms[i], largest)];
    }
    return communicator.sum(counts);
}


void packCandidate(
    std::vector<double>& buffer, const ControlPoints& candidates,
    const Errors& errors, Index i, int rank)
{
    const Vector3 residual = errors.residuals.row(i).transpose();
    pack(buffer, {candidates[i], residual, errors.norms[i], rank, i});
}


void unpackAll(const std::vector<double>& buffer, std::vector<Candidate>& list)
{
    for (std::size_t i = 0; i < buffer.size(); i += packedSize)
    {
        list.push_back(unpack(&buffer[i]));
    }
}

} // namespace


bool Candidate::precedes(const Candidate& a, const Candidate& b)
{
    if (a.error != b.error)
    {
        return a.error > b.error;
    }
    if (a.point.position != b.point.position)
    {
        return before(a.point.position, b.point.position);
    }
    return a.point.k > b.point.k;
}


std::vector<Candidate> worstCandidate(
    const ControlPoints& candidates, const Errors& errors, double least,
    Communicator& communicator)
{
    std::vector<double> mine;
    for (const Index i : worstFirst(candidates, errors, least, 1, 0))
    {
        packCandidate(mine, candidates, errors, i, communicator.rank());
    }
    std::vector<Candidate> offered;
    unpackAll(communicator.gather(mine), offered);
    std::sort(offered.begin(), offered.end(), Candidate::precedes);
    offered.resize(std::min<std::size_t>(1, offered.size()));
    return offered;
}


std::vector<Candidate> candidateList(
    const ControlPoints& candidates, const Errors& errors, double least,
    Index length, double cell, double largest, Communicator& communicator,
    double& outside)
{
    // One more, whose error is the one outside
    const std::vector<Index> bad =
        worstFirst(candidates, errors, least, length + 1, cell);
    const std::vector<double> counts =
        histogram(errors, bad, largest, communicator);

    // Of the worst of each rank as many as are in the list for certain, and
    // more while the cells that several ranks share leave it too short: what
    // has larger errors decides about what has smaller ones, so that nothing
    // held back could change the list
    std::vector<Candidate> offered, list;
    std::size_t sent = 0;
    double all = 0;
    for (int bin = 0; bin < bins;)
    {
        const double needed = all + double(length + 1) - double(list.size());
        for (; bin < bins && all < needed; ++bin)
        {
            all += counts[bin];
        }
        std::vector<double> mine;
        for (;
             sent < bad.size() && binOf(errors.norms[bad[sent]], largest) < bin;
             ++sent)
        {
            packCandidate(
                mine, candidates, errors, bad[sent], communicator.rank());
        }
        unpackAll(communicator.gather(mine), offered);
        std::sort(offered.begin(), offered.end(), Candidate::precedes);
        list = firstOfCells(offered, cell, length + 1);
        if (Index(list.size()) > length)
        {
            break;
        }
    }

    outside = 0;
    if (Index(list.size()) > length)
    {
        outside = list.back().error;
        list.pop_back();
    }
    return list;
}


std::vector<Candidate> candidatesAt(
    const ControlPoints& candidates, const std::vector<Vector3>& positions,
    Communicator& communicator)
{
    std::map<Vector3, Index, bool (*)(const Vector3&, const Vector3&)> wanted(
        before);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
        wanted.emplace(positions[i], i);
    }

    std::vector<double> mine;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        if (wanted.count(candidates[i].position))
        {
            pack(
                mine,
                {candidates[i], Vector3::Zero(), 0, communicator.rank(),
                 Index(i)});
        }
    }

    const std::vector<double> all = communicator.gather(mine);
    std::vector<Candidate> found(positions.size());
    std::vector<char> there(positions.size(), 0);
    for (std::size_t i = 0; i < all.size(); i += packedSize)
    {
        const Candidate entry = unpack(&all[i]);
        const Index at = wanted.at(entry.point.position);
        if (!there[at] || entry.point.k > found[at].point.k)
        {
            found[at] = entry;
            there[at] = 1;
        }
    }
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
        const Vector3& x = positions[i];
        if (!there[i])
        {
            std::ostringstream message;
            message.precision(std::numeric_limits<double>::max_digits10);
            message << "no control point at (" << x.transpose()
                    << "), or it "
                       "is named twice";
            throw std::invalid_argument(message.str());
        }
    }
    return found;
}

} // namespace morph
