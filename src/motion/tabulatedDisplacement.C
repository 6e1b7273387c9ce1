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

#include "tabulatedDisplacement.H"
#include "dictionaryChecks.H"
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
        scale_ = Function1<scalar>::New("scale", dict);
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
