// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The system of Mastrippolito et al. (2019), doi:10.1108/EC-06-2018-0265, as
// the paper has it. Used by the reference algorithms; gramFactor.hpp is the
// efficient form.

#ifndef morph_referenceSystem_hpp
#define morph_referenceSystem_hpp

#include "controlPoints.hpp"
#include "kernel.hpp"

namespace morph
{

// Rows of equation (6) for the conditions of n points, columns for the weights
// of m points: 3 n x 3 m, point after point. Per point k rows
// C^T sum_j phi_ij gamma_j, and 3 - k rows t . gamma_i = 0 (4, 5). The latter
// are there only where both are the same list, same = true.
Matrix referenceSystem(
    const Kernel& kernel, const ControlPoints& conditions,
    const ControlPoints& weights, bool same);

// Its right-hand side: g, and zero in the rows of (4, 5)
Matrix paperValues(const ControlPoints& conditions);

// Weights 3 n x 1, point after point, as n x 3
Columns paperWeights(const Matrix& gamma);

// Is a factorised matrix singular to round-off?
template <class LU>
bool singular(const LU& lu)
{
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    return !(pivots.minCoeff() > 1e-14 * pivots.maxCoeff());
}

} // namespace morph

#endif
