/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "cellDisplacementField.H"
#include "dictionaryChecks.H"
#include "functionObjectList.H"
#include "Time.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(cellDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        cellDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellDisplacement::cellDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    patches_(patches),
    functions_(dict.getOrDefault("functions", wordList()))
{
    dictionaryChecks::onlyKeys(dict, {"type", "functions"});

    if (patches.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Displacement type 'cellDisplacement' takes its values from"
            << " faces of patches, but this group selects none" << nl
            << "    Give the group 'patches', or a 'displacement' of another"
            << " type" << nl << exit(FatalIOError);
    }
    const auto* field = cellDisplacementField::of(mesh);
    for (const label patchi : patches)
    {
        if (!field || !field->moves(patchi))
        {
            FatalIOErrorInFunction(dict)
                << "The displacement of patch '"
                << mesh.boundaryMesh()[patchi].name()
                << "' is to come from cellDisplacement, which has no condition"
                << " there that fixes the value, or pointDisplacement has one"
                << nl
                << "    Give it fixedValue in cellDisplacement and calculated"
                << " in pointDisplacement" << nl << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellDisplacement::update()
{
    if (functions_.empty())
    {
        return;
    }

    // Time has no other way to execute one
    auto& all =
        const_cast<functionObjectList&>(mesh().time().functionObjects());
    List<wordRe> names(functions_.size());
    forAll(functions_, i)
    {
        names[i] = functions_[i];
        if (all.findObjectID(functions_[i]) < 0)
        {
            FatalIOErrorInFunction(dict())
                << "Entry 'functions': no function object is called '"
                << functions_[i] << "'" << nl
                << "    Write it into 'functions' of system/controlDict, and"
                << " run a program that executes function objects" << nl
                << exit(FatalIOError);
        }
    }
    all.execute(names, 0);
}


Foam::tmp<Foam::vectorField> Foam::cellDisplacement::displacement
(
    const points& p
) const
{
    Map<label> place(2*p.meshPoints.size());
    forAll(p.meshPoints, i)
    {
        place.insert(p.meshPoints[i], i);
    }

    auto result = tmp<vectorField>::New(p.meshPoints.size(), Zero);
    for (const label patchi : patches_)
    {
        const vectorField values
        (
            cellDisplacementField::of(mesh())->atPoints(patchi)
        );
        const labelList& meshPoints = mesh().boundaryMesh()[patchi].meshPoints();
        forAll(meshPoints, i)
        {
            const auto found = place.cfind(meshPoints[i]);
            if (found.found())
            {
                result.ref()[found.val()] = values[i];
            }
        }
    }
    return result;
}


// ************************************************************************* //
