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


Foam::scalar Foam::velocityDisplacement::way() const
{
    return speed_->integrate(start_, mesh().time().timeOutputValue());
}


Foam::vector Foam::velocityDisplacement::path() const
{
    return velocity_->integrate(start_, mesh().time().timeOutputValue());
}


Foam::tmp<Foam::vectorField> Foam::velocityDisplacement::displacement
(
    const points& p
) const
{
    return tmp<vectorField>::New
    (
        p.positions.size(),
        speed_.valid() ? way()*direction_ : path()
    );
}


Foam::List<Foam::motionParameter> Foam::velocityDisplacement::parameters
(
    const word& group
) const
{
    const scalar now = mesh().time().timeOutputValue();
    DynamicList<motionParameter> list;
    if (speed_.valid())
    {
        append(list, group + ".direction", direction_);
        list.append({group + ".value", speed_->value(now)});
    }
    else
    {
        append(list, group + ".value", velocity_->value(now));
    }
    return List<motionParameter>(list);
}


Foam::tmp<Foam::vectorField> Foam::velocityDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    // By what is added to the velocity at all times
    const scalar span = mesh().time().timeOutputValue() - start_;
    const vector d =
        !speed_.valid() ? span*unit(parameteri)
      : parameteri < vector::nComponents ? way()*unit(parameteri)
      : span*direction_;
    return tmp<vectorField>::New(p.positions.size(), d);
}


// ************************************************************************* //
