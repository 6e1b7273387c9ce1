/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "movedMesh.H"
#include "emptyPolyPatch.H"
#include "foamCompat.H"
#include "wedgePolyPatch.H"

#include <cmath>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshPictures
{

void peak::reduce()
{
    List<peak> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = *this;
    foamCompat::allGatherList(all);
    for (const peak& other : all)
    {
        if (other.beats(*this))
        {
            *this = other;
        }
    }
}


void movedMesh::findFaces()
{
    if (across_ < 0)
    {
        faces_ = identity(mesh_.nFaces());
        return;
    }
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch))
        {
            forAll(patch, i)
            {
                const label facei = patch.start() + i;
                const vector area
                (
                    mesh_.faces()[facei].areaNormal(mesh_.points())
                );
                if (area[across_] > 0.5*mag(area))
                {
                    faces_.append(facei);
                }
            }
        }
    }
}


movedMesh::movedMesh(const fvMesh& mesh, const pointField& after)
:
    mesh_(mesh),
    after_(after),
    across_(-1)
{
    for (direction i = 0; i < 3; ++i)
    {
        if (mesh.geometricD()[i] < 0)
        {
            across_ = i;
        }
    }
    findFaces();
}


scalar movedMesh::length(const label facei) const
{
    scalar longest = 0;
    const face& f = mesh_.faces()[facei];
    forAll(f, i)
    {
        for (label j = 0; j < i; ++j)
        {
            longest = max
            (
                longest,
                max
                (
                    mag(seen(before(f[i]) - before(f[j]))),
                    mag(seen(after(f[i]) - after(f[j])))
                )
            );
        }
    }
    return longest;
}


vector movedMesh::normal(const peak& at) const
{
    vector n(Zero);
    if (planar())
    {
        n[across_] = 1;
        return n;
    }
    const vector moved(at.after - at.before);
    const vector u(moved/max(mag(moved), VSMALL));
    const vector v(at.along/max(mag(at.along), VSMALL));
    direction least = 1;
    for (const direction i : {0, 2})
    {
        if (sqr(u[i]) + sqr(v[i]) < sqr(u[least]) + sqr(v[least]) - 1e-6)
        {
            least = i;
        }
    }
    n[least] = 1;
    return n;
}


peak mostChanged(const movedMesh& moved)
{
    peak most;
    for (const label facei : moved.faces())
    {
        const face& f = moved.mesh().faces()[facei];
        forAll(f, i)
        {
            for (label j = 0; j < i; ++j)
            {
                const vector was
                (
                    moved.seen(moved.before(f[i]) - moved.before(f[j]))
                );
                const vector is
                (
                    moved.seen(moved.after(f[i]) - moved.after(f[j]))
                );
                if (magSqr(was) <= VSMALL)
                {
                    continue;
                }
                peak here;
                here.value =
                    std::abs(std::log(max(mag(is), VSMALL)/mag(was)));
                here.before =
                    0.5*(moved.before(f[i]) + moved.before(f[j]));
                if (!(here.value >= most.value))
                {
                    continue;
                }
                here.after = 0.5*(moved.after(f[i]) + moved.after(f[j]));
                here.length = moved.length(facei);
                here.along = was;
                if (here.beats(most))
                {
                    most = here;
                }
            }
        }
    }
    most.reduce();
    return most;
}

} // End namespace morphMeshPictures
} // End namespace Foam


// ************************************************************************* //
