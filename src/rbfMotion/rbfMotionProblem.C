/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionProblem.H"
#include "foamCompat.H"
#include "invalidMotion.H"
#include "StringStream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Largest radius of the surface correction, in support radii: about the
// distance between selected points, the length scale of the remaining error
static const scalar correctionReach = 0.1;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfMotionProblem::rbfMotionProblem
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const controlPointGroups& groups,
    const rbfMotionSettings& settings,
    const motionZone& zone,
    const scalar formerRadius
)
:
    mesh_(mesh),
    dict_(dict),
    points0_(points0),
    settings_(settings),
    zone_(zone),
    slidingPatches_(slidingPatchesOf(groups)),
    reduced_(mesh, points0),
    inZone_(regionsInZone()),
    images_(mesh, dict, points0, reduced_.plane(), groups, settings.images),
    controlPoints_
    (
        mesh, dict, points0, groups, reduced_, images_, settings.featureAngle
    ),
    radius_(settings, formerRadius),
    span_(boundBox(points0, true).mag()),
    accuracy_(mesh, points0, settings, reduced_.nRegions()),
    part_(mesh)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::boolList Foam::rbfMotionProblem::regionsInZone() const
{
    boolList inZone(reduced_.nRegions(), zone_.wholeMesh());
    for (const label pointi : zone_.pointLabels())
    {
        inZone[reduced_.regionOf(pointi)] = true;
    }
    foamCompat::allCombineList(inZone, orEqOp<bool>());
    return inZone;
}


Foam::labelHashSet Foam::rbfMotionProblem::slidingPatchesOf
(
    const controlPointGroups& groups
)
{
    labelHashSet patches;
    for (const controlPointGroup& group : groups)
    {
        if (group.slides())
        {
            patches.insert(group.patches());
        }
    }
    return patches;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::labelList Foam::rbfMotionProblem::staying() const
{
    if (zone_.wholeMesh())
    {
        return labelList();
    }
    boolList stays(mesh_.nPoints(), true);
    UIndirectList<bool>(stays, zone_.pointLabels()) = false;
    return findIndices(stays, true);
}


Foam::scalar Foam::rbfMotionProblem::correctionRadius
(
    const label regioni,
    const bool rough
) const
{
    return accuracy_.corrects(regioni, rough) ? correctionReach*radius() : 0;
}


Foam::rbfMotionProblem::change Foam::rbfMotionProblem::update
(
    const bool first,
    const bool rebuild
)
{
    change changed;
    changed.directions = controlPoints_.update(rebuild);
    changed.radius = radius_.update(controlPoints_);
    if ((first || changed.radius) && !images_.reach(radius()))
    {
        controlPoints_.update(rebuild);
    }
    boolList moving(reduced_.nRegions());
    forAll(moving, regioni)
    {
        moving[regioni] = moves(regioni);
    }
    accuracy_.update(controlPoints_, moving);
    return changed;
}


void Foam::rbfMotionProblem::provideRadius(const scalar span)
{
    const bool none = radius() == 0;
    if (!radius_.provide(span))
    {
        FatalIOErrorInFunction(dict_)
            << "Nothing moves at these values, so that the support radius,"
            << " which is to follow from the displacement, would be zero" << nl
            << "    For derivatives there give 'supportRadius', a length [m],"
            << " instead of 'supportRadiusFactor'" << nl << exit(FatalIOError);
    }
    if (none && !images_.reach(radius()))
    {
        controlPoints_.update(true);
    }
}


bool Foam::rbfMotionProblem::moves(const label regioni) const
{
    // A body about to start moves by round-off, which is not worth control
    // points
    return
        inZone_[regioni]
     && radius() > 0
     && controlPoints_.largestValue(regioni) > SMALL*span_;
}


bool Foam::rbfMotionProblem::mayFollow(const label regioni) const
{
    if
    (
        reduced_.nRegions() == 1
     || settings_.polynomialGiven
     || settings_.selection.all
     || settings_.selection.algorithm != morph::Algorithm::incremental
     || images_.active()
    )
    {
        return false;
    }
    bool slides = false;
    for
    (
        const morph::ControlPoint& p
      : controlPoints_.candidates(regioni).conditions
    )
    {
        slides = slides || p.slides();
    }
    return !returnReduce(slides, orOp<bool>());
}


morph::GreedySelection::Renewal Foam::rbfMotionProblem::renewal
(
    const label regioni
)
{
    if (!controlPoints_.follow())
    {
        return morph::GreedySelection::Renewal();
    }
    return [this, regioni](const morph::Vectors& s, morph::ControlPoints& c)
    {
        controlPoints_.renew(regioni, s, c);
    };
}


void Foam::rbfMotionProblem::constrain
(
    vectorField& inPlane,
    const scalar fraction,
    const motionPaths& paths
) const
{
    // Otherwise images make coupled points move alike
    if (!images_.periodic())
    {
        reduced_.match(inPlane);
    }
    controlPoints_.impose(inPlane, settings_.exactSliding, fraction, paths);
}


void Foam::rbfMotionProblem::constrainDerivative
(
    const vectorField& controlled,
    const vectorField& displacement,
    vectorField& inPlane
) const
{
    if (!images_.periodic())
    {
        reduced_.match(inPlane);
    }
    controlPoints_.imposeDerivative
    (
        controlled, displacement, inPlane, settings_.exactSliding
    );
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionProblem::expand
(
    const vectorField& inPlane
) const
{
    tmp<vectorField> displacement(reduced_.expand(inPlane));
    zone_.restrict(displacement.ref());
    return displacement;
}


bool Foam::rbfMotionProblem::isValid(const vectorField& displacement)
{
    return invalidMotion
    (
        mesh_, points0_, points0_ + displacement, part(displacement)
    ).empty();
}


Foam::string Foam::rbfMotionProblem::remedy() const
{
    OStringStream remedy;
    const bool fewer = settings_.subStepsGiven && settings_.subSteps > 0;
    if (fewer)
    {
        remedy
            << "Leave out 'subSteps', which is " << settings_.subSteps
            << ": as many are made then as a valid mesh needs, up to 32." << nl
            << "    Or make";
    }
    else
    {
        remedy << "Make";
    }
    remedy
        << " the motion smaller, or let patches slide that are fixed or told to"
        << " move beside it";
    if (settings_.subSteps == 0)
    {
        remedy << ": more steps than one did not help";
    }
    return remedy.str();
}


// ************************************************************************* //
