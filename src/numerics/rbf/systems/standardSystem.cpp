// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "standardSystem.hpp"

#include "referenceSystem.hpp"

#include <Eigen/Dense>

namespace morph
{

StandardSystem::StandardSystem(const Kernel& kernel)
: kernel_(kernel)
{
}


std::vector<bool> StandardSystem::append(
    const std::vector<Candidate>& list, const std::vector<Index>& chosen)
{
    ControlPoints extended(points_);
    for (const Index i : chosen)
    {
        extended.push_back(list[i].point);
    }

    const Eigen::PartialPivLU<Matrix> lu(
        referenceSystem(kernel_, extended, extended, true));
    if (singular(lu))
    {
        return std::vector<bool>(chosen.size(), false);
    }
    points_ = extended;
    gamma_ = lu.solve(paperValues(points_));
    return std::vector<bool>(chosen.size(), true);
}


void StandardSystem::setValues(const std::vector<Vector3>& values)
{
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        points_[i].value = values[i];
    }
    if (!points_.empty())
    {
        gamma_ = referenceSystem(kernel_, points_, points_, true)
                     .partialPivLu()
                     .solve(paperValues(points_));
    }
}


void StandardSystem::solve(RbfInterpolant& interpolant)
{
    interpolant.set(positions(points_), paperWeights(gamma_));
}

} // namespace morph
