// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "polynomialNodes.hpp"

#include "affineBasis.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace morph
{

namespace
{

// Relative to their span, points closer than this to a plane are in it
constexpr double flat = 1e-6;


// The candidate farthest from the span of the basis
std::vector<Candidate> farthest(
    const ControlPoints& candidates, const AffineBasis& basis, bool slidingToo,
    Communicator& communicator)
{
    const Index n = candidates.size();
    Errors far;
    far.residuals = Vectors::Zero(n, 3);
    far.norms.resize(n);
    far.available.resize(n);
    for (Index i = 0; i < n; ++i)
    {
        const ControlPoint& p = candidates[i];
        far.available[i] = slidingToo || !p.slides();
        far.norms[i] = basis.size() > 0 ? basis.distance(p.position) : 1.0;
    }
    return worstCandidate(candidates, far, 0, communicator);
}

} // namespace


std::vector<Candidate> polynomialNodes(
    const Kernel& kernel, const ControlPoints& candidates, Index most,
    Communicator& communicator)
{
    std::vector<Candidate> nodes;
    AffineBasis basis;
    double span = 0;
    while (Index(nodes.size()) < std::min<Index>(4, most))
    {
        const std::vector<Candidate> next =
            farthest(candidates, basis, false, communicator);
        if (next.empty() || next[0].error <= flat * span)
        {
            break;
        }
        if (!nodes.empty())
        {
            span = std::max(span, next[0].error);
        }
        nodes.push_back(next[0]);
        basis = AffineBasis(positions(nodes));
    }

    if (nodes.empty())
    {
        throw std::invalid_argument(
            "a linear polynomial needs moving or fixed control points, "
            "but there are none");
    }
    if (kernel.order() > 1 && most < 4)
    {
        throw std::invalid_argument(
            "thinPlate needs at least four points, but no more than "
            + std::to_string(most) + " are allowed");
    }
    if (kernel.order() > 1)
    {
        const std::vector<Candidate> off =
            farthest(candidates, basis, true, communicator);
        if (!off.empty() && off[0].error > flat * span)
        {
            throw std::invalid_argument(
                "thinPlate needs moving or fixed control points that do not "
                "all lie in one plane (in 2D: on one line)");
        }
    }
    return nodes;
}


Columns positions(const std::vector<Candidate>& points)
{
    Columns x(points.size(), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        x.row(i) = points[i].point.position.transpose();
    }
    return x;
}

} // namespace morph
