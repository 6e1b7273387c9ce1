/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "planePatches.H"
#include "boundBox.H"
#include "polyMesh.H"
#include "SubField.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Cosine of the angle between faces that an edge is sharp from: 45 degrees
static const scalar sharp = 0.7;

//- Distance from a plane that counts as round-off, of the size of the mesh
static const scalar roundOff = 1e-12;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::planePatches::planePatches(const polyMesh& mesh)
:
    mesh_(mesh),
    planes_(mesh.nBoundaryFaces(), -1)
{
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        // Coupled patches and those of plane meshes keep their faces
        if
        (
            !polyPatch::constraintType(patch.type())
         || patch.type().starts_with("symmetry")
        )
        {
            findPlanes(patch.index());
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::planePatches::findPlanes(const label patchi)
{
    const polyPatch& patch = mesh_.boundaryMesh()[patchi];
    const vectorField areas(patch.faceAreas());
    vectorField normals(areas);
    normals /= mag(areas) + VSMALL;
    const label offset = patch.start() - mesh_.nInternalFaces();
    boolList visited(patch.size(), false);
    forAll(patch, start)
    {
        if (visited[start])
        {
            continue;
        }
        DynamicList<label> sheet(1, start);
        visited[start] = true;
        vector sum(Zero);
        for (label i = 0; i < sheet.size(); ++i)
        {
            const label facei = sheet[i];
            sum += areas[facei];
            for (const label edgei : patch.faceEdges()[facei])
            {
                for (const label other : patch.edgeFaces()[edgei])
                {
                    if
                    (
                        !visited[other]
                     && (normals[facei] & normals[other]) > sharp
                    )
                    {
                        visited[other] = true;
                        sheet.append(other);
                    }
                }
            }
        }
        const vector normal(sum/(mag(sum) + VSMALL));
        const point& on = mesh_.points()[patch[start][0]];
        scalar farthest = 0;
        for (const label facei : sheet)
        {
            for (const label pointi : patch[facei])
            {
                farthest = max
                (
                    farthest, mag(normal & (mesh_.points()[pointi] - on))
                );
            }
        }
        const scalar size = max(mesh_.bounds().mag(), mag(on));
        if (farthest <= roundOff*size)
        {
            for (const label facei : sheet)
            {
                planes_[offset + facei] = patches_.size();
            }
            patches_.append(patchi);
            normals_.append(normal);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::planePatches::plane(const label facei) const
{
    return planes_[facei - mesh_.nInternalFaces()];
}


// ************************************************************************* //
