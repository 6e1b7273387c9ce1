/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "tabulatedDisplacement.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::tabulatedDisplacement::tabulatedDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const wordList& keys
)
:
    prescribedDisplacement(dict, mesh),
    scale_(nullptr)
{
    wordList values({"type"});
    values.append(keys);
    dictionaryChecks::onlyKeys(dict, values, {"scale", "scaleCoeffs"});

    if (dict.found("scale"))
    {
        scale_ = dictionaryChecks::naming
        (
            dict,
            "scale",
            [&]{ return foamCompat::function1<scalar>("scale", dict, &mesh); }
        );
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::tabulatedDisplacement::scale() const
{
    if (!scale_.valid())
    {
        return 1;
    }
    return dictionaryChecks::naming
    (
        dict(),
        "scale",
        [&]{ return scale_->value(mesh().time().timeOutputValue()); }
    );
}


Foam::tmp<Foam::vectorField> Foam::tabulatedDisplacement::displacement
(
    const points& p
) const
{
    tmp<vectorField> d = unscaled(p);
    const scalar factor = scale();
    const untrapped numbers;
    d.ref() *= factor;
    return d;
}


Foam::List<Foam::motionParameter> Foam::tabulatedDisplacement::parameters
(
    const word& group
) const
{
    List<motionParameter> list({{group + ".scale", scale()}});
    list.append(tableParameters(group));
    return list;
}


Foam::tmp<Foam::vectorField> Foam::tabulatedDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    if (parameteri == 0)
    {
        return unscaled(p);
    }
    tmp<vectorField> d = tableDerivative(p, parameteri - 1);
    d.ref() *= scale();
    return d;
}


// ************************************************************************* //
