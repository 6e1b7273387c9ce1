// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "incrementalSystem.hpp"

#include "pivotedCholesky.hpp"

#include <utility>

namespace morph
{

namespace
{

GramFactor
factorOf(const Kernel& kernel, const Columns& nodes, const Matrix& nodeValues)
{
    return nodes.rows() > 0 ? GramFactor(kernel, AffineBasis(nodes), nodeValues)
                            : GramFactor(kernel);
}


// The residuals of the list as the right-hand side of its system
Matrix rightHandSide(
    const std::vector<Candidate>& list, const GramFactor::Residual& system)
{
    Matrix r(system.offset.back(), system.scalar ? 3 : 1);
    for (std::size_t p = 0; p < list.size(); ++p)
    {
        if (system.scalar)
        {
            r.row(p) = list[p].residual.transpose();
        }
        else
        {
            const int k = list[p].point.k;
            r.middleRows(system.offset[p], k) = list[p].residual.head(k);
        }
    }
    return r;
}

} // namespace


IncrementalSystem::IncrementalSystem(
    const Kernel& kernel, const Columns& nodes, const Matrix& nodeValues)
: nNodes_(nodes.rows()),
  factor_(factorOf(kernel, nodes, nodeValues))
{
}


ControlSystem::Choice IncrementalSystem::choose(
    const std::vector<Candidate>& list, Index most, double least,
    double outside)
{
    points_.clear();
    for (const Candidate& entry : list)
    {
        points_.push_back(entry.point);
    }
    residual_ = factor_.residual(points_);
    std::vector<double> scale;
    for (const ControlPoint& p : points_)
    {
        scale.push_back(factor_.pivotScale(p.position));
    }
    return pivotedCholesky(
        [this](const std::vector<Index>& which)
        { return factor_.columns(points_, residual_, which); },
        residual_.offset, rightHandSide(list, residual_), scale, most, least,
        outside);
}


std::vector<bool> IncrementalSystem::append(
    const std::vector<Candidate>& list, const std::vector<Index>& chosen)
{
    if (points_.empty())
    {
        ControlPoints points;
        for (const Index i : chosen)
        {
            points.push_back(list[i].point);
        }
        return factor_.append(points);
    }
    const std::vector<bool> in =
        factor_.append(points_, chosen, std::move(residual_));
    points_.clear();
    return in;
}


void IncrementalSystem::setValues(const std::vector<Vector3>& values)
{
    Matrix nodeValues(nNodes_, 3);
    for (Index i = 0; i < nNodes_; ++i)
    {
        nodeValues.row(i) = values[i].transpose();
    }
    factor_.setValues(
        std::vector<Vector3>(values.begin() + nNodes_, values.end()),
        nodeValues);
}


void IncrementalSystem::solve(RbfInterpolant& interpolant)
{
    factor_.solve(interpolant);
}

} // namespace morph
