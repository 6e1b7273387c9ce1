// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surfaceCorrection.hpp"

#include "kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace morph
{

namespace
{

// Radii shrink by 2^-60 at most: points closer than that are at one place
constexpr int mostLevels = 60;

} // namespace


std::size_t SurfaceCorrection::Hash::operator()(const Cell& cell) const
{
    // Large primes, as is usual for spatial hashing
    return std::size_t(cell[0]) * 73856093u ^ std::size_t(cell[1]) * 19349663u
        ^ std::size_t(cell[2]) * 83492791u;
}


SurfaceCorrection::Cell SurfaceCorrection::cellOf(const Vector3& x, double size)
{
    Cell cell;
    for (int a = 0; a < 3; ++a)
    {
        cell[a] = std::int64_t(std::floor(x[a] / size));
    }
    return cell;
}


template <class Action>
void SurfaceCorrection::cellsAround(
    const Grid& grid, const Vector3& x, double size, const Action& action)
{
    const Cell middle = cellOf(x, size);
    Cell cell;
    for (cell[0] = middle[0] - 1; cell[0] <= middle[0] + 1; ++cell[0])
    {
        for (cell[1] = middle[1] - 1; cell[1] <= middle[1] + 1; ++cell[1])
        {
            for (cell[2] = middle[2] - 1; cell[2] <= middle[2] + 1; ++cell[2])
            {
                const auto found = grid.find(cell);
                if (found != grid.end())
                {
                    action(found->second);
                }
            }
        }
    }
}


SurfaceCorrection::SurfaceCorrection(
    const Columns& centres, double radius, const std::vector<Index>& family)
: centres_(centres),
  coefficients_(Vectors::Zero(centres.rows(), 3))
{
    if (!(radius > 0) || !std::isfinite(radius))
    {
        throw std::invalid_argument(
            "the radius of the surface correction must be positive");
    }

    Families all(centres.rows());
    for (Index i = 0; i < centres.rows(); ++i)
    {
        all[family.empty() ? i : family[i]].push_back(i);
    }
    Families left;
    for (std::vector<Index>& members : all)
    {
        if (!members.empty())
        {
            left.push_back(std::move(members));
        }
    }
    double h = radius;
    for (int l = 0; !left.empty(); ++l, h *= 0.5)
    {
        if (l == mostLevels)
        {
            throw std::invalid_argument(
                "two points of the surface correction are at one place");
        }
        levels_.push_back(makeLevel(left, h));
    }
    among_ = reach(centres);
}


SurfaceCorrection::Level
SurfaceCorrection::makeLevel(Families& left, double radius) const
{
    Level level;
    level.radius = radius;
    for (Index i = 0; i < centres_.rows(); ++i)
    {
        level.all[cellOf(centres_.row(i), radius)];
    }

    // All that are placed so far
    Grid placed;
    for (const Level& earlier : levels_)
    {
        for (const Index i : earlier.members)
        {
            placed[cellOf(centres_.row(i), radius)].push_back(i);
        }
    }

    Families rest;
    for (const std::vector<Index>& members : left)
    {
        bool alone = true;
        for (std::size_t k = 0; k < members.size(); ++k)
        {
            const Vector3 x = centres_.row(members[k]);
            const auto apart = [&](const Index j)
            { return (centres_.row(j).transpose() - x).norm() >= radius; };
            alone = alone
                && std::all_of(members.begin(), members.begin() + k, apart);
            cellsAround(
                placed, x, radius,
                [&](const std::vector<Index>& there) {
                    alone =
                        alone && std::all_of(there.begin(), there.end(), apart);
                });
        }
        if (!alone)
        {
            rest.push_back(members);
            continue;
        }
        for (const Index i : members)
        {
            const Cell cell = cellOf(centres_.row(i), radius);
            level.members.push_back(i);
            level.grid[cell].push_back(i);
            placed[cell].push_back(i);
        }
    }
    left = rest;
    return level;
}


SurfaceCorrection::Reach::Level SurfaceCorrection::reachAt(
    const Level& level, const Vectors& points,
    std::vector<std::int32_t>& near) const
{
    const Kernel kernel(KernelType::wendlandC2, level.radius);
    // All points of a cell have the same cells around them
    struct Around
    {
        bool near = false;
        std::vector<Index> centres;
    };
    std::unordered_map<Cell, Around, Hash> around;
    const auto aroundOf = [&](const Vector3& x) -> const Around&
    {
        const auto place = around.emplace(cellOf(x, level.radius), Around());
        Around& here = place.first->second;
        if (place.second)
        {
            cellsAround(
                level.all, x, level.radius,
                [&](const std::vector<Index>&) { here.near = true; });
            cellsAround(
                level.grid, x, level.radius,
                [&](const std::vector<Index>& there) {
                    here.centres.insert(
                        here.centres.end(), there.begin(), there.end());
                });
        }
        return here;
    };

    Reach::Level reach;
    std::vector<std::int32_t> still;
    for (const std::int32_t i : near)
    {
        const Vector3 x = points.row(i);
        const Around& here = aroundOf(x);
        if (!here.near)
        {
            continue;
        }
        still.push_back(i);

        const std::size_t begin = reach.centres.size();
        for (const Index j : here.centres)
        {
            const double value =
                kernel((centres_.row(j).transpose() - x).norm());
            if (value != 0)
            {
                reach.centres.push_back(j);
                reach.values.push_back(value);
            }
        }
        if (reach.centres.size() > begin)
        {
            reach.points.push_back(i);
            reach.begin.push_back(begin);
        }
    }
    reach.begin.push_back(reach.centres.size());
    near.swap(still);
    return reach;
}


SurfaceCorrection::Reach SurfaceCorrection::reach(const Vectors& points) const
{
    Reach reach;
    std::vector<std::int32_t> near(points.rows());
    std::iota(near.begin(), near.end(), 0);
    for (const Level& level : levels_)
    {
        reach.levels_.push_back(reachAt(level, points, near));
    }
    return reach;
}


void SurfaceCorrection::addLevel(
    const Reach::Level& reach, double factor, Vectors& displacements) const
{
    for (std::size_t i = 0; i < reach.points.size(); ++i)
    {
        Vector3 sum = Vector3::Zero();
        for (std::size_t k = reach.begin[i]; k < reach.begin[i + 1]; ++k)
        {
            sum += reach.values[k]
                * coefficients_.row(reach.centres[k]).transpose();
        }
        displacements.row(reach.points[i]) += factor * sum.transpose();
    }
}


void SurfaceCorrection::set(const Vectors& residuals)
{
    // What a level has met stays met: no later one reaches its points
    Vectors open = residuals;
    for (std::size_t l = 0; l < levels_.size(); ++l)
    {
        for (const Index i : levels_[l].members)
        {
            coefficients_.row(i) = open.row(i);
        }
        addLevel(among_.levels_[l], -1, open);
    }
}


void SurfaceCorrection::add(const Reach& points, Vectors& displacements) const
{
    for (const Reach::Level& level : points.levels_)
    {
        addLevel(level, 1, displacements);
    }
}

} // namespace morph
