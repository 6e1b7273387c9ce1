/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "firstCells.H"
#include "bitSet.H"
#include "cellGeometry.H"
#include "emptyPolyPatch.H"
#include "syncTools.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::firstCells::firstCells
(
    const polyMesh& mesh,
    const pointField& points
)
:
    mesh_(mesh),
    points_(points),
    heights_(mesh.boundaryMesh().nNonProcessor())
{
    cellGeometry cell(mesh, points);
    forAll(heights_, patchi)
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        if (polyPatch::constraintType(patch.type()))
        {
            continue;
        }
        scalarField& least = heights_[patchi];
        least.setSize(patch.nPoints(), GREAT);
        forAll(patch, i)
        {
            const label celli = patch.faceCells()[i];
            cell.set(celli);
            const label facei = mesh.cells()[celli].find(patch.start() + i);
            const scalar height =
                cell.volume()/max(mag(cell.areas()[facei]), VSMALL);
            for (const label pointi : patch.localFaces()[i])
            {
                least[pointi] = min(least[pointi], height);
            }
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::firstCells::leastOfCells(const boolList& points) const
{
    if (!returnReduce(points.found(true), orOp<bool>()))
    {
        return GREAT;
    }
    bitSet touching(mesh_.nCells());
    forAll(mesh_.faces(), facei)
    {
        for (const label pointi : mesh_.faces()[facei])
        {
            if (points[pointi])
            {
                touching.set(mesh_.faceOwner()[facei]);
                if (mesh_.isInternalFace(facei))
                {
                    touching.set(mesh_.faceNeighbour()[facei]);
                }
                break;
            }
        }
    }
    cellGeometry cell(mesh_, points_);
    scalar least = GREAT;
    for (const label celli : touching)
    {
        cell.set(celli);
        scalar largest = 0;
        forAll(mesh_.cells()[celli], i)
        {
            const label facei = mesh_.cells()[celli][i];
            const label patchi = mesh_.boundaryMesh().whichPatch(facei);
            const bool flat =
                patchi >= 0
             && (
                    isA<emptyPolyPatch>(mesh_.boundaryMesh()[patchi])
                 || isA<wedgePolyPatch>(mesh_.boundaryMesh()[patchi])
                );
            if (!flat)
            {
                largest = max(largest, mag(cell.areas()[i]));
            }
        }
        least = min(least, cell.volume()/max(largest, VSMALL));
    }
    return least;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::firstCells::least(const labelUList& meshPoints) const
{
    // Points that ranks share are asked for by one of them
    boolList asked(mesh_.nPoints(), false);
    for (const label pointi : meshPoints)
    {
        if (pointi >= 0)
        {
            asked[pointi] = true;
        }
    }
    syncTools::syncPointList(mesh_, asked, orEqOp<bool>(), false);

    scalar height = GREAT;
    boolList onPatch(mesh_.nPoints(), false);
    forAll(heights_, patchi)
    {
        const labelList& points = mesh_.boundaryMesh()[patchi].meshPoints();
        forAll(heights_[patchi], i)
        {
            if (asked[points[i]])
            {
                height = min(height, heights_[patchi][i]);
                onPatch[points[i]] = true;
            }
        }
    }
    syncTools::syncPointList(mesh_, onPatch, orEqOp<bool>(), false);
    forAll(asked, pointi)
    {
        asked[pointi] = asked[pointi] && !onPatch[pointi];
    }
    return returnReduce(min(height, leastOfCells(asked)), minOp<scalar>());
}


// ************************************************************************* //
