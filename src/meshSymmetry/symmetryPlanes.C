/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "symmetryPlanes.H"
#include "constraintPatches.H"
#include "emptyPolyPatch.H"
#include "surfaceNormals.H"
#include "syncTools.H"
#include "unitConversion.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Largest angle between faces of one plane [rad]
static const scalar planar = 1e-3;

// Between faces on either side of an edge
static const scalar edgeAngle = degToRad(30);


// Add the part of n that is independent of an orthonormal basis
static void addDirection(List<vector>& basis, vector n)
{
    for (const vector& b : basis)
    {
        n -= (n & b)*b;
    }
    if (mag(n) > planar)
    {
        basis.append(n/mag(n));
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::symmetryPlanes::addPatch
(
    const polyPatch& patch,
    const pointField& points,
    labelHashSet& curved
)
{
    const polyMesh& mesh = patch.boundaryMesh().mesh();
    vectorField areas(patch.size());
    forAll(areas, facei)
    {
        areas[facei] = patch[facei].areaNormal(points);
    }
    const surfaceNormals::plane plane(surfaceNormals::planeOf(areas));
    if (plane.empty)
    {
        return;
    }

    // Ranks may have points of a patch, but no face of it
    boolList isOn(mesh.nPoints(), false);
    UIndirectList<bool>(isOn, patch.meshPoints()) = true;
    syncTools::syncPointList(mesh, isOn, orEqOp<bool>(), false);
    const labelList on(findIndices(isOn, true));
    List<List<vector>> around(on.size());
    if (plane.deviation > planar)
    {
        Map<label> place(2*on.size());
        forAll(on, i)
        {
            place.insert(on[i], i);
        }
        forAll(patch, facei)
        {
            for (const label pointi : patch[facei])
            {
                around[place[pointi]].append(areas[facei]);
            }
        }
        syncTools::syncPointList
        (
            mesh,
            on,
            around,
            ListOps::appendEqOp<vector>(),
            List<vector>(),
            mapDistribute::transform()
        );
    }

    forAll(on, i)
    {
        List<vector>& basis = normals_(on[i]);
        patch_.insert(on[i], patch.index());
        if (plane.deviation <= planar)
        {
            addDirection(basis, plane.normal);
            continue;
        }
        curved.insert(on[i]);
        List<surfaceNormals::taggedNormal> normals(around[i].size());
        forAll(normals, j)
        {
            normals[j] = {around[i][j], 0};
        }
        for
        (
            const surfaceNormals::taggedNormal& n
          : surfaceNormals::distinct(normals, edgeAngle)
        )
        {
            addDirection(basis, n.normal);
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::symmetryPlanes::symmetryPlanes
(
    const polyMesh& mesh,
    const pointField& points,
    const planarReduction* plane
)
{
    labelHashSet curved;
    for (const label patchi : constraintPatches::keepingNormal(mesh))
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        const bool inPlane =
            isA<wedgePolyPatch>(patch)
         || (isA<emptyPolyPatch>(patch) && mesh.nGeometricD() > 1);
        if (!inPlane)
        {
            addPatch(patch, points, curved);
        }
    }
    points_ = normals_.sortedToc();
    labelHashSet onPlanes(points_);
    onPlanes -= curved;
    onPlanes_ = onPlanes.sortedToc();

    if (plane && plane->active())
    {
        for (const label pointi : points_)
        {
            List<vector> reduced;
            for (const vector& n : normals_[pointi])
            {
                addDirection(reduced, plane->reduce(points[pointi], n));
            }
            normals_[pointi] = reduced;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::vector Foam::symmetryPlanes::kept(const label pointi, vector d) const
{
    const auto found = normals_.cfind(pointi);
    if (!found.found())
    {
        return d;
    }
    if (found.val().size() == 3)
    {
        return Zero;
    }
    for (const vector& n : found.val())
    {
        d -= (d & n)*n;
    }
    return d;
}


Foam::scalar Foam::symmetryPlanes::impose(vectorField& displacement) const
{
    scalar largest = 0;
    for (const label pointi : points_)
    {
        vector& d = displacement[pointi];
        const vector given(d);
        d = kept(pointi, d);
        largest = max(largest, mag(given - d));
    }
    return returnReduce(largest, maxOp<scalar>());
}


// ************************************************************************* //
