/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlPointGroups.H"
#include "basicSymmetryPointPatchField.H"
#include "calculatedPointPatchField.H"
#include "pointDisplacementField.H"
#include "pointFields.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "zeroGradientPointPatchField.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static bool slidingCondition(const pointPatchVectorField& condition)
{
    return isA<basicSymmetryPointPatchField<vector>>(condition);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::controlPointGroups::controlPointGroups
(
    const polyMesh& mesh,
    const dictionary& coeffs,
    const pointVectorField& pointDisplacement
)
:
    mesh_(mesh),
    pointDisplacement_(pointDisplacement)
{
    const dictionary* dict = coeffs.findDict("controlPoints");
    if (dict)
    {
        readGroups(*dict);
        addSymmetryPatches();
    }
    else if (coeffs.found("controlPoints"))
    {
        FatalIOErrorInFunction(coeffs)
            << "Entry 'controlPoints' has to be a dictionary of groups" << nl
            << exit(FatalIOError);
    }
    else
    {
        groupsFromField(coeffs);
    }
    checkThatSomethingMoves(coeffs);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::controlPointGroups::readGroups(const dictionary& dict)
{
    for (const entry& e : dict)
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' is no group of control points"
                << nl << "    A group is a dictionary: " << e.keyword()
                << " { type ...; patches (...); }" << nl
                << exit(FatalIOError);
        }
        append(new controlPointGroup(e.keyword(), e.dict(), mesh_));
    }
}


void Foam::controlPointGroups::addSymmetryPatches()
{
    labelHashSet selected;
    for (const controlPointGroup& group : *this)
    {
        selected.insert(group.patches());
    }
    forAll(mesh_.boundaryMesh(), patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        const bool symmetric =
            isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch);
        if (symmetric && !selected.found(patchi))
        {
            append
            (
                new controlPointGroup
                (
                    mesh_, patchi, controlPointGroup::role::sliding
                )
            );
        }
    }
}


void Foam::controlPointGroups::groupsFromField(const dictionary& coeffs)
{
    checkConditions(coeffs);

    // Where patches meet the last one wins, as it does when OpenFOAM evaluates
    // the boundary conditions one after the other
    typedef controlPointGroup::role role;
    for (const role r : {role::moving, role::sliding})
    {
        forAllReverse(mesh_.boundaryMesh(), patchi)
        {
            const pointPatchVectorField& condition =
                pointDisplacementField::condition
                (
                    pointDisplacement_, mesh_.boundaryMesh()[patchi]
                );
            const bool slides = slidingCondition(condition);
            if
            (
                r == role::sliding
              ? slides
              : !slides && condition.fixesValue()
            )
            {
                append(new controlPointGroup(mesh_, patchi, r));
            }
        }
    }
}


void Foam::controlPointGroups::checkConditions
(
    const dictionary& coeffs
) const
{
    for (const pointPatchVectorField& condition
        : pointDisplacement_.boundaryField())
    {
        if (pointDisplacementField::patchIndex(condition) < 0)
        {
            checkPointPatch(coeffs, condition);
            continue;
        }
        const polyPatch& patch = mesh_.boundaryMesh()
        [
            pointDisplacementField::patchIndex(condition)
        ];
        if
        (
            !condition.fixesValue()
         && !slidingCondition(condition)
         && !polyPatch::constraintType(patch.type())
         && !isA<zeroGradientPointPatchField<vector>>(condition)
         && !isA<calculatedPointPatchField<vector>>(condition)
        )
        {
            FatalIOErrorInFunction(coeffs)
                << "The pointDisplacement condition of patch '"
                << patch.name() << "' has type '" << condition.type()
                << "', which has no part in the motion" << nl
                << "    Conditions that fix the value move points,"
                << " slip and symmetry let them slide," << nl
                << "    zeroGradient and calculated leave them free." << nl
                << "    Use one of them, or say in 'controlPoints' which"
                << " patches move, slide or are fixed" << nl
                << exit(FatalIOError);
        }
    }
}


void Foam::controlPointGroups::checkPointPatch
(
    const dictionary& coeffs,
    const pointPatchVectorField& condition
) const
{
    if (!condition.fixesValue() && !slidingCondition(condition))
    {
        return;
    }
    FatalIOErrorInFunction(coeffs)
        << "The pointDisplacement condition of '" << condition.patch().name()
        << "' has type '" << condition.type() << "'," << nl
        << "    but that is a patch of points without faces, which is not"
        << " controlled by its condition" << nl
        << "    Make its condition calculated, put its points into a pointZone"
        << " and add to 'controlPoints'" << nl
        << "    " << condition.patch().name() << " { type moving; pointZones"
        << " (...); displacement { ... } }" << nl << exit(FatalIOError);
}


void Foam::controlPointGroups::checkThatSomethingMoves
(
    const dictionary& coeffs
) const
{
    for (const controlPointGroup& group : *this)
    {
        if (group.moves())
        {
            return;
        }
    }

    FatalIOErrorInFunction(coeffs)
        << "Nothing moves the mesh, and nothing ever could" << nl
        << "    Give a patch a moving condition in "
        << pointDisplacement_.objectPath() << nl
        << "    or add a group of type moving to 'controlPoints'"
        << nl << exit(FatalIOError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::controlPointGroups::fromField() const
{
    for (const controlPointGroup& group : *this)
    {
        if (group.fromField())
        {
            return true;
        }
    }
    return false;
}


// ************************************************************************* //
