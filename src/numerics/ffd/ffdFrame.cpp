// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "ffdFrame.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace morph
{

namespace
{

const double pi = 3.14159265358979323846;


void checkSpan(const Vector3& span)
{
    for (int d = 0; d < 3; ++d)
    {
        if (!(span[d] > 0) || !std::isfinite(span[d]))
        {
            throw std::invalid_argument(
                "every component of the span of a box has to be positive");
        }
    }
}

} // namespace

// * * * Common

Vector3 FfdFrame::displacement(const Vector3&, const Vector3& d) const
{
    return d;
}


Eigen::Matrix3d
FfdFrame::displacementByLattice(const Vector3&, const Vector3&) const
{
    return Eigen::Matrix3d::Identity();
}


Eigen::Matrix3d
FfdFrame::displacementByPosition(const Vector3&, const Vector3&) const
{
    return Eigen::Matrix3d::Zero();
}


Eigen::Matrix3d FfdFrame::frameJacobian(const Vector3& xi) const
{
    // Along each line of the box the map is linear
    Eigen::Matrix3d J;
    for (int c = 0; c < 3; ++c)
    {
        Vector3 from = xi, to = xi;
        from[c] = 0;
        to[c] = 1;
        J.col(c) = frameCoordinates(to) - frameCoordinates(from);
    }
    return J;
}


Vector3
FfdFrame::fromFractions(const Vector3& xi, const Vector3& fractions) const
{
    return frameJacobian(xi) * fractions;
}

// * * * Rectangular

AffineFrame::AffineFrame(
    const Vector3& origin, const Vector3& span, const Eigen::Matrix3d& axes)
: origin_(origin),
  span_(span),
  axes_(axes)
{
    checkSpan(span);
}


Vector3 AffineFrame::coordinates(const Vector3& x) const
{
    return (axes_.transpose() * (x - origin_)).cwiseQuotient(span_);
}


Vector3 AffineFrame::position(const Vector3& xi) const
{
    return origin_ + axes_ * xi.cwiseProduct(span_);
}


Eigen::Matrix3d AffineFrame::gradient(const Vector3&) const
{
    return span_.cwiseInverse().asDiagonal() * axes_.transpose();
}


Vector3 AffineFrame::frameCoordinates(const Vector3& xi) const
{
    return axes_ * xi.cwiseProduct(span_);
}


Vector3
AffineFrame::fromFractions(const Vector3&, const Vector3& fractions) const
{
    return frameCoordinates(fractions);
}


Vector3 AffineFrame::fromUnits(const Vector3& vector) const
{
    return axes_ * vector;
}

// * * * Cylindrical

CylindricalFrame::CylindricalFrame(
    const Vector3& origin, const Eigen::Matrix3d& axes, const Vector3& start,
    const Vector3& span)
: origin_(origin),
  axes_(axes),
  start_(start),
  span_(span),
  ring_(span[1] > 2 * pi * (1 - 1e-12))
{
    checkSpan(span);
    if (!(start[0] >= 0))
    {
        throw std::invalid_argument(
            "the inner radius of a cylindrical box may not be negative");
    }
    if (span[1] > 2 * pi * (1 + 1e-12))
    {
        throw std::invalid_argument(
            "a cylindrical box reaches around its axis at most once");
    }
}


CylindricalFrame::Polar CylindricalFrame::polar(const Vector3& x) const
{
    Polar p;
    p.local = axes_.transpose() * (x - origin_);
    p.radius = std::hypot(p.local[0], p.local[1]);
    const bool onAxis = p.radius < 1e-14 * (start_[0] + span_[0]);
    p.cosine = onAxis ? 1 : p.local[0] / p.radius;
    p.sine = onAxis ? 0 : p.local[1] / p.radius;
    return p;
}


Vector3 CylindricalFrame::coordinates(const Vector3& x) const
{
    const Polar p = polar(x);

    // The angle from the middle of the box: the cut is opposite to it
    const double middle = start_[1] + 0.5 * span_[1];
    const double c = std::cos(middle);
    const double s = std::sin(middle);
    const double angle =
        std::atan2(c * p.sine - s * p.cosine, c * p.cosine + s * p.sine);
    return Vector3(
        (p.radius - start_[0]) / span_[0], 0.5 + angle / span_[1],
        (p.local[2] - start_[2]) / span_[2]);
}


Vector3 CylindricalFrame::position(const Vector3& xi) const
{
    const Vector3 q = frameCoordinates(xi);
    return origin_
        + axes_ * Vector3(q[0] * std::cos(q[1]), q[0] * std::sin(q[1]), q[2]);
}


Vector3 CylindricalFrame::displacement(const Vector3& x, const Vector3& d) const
{
    // (r + dr) e(theta + dtheta) - r e(theta), without cancellation
    const Polar p = polar(x);
    const double half = std::sin(0.5 * d[1]);
    const double turn = -2 * half * half;
    const double side = std::sin(d[1]);
    const double radius = p.radius + d[0];
    const Vector3 local(
        d[0] * p.cosine + radius * (turn * p.cosine - side * p.sine),
        d[0] * p.sine + radius * (turn * p.sine + side * p.cosine), d[2]);
    return axes_ * local;
}


Eigen::Matrix3d CylindricalFrame::displacementByLattice(
    const Vector3& x, const Vector3& d) const
{
    const Polar p = polar(x);
    const double c = std::cos(d[1]) * p.cosine - std::sin(d[1]) * p.sine;
    const double s = std::cos(d[1]) * p.sine + std::sin(d[1]) * p.cosine;
    const double radius = p.radius + d[0];
    Eigen::Matrix3d local;
    local << c, -radius * s, 0, s, radius * c, 0, 0, 0, 1;
    return axes_ * local;
}


Eigen::Matrix3d CylindricalFrame::displacementByPosition(
    const Vector3& x, const Vector3& d) const
{
    // x* = Rot(dtheta) (x + dr e_r), and d e_r/d x = e_t e_t^T/r
    const Polar p = polar(x);
    const double ratio = p.radius > 0 ? d[0] / p.radius : 0;
    const Vector3 tangent(-p.sine, p.cosine, 0);
    Eigen::Matrix3d rotation;
    rotation << std::cos(d[1]), -std::sin(d[1]), 0, std::sin(d[1]),
        std::cos(d[1]), 0, 0, 0, 1;
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    return axes_
        * (rotation * (identity + ratio * tangent * tangent.transpose())
           - identity)
        * axes_.transpose();
}


Eigen::Matrix3d CylindricalFrame::gradient(const Vector3& x) const
{
    const Polar p = polar(x);
    const double inverse = p.radius > 0 ? 1 / p.radius : 0;
    Eigen::Matrix3d local;
    local << p.cosine, p.sine, 0, -p.sine * inverse, p.cosine * inverse, 0, 0,
        0, 1;
    return span_.cwiseInverse().asDiagonal() * local * axes_.transpose();
}


Vector3 CylindricalFrame::frameCoordinates(const Vector3& xi) const
{
    return start_ + xi.cwiseProduct(span_);
}


Vector3 CylindricalFrame::fromUnits(const Vector3& vector) const
{
    return Vector3(vector[0], vector[1] * pi / 180, vector[2]);
}

// * * * Eight corners

HexahedralFrame::HexahedralFrame(const std::array<Vector3, 8>& corners)
: corners_(corners),
  low_(corners[0]),
  high_(corners[0])
{
    for (const Vector3& corner : corners)
    {
        low_ = low_.cwiseMin(corner);
        high_ = high_.cwiseMax(corner);
    }

    // The determinant is of second degree in each coordinate; sampled finely,
    // since this is about input, not about round-off
    const int n = 8;
    for (int i = 0; i <= n; ++i)
    {
        for (int j = 0; j <= n; ++j)
        {
            for (int k = 0; k <= n; ++k)
            {
                if (!(frameJacobian(Vector3(i, j, k) / n).determinant() > 0))
                {
                    throw std::invalid_argument(
                        "the eight corners enclose no box: it is inside out"
                        " or folded somewhere. They are given in the order of"
                        " blockMesh's hex");
                }
            }
        }
    }
}


Vector3 HexahedralFrame::position(const Vector3& xi) const
{
    Vector3 x = Vector3::Zero();
    for (int i = 0; i < 8; ++i)
    {
        const double a = i & 1 ? xi[0] : 1 - xi[0];
        const double b = i & 2 ? xi[1] : 1 - xi[1];
        const double c = i & 4 ? xi[2] : 1 - xi[2];
        x += a * b * c * corners_[std::size_t(i)];
    }
    return x;
}


Vector3 HexahedralFrame::coordinates(const Vector3& x) const
{
    const Vector3 nowhere =
        Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
    const Vector3 span = high_ - low_;
    const Vector3 margin = 1e-6 * Vector3::Constant(span.norm());
    if (((x - low_ + margin).array() < 0).any()
        || ((high_ - x + margin).array() < 0).any())
    {
        return nowhere;
    }

    // Of the map where it is flat: dividing by it is trapped
    const double size =
        std::abs(frameJacobian(Vector3::Constant(0.5)).determinant());
    const int most = 50;
    Vector3 xi = Vector3::Constant(0.5);
    for (int i = 0; i < most; ++i)
    {
        const Eigen::Matrix3d J = frameJacobian(xi);
        if (!(std::abs(J.determinant()) > 1e-9 * size))
        {
            return nowhere;
        }
        const Vector3 step = J.partialPivLu().solve(x - position(xi));
        xi += step;
        if (!(xi.cwiseAbs().maxCoeff() < 100))
        {
            return nowhere;
        }
        if (step.cwiseAbs().maxCoeff() < 1e-14)
        {
            return xi;
        }
    }
    return (position(xi) - x).norm() < 1e-12 * span.norm() ? xi : nowhere;
}


Eigen::Matrix3d HexahedralFrame::gradient(const Vector3& x) const
{
    return frameJacobian(coordinates(x)).inverse();
}


Vector3 HexahedralFrame::frameCoordinates(const Vector3& xi) const
{
    return position(xi);
}


Vector3 HexahedralFrame::fromUnits(const Vector3& vector) const
{
    return vector;
}

} // namespace morph
