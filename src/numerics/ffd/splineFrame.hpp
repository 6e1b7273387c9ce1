// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A box of any shape: the volume that the control points of a lattice span.

#ifndef morph_splineFrame_hpp
#define morph_splineFrame_hpp

#include "ffdFrame.hpp"
#include "ffdLattice.hpp"

namespace morph
{

// X(xi) = sum_lmn b_l(s) b_m(t) b_n(p) P_lmn with the functions of the lattice
// that displaces it, so that x + d(xi) is the same sum of the moved control
// points: the position form of free-form deformation. Where a point is in the
// box is found by Newton's method.
class SplineFrame : public FfdFrame
{
public:
    // Clamped bases, and as many control points as they have functions, number
    // l + size_s (m + size_t n). Throws std::invalid_argument unless the map
    // is one to one
    SplineFrame(
        const std::array<BSpline, 3>& basis, const Vectors& controlPoints);

    // Not a number for points beyond the bounds of the control points, between
    // which the box lies
    Vector3 coordinates(const Vector3& x) const override;
    Vector3 position(const Vector3& xi) const override;
    Eigen::Matrix3d gradient(const Vector3& x) const override;
    Vector3 frameCoordinates(const Vector3& xi) const override;

    // In fractions of the mean lengths of the lattice from its first to its
    // last layer
    Vector3
    fromFractions(const Vector3& xi, const Vector3& fractions) const override;
    Vector3 fromUnits(const Vector3& vector) const override;

    Eigen::Matrix3d frameJacobian(const Vector3& xi) const override;
    const Vectors* controlPoints() const override { return &controlPoints_; }

private:
    // X and dX/dxi, beyond [0,1] linearly onwards
    void evaluate(
        const Vector3& xi, Vector3& position, Eigen::Matrix3d& jacobian) const;

    std::array<BSpline, 3> basis_;

    Vectors controlPoints_;

    Vector3 low_;
    Vector3 high_;

    // Of the lattice, as columns
    Eigen::Matrix3d span_;

    // Places to start from
    std::vector<Vector3> starts_;
    Vectors startPositions_;
};

} // namespace morph

#endif
