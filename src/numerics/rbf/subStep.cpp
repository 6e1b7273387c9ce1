// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A selection and an evaluation in an intermediate mesh

#include "subStep.hpp"
#include "exactSurface.hpp"

namespace morph
{

SubStep subStep(
    const SubStepSettings& settings, const ControlPoints& conditions,
    const Vectors& reached, const int steps,
    const GreedySelection::Renewal& renewal, const Vectors& positions,
    Communicator& communicator)
{
    ControlPoints whole = conditions;
    ControlPoints part = conditions;
    const auto divide = [&]()
    {
        for (Index i = 0; i < Index(part.size()); ++i)
        {
            const bool atOnce = settings.slideAtOnce && whole[i].slides();
            part[i].value = whole[i].residual(reached.row(i).transpose())
                / (atOnce ? 1 : steps);
        }
    };
    for (Index i = 0; i < Index(part.size()); ++i)
    {
        part[i].position += reached.row(i).transpose();
    }
    divide();

    SubStep step;
    const auto selection = std::make_shared<GreedySelection>(
        settings.kernel, settings.polynomial, settings.selection,
        settings.images);
    step.selection = selection;
    if (renewal)
    {
        const auto renewPart = [&](const Vectors& s, ControlPoints& points)
        {
            renewal(reached + s, whole);
            divide();
            for (Index i = 0; i < Index(points.size()); ++i)
            {
                points[i].value = part[i].value;
            }
        };
        ControlPoints candidates = part;
        step.result = selection->select(
            candidates, communicator, GreedySelection::Renewal(renewPart));
    }
    else
    {
        step.result = selection->select(part, communicator);
    }

    step.displacements = selection->interpolant()(PointCloud(positions));
    const double radius =
        step.result.rough ? settings.roughRadius : settings.correctionRadius;
    if (radius > 0)
    {
        ExactSurface correction(radius, settings.images);
        correction.add(
            part, selection->residuals(part), communicator, positions,
            step.displacements);
    }
    step.candidates = std::make_shared<ControlPoints>(std::move(part));
    return step;
}

} // namespace morph
