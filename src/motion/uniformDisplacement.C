/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "uniformDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "Time.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(uniformDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        uniformDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::uniformDisplacement::uniformDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    value_
    (
        dictionaryChecks::naming
        (
            dict,
            "value",
            [&]{ return foamCompat::function1<vector>("value", dict, &mesh); }
        )
    )
{
    dictionaryChecks::onlyKeys(dict, {"type"}, {"value", "valueCoeffs"});
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::uniformDisplacement::displacement
(
    const points& p
) const
{
    return tmp<vectorField>::New
    (
        p.positions.size(),
        dictionaryChecks::naming
        (
            dict(),
            "value",
            [&]{ return value_->value(mesh().time().timeOutputValue()); }
        )
    );
}


// ************************************************************************* //
