/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "tabulatedDisplacement.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "Time.H"

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
    wordList allowed({"type", "scale", "scaleCoeffs"});
    allowed.append(keys);
    dictionaryChecks::onlyKeys(dict, allowed);

    if (dict.found("scale"))
    {
        scale_ = foamCompat::function1<scalar>("scale", dict, &mesh);
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
        d.ref() *= scale_->value(mesh().time().timeOutputValue());
    }
    return d;
}


// ************************************************************************* //
