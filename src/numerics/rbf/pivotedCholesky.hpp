// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Chooses points of a short list.

#ifndef morph_pivotedCholesky_hpp
#define morph_pivotedCholesky_hpp

#include "controlSystem.hpp"

#include <functional>

namespace morph
{

// Pivots below this fraction of their scale are round-off
constexpr double leastPivot = 1e-12;

// The columns of a symmetric matrix that belong to some points of a list
using ColumnsOfPoints = std::function<Matrix(const std::vector<Index>&)>;

// The standard greedy algorithm on a list alone: a Cholesky factorisation,
// block by block, of the system W that what is selected leaves for the points
// of the list, each pivot the point with the largest error left. Choosing a
// point also removes its influence on the others of the list.
//
// system: W by its columns; first: the first row of each point in it, and the
// end; r: the residuals, with one row for each of W; scale:
// of each point's pivot. most, least and outside: see ControlSystem::choose().
ControlSystem::Choice pivotedCholesky(
    const ColumnsOfPoints& system, const std::vector<Index>& first,
    const Matrix& r, const std::vector<double>& scale, Index most, double least,
    double outside);

} // namespace morph

#endif
