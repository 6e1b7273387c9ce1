/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "remesher.H"
#include "fvMesh.H"
#include "indexedOctree.H"
#include "polyTopoChange.H"
#include "treeDataPoint.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- For each position the nearest of some others
static labelList nearest(const pointField& to, const pointField& of)
{
    treeBoundBox bounds(of);
    bounds.inflate(1e-3);
    const indexedOctree<treeDataPoint> tree
    (
        treeDataPoint(of), bounds, 10, 10, 3
    );
    labelList found(to.size());
    forAll(to, i)
    {
        found[i] = tree.findNearest(to[i], GREAT).index();
    }
    return found;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::labelList Foam::remesher::addPoints(polyTopoChange& change) const
{
    // The old mesh's points of these cells come first among the given ones
    DynamicList<label> old;
    for (const label pointi : attempt_().cavity().cut().meshPoints())
    {
        if (pointi >= 0)
        {
            old.append(pointi);
        }
    }
    const labelList near
    (
        nearest(attempt_().tetrahedra.points, pointField(mesh_.points(), old))
    );

    labelList labels(attempt_().tetrahedra.points.size());
    bitSet stays(mesh_.nPoints());
    forAll(labels, i)
    {
        const label origin = attempt_().tetrahedra.origin[i];
        const label pointi =
            origin >= 0 ? attempt_().cavity().cut().meshPoints()[origin] : -1;
        if (pointi >= 0 && mesh_.points()[pointi] == attempt_().tetrahedra.points[i])
        {
            labels[i] = pointi;
            stays.set(pointi);
        }
        else
        {
            labels[i] = change.addPoint
            (
                attempt_().tetrahedra.points[i], old[near[i]], -1, true
            );
        }
    }
    for (const label pointi : old)
    {
        if (!stays.test(pointi))
        {
            change.removePoint(pointi, -1);
        }
    }
    return labels;
}


Foam::labelList Foam::remesher::addCells(polyTopoChange& change) const
{
    const labelList& cells = attempt_().cavity().cells();
    labelList labels(attempt_().tetrahedra.tets.size());
    pointField centres(labels.size());
    forAll(attempt_().tetrahedra.tets, i)
    {
        centres[i] = Zero;
        for (const label pointi : attempt_().tetrahedra.tets[i])
        {
            centres[i] += 0.25*attempt_().tetrahedra.points[pointi];
        }
    }

    // The values that cells get are those of a cell of their own zone
    Map<DynamicList<label>> old;
    for (const label celli : cells)
    {
        old(mesh_.cellZones().whichZone(celli)).append(celli);
    }
    Map<DynamicList<label>> made;
    forAll(attempt_().tetrahedra.regions, i)
    {
        made(attempt_().tetrahedra.regions[i] - 1).append(i);
    }
    labelList masters(labels.size());
    forAllConstIters(made, iter)
    {
        const labelList& ofZone = old[iter.key()];
        const labelList near
        (
            nearest
            (
                pointField(centres, iter.val()),
                pointField(mesh_.cellCentres(), ofZone)
            )
        );
        forAll(near, i)
        {
            masters[iter.val()[i]] = ofZone[near[i]];
        }
    }
    forAll(labels, i)
    {
        labels[i] = change.addCell
        (
            -1, -1, -1, masters[i], attempt_().tetrahedra.regions[i] - 1
        );
    }
    for (const label celli : cells)
    {
        change.removeCell(celli, -1);
    }
    return labels;
}


void Foam::remesher::addFaces
(
    polyTopoChange& change,
    const labelUList& points,
    const labelUList& cells
) const
{
    labelHashSet old;
    for (const label celli : attempt_().cavity().cells())
    {
        old.insert(mesh_.cells()[celli]);
    }
    // The first triangle of a face takes its place
    labelHashSet taken;
    for (const cavityFaces::newFace& f : attempt_().faces().faces())
    {
        const label facei = f.oldFace;
        const auto cellOf = [&](const label tet, const label celli)
        {
            return tet >= 0 ? cells[tet] : celli;
        };
        label own = -1;
        label nei = -1;
        label patch = -1;
        if (facei >= 0 && !mesh_.isInternalFace(facei))
        {
            own = cells[f.owner];
            patch = mesh_.boundaryMesh().whichPatch(facei);
        }
        else
        {
            own = cellOf(f.owner, facei < 0 ? -1 : mesh_.faceOwner()[facei]);
            nei = cellOf
            (
                f.neighbour, facei < 0 ? -1 : mesh_.faceNeighbour()[facei]
            );
        }
        face corners(3);
        forAll(corners, i)
        {
            corners[i] = points[f.points[i]];
        }
        const bool turned = nei >= 0 && nei < own;
        if (turned)
        {
            corners.flip();
            Swap(own, nei);
        }
        const label zone = facei < 0 ? -1 : mesh_.faceZones().whichZone(facei);
        bool zoneFlip = false;
        if (zone >= 0)
        {
            const faceZone& ofFace = mesh_.faceZones()[zone];
            zoneFlip = ofFace.flipMap()[ofFace.whichFace(facei)] != turned;
        }
        if (facei >= 0 && taken.insert(facei))
        {
            change.modifyFace
            (
                corners, facei, own, nei, turned, patch, zone, zoneFlip
            );
        }
        else
        {
            change.addFace
            (
                corners, own, nei, -1, -1, facei, turned, patch, zone, zoneFlip
            );
        }
    }
    for (const label facei : old.sortedToc())
    {
        if (!taken.found(facei))
        {
            change.removeFace(facei, -1);
        }
    }
}


void Foam::remesher::setMap(const mapPolyMesh& changed)
{
    // New cells come last, in their own order
    const label nCells = changed.cellMap().size();
    const label nNew = attempt_().tetrahedra.tets.size();
    map_.after.cells = identity(nNew, nCells - nNew);
    map_.cellMap = changed.cellMap();
    for (const label celli : map_.after.cells)
    {
        map_.cellMap[celli] = -1;
    }
    map_.faceMap = changed.faceMap();
    map_.pointMap = changed.pointMap();
    forAll(map_.pointMap, pointi)
    {
        const label old = map_.pointMap[pointi];
        if (old >= 0 && changed.reversePointMap()[old] != pointi)
        {
            map_.pointMap[pointi] = -1;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::autoPtr<Foam::mapPolyMesh> Foam::remesher::change()
{
    polyTopoChange change(mesh_);
    const labelList points(addPoints(change));
    const labelList cells(addCells(change));
    addFaces(change, points, cells);
    autoPtr<mapPolyMesh> changed(change.changeMesh(mesh_, false));
    mesh_.updateMesh(changed());
    setMap(changed());
    return changed;
}


// ************************************************************************* //
