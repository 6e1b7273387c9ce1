/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cavityTetrahedra.H"
#include "polyMesh.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sine of the angle from which planes have a line in common
static const scalar least = 1e-3;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cavityTetrahedra::cavityTetrahedra
(
    const polyMesh& mesh,
    const planePatches& planes,
    const labelUList& cells,
    const scalarField& sizes
)
:
    mesh_(mesh),
    planes_(planes),
    cells_(cells),
    inside_(mesh.nCells(), cells),
    cut_(mesh, cells)
{
    given_.points = cut_.points();
    given_.tets = cut_.tets();
    given_.regions.setSize(given_.tets.size());
    forAll(given_.regions, i)
    {
        given_.regions[i] = 1 + mesh.cellZones().whichZone(cut_.cells()[i]);
    }
    addFaces();
    addLines();
    addPoints();
    addSizes(sizes);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::cavityTetrahedra::isFixed(const label facei) const
{
    if (mesh_.faceZones().whichZone(facei) >= 0)
    {
        return true;
    }
    const label owner = mesh_.faceOwner()[facei];
    if (!mesh_.isInternalFace(facei))
    {
        return planes_.plane(facei) < 0;
    }
    const label neighbour = mesh_.faceNeighbour()[facei];
    return
        !inside(owner) || !inside(neighbour)
     || mesh_.cellZones().whichZone(owner)
     != mesh_.cellZones().whichZone(neighbour);
}


void Foam::cavityTetrahedra::addFaces()
{
    labelHashSet used;
    for (const label celli : cells_)
    {
        used.insert(mesh_.cells()[celli]);
    }
    DynamicList<triFace> fixedFaces;
    DynamicList<label> oldFaces;
    DynamicList<triFace> planeFaces;
    DynamicList<label> oldPlaneFaces;
    DynamicList<label> planes;
    for (const label facei : used.sortedToc())
    {
        const triFaceList& triangles = cut_.triangles(facei);
        if (isFixed(facei))
        {
            fixedFaces.append(triangles);
            oldFaces.append(labelList(triangles.size(), facei));
        }
        else if (!mesh_.isInternalFace(facei))
        {
            planeFaces.append(triangles);
            oldPlaneFaces.append(labelList(triangles.size(), facei));
            planes.append(labelList(triangles.size(), planes_.plane(facei)));
        }
    }
    given_.fixedFaces.transfer(fixedFaces);
    oldFaces_.transfer(oldFaces);
    given_.planeFaces.transfer(planeFaces);
    oldPlaneFaces_.transfer(oldPlaneFaces);
    given_.planes.transfer(planes);
}


void Foam::cavityTetrahedra::addLines()
{
    // Planes on both sides of an edge
    EdgeMap<FixedList<label, 2>> sides;
    forAll(given_.planeFaces, i)
    {
        for (label j = 0; j < 3; ++j)
        {
            const triFace& f = given_.planeFaces[i];
            const edge e(f[j], f[(j + 1)%3]);
            auto found = sides.find(e);
            if (found.found())
            {
                found()[1] = given_.planes[i];
            }
            else
            {
                sides.insert(e, FixedList<label, 2>({given_.planes[i], -1}));
            }
        }
    }

    EdgeMap<label> lineOf;
    DynamicList<edge> lineEdges;
    DynamicList<label> lines;
    DynamicList<edge> fixedEdges;
    for (const edge& e : sides.sortedToc())
    {
        const FixedList<label, 2>& planes = sides[e];
        const bool ofOthers =
            cut_.meshPoints()[e.start()] >= 0
         && cut_.meshPoints()[e.end()] >= 0;
        if (planes[1] < 0 || planes[0] == planes[1])
        {
            // Where cells touch along an edge only, others may have it too
            if (ofOthers)
            {
                bool outside = true;
                for (const label pointi : {e.start(), e.end()})
                {
                    bool any = false;
                    const label meshPointi = cut_.meshPoints()[pointi];
                    for (const label celli : mesh_.pointCells(meshPointi))
                    {
                        any = any || !inside(celli);
                    }
                    outside = outside && any;
                }
                if (outside)
                {
                    fixedEdges.append(e);
                }
            }
            continue;
        }
        const scalar sine = mag
        (
            planes_.normal(planes[0])^planes_.normal(planes[1])
        );
        if (sine < least)
        {
            fixedEdges.append(e);
            continue;
        }
        const edge pair(planes[0], planes[1]);
        if (!lineOf.found(pair))
        {
            lineOf.insert(pair, lineOf.size());
        }
        lineEdges.append(e);
        lines.append(lineOf[pair]);
    }
    given_.lineEdges.transfer(lineEdges);
    given_.lines.transfer(lines);
    given_.fixedEdges.transfer(fixedEdges);
}


void Foam::cavityTetrahedra::addPoints()
{
    DynamicList<label> fixedPoints;
    forAll(cut_.meshPoints(), i)
    {
        const label pointi = cut_.meshPoints()[i];
        if (pointi < 0)
        {
            break;
        }
        bool stays = mesh_.pointZones().whichZone(pointi) >= 0;
        for (const label celli : mesh_.pointCells(pointi))
        {
            stays = stays || !inside(celli);
        }
        if (stays)
        {
            fixedPoints.append(i);
        }
    }
    given_.fixedPoints.transfer(fixedPoints);
}


void Foam::cavityTetrahedra::addSizes(const scalarField& sizes)
{
    scalarField sum(given_.points.size(), Zero);
    scalarField weight(given_.points.size(), Zero);
    forAll(given_.tets, i)
    {
        for (const label pointi : given_.tets[i])
        {
            sum[pointi] += Foam::log(sizes[cut_.cells()[i]]);
            weight[pointi] += 1;
        }
    }
    given_.sizes = exp(sum/weight);
}


// ************************************************************************* //
