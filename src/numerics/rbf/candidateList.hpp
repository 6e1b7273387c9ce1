// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The short list of candidates from which a sweep takes its points.

#ifndef morph_candidateList_hpp
#define morph_candidateList_hpp

#include "communicator.hpp"
#include "controlPoints.hpp"

namespace morph
{

// A candidate as known to all ranks
struct Candidate
{
    ControlPoint point;
    Vector3 residual; // g - C^T s, its first k entries
    double error;     // |residual|
    int rank;         // its rank
    Index index;      // and its index there

    // Larger errors first, then by position
    static bool precedes(const Candidate& a, const Candidate& b);
};

// The errors of a rank's candidates after a sweep
struct Errors
{
    Vectors residuals;           // n x 3
    std::vector<double> norms;   // n
    std::vector<char> available; // n: neither selected nor rejected
};

// The candidate with the largest error over all ranks, if it exceeds `least`.
// Every rank sends one. Collective.
std::vector<Candidate> worstCandidate(
    const ControlPoints& candidates, const Errors& errors, double least,
    Communicator& communicator);

// The `length` candidates of all ranks with the largest errors above `least`,
// at most one per cell of size `cell` [m] (none if zero); sorted, the same on
// every rank whatever the distribution. `outside` receives the largest error of
// those left out, zero if there are none. `largest` is the largest error of all
// ranks.
//
// A histogram of the errors of all ranks tells each rank what it need not send:
// together they send hardly more than the list holds. Collective.
std::vector<Candidate> candidateList(
    const ControlPoints& candidates, const Errors& errors, double least,
    Index length, double cell, double largest, Communicator& communicator,
    double& outside);

// The candidates of all ranks at the given positions, to the last bit, in that
// order: the same on every rank whatever the distribution. Of several at one
// position the one with most conditions. Residuals and errors are not set.
// Throws std::invalid_argument, on all ranks, where a position has none;
// collective.
std::vector<Candidate> candidatesAt(
    const ControlPoints& candidates, const std::vector<Vector3>& positions,
    Communicator& communicator);

} // namespace morph

#endif
