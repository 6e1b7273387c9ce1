/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionMaker.H"
#include "dictionaryChecks.H"
#include "subSteppedMotion.H"
#include "Time.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Most steps that 'subSteps auto' takes
static const label maxSubSteps = 32;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionMaker::motionMaker
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const controlPointGroups& groups,
    const rbfMotionSettings& settings,
    const motionZone& zone,
    rbfMotionState& state
)
:
    settings_(settings),
    problem_
    (
        mesh, dict, points0, groups, settings, zone, state.supportRadius()
    ),
    state_(state),
    oneStep_(problem_, state),
    formerIndex_(-1),
    first_(true)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::motionMaker::checkPointsOfMesh() const
{
    bool offMesh = false;
    for (label i = 0; i < problem_.controlPoints().nRegions(); ++i)
    {
        offMesh =
            offMesh
         || problem_.controlPoints().candidates(i).meshPoints.found(-1);
    }
    dictionaryChecks::stopIf
    (
        problem_.dict(),
        offMesh
      ? "Entry 'reference' is moving, but there are control points off the"
        " mesh, which a restart would not find\n"
        "    Use 'reference fixed', or points of the mesh"
      : ""
    );
}


Foam::rbfMotion Foam::motionMaker::moveInSteps
(
    const label n,
    const bool check
)
{
    const rbfMotion motion(subSteppedMotion(problem_).move(n, check));
    const label turned = motion.paths.turnsOver(ways_);
    dictionaryChecks::stopIf
    (
        problem_.dict(),
        turned >= 0
      ? "Control points '" + problem_.controlPoints().groupName(turned)
      + "' have turned by more than half a turn since the reference mesh:"
        " what turns the mesh least is now the other way around, to where it"
        " would jump\n"
        "    Use 'reference moving', which follows any turn, with 'optimise'"
        " for a mesh that lasts longer"
      : ""
    );
    ways_ = motion.paths;
    return motion;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::motionMaker::update()
{
    // After a write this run goes on as one that restarts from it does
    const bool rebuild = state_.wasWritten() || first_;
    const rbfMotionProblem::change changed = problem_.update(first_, rebuild);
    state_.setSupportRadius(problem_.radius());
    if (rebuild || changed.directions || changed.radius)
    {
        oneStep_.rebuild(changed.radius);
    }
    first_ = false;
}


bool Foam::motionMaker::active()
{
    if (!settings_.movingReference)
    {
        return oneStep_.active();
    }
    checkPointsOfMesh();

    // Outer correctors of a time step all start from the same mesh
    if (formerIndex_ != problem_.mesh().time().timeIndex())
    {
        formerIndex_ = problem_.mesh().time().timeIndex();
        const planarReduction& plane = problem_.reduced().plane();
        former_.setSize(problem_.points0().size());
        forAll(former_, pointi)
        {
            former_[pointi] =
                plane.position(problem_.mesh().points()[pointi])
              - plane.position(problem_.points0()[pointi]);
        }
    }
    return oneStep_.active() || gMax(mag(former_)) > 0;
}


Foam::rbfMotion Foam::motionMaker::move()
{
    if (settings_.movingReference)
    {
        return subSteppedMotion(problem_).moveOn
        (
            former_, settings_.onInvalidMesh != motionLimiter::policy::ignore
        );
    }
    const label n = settings_.subSteps;
    const bool check =
        settings_.onInvalidMesh != motionLimiter::policy::ignore;
    if (n > 1)
    {
        return moveInSteps(n, check);
    }

    // Where one step is valid this costs nothing: that is checked in any case
    const bool automatic = n == 0;
    rbfMotion one(oneStep_.move(check || automatic));
    if (!automatic || one.complete())
    {
        // What one step can make is no turn to go on from
        ways_ = motionPaths();
        return one;
    }
    rbfMotion motion(one);
    for
    (
        label more = 2;
        !motion.complete() && more <= maxSubSteps;
        more *= 2
    )
    {
        const motionTimes former(motion.times);
        motion = moveInSteps(more, check || more < maxSubSteps);
        motion.times += former;
    }
    if (!motion.complete() && !settings_.subStepsGiven)
    {
        // How far it goes is said of what was asked for: one step
        return one;
    }
    return motion;
}


bool Foam::motionMaker::optimise(rbfMotion& motion)
{
    if (settings_.optimise.never())
    {
        return false;
    }
    if (!optimised_.valid())
    {
        optimised_.reset(new optimisedMotion(problem_, problem_.points0()));
    }
    const vectorField before(motion.displacement);
    if (motion.complete())
    {
        optimised_->improve(motion);
    }
    else if (motion.nSteps == 1)
    {
        optimised_->untangle
        (
            motion, vectorField(motion.inPlane + motion.increment)
        );
    }
    else
    {
        const rbfMotion whole
        (
            subSteppedMotion(problem_).move(motion.nSteps, false)
        );
        optimised_->untangle(motion, whole.inPlane);
    }
    return returnReduce(motion.displacement != before, orOp<bool>());
}


void Foam::motionMaker::limit(rbfMotion& motion)
{
    if (motion.complete())
    {
        return;
    }
    const motionLimiter limiter(problem_.mesh(), problem_.dict(), settings_.onInvalidMesh);
    const scalar n = motion.nSteps;
    const motionLimiter::limit found = limiter.limitPart
    (
        problem_.points0() + motion.displacement,
        problem_.expand(motion.increment)(),
        {motion.nMade/n, (motion.nMade + 1)/n, motion.nSteps},
        settings_.movingReference
      ? string
        (
            "Make the time step smaller, or add 'optimise {}', which untangles"
            " the mesh"
        )
      : problem_.remedy()
    );
    if (settings_.movingReference)
    {
        motion.fraction = found.fraction;
        motion.inPlane += found.fraction*motion.increment;
        motion.displacement = problem_.expand(motion.inPlane);
    }
    else if (motion.nSteps == 1)
    {
        oneStep_.makePart(motion, found.fraction);
    }
    else
    {
        subSteppedMotion(problem_).makePart(motion, found.fraction);
    }
    limiter.note(found, motion.fraction);
}


// ************************************************************************* //
