/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "symmetryPlanes.H"
#include "surfaceNormals.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Angle between faces of what is taken as one plane [rad]
static const scalar planar = 1e-3;


// Add what of n is independent of an orthonormal basis
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


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::symmetryPlanes::symmetryPlanes
(
    const polyMesh& mesh,
    const pointField& points
)
{
    Map<List<vector>> found;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (!isA<symmetryPolyPatch>(patch) && !isA<symmetryPlanePolyPatch>(patch))
        {
            continue;
        }
        vectorField areas(patch.size());
        forAll(areas, facei)
        {
            areas[facei] = patch[facei].areaNormal(points);
        }
        const surfaceNormals::plane plane(surfaceNormals::planeOf(areas));
        if (plane.empty)
        {
            continue;
        }

        // Ranks may have points of a patch, but no face of it
        boolList isOn(mesh.nPoints(), false);
        UIndirectList<bool>(isOn, patch.meshPoints()) = true;
        syncTools::syncPointList(mesh, isOn, orEqOp<bool>(), false);
        forAll(isOn, pointi)
        {
            if (!isOn[pointi])
            {
                continue;
            }
            List<vector>& basis = found(pointi);
            addDirection(basis, plane.normal);
            for (direction d = 0; plane.deviation > planar && d < 3; ++d)
            {
                vector axis(Zero);
                axis[d] = 1;
                addDirection(basis, axis);
            }
        }
    }

    points_ = found.sortedToc();
    normals_.setSize(points_.size());
    forAll(points_, i)
    {
        normals_[i] = found[points_[i]];
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::symmetryPlanes::impose(vectorField& displacement) const
{
    scalar largest = 0;
    forAll(points_, i)
    {
        vector& d = displacement[points_[i]];
        const vector given(d);
        if (normals_[i].size() == 3)
        {
            d = Zero;
        }
        for (const vector& n : normals_[i])
        {
            d -= (d & n)*n;
        }
        largest = max(largest, mag(given - d));
    }
    return returnReduce(largest, maxOp<scalar>());
}


// ************************************************************************* //
