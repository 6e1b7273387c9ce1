/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfDisplacementMethod.H"
#include "valuePointPatchFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(rbfDisplacementMethod, 0);
    addToRunTimeSelectionTable
    (
        displacementMethod,
        rbfDisplacementMethod,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfDisplacementMethod::rbfDisplacementMethod
(
    fvMesh& mesh,
    const labelList& patchIDs
)
:
    displacementMethod(mesh, patchIDs),
    motion_(refCast<displacementMotionSolver>(motionPtr_()))
{
    for (const label patchi : patchIDs)
    {
        condition(patchi);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::pointPatchVectorField& Foam::rbfDisplacementMethod::condition
(
    const label patchi
) const
{
    pointVectorField& displacement = motion_.pointDisplacement();
    pointPatchVectorField& field = displacement.boundaryFieldRef()[patchi];
    if (!isA<valuePointPatchField<vector>>(field))
    {
        FatalErrorInFunction
            << "Patch '" << mesh_.boundary()[patchi].name() << "' is optimised,"
            << " but its condition " << field.type() << " in "
            << displacement.objectPath() << " takes no values" << nl
            << "    Give it the condition fixedValue there" << nl
            << exit(FatalError);
    }
    return field;
}


void Foam::rbfDisplacementMethod::stop(const char* what) const
{
    FatalErrorInFunction
        << "rbfMotionSolver moves points of patches, not " << what << nl
        << "    Choose a meshMovement of optimisationDict that moves a boundary:"
        << " volumetricBSplinesExternalMotionSolver or Bezier" << nl
        << exit(FatalError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rbfDisplacementMethod::setMotionField
(
    const pointVectorField& pointMovement
)
{
    for (const label patchi : patchIDs_)
    {
        const vectorField movement
        (
            pointMovement.boundaryField()[patchi].patchInternalField()
        );
        const labelList& points = mesh_.boundaryMesh()[patchi].meshPoints();
        const pointField now(mesh_.points(), points);
        const pointField first(motion_.points0(), points);
        condition(patchi) == now + movement - first;
        maxDisplacement_ = max(maxDisplacement_, gMax(mag(movement)));
    }
}


void Foam::rbfDisplacementMethod::setMotionField(const volVectorField&)
{
    stop("cells");
}


void Foam::rbfDisplacementMethod::setControlField(const vectorField&)
{
    stop("control points of an optimiser");
}


void Foam::rbfDisplacementMethod::setControlField(const scalarField&)
{
    stop("control points of an optimiser");
}


// ************************************************************************* //
