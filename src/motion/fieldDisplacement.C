/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "fieldDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "pointDisplacementField.H"
#include "pointFields.H"
#include "valuePointPatchField.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(fieldDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        fieldDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::fieldDisplacement::fieldDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    patches_(patches)
{
    dictionaryChecks::onlyKeys(dict, {"type"});

    if (patches.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Displacement type 'pointDisplacement' takes its values from"
            << " boundary conditions, but this group selects no patches" << nl
            << "    Give the group a 'displacement' of another type" << nl
            << exit(FatalIOError);
    }

    const auto& field =
        mesh.lookupObject<pointVectorField>("pointDisplacement");

    for (const label patchi : patches)
    {
        const pointPatchVectorField& condition =
            pointDisplacementField::condition
            (
                field, mesh.boundaryMesh()[patchi]
            );
        if (!condition.fixesValue())
        {
            FatalIOErrorInFunction(dict)
                << "The displacement of patch '" << condition.patch().name()
                << "' is to come from its boundary condition in"
                << " pointDisplacement, but that is of type '"
                << condition.type() << "' and fixes no value" << nl
                << "    Give the patch a fixedValue, solidBodyMotionDisplacement"
                << " or similar condition in " << field.objectPath() << nl
                << "    or the group a 'displacement' of another type" << nl
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::fieldDisplacement::displacement
(
    const points& p
) const
{
    const auto& field =
        mesh().lookupObject<pointVectorField>("pointDisplacement");

    Map<vector> values(2*p.meshPoints.size());
    for (const label patchi : patches_)
    {
        const auto& condition = refCast<const valuePointPatchField<vector>>
        (
            pointDisplacementField::condition
            (
                field, mesh().boundaryMesh()[patchi]
            )
        );
        const labelList& meshPoints = condition.patch().meshPoints();
        forAll(meshPoints, i)
        {
            values.insert(meshPoints[i], condition[i]);
        }
    }

    auto result = tmp<vectorField>::New(p.meshPoints.size());
    forAll(p.meshPoints, i)
    {
        result.ref()[i] = values[p.meshPoints[i]];
    }
    return result;
}


Foam::List<Foam::motionParameter> Foam::fieldDisplacement::parameters
(
    const word& group
) const
{
    return List<motionParameter>({{group + ".scale", 1}});
}


Foam::tmp<Foam::vectorField> Foam::fieldDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    return displacement(p);
}


// ************************************************************************* //
