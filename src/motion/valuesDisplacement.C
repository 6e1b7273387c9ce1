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

#include "valuesDisplacement.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(valuesDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        valuesDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::valuesDisplacement::valuesDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    tabulatedDisplacement(dict, mesh, {"values"}),
    values_(dict.get<vectorField>("values"))
{
    if (nListed == 0 || !patches.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Displacement type 'values' needs a group that lists 'points':"
            << " the points of patches and zones have no order" << nl
            << "    For those use displacement type 'file', which matches by"
            << " position" << nl
            << exit(FatalIOError);
    }
    if (values_.size() != nListed)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'values' has " << values_.size()
            << " displacements, but the group lists " << nListed << " points"
            << nl
            << "    Give one displacement for each point" << nl
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::valuesDisplacement::unscaled
(
    const points& p
) const
{
    return tmp<vectorField>::New(values_, p.listed);
}


// ************************************************************************* //
