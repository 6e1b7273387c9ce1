// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A control lattice: the displacement of points by its control points.

#ifndef morph_ffdLattice_hpp
#define morph_ffdLattice_hpp

#include "bSpline.hpp"

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <vector>

namespace morph
{

// Depends on the positions of points: three short rows of basis values per
// point
struct LatticeRows
{
    // Number of points
    Index size = 0;

    // Per point the first function of each direction
    std::vector<std::int32_t> first;

    // Per point the rows of the three directions, one after the other
    std::vector<double> values;

    // Rational: per point 1/sum(w b); empty otherwise
    std::vector<double> scale;
};


// The displacement d(xi) = sum_lmn b_l(s) b_m(t) b_n(p) d_lmn, or with weights
// sum b w d / sum b w (Sederberg and Parry 1986 in displacement form; with
// weights Lamousin and Waggenspack 1994). Control point (l,m,n) is number
// l + size_s (m + size_t n).
class FfdLattice
{
public:
    // weights: none, or a positive one for each control point. Throws
    // std::invalid_argument if they are not
    explicit FfdLattice(
        const std::array<BSpline, 3>& basis,
        const std::vector<double>& weights = {});

    const BSpline& basis(int direction) const
    {
        return basis_[std::size_t(direction)];
    }

    bool rational() const { return !weights_.empty(); }

    const std::vector<double>& weights() const { return weights_; }

    // Number of control points
    Index size() const;

    Index number(Index l, Index m, Index n) const;

    // The offline part. xi: n x 3
    LatticeRows rows(const Vectors& xi) const;

    // The online part: n x 3, in the units of the control points'
    // displacements (size() x 3). Exactly zero where those that matter are
    Vectors displacement(const LatticeRows& rows, const Vectors& control) const;

    // The transposed map: what displacement() has by the control points of
    // sum_i g_i . d_i for vectors g at the points (n x 3): size() x 3
    Vectors transposed(const LatticeRows& rows, const Vectors& g) const;

    // At one point; its derivative by xi in the columns of the matrix
    Vector3 displacement(const Vector3& xi, const Vectors& control) const;

    Eigen::Matrix3d gradient(const Vector3& xi, const Vectors& control) const;

private:
    // With neighbours over the seam of a periodic direction: four numbers each
    // (three components times weight, and nothing)
    std::vector<double> extended(const Vectors& control) const;

    // 1/sum(w b)
    double scale(const std::int32_t* first, const double* row) const;

    std::array<BSpline, 3> basis_;

    std::vector<double> weights_;
};

} // namespace morph

#endif
