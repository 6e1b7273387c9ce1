// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The control points that carry the linear polynomial.

#ifndef morph_polynomialNodes_hpp
#define morph_polynomialNodes_hpp

#include "candidateList.hpp"
#include "kernel.hpp"

namespace morph
{

// Up to four moving or fixed points, as far apart as possible: the first by
// position, then each the farthest from the span of the others. The same on
// every rank; collective. Throws std::invalid_argument where the candidates of
// all ranks cannot carry what the kernel needs.
std::vector<Candidate> polynomialNodes(
    const Kernel& kernel, const ControlPoints& candidates, Index most,
    Communicator& communicator);

// Positions of listed points: n x 3
Columns positions(const std::vector<Candidate>& points);

} // namespace morph

#endif
