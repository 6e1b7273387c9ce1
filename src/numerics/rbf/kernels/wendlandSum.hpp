// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The loop over pairs of kernelSum.hpp for Wendland's functions and AVX-512.

#ifndef morph_wendlandSum_hpp
#define morph_wendlandSum_hpp

#include "kernelSum.hpp"

namespace morph
{

// With one square root per pair, the square-root unit is the bottleneck. The
// distances of some centres (CentreGroup) are computed by multiplications
// instead, from an approximate reciprocal root: within 1.1 units in the last
// place, and zero at the centre. Which centres these are depends on their place
// among all alone, so that a point's sum does not depend on the points and
// centres beside it.

// Does the sum below support this function and this machine?
bool hasWendlandSum(KernelType type);

// As addKernelSum
void addWendlandSum(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const double* const weights[3],
    const std::vector<CentreGroup>& groups, double* const sums[3]);

} // namespace morph

#endif
