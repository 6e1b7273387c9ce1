// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The system of the paper's improved greedy algorithm.

#ifndef morph_schurSystem_hpp
#define morph_schurSystem_hpp

#include "controlSystem.hpp"
#include "kernel.hpp"

#include <Eigen/LU>

namespace morph
{

// Algorithm 2 of Mastrippolito et al. (2019), doi:10.1108/EC-06-2018-0265, as
// printed: the kernel between all candidates, Phi^c (16), is assembled
// beforehand; the LU factors of the N_g points at the last restart are kept,
// and N_a points are added through the Schur complement (27)-(29) until N_a
// reaches a fraction of N_g, which is the next restart. A reference: Phi^c
// takes 8 N_c^2 bytes, over all ranks.
class SchurSystem : public ControlSystem
{
public:
    // restartFraction: N_res/N_g. candidates: those of this rank. Collective.
    // Throws std::runtime_error if Phi^c does not fit into memory.
    SchurSystem(
        const Kernel& kernel, double restartFraction,
        const ControlPoints& candidates, Communicator& communicator);

    std::vector<bool> append(
        const std::vector<Candidate>& list,
        const std::vector<Index>& chosen) override;

    void setValues(const std::vector<Vector3>& values) override;

    void solve(RbfInterpolant& interpolant) override;

    Vectors evaluate(
        const RbfInterpolant& interpolant,
        const PointCloud& candidates) const override;

private:
    bool restart();
    bool solveBlocks();

    Kernel kernel_;
    double restartFraction_;

    // Phi^c: this rank's candidates x all candidates, and where those of each
    // rank begin
    Matrix phi_;
    std::vector<Index> firstOfRank_;
    std::vector<Index> column_;

    // N_g points in the LU factors, and N_a added since
    ControlPoints kept_;
    ControlPoints added_;
    Eigen::PartialPivLU<Matrix> lu_;

    // Weights of kept_ without those added, (Gamma^g)' of (17)
    Matrix keptAlone_;

    Matrix gamma_;
};

} // namespace morph

#endif
