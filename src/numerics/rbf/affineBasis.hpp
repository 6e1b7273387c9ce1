// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear polynomial of an interpolant, carried by a few of its points.

#ifndef morph_affineBasis_hpp
#define morph_affineBasis_hpp

#include "arrays.hpp"

namespace morph
{

// Affine functions on the span of up to four points x_u (a point, line, plane
// or all space), as the Lagrange functions l_u of these points:
// l_u(x_v) = delta_uv, and sum_u l_u(x) p(x_u) = p(x) for every affine p (where
// the points span less than the space, for every p that is constant normal to
// their span).
class AffineBasis
{
public:
    // No polynomial at all
    AffineBasis() = default;

    // nodes: r x 3, 1 <= r <= 4, affinely independent [m]
    explicit AffineBasis(const Columns& nodes);

    // r
    Index size() const { return nodes_.rows(); }

    const Columns& nodes() const { return nodes_; }

    // l_u(x_i): n x r
    Matrix values(const Columns& x) const;

    // The gradient of sum_u l_u v_u: 3 x 3, entry (a, b) = d p_b / d x_a.
    // v: r x 3
    Eigen::Matrix3d gradient(const Matrix& v) const;

    // Distance from x to the span of the nodes [m]
    double distance(const Vector3& x) const;

private:
    Columns nodes_;

    // Gradients of the Lagrange functions: 3 x r
    Matrix gradients_;

    // Orthonormal basis of the directions of the span: 3 x (r - 1)
    Matrix span_;
};

} // namespace morph

#endif
