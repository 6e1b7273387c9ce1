// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The system of incremental greedy selection.

#ifndef morph_incrementalSystem_hpp
#define morph_incrementalSystem_hpp

#include "controlSystem.hpp"
#include "gramFactor.hpp"

namespace morph
{

// Keeps the factors of GramFactor and appends to them.
//
// Offered one candidate at a time, it gives the set of the standard greedy
// algorithm. Offered a list of bad candidates, it runs that algorithm on the
// list alone, with the Schur complement of the list (GramFactor::residual) in
// place of the system: a Cholesky factorisation, block by block, each pivot
// the point with the largest error left. A point chosen so takes its influence
// on the others of the list with it, and about as many points are selected in
// a tenth of the sweeps.
class IncrementalSystem : public ControlSystem
{
public:
    // nodes, nodeValues: r x 3, those of a linear polynomial; r = 0 for none.
    // The nodes are the first points of the system
    IncrementalSystem(
        const Kernel& kernel, const Columns& nodes, const Matrix& nodeValues);

    Choice choose(
        const std::vector<Candidate>& list, Index most, double least,
        double outside) override;

    std::vector<bool> append(
        const std::vector<Candidate>& list,
        const std::vector<Index>& chosen) override;

    void setValues(const std::vector<Vector3>& values) override;

    void solve(RbfInterpolant& interpolant) override;

private:
    Index nNodes_;
    GramFactor factor_;

    // Of the list last chosen from, until something of it is appended
    ControlPoints points_;
    GramFactor::Residual residual_;
};

} // namespace morph

#endif
