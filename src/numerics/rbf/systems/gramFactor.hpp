// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear system of the selected control points, factorised as it grows.

#ifndef morph_gramFactor_hpp
#define morph_gramFactor_hpp

#include "affineBasis.hpp"
#include "controlPoints.hpp"
#include "growingMatrix.hpp"
#include "blockTriangularFactor.hpp"
#include "kernel.hpp"
#include "rbfInterpolant.hpp"

namespace morph
{

// Weights gamma_j = C_j alpha_j turn the conditions C_i^T s(x_i) = g_i into
//
//     G alpha = g,   G_ij = phi_ij C_i^T C_j,
//
// symmetric positive definite. With M the fully prescribed points and S the
// sliding ones, M is eliminated with the *scalar* kernel, three right-hand
// sides at once, and only the Schur complement T of S carries directions:
//
//     phi_MM = L L^T,  z = L^-1 d_M,  Y = L^-1 phi_MS,  T = phi_SS - Y^T Y
//     H_ij = T_ij C_i^T C_j = R R^T,  R R^T alpha = g_S - C_S^T (Y^T z)
//     gamma_S = C_S alpha,  gamma_M = L^-T (z - Y gamma_S)
//
// Appending points adds rows to these factors; nothing is factorised anew but
// H when M grows.
//
// A linear polynomial comes in through the kernel. With l_u the Lagrange
// functions of a few fully prescribed nodes x_u (affineBasis.hpp),
//
//     K(x,y) = phi(x,y) - l_u(x) phi(x_u,y) - phi(x,x_u) l_u(y)
//            + l_u(x) phi(x_u,x_v) l_v(y)
//
// is positive definite away from the nodes also where phi is only conditionally
// so (Wendland 2005, ch. 10.5), and interpolating what is left of the data
// after the nodes' polynomial is the interpolation with side conditions
// sum_j gamma_j q(x_j) = 0 for all linear q, those of sliding points included.
class GramFactor
{
public:
    // Without a polynomial; kernels of conditional order need one
    explicit GramFactor(const Kernel& kernel);

    // With a linear polynomial on the nodes of the basis, whose displacements
    // are nodeValues: r x 3 [m]
    GramFactor(
        const Kernel& kernel, const AffineBasis& basis,
        const Matrix& nodeValues);

    // Control points appended (the nodes of the polynomial do not count)
    Index size() const { return entries_.size(); }

    // All centres: nodes of the polynomial, then M, then S: n x 3
    Columns centres() const;

    // The system that is left for further points once those appended are
    // eliminated, W = G_KK - G_KA G_AA^-1 G_AK: what its columns, and appending
    // the points, are computed from. Where neither the list nor those appended
    // slide, one row of W stands for the three of a point.
    struct Residual
    {
        std::vector<Index> offset; // first row of each point, and the end
        bool scalar;

        Matrix Y; // L^-1 K_MK
        Matrix Q; // R^-1 of K_SK - Y_S^T Y with its directions
    };
    Residual residual(const ControlPoints& list) const;

    // The columns of W that belong to some points of the list. W whole would be
    // larger than the factors themselves
    Matrix columns(
        const ControlPoints& list, const Residual& residual,
        const std::vector<Index>& which) const;

    // Appends points of a list and tells which of them are in: those with
    // which the system would be singular to round-off are left out. Takes the
    // residual, to make room.
    std::vector<bool> append(
        const ControlPoints& list, const std::vector<Index>& which,
        Residual&& residual);

    // Appends all points of a list
    std::vector<bool> append(const ControlPoints& list);

    // New prescribed values for the points, in the order they were appended,
    // and for the nodes of the polynomial
    void
    setValues(const std::vector<Vector3>& values, const Matrix& nodeValues);

    // Solves for the weights and hands them to the interpolant
    void solve(RbfInterpolant& interpolant) const;

    // Scale of the pivot of a point at x: a bound of the terms of K(x, x), of
    // which round-off is a fraction also beside a node, where they cancel
    double pivotScale(const Vector3& x) const;

private:
    struct Entry
    {
        bool slides;
        Index index;
    };

    Matrix kernelBlock(const Columns& a, const Columns& b) const;
    Matrix besideSliding(const Columns& x, const Matrix& Y) const;
    bool
    appendPrescribed(const ControlPoints& points, const Matrix& Y, Matrix& l);
    bool appendSliding(
        const ControlPoints& points, const Matrix& Y, const Matrix& Q);
    Matrix shift(const Columns& x) const;

    Kernel kernel_;
    AffineBasis basis_;
    Matrix nodeValues_;
    Matrix nodeKernel_;

    std::vector<Entry> entries_;

    // M
    ControlPoints prescribed_;
    Columns xM_;
    BlockTriangularFactor L_;

    // S
    ControlPoints sliding_;
    Columns xS_;
    GrowingMatrix Y_;
    Matrix T_; // lower triangle
    BlockTriangularFactor R_;
};

} // namespace morph

#endif
