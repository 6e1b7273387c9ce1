// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The two loops over pairs of points that take most of the time.

#ifndef morph_kernelSum_hpp
#define morph_kernelSum_hpp

#include "arrays.hpp"
#include "kernel.hpp"

#include <vector>

namespace morph
{

// Points are summed in blocks of this size, always whole ones: a point's sum
// then never depends on its place in a block, which makes the result
// independent of how points are distributed.
constexpr Index blockSize = 32;

// Centres that are summed apart from those of other groups. Where weights
// cancel, most additions are then of numbers smaller than the largest partial
// sum, and the round-off is half.
struct CentreGroup
{
    // Those begin <= j < end ...
    Index begin;
    Index end;

    // ... and others, whose distances may be made without the square root
    // (wendlandSum.hpp)
    Index rootlessBegin;
    Index rootlessEnd;

    bool empty() const { return begin == end && rootlessBegin == rootlessEnd; }
};

// Best sizes: round-off against the time of changing groups, and one in four
// without a root
constexpr Index groupSize = 64;
constexpr Index rootsOfGroup = 48;

// Adds sum_j phi(|x_i - c_j|/r0) w_j to s_i for the points i of whole blocks,
// over the centres j of some groups, each of which begins (both its ranges)
// where the one before ends.
//
// points, sums: n x 3 columns (n a multiple of blockSize) given by the pointers
// to their columns; centres, weights: likewise. Positions are in units of the
// support radius.
void addKernelSum(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const double* const weights[3],
    const std::vector<CentreGroup>& groups, double* const sums[3]);

// The weights of a field and its sums, n x 3 columns each
struct FieldSum
{
    const double* weights[3];
    double* sums[3];
};

// The same for several fields, whose kernel is evaluated once. The groups are
// ranges of centres, without others
void addKernelSums(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const std::vector<FieldSum>& fields,
    const std::vector<CentreGroup>& groups);

// phi(|a_i - b_j|/r0) of all pairs (n x m) of positions in metres
Matrix kernelMatrix(const Kernel& kernel, const Columns& a, const Columns& b);

} // namespace morph

#endif
