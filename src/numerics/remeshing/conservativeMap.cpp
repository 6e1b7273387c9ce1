// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conservativeMap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace morph
{

namespace
{

// Overlaps of less than this part of a donor have no centroid but by round-off
constexpr double touch = 1e-10;


// Values are taken as linear up to this roughness, and as not at all linear
// from twice of it
constexpr double smooth = 0.2;


// The largest part of a change that stays between the limits
double allowed(
    const double value, const double change, const double least,
    const double most)
{
    if (change > 0)
    {
        return change > most - value ? std::max(0.0, most - value) / change : 1;
    }
    return change < least - value ? std::max(0.0, value - least) / -change : 1;
}

} // namespace


ConservativeMap::ConservativeMap(OverlapTable table)
: table_(std::move(table))
{
    const OverlapTable::Sums sums = table_.donorSums();
    centroid_ = Vectors::Zero(table_.nDonors(), 3);
    for (int j = 0; j < table_.nDonors(); ++j)
    {
        if (sums.volume[j] != 0)
        {
            centroid_.row(j) = sums.moment.row(j) / sums.volume[j];
        }
    }

    way_ = Vectors::Zero(table_.size(), 3);
    start_.assign(table_.nDonors() + 1, 0);
    for (Index e = 0; e < table_.size(); ++e)
    {
        if (table_.volume(e) != 0)
        {
            way_.row(e) = table_.moment(e) / table_.volume(e)
                - centroid_.row(table_.donor(e));
        }
        ++start_[table_.donor(e) + 1];
    }
    for (int j = 0; j < table_.nDonors(); ++j)
    {
        start_[j + 1] += start_[j];
    }
    entry_.resize(table_.size());
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    for (Index e = 0; e < table_.size(); ++e)
    {
        entry_[next[table_.donor(e)]++] = e;
    }
}


Eigen::VectorXd
ConservativeMap::map(const Eigen::VectorXd& values, const Vectors& slopes) const
{
    Eigen::VectorXd result = Eigen::VectorXd::Zero(table_.nTargets());
    for (int i = 0; i < table_.nTargets(); ++i)
    {
        double volume = 0, integral = 0;
        for (Index e = table_.begin(i); e < table_.end(i); ++e)
        {
            const int j = table_.donor(e);
            volume += table_.volume(e);
            integral +=
                table_.volume(e) * (values[j] + slopes.row(j).dot(way_.row(e)));
        }
        if (volume != 0)
        {
            result[i] = integral / volume;
        }
    }
    return result;
}


Eigen::VectorXd ConservativeMap::map(
    const CellSlopes& slopes, const Eigen::VectorXd& values,
    const ValueBounds& bounds) const
{
    Vectors gradient = slopes.slopes(values);
    limit(slopes, values, bounds, gradient);
    Eigen::VectorXd result = map(values, gradient);

    // Of round-off
    for (Index i = 0; i < result.size(); ++i)
    {
        result[i] = std::clamp(result[i], bounds.least, bounds.most);
    }
    return result;
}


void ConservativeMap::limit(
    const CellSlopes& slopes, const Eigen::VectorXd& values,
    const ValueBounds& bounds, Vectors& gradient) const
{
    for (int j = 0; j < table_.nDonors(); ++j)
    {
        double whole = 0;
        for (Index n = start_[j]; n < start_[j + 1]; ++n)
        {
            whole += std::abs(table_.volume(entry_[n]));
        }

        const Vector3 slope = gradient.row(j);
        const CellSlopes::Range range = slopes.range(j, values);
        double byRange = 1, byBounds = 1;
        for (Index n = start_[j]; n < start_[j + 1]; ++n)
        {
            if (std::abs(table_.volume(entry_[n])) <= touch * whole)
            {
                continue;
            }
            const double change = slope.dot(way_.row(entry_[n]));
            byRange = std::min(
                byRange, allowed(values[j], change, range.least, range.most));
            byBounds = std::min(
                byBounds,
                allowed(values[j], change, bounds.least, bounds.most));
        }
        if (byRange < 1)
        {
            const double linear = std::clamp(
                2 - slopes.roughness(j, values, slope) / smooth, 0.0, 1.0);
            byRange += linear * (1 - byRange);
        }
        gradient.row(j) *= std::min(byRange, byBounds);
    }
}

} // namespace morph
