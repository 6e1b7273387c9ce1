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

Foam::tmp<Foam::vectorField> Foam::tabulatedDisplacement::displacement
(
    const points& p
) const
{
    tmp<vectorField> d = unscaled(p);
    if (scale_.valid())
    {
        const scalar scale = dictionaryChecks::naming
        (
            dict(),
            "scale",
            [&]{ return scale_->value(mesh().time().timeOutputValue()); }
        );
        const untrapped numbers;
        d.ref() *= scale;
    }
    return d;
}


// ************************************************************************* //
