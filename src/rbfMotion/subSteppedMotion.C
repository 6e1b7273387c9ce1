/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "subSteppedMotion.H"
#include "eigenFields.H"
#include "pstreamCommunicator.H"
#include "subStep.hpp"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// How often a part of a motion is made shorter, each time by a tenth
static const label mostTries = 32;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::subSteppedMotion::subSteppedMotion(rbfMotionProblem& problem)
:
    problem_(problem)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

morph::Vectors Foam::subSteppedMotion::reachedByCandidates
(
    const label regioni,
    const rbfMotion& motion
) const
{
    const controlCandidates& candidates =
        problem_.controlPoints().candidates(regioni);
    const scalar fraction = scalar(motion.nMade)/motion.nSteps;

    // Points off the mesh are prescribed
    morph::Vectors reached(candidates.size(), 3);
    forAll(candidates.meshPoints, i)
    {
        const label pointi = candidates.meshPoints[i];
        const morph::Vector3 s =
            pointi < 0
          ? morph::Vector3(fraction*candidates.conditions[i].value)
          : toEigen(motion.inPlane[pointi]);
        reached.row(i) = s.transpose();
    }
    return reached;
}


std::vector<Foam::subSteppedMotion::moving>
Foam::subSteppedMotion::findMoving() const
{
    std::vector<moving> parts;
    for (label i = 0; i < problem_.reduced().nRegions(); ++i)
    {
        if (problem_.moves(i))
        {
            const scalar largest = problem_.controlPoints().largestValue(i);
            parts.push_back({i, problem_.images().inReach(largest)});
        }
    }
    return parts;
}


std::vector<Foam::subSteppedMotion::moving>
Foam::subSteppedMotion::findMoving(const rbfMotion& made) const
{
    // Also where the whole motion is none, as a body has come back
    const scalar span = boundBox(problem_.points0(), true).mag();
    std::vector<moving> parts;
    for (label i = 0; i < problem_.reduced().nRegions(); ++i)
    {
        const controlCandidates& candidates =
            problem_.controlPoints().candidates(i);
        const morph::Vectors reached = reachedByCandidates(i, made);
        scalar largest = 0;
        for (label j = 0; j < candidates.size(); ++j)
        {
            const morph::Vector3 s = reached.row(j).transpose();
            largest = max(largest, candidates.conditions[j].residual(s).norm());
        }
        reduce(largest, maxOp<scalar>());
        if (problem_.radius() > 0 && largest > SMALL*span)
        {
            parts.push_back({i, problem_.images().inReach(largest)});
        }
    }
    return parts;
}


void Foam::subSteppedMotion::addStep
(
    const moving& part,
    rbfMotion& motion,
    vectorField& inPlane
) const
{
    const label regioni = part.region;
    const reducedMesh& reduced = problem_.reduced();
    const labelList& evaluated = reduced.independent(regioni);
    pointField positions(reduced.positions(regioni));
    forAll(evaluated, i)
    {
        positions[i] += motion.inPlane[evaluated[i]];
    }

    // Conditions on curved surfaces turn with their points
    rbfControlPoints& controlPoints = problem_.controlPoints();
    const morph::Vectors reached = reachedByCandidates(regioni, motion);
    controlPoints.setDirections(regioni, reached);

    // Steps are for motions that shrink cells far below the height for which
    // a tolerance of the mesh was right
    const rbfMotionSettings& entries = problem_.settings();
    const bool mayShrink =
        motion.nSteps > 1
     && !entries.toleranceGiven
     && !entries.selection.all
     && entries.surfaceCorrection
     == rbfMotionSettings::correctionPolicy::automatic;

    const morph::SubStepSettings settings
    {
        problem_.kernel(),
        problem_.settings().polynomial,
        problem_.selection(regioni),
        problem_.correctionRadius(regioni, mayShrink),
        problem_.correctionRadius(regioni, true),
        part.images,
        controlPoints.surfacesAreOwn()
    };
    const label steps = motion.nSteps - motion.nMade;
    pstreamCommunicator communicator;
    const morph::SubStep step = morph::subStep
    (
        settings,
        controlPoints.conditionsOnWay
        (
            regioni, reached, motion.paths, motion.partAfterNext(), steps
        ),
        reached,
        steps,
        problem_.renewal(regioni),
        asVectors(positions),
        communicator
    );
    motion.add
    (
        regioni,
        step.result,
        step.selection,
        step.candidates,
        communicator,
        true
    );
    forAll(evaluated, i)
    {
        inPlane[evaluated[i]] += toFoam(step.displacements.row(i).transpose());
    }
}


Foam::vectorField Foam::subSteppedMotion::next
(
    const std::vector<moving>& parts,
    rbfMotion& motion
) const
{
    vectorField inPlane(motion.inPlane);
    for (const moving& part : parts)
    {
        addStep(part, motion, inPlane);
    }
    motion.times.lap(motionTimes::selection);
    problem_.constrain(inPlane, motion.partAfterNext(), motion.paths);
    motion.times.lap(motionTimes::propagation);
    return inPlane;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::rbfMotion Foam::subSteppedMotion::move
(
    const label n,
    const bool check,
    const scalar fraction
) const
{
    const std::vector<moving> parts(findMoving());
    rbfMotion motion(n);
    motion.paths = problem_.controlPoints().paths(n);
    motion.inPlane = vectorField(problem_.points0().size(), Zero);
    while (motion.nMade < fraction*n)
    {
        vectorField inPlane(next(parts, motion));
        const scalar part = fraction*n - motion.nMade;
        if (part < 1)
        {
            inPlane = motion.inPlane + part*(inPlane - motion.inPlane);
            problem_.constrain(inPlane, fraction, motion.paths);
        }

        const bool valid =
            !check
         || problem_.isValid(problem_.expand(inPlane)());
        motion.times.lap(motionTimes::meshCheck);
        if (!valid)
        {
            motion.increment = inPlane - motion.inPlane;
            break;
        }
        motion.inPlane.transfer(inPlane);
        ++motion.nMade;
    }
    motion.fraction = min(fraction, scalar(motion.nMade)/n);
    motion.displacement = problem_.expand(motion.inPlane);
    return motion;
}


Foam::rbfMotion Foam::subSteppedMotion::moveOn
(
    const vectorField& inPlane,
    const bool check
) const
{
    rbfMotion motion;
    motion.inPlane = inPlane;
    const vectorField next(this->next(findMoving(motion), motion));
    motion.displacement = problem_.expand(next);
    if (!check || problem_.isValid(motion.displacement))
    {
        motion.inPlane = next;
        motion.nMade = 1;
        motion.fraction = 1;
    }
    else
    {
        motion.increment = next - inPlane;
        motion.displacement = problem_.expand(inPlane);
    }
    motion.times.lap(motionTimes::meshCheck);
    return motion;
}


void Foam::subSteppedMotion::makePart
(
    rbfMotion& motion,
    const scalar fraction
) const
{
    scalar part = fraction;
    for (label i = 0; i < mostTries; ++i)
    {
        rbfMotion shorter(move(motion.nSteps, true, part));
        shorter.times += motion.times;
        motion = shorter;
        if (motion.increment.empty())
        {
            return;
        }
        part *= 0.9;
    }
}


// ************************************************************************* //
