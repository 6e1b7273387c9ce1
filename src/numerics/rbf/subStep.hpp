// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// One of several steps of a motion, starting where the previous one left the
// points.

#ifndef morph_subStep_hpp
#define morph_subStep_hpp

#include "communicator.hpp"
#include "greedySelection.hpp"

namespace morph
{

struct SubStepSettings
{
    Kernel kernel;
    Polynomial polynomial;
    SelectionSettings selection;

    // Largest radius of the surface correction [m], 0 for none
    // (exactSurface.hpp)
    double correctionRadius;

    // The same where a rough tolerance of the selection has to do
    double roughRadius;

    ImageGroup images = ImageGroup();

    // Are points that slide on their surfaces, and stay so in every step? Otherwise
    // they get there in equal parts, as to surfaces elsewhere
    bool slideAtOnce = false;
};

struct SubStep
{
    // At the positions that were given: m x 3 [m]
    Vectors displacements;

    SelectionResult result;

    // Of the control points, with errors and weights of this step, and what
    // it selected from: the control points where they were
    std::shared_ptr<const GreedySelection> selection;
    std::shared_ptr<const ControlPoints> candidates;
};


// One step at the given positions (m x 3).
//
// The control points have moved by what was reached (n x 3), and so have the
// kernels about them: the field is one of the intermediate mesh. What each of
// their conditions, which are those of the whole motion, still lacks is made
// up in equal parts by this and the remaining steps:
//
//     C^T s = (g - C^T reached)/steps
//
// so that prescribed points go in a straight line, and the last step (1) meets
// every condition. A renewal, if any, receives the displacements since the
// beginning of the motion.
//
// positions: of the points, in the intermediate mesh
// steps: this one and those that remain
// Throws as GreedySelection does. Collective.
SubStep subStep(
    const SubStepSettings& settings, const ControlPoints& conditions,
    const Vectors& reached, int steps, const GreedySelection::Renewal& renewal,
    const Vectors& positions, Communicator& communicator);

} // namespace morph

#endif
