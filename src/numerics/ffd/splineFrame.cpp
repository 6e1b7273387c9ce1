// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "splineFrame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace morph
{

SplineFrame::SplineFrame(
    const std::array<BSpline, 3>& basis, const Vectors& controlPoints)
: basis_(basis),
  controlPoints_(controlPoints),
  low_(controlPoints.colwise().minCoeff().transpose()),
  high_(controlPoints.colwise().maxCoeff().transpose()),
  span_(Eigen::Matrix3d::Zero())
{
    std::array<Index, 3> n;
    for (std::size_t d = 0; d < 3; ++d)
    {
        n[d] = basis[d].size();
    }
    const Index stride[3] = {1, n[0], n[0] * n[1]};
    for (int d = 0; d < 3; ++d)
    {
        const Index lines = controlPoints.rows() / n[std::size_t(d)];
        const Index last = (n[std::size_t(d)] - 1) * stride[d];
        for (Index i = 0; i < controlPoints.rows(); ++i)
        {
            if (i / stride[d] % n[std::size_t(d)] == 0)
            {
                span_.col(d) +=
                    (controlPoints.row(i + last) - controlPoints.row(i))
                        .transpose()
                    / double(lines);
            }
        }
    }

    // In each direction a few per control point; the middle of each piece too,
    // to find maps that fold
    const double size = std::abs(span_.determinant());
    std::array<Index, 3> pieces;
    for (std::size_t d = 0; d < 3; ++d)
    {
        pieces[d] = std::min<Index>(std::max<Index>(2 * n[d], 4), 24);
    }
    for (Index k = 0; k <= pieces[2]; ++k)
    {
        for (Index j = 0; j <= pieces[1]; ++j)
        {
            for (Index i = 0; i <= pieces[0]; ++i)
            {
                const Vector3 xi(
                    double(i) / double(pieces[0]),
                    double(j) / double(pieces[1]),
                    double(k) / double(pieces[2]));
                if (!(frameJacobian(xi).determinant() > 1e-9 * size))
                {
                    throw std::invalid_argument(
                        "the control points enclose no box: it is inside out"
                        " or folded somewhere. The first index has to be"
                        " fastest, and the three directions right-handed");
                }
                starts_.push_back(xi);
            }
        }
    }
    startPositions_.resize(Index(starts_.size()), 3);
    for (std::size_t i = 0; i < starts_.size(); ++i)
    {
        startPositions_.row(Index(i)) = position(starts_[i]).transpose();
    }
}


void SplineFrame::evaluate(
    const Vector3& xi, Vector3& position, Eigen::Matrix3d& jacobian) const
{
    // Room for the highest degrees that lattices have; no allocation per point
    thread_local std::vector<double> rows;
    Index first[3];
    double* value[3];
    double* slope[3];
    std::size_t length = 0;
    for (const BSpline& basis : basis_)
    {
        length += std::size_t(basis.degree()) + 1;
    }
    rows.resize(2 * length);
    double* next = rows.data();
    for (std::size_t d = 0; d < 3; ++d)
    {
        value[d] = next;
        next += basis_[d].degree() + 1;
        slope[d] = next;
        next += basis_[d].degree() + 1;
        first[d] = basis_[d].values(xi[Index(d)], value[d], slope[d]);
    }

    position.setZero();
    jacobian.setZero();
    for (Index k = 0; k <= basis_[2].degree(); ++k)
    {
        for (Index j = 0; j <= basis_[1].degree(); ++j)
        {
            const Index line = first[0]
                + basis_[0].size()
                    * (first[1] + j + basis_[1].size() * (first[2] + k));
            Vector3 along = Vector3::Zero();
            Vector3 alongSlope = Vector3::Zero();
            for (Index i = 0; i <= basis_[0].degree(); ++i)
            {
                const Vector3 P = controlPoints_.row(line + i).transpose();
                along += value[0][i] * P;
                alongSlope += slope[0][i] * P;
            }
            position += value[1][j] * value[2][k] * along;
            jacobian.col(0) += value[1][j] * value[2][k] * alongSlope;
            jacobian.col(1) += slope[1][j] * value[2][k] * along;
            jacobian.col(2) += value[1][j] * slope[2][k] * along;
        }
    }

    // A direction with one layer has no slope of its own
    for (int d = 0; d < 3; ++d)
    {
        const double beyond = xi[d] - std::min(std::max(xi[d], 0.0), 1.0);
        if (beyond != 0)
        {
            position += beyond * jacobian.col(d);
        }
    }
}


Vector3 SplineFrame::position(const Vector3& xi) const
{
    Vector3 x;
    Eigen::Matrix3d J;
    evaluate(xi, x, J);
    return x;
}


Eigen::Matrix3d SplineFrame::frameJacobian(const Vector3& xi) const
{
    Vector3 x;
    Eigen::Matrix3d J;
    evaluate(xi, x, J);
    return J;
}


Vector3 SplineFrame::coordinates(const Vector3& x) const
{
    const Vector3 nowhere =
        Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
    const Vector3 margin = Vector3::Constant(1e-6 * (high_ - low_).norm());
    if (((x - low_ + margin).array() < 0).any()
        || ((high_ - x + margin).array() < 0).any())
    {
        return nowhere;
    }

    Index nearest;
    (startPositions_.rowwise() - x.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    Vector3 xi = starts_[std::size_t(nearest)];

    const double size = std::abs(span_.determinant());
    const double far = (high_ - low_).norm();
    Vector3 at;
    Eigen::Matrix3d J;
    evaluate(xi, at, J);
    double miss = (x - at).norm();
    for (int i = 0; i < 60; ++i)
    {
        if (!(std::abs(J.determinant()) > 1e-12 * size))
        {
            return nowhere;
        }
        Vector3 step = J.partialPivLu().solve(x - at);

        // At most a third of the box at once, and shorter until it is nearer
        const double longest = step.cwiseAbs().maxCoeff();
        const bool done = longest < 1e-14;
        step *= std::min(1.0, 0.3 / std::max(longest, 1e-300));
        Vector3 to = xi + step;
        evaluate(to, at, J);
        for (int half = 0; half < 20 && !done; ++half)
        {
            if ((x - at).norm() <= miss * (1 + 1e-12) + 1e-15 * far)
            {
                break;
            }
            step *= 0.5;
            to = xi + step;
            evaluate(to, at, J);
        }
        xi = to;
        miss = (x - at).norm();
        if (done || xi.cwiseAbs().maxCoeff() > 10)
        {
            break;
        }
    }
    return miss < 1e-11 * far ? xi : nowhere;
}


Eigen::Matrix3d SplineFrame::gradient(const Vector3& x) const
{
    return frameJacobian(coordinates(x)).inverse();
}


Vector3 SplineFrame::frameCoordinates(const Vector3& xi) const
{
    return position(xi);
}


Vector3
SplineFrame::fromFractions(const Vector3&, const Vector3& fractions) const
{
    return span_ * fractions;
}


Vector3 SplineFrame::fromUnits(const Vector3& vector) const
{
    return vector;
}

} // namespace morph
