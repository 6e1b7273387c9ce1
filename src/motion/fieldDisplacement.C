/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

\*---------------------------------------------------------------------------*/

#include "fieldDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
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
        const pointPatchVectorField& condition = field.boundaryField()[patchi];
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
            field.boundaryField()[patchi]
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


// ************************************************************************* //
