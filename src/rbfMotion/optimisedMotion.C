/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "optimisedMotion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Points that slide keep to their surfaces
class controlledFreedom
:
    public pointFreedom
{
    const rbfMotionProblem& problem_;

public:

    explicit controlledFreedom(const rbfMotionProblem& problem)
    :
        pointFreedom
        (
            problem.mesh(),
            problem.points0(),
            problem.reduced(),
            problem.slidingPatches(),
            problem.staying()
        ),
        problem_(problem)
    {
        stop(problem.controlPoints().prescribed());
    }

    virtual void project
    (
        const vectorField& displacement,
        vectorField& velocity
    ) const override
    {
        problem_.controlPoints().restrict(displacement, velocity);
        pointFreedom::project(displacement, velocity);
    }

    virtual void retract(vectorField& displacement) const override
    {
        pointFreedom::retract(displacement);
        problem_.constrain(displacement);
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::optimisedMotion::optimisedMotion
(
    rbfMotionProblem& problem,
    const pointField& target
)
:
    problem_(problem),
    freedom_(new controlledFreedom(problem)),
    optimiser_
    (
        problem.mesh(), problem.settings().optimise, target, problem.reduced()
    )
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::optimisedMotion::improve(rbfMotion& motion) const
{
    if (optimiser_.improve(freedom_(), problem_.points0(), motion.inPlane))
    {
        motion.displacement = problem_.expand(motion.inPlane);
    }
}


void Foam::optimisedMotion::untangle
(
    rbfMotion& motion,
    const vectorField& whole
) const
{
    vectorField inPlane(whole);
    if (!optimiser_.improve(freedom_(), problem_.points0(), inPlane))
    {
        return;
    }
    const vectorField displacement(problem_.expand(inPlane));
    if (problem_.isValid(displacement))
    {
        motion.nMade = motion.nSteps;
        motion.fraction = 1;
        motion.increment.clear();
        motion.inPlane = inPlane;
        motion.displacement = displacement;
    }
}


// ************************************************************************* //
