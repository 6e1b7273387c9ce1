// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear system of the control points selected so far.

#ifndef morph_controlSystem_hpp
#define morph_controlSystem_hpp

#include "candidateList.hpp"
#include "pointCloud.hpp"
#include "rbfInterpolant.hpp"

namespace morph
{

// The interface between greedy selection and its linear system; algorithms
// differ in how they solve it.
class ControlSystem
{
public:
    virtual ~ControlSystem() = default;

    // Indices into a list of candidates
    struct Choice
    {
        std::vector<Index> taken;
        std::vector<Index> singular; // can never be taken
    };

    // Candidates of the list to append next, at most `most`. The first of the
    // list, the worst, is tried in any case; others only while the errors left
    // in the list exceed `least`, and once one is taken also `outside`.
    // This default takes the first alone, and leaves it to append() to find
    // out whether the system is singular with it.
    virtual Choice choose(
        const std::vector<Candidate>& /* list */, Index /* most */,
        double /* least */, double /* outside */
    )
    {
        Choice choice;
        choice.taken.push_back(0);
        return choice;
    }

    // Appends the chosen points of the list and returns which were accepted:
    // points with which the system would be singular to round-off are left out.
    // After choose() it must be the list chosen from.
    virtual std::vector<bool> append(
        const std::vector<Candidate>& list,
        const std::vector<Index>& chosen) = 0;

    // New prescribed values for the points, in the order they were appended
    virtual void setValues(const std::vector<Vector3>& values) = 0;

    // Solves for the weights and hands them to the interpolant
    virtual void solve(RbfInterpolant& interpolant) = 0;

    // The interpolant that was solved for, at this rank's candidates: n x 3
    virtual Vectors evaluate(
        const RbfInterpolant& interpolant, const PointCloud& candidates) const
    {
        return interpolant(candidates);
    }
};

} // namespace morph

#endif
