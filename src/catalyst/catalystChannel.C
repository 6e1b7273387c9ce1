/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
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
