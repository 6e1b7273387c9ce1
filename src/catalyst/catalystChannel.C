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

#include "catalystChannel.H"
#include "controlsChannel.H"
#include "fvMesh.H"
#include "meshChannel.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::catalystChannel::catalystChannel
(
    const word& name,
    const dictionary& dict,
    const Time& time
)
:
    name_(name),
    dict_(dict),
    time_(time)
{}


Foam::autoPtr<Foam::catalystChannel> Foam::catalystChannel::New
(
    const word& name,
    const dictionary& dict,
    const Time& time
)
{
    const word type(dict.getOrDefault<word>("type", "mesh"));
    if (type == "mesh")
    {
        return autoPtr<catalystChannel>(new meshChannel(name, dict, time));
    }
    if (type == "controls")
    {
        return autoPtr<catalystChannel>(new controlsChannel(name, dict, time));
    }
    FatalIOErrorInFunction(dict)
        << "Input '" << name << "' is of type '" << type << "'" << nl
        << "    Use one of (controls mesh)" << nl << exit(FatalIOError);
    return nullptr;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::fvMesh* Foam::catalystChannel::mesh() const
{
    return time_.cfindObject<fvMesh>
    (
        dict_.getOrDefault<word>("region", polyMesh::defaultRegion)
    );
}


// ************************************************************************* //
