// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// How much simplices (triangles, tetrahedra) are distorted against a target
// shape, with the exact derivative.
//
// With the edges W of the target and E of the simplex as columns, J = E W^-1,
// D = det J and d the dimension,
//
//     chi = (D + sqrt(epsilon^2 + D^2))/2
//     mu  = [ tr(J^T J)/(d chi^(2/d)) + lambda (D^2 + 1)/(2 chi) ]
//         / (1 + lambda)
//
// which is 1 for the target, turned or shifted, and larger for anything else.
// A folded simplex, D < 0, has a finite value that falls towards D > 0.
//
// Garanzha, V., Kaporin, I., Kudryavtseva, L., Protais, F., Ray, N., Sokolov, D.
// (2021). Foldover-free maps in 50 lines of code. ACM Transactions on Graphics
// 40(4), 102. doi:10.1145/3450626.3459847

#ifndef morph_simplexEnergy_hpp
#define morph_simplexEnergy_hpp

namespace morph
{

// Simplices that are computed at once: entry k of component i is at
// [i*simplexLanes + k]. All are always computed, so that every one takes the
// same way through the same instructions
constexpr int simplexLanes = 32;

struct SimplexBlock
{
    // Edges from the first corner to the others, of target and simplex:
    // component j of edge i is at (i*d + j)
    double target[9 * simplexLanes];
    double edges[9 * simplexLanes];

    // mu, and its derivative by the components of edges
    double mu[simplexLanes];
    double derivative[9 * simplexLanes];

    // D
    double determinant[simplexLanes];
};

struct SimplexSettings
{
    // lambda
    double sizeWeight = 1;

    double epsilonSquared = 1e-12;
};

// Compute mu, its derivative and D of d-dimensional simplices, d = 2 or 3.
// Targets must not be flat
void evaluateSimplices(
    int dimension, const SimplexSettings& settings, SimplexBlock& block);

} // namespace morph

#endif
