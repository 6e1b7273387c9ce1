/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "velocityDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(velocityDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        velocityDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const integrableFunctions =
    "constant csvFile one polynomial table tableFile uniform zero";

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::velocityDisplacement::velocityDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    direction_(Zero),
    start_(dict.getOrDefault<scalar>("start", 0))
{
    dictionaryChecks::onlyKeys
    (
        dict, {"type", "value", "valueCoeffs", "direction", "start"}
    );

    word functionType;
    if (dict.found("direction"))
    {
        direction_ = dict.get<vector>("direction");
        speed_ = foamCompat::function1<scalar>("value", dict, &mesh);
        functionType = speed_->type();
    }
    else
    {
        velocity_ = foamCompat::function1<vector>("value", dict, &mesh);
        functionType = velocity_->type();
    }

    if (!integrable(functionType))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'value' is a function of type '" << functionType
            << "', of which OpenFOAM has no integral" << nl
            << "    Use one of (" << integrableFunctions << ')' << nl
            << "    or integrate it yourself and give the displacement:"
            << " type uniform" << nl << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::velocityDisplacement::integrable(const word& functionType)
{
    const string names(string(integrableFunctions) + ' ');
    return names.find(functionType + ' ') != string::npos;
}


Foam::tmp<Foam::vectorField> Foam::velocityDisplacement::displacement
(
    const points& p
) const
{
    const scalar now = mesh().time().timeOutputValue();
    return tmp<vectorField>::New
    (
        p.positions.size(),
        speed_.valid()
      ? speed_->integrate(start_, now)*direction_
      : velocity_->integrate(start_, now)
    );
}


// ************************************************************************* //
