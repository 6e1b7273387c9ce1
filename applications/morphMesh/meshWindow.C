/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshWindow.H"
#include "processorPolyPatch.H"
#include "shownFaces.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshPictures
{

// Of a window, in lengths of the face that changed most
static const scalar windowSize = 8;

// Faces of a window: more are too small to be seen
static const label mostFaces = 6000;

// A plane beside the boundary has fewer, and is moved into the mesh
static const label leastFaces = 12;


labelList meshWindow::crinkle(const scalar offset, const scalarField& heights) const
{
    const fvMesh& mesh = moved_.mesh();
    scalarList others;
    syncTools::swapBoundaryCellList(mesh, heights, others);
    DynamicList<label> cut;
    for (label facei = 0; facei < mesh.nInternalFaces(); ++facei)
    {
        const bool owner = heights[mesh.faceOwner()[facei]] > offset;
        const bool other = heights[mesh.faceNeighbour()[facei]] > offset;
        if (owner != other)
        {
            cut.append(facei);
        }
    }
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        const auto* processor = isA<processorPolyPatch>(patch);
        if (!processor || !processor->owner())
        {
            continue;
        }
        forAll(patch, i)
        {
            const label facei = patch.start() + i;
            const bool owner = heights[mesh.faceOwner()[facei]] > offset;
            const bool other =
                others[facei - mesh.nInternalFaces()] > offset;
            if (owner != other)
            {
                cut.append(facei);
            }
        }
    }
    return labelList(cut);
}


DynamicList<label> meshWindow::within(const labelUList& all, const scalar width) const
{
    DynamicList<label> inside;
    for (const label facei : all)
    {
        vector was(Zero), is(Zero);
        const face& f = moved_.mesh().faces()[facei];
        scalar nearest = GREAT;
        for (const label pointi : f)
        {
            was = moved_.before(pointi) - at.before;
            is = moved_.after(pointi) - at.after;
            nearest = min
            (
                nearest,
                min
                (
                    cmptMax(cmptMag(was - (was & normal)*normal)),
                    cmptMax(cmptMag(is - (is & normal)*normal))
                )
            );
        }
        if (nearest <= (1 + 1e-6)*width)
        {
            inside.append(facei);
        }
    }
    return inside;
}


void meshWindow::take(const labelUList& section)
{
    faces = within(section, reach);
    while (count(faces) > mostFaces)
    {
        reach *= 0.7;
        faces = within(labelList(faces), reach);
    }
}


meshWindow::meshWindow(const word& called, const movedMesh& moved, const peak& place)
:
    moved_(moved),
    name(called),
    at(place),
    normal(moved.normal(place)),
    reach(0)
{
    const boundBox box(moved.mesh().points());
    const scalar whole = 0.5*cmptMax(moved.seen(box.span()));
    const scalar full = max(min(windowSize*at.length, whole), VSMALL);
    reach = full;
    if (moved.planar())
    {
        take(moved.faces());
        return;
    }

    const scalarField heights
    (
        (moved.mesh().cellCentres() - at.before) & normal
    );
    // Not through centres of cells, on either side by round-off
    take(crinkle(0.01*at.length, heights));
    scalar chosen = reach;
    DynamicList<label> most(faces);
    for
    (
        scalar step = at.length/64;
        count(most) < leastFaces && step < 8*whole;
        step *= 2
    )
    {
        for (const scalar offset : {step, -step})
        {
            reach = full;
            take(crinkle(offset, heights));
            if (count(faces) > count(most))
            {
                most = faces;
                chosen = reach;
            }
        }
    }
    faces = most;
    reach = chosen;
}


void meshWindow::write
(
    const cellFigures& before,
    const cellFigures& after,
    const fileName& folder
) const
{
    const fvMesh& mesh = moved_.mesh();
    faceList shown;
    labelList used;
    compact(mesh, faces, shown, used);
    pointField was(used.size());
    vectorField by(used.size());
    forAll(used, i)
    {
        was[i] = moved_.before(used[i]) - at.before;
        by[i] = (moved_.after(used[i]) - at.after) - was[i];
    }
    writeSurface
    (
        folder/name,
        was,
        shown,
        by,
        ofFaces(mesh, before.nonOrthogonality, faces),
        ofFaces(mesh, after.nonOrthogonality, faces)
    );
}


void meshWindow::writeRow(Ostream& os) const
{
    os  << name.c_str();
    for (const vector& v : {at.before, at.after, normal})
    {
        os  << ' ' << v.x() << ' ' << v.y() << ' ' << v.z();
    }
    os  << ' ' << reach << ' ' << at.value << ' '
        << (moved_.planar() ? 2 : 3) << nl;
}

} // End namespace morphMeshPictures
} // End namespace Foam


// ************************************************************************* //
