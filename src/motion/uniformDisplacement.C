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

Foam::vector Foam::uniformDisplacement::value() const
{
    return dictionaryChecks::naming
    (
        dict(),
        "value",
        [&]{ return value_->value(mesh().time().timeOutputValue()); }
    );
}


Foam::tmp<Foam::vectorField> Foam::uniformDisplacement::displacement
(
    const points& p
) const
{
    return tmp<vectorField>::New(p.positions.size(), value());
}


Foam::List<Foam::motionParameter> Foam::uniformDisplacement::parameters
(
    const word& group
) const
{
    DynamicList<motionParameter> list;
    append(list, group + ".value", value());
    return List<motionParameter>(list);
}


Foam::tmp<Foam::vectorField> Foam::uniformDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    return tmp<vectorField>::New(p.positions.size(), unit(parameteri));
}


// ************************************************************************* //
