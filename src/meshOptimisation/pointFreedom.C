/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "pointFreedom.H"
#include "constraintPatches.H"
#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "processorPolyPatch.H"
#include "syncTools.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::pointFreedom::pointFreedom
(
    const polyMesh& mesh,
    const pointField& points0,
    const reducedMesh& reduced,
    const labelHashSet& sliding,
    const labelUList& staying
)
:
    mesh_(mesh),
    points0_(points0),
    reduced_(reduced),
    planes_(mesh, points0, &reduced.plane()),
    coupled_(!reduced.coupled().empty()),
    free_(mesh.nPoints(), true)
{
    labelHashSet open(sliding);
    open.insert(constraintPatches::slidingSurfaces(mesh));
    DynamicList<label> held;
    held.append(staying);
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        const bool joins =
            isA<processorPolyPatch>(patch)
         || (isA<cyclicPolyPatch>(patch) && !open.found(patch.index()));
        const bool inPlane =
            isA<wedgePolyPatch>(patch) || isA<emptyPolyPatch>(patch);
        if (!joins && !inPlane && !open.found(patch.index()))
        {
            held.append(patch.meshPoints());
        }
    }

    // Along curved symmetry patches a point would go off its surface
    const labelHashSet onPlanes(planes_.onPlanes());
    forAll(free_, pointi)
    {
        if
        (
            planes_.patchOf(pointi) >= 0
         && !onPlanes.found(pointi)
         && !sliding.found(planes_.patchOf(pointi))
        )
        {
            held.append(pointi);
        }
    }
    stop(held);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::pointFreedom::stop(const labelUList& points)
{
    for (const label pointi : points)
    {
        free_[pointi] = false;
    }
    syncTools::syncPointList(mesh_, free_, andEqOp<bool>(), true);
}


void Foam::pointFreedom::project
(
    const vectorField&,
    vectorField& velocity
) const
{
    const planarReduction& plane = reduced_.plane();
    forAll(velocity, pointi)
    {
        vector& v = velocity[pointi];
        if (!free_[pointi])
        {
            v = Zero;
        }
        else if (plane.active() && plane.onAxis(points0_[pointi]))
        {
            v -= (v & plane.radial())*plane.radial();
        }
        v = planes_.kept(pointi, v);
    }
    if (coupled_)
    {
        reduced_.match(velocity);
    }
}


void Foam::pointFreedom::retract(vectorField& displacement) const
{
    if (coupled_)
    {
        reduced_.match(displacement);
    }
}


// ************************************************************************* //
