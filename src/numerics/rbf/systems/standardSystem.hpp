// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The standard greedy algorithm's system.

#ifndef morph_standardSystem_hpp
#define morph_standardSystem_hpp

#include "controlSystem.hpp"
#include "kernel.hpp"

namespace morph
{

// Assembles the paper's system (6) anew and factorises it by LU whenever a
// point was added (Aubert et al. 2017, doi:10.1016/j.proeng.2017.09.819,
// algorithm 2). A reference: the cost of n points grows as n^4.
class StandardSystem : public ControlSystem
{
public:
    explicit StandardSystem(const Kernel& kernel);

    std::vector<bool> append(
        const std::vector<Candidate>& list,
        const std::vector<Index>& chosen) override;

    void setValues(const std::vector<Vector3>& values) override;

    void solve(RbfInterpolant& interpolant) override;

private:
    Kernel kernel_;
    ControlPoints points_;
    Matrix gamma_;
};

} // namespace morph

#endif
