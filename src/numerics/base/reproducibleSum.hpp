// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Sums that are the same to the last bit, however their terms are ordered or
// distributed over ranks.
//
// Each term is rounded to a multiple of 2^-61 of the (power of two above the)
// largest; these integers are added exactly. For sums of squares that is more
// accurate than a sum of doubles (Demmel, Nguyen 2015, doi:10.1109/TC.2014.2345391,
// with integers in place of bins).

#ifndef morph_reproducibleSum_hpp
#define morph_reproducibleSum_hpp

#include "communicator.hpp"

#include "arrays.hpp"

namespace morph
{

// The sum of x_i over all ranks; not a number if a term is not finite.
// Collective
double reproducibleSum(const double* x, Index n, Communicator& communicator);

// The sum of x_i y_i over all ranks. Collective
double reproducibleDot(
    const double* x, const double* y, Index n, Communicator& communicator);

} // namespace morph

#endif
