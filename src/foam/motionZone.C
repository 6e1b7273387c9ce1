/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionZone.H"
#include "polyMesh.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Both in the file's dictionary and in that of the coefficients, they have to
// say the same
static dictionary selection(const dictionary& dict, const dictionary& coeffs)
{
    dictionary selected(dict.name());
    for (const word& key : motionZone::keys())
    {
        const entry* beside = dict.findEntry(key, keyType::LITERAL);
        const entry* among = coeffs.findEntry(key, keyType::LITERAL);
        if (beside && among && *beside != *among)
        {
            FatalIOErrorInFunction(coeffs)
                << "Entry '" << key << "' is here and beside the"
                << " coefficients, with different values" << nl
                << "    Remove one of them: releases of OpenFOAM differ in"
                << " which they read" << nl << exit(FatalIOError);
        }
        if (among || beside)
        {
            selected.add(among ? *among : *beside);
        }
    }
    return selected;
}

} // End namespace Foam


// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::word Foam::motionZone::frozenKey("frozenPointsZone");


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionZone::motionZone
(
    const dictionary& dict,
    const dictionary& coeffs,
    const polyMesh& mesh
)
:
    zone_(nullptr)
{
    const dictionary selected(selection(dict, coeffs));
    if (selected.size())
    {
        zone_.reset(new zoneMotion(selected, mesh));
    }
    const word frozen(frozenZone(coeffs, mesh));
    if (!frozen.empty())
    {
        frozen_ = mesh.pointZones()[frozen];
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::motionZone::keys()
{
    return {"cellZone", "cellSet"};
}


Foam::word Foam::motionZone::frozenZone
(
    const dictionary& coeffs,
    const polyMesh& mesh
)
{
    if (!coeffs.found(frozenKey))
    {
        return word();
    }
    const wordList zones(mesh.pointZones().names());
    const word zone(coeffs.get<word>(frozenKey));
    if (!zones.found(zone))
    {
        FatalIOErrorInFunction(coeffs)
            << "Entry '" << frozenKey << "': no pointZone is called '"
            << zone << "'" << nl
            << "    There are: " << flatOutput(zones) << nl
            << exit(FatalIOError);
    }
    return zone;
}


bool Foam::motionZone::wholeMesh() const
{
    return !zone_ || zone_->moveAllCells();
}


const Foam::labelList& Foam::motionZone::pointLabels() const
{
    return zone_ ? zone_->pointIDs() : labelList::null();
}


void Foam::motionZone::restrict(vectorField& displacement) const
{
    if (!wholeMesh())
    {
        const vectorField all(displacement);
        displacement = Zero;
        for (const label pointi : pointLabels())
        {
            displacement[pointi] = all[pointi];
        }
    }
    for (const label pointi : frozen_)
    {
        displacement[pointi] = Zero;
    }
}


Foam::tmp<Foam::pointField> Foam::motionZone::moved
(
    const pointField& points0,
    const vectorField& displacement,
    const pointField& present
) const
{
    if (wholeMesh())
    {
        return points0 + displacement;
    }
    auto points = tmp<pointField>::New(present);
    for (const label pointi : pointLabels())
    {
        points.ref()[pointi] = points0[pointi] + displacement[pointi];
    }
    return points;
}


// ************************************************************************* //
