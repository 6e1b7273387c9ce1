/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "oneStepMotion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// How often a part of a motion is made shorter, each time by a tenth
static const label mostTries = 32;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::oneStepMotion::oneStepMotion
(
    rbfMotionProblem& problem,
    rbfMotionState& state
)
:
    problem_(problem),
    state_(state),
    fields_(problem.reduced().nRegions()),
    first_(true)
{
    forAll(fields_, regioni)
    {
        fields_.set(regioni, new rbfField(problem, regioni));
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::oneStepMotion::rebuild(const bool newRadius)
{
    // A restart does not know directions that change from step to step
    const bool restore =
        !newRadius && !problem_.controlPoints().surfacesMove();
    for (rbfField& field : fields_)
    {
        std::vector<morph::Vector3> positions;
        if (restore && first_)
        {
            positions = state_.positionsAmong
            (
                field.region(),
                problem_.controlPoints().candidates(field.region()).conditions
            );
        }
        else if (restore)
        {
            positions = field.selectedPositions();
        }
        field.restart(positions);
    }
}


bool Foam::oneStepMotion::active() const
{
    bool some = false;
    for (const rbfField& field : fields_)
    {
        some = field.active() || some;
    }
    return some;
}


Foam::rbfMotion Foam::oneStepMotion::move(const bool check)
{
    rbfMotion motion;
    motion.inPlane.setSize(problem_.points0().size(), Zero);
    for (rbfField& field : fields_)
    {
        if (field.active())
        {
            field.select(motion, first_);
            if (problem_.controlPoints().surfacesMove())
            {
                state_.clearPositions(field.region());
            }
            else
            {
                state_.setPositions(field.region(), field.selectedPositions());
            }
            motion.times.lap(motionTimes::selection);
            field.propagate(motion.inPlane);
            motion.times.lap(motionTimes::propagation);
        }
    }
    first_ = false;
    problem_.constrain(motion.inPlane);
    motion.displacement.transfer(problem_.expand(motion.inPlane).ref());
    motion.times.lap(motionTimes::propagation);

    if (!check || problem_.isValid(motion.displacement))
    {
        motion.nMade = 1;
        motion.fraction = 1;
    }
    else
    {
        motion.increment.transfer(motion.inPlane);
        motion.inPlane = vectorField(motion.increment.size(), Zero);
        motion.displacement = Zero;
    }
    motion.times.lap(motionTimes::meshCheck);
    return motion;
}


void Foam::oneStepMotion::makePart
(
    rbfMotion& motion,
    const scalar fraction
) const
{
    motion.fraction = fraction;
    if (problem_.controlPoints().follow())
    {
        // A fraction of a displacement along its chord leaves a curved surface
        scalar part = fraction;
        for (label i = 0; i < mostTries; ++i)
        {
            motion.inPlane = part*motion.increment;
            problem_.constrain(motion.inPlane, part);
            motion.displacement = problem_.expand(motion.inPlane);
            if (problem_.isValid(motion.displacement))
            {
                motion.fraction = part;
                return;
            }
            part *= 0.9;
        }
    }
    motion.displacement = problem_.expand(motion.increment);
    motion.displacement *= fraction;
}


// ************************************************************************* //
