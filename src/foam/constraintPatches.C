/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "constraintPatches.H"
#include "foamCompat.H"
#include "emptyPolyPatch.H"
#include "pointConstraint.H"
#include "pointMesh.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::labelList Foam::constraintPatches::keepingNormal(const polyMesh& mesh)
{
    const polyBoundaryMesh& patches = mesh.boundaryMesh();
    const pointBoundaryMesh& pointPatches = foamCompat::pointMeshOf(mesh).boundary();

    // Ranks without a point of a patch cannot ask it
    boolList keeps(patches.nNonProcessor(), false);
    forAll(keeps, patchi)
    {
        const label i = pointPatches.findPatchID(patches[patchi].name());
        if (i >= 0 && pointPatches[i].size())
        {
            pointConstraint constraint;
            pointPatches[i].applyConstraint(0, constraint);
            keeps[patchi] = constraint.first() > 0;
        }
    }
    foamCompat::allCombineList(keeps, orEqOp<bool>());
    return findIndices(keeps, true);
}


Foam::labelList Foam::constraintPatches::slidingSurfaces(const polyMesh& mesh)
{
    DynamicList<label> surfaces;
    for (const label patchi : keepingNormal(mesh))
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        if (!isA<emptyPolyPatch>(patch) && !isA<wedgePolyPatch>(patch))
        {
            surfaces.append(patchi);
        }
    }
    return labelList(surfaces);
}


// ************************************************************************* //
