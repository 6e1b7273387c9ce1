/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "shownFaces.H"
#include "foamVtkSurfaceWriter.H"
#include "syncTools.H"
#include "wholeFile.H"

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshPictures
{

scalarField ofFaces
(
    const fvMesh& mesh,
    const scalarField& cells,
    const labelUList& faces
)
{
    scalarList others;
    syncTools::swapBoundaryCellList(mesh, cells, others);
    scalarField values(faces.size());
    forAll(faces, i)
    {
        const label facei = faces[i];
        const label patchi = mesh.boundaryMesh().whichPatch(facei);
        const scalar own = cells[mesh.faceOwner()[facei]];
        values[i] =
            patchi < 0
          ? max(own, cells[mesh.faceNeighbour()[facei]])
          : mesh.boundaryMesh()[patchi].coupled()
          ? max(own, others[facei - mesh.nInternalFaces()])
          : own;
    }
    return values;
}


void compact
(
    const fvMesh& mesh,
    const labelUList& which,
    faceList& faces,
    labelList& points
)
{
    faces.setSize(which.size());
    Map<label> place(4*which.size());
    DynamicList<label> used;
    forAll(which, i)
    {
        faces[i] = mesh.faces()[which[i]];
        for (label& pointi : faces[i])
        {
            if (place.insert(pointi, used.size()))
            {
                used.append(pointi);
            }
            pointi = place[pointi];
        }
    }
    points.transfer(used);
}


void writeSurface
(
    const fileName& file,
    const pointField& points,
    const faceList& faces,
    const vectorField& displacement,
    const scalarField& before,
    const scalarField& after
)
{
    vtk::surfaceWriter writer(points, faces, file);
    writer.writeGeometry();
    writer.beginCellData(2);
    writer.write("nonOrthogonalityBefore", before);
    writer.write("nonOrthogonalityAfter", after);
    writer.beginPointData(1);
    writer.write("displacement", displacement);
    const fileName written(writer.output());
    writer.close();
    wholeFile::checkEnd(written, "</VTKFile>");
}

} // End namespace morphMeshPictures
} // End namespace Foam


// ************************************************************************* //
