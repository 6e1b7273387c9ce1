// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Bernstein polynomials of one variable on [0,1].

#ifndef morph_bernstein_hpp
#define morph_bernstein_hpp

#include "arrays.hpp"

namespace morph
{

// The values b_i(s) = C(n,i) s^i (1 - s)^(n - i), i = 0..n, by the recurrence
// b_i^n = (1 - s) b_i^(n-1) + s b_(i-1)^(n-1), which only adds positive numbers
// (Farin, Curves and Surfaces for CAGD, ch. 6). row: n + 1 entries
void bernsteinRow(Index n, double s, double* row);

// n over i, exact as long as it is below 2^53
double binomial(Index n, Index i);

} // namespace morph

#endif
