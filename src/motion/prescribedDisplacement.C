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

#include "prescribedDisplacement.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(prescribedDisplacement, 0);
    defineRunTimeSelectionTable(prescribedDisplacement, dictionary);
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::prescribedDisplacement::prescribedDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh
)
:
    dict_(dict),
    mesh_(mesh)
{}


Foam::autoPtr<Foam::prescribedDisplacement> Foam::prescribedDisplacement::New
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
{
    const word type(dict.get<word>("type"));
    const auto constructor = dictionaryConstructorTablePtr_->cfind(type);

    if (!constructor.found())
    {
        FatalIOErrorInFunction(dict)
            << "Unknown displacement type '" << type << "'" << nl
            << "    Valid types: "
            << flatOutput(dictionaryConstructorTablePtr_->sortedToc()) << nl
            << exit(FatalIOError);
    }

    return autoPtr<prescribedDisplacement>
    (
        constructor()(dict, mesh, patches, nListed)
    );
}


// ************************************************************************* //
