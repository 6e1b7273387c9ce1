/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "firstCells.H"
#include "movedGeometry.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::firstCells::firstCells
(
    const polyMesh& mesh,
    const pointField& points
)
:
    mesh_(mesh),
    heights_(mesh.boundaryMesh().nNonProcessor())
{
    const movedGeometry geometry(mesh, points);
    forAll(heights_, patchi)
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        if (polyPatch::constraintType(patch.type()))
        {
            continue;
        }
        scalarField& least = heights_[patchi];
        least.setSize(patch.nPoints(), GREAT);
        forAll(patch, i)
        {
            const scalar height =
                geometry.cellVolumes()[patch.faceCells()[i]]
               /max(mag(geometry.faceAreas()[patch.start() + i]), VSMALL);
            for (const label pointi : patch.localFaces()[i])
            {
                least[pointi] = min(least[pointi], height);
            }
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::firstCells::least(const labelUList& meshPoints) const
{
    // Points that ranks share are asked for by one of them
    boolList asked(mesh_.nPoints(), false);
    for (const label pointi : meshPoints)
    {
        if (pointi >= 0)
        {
            asked[pointi] = true;
        }
    }
    syncTools::syncPointList(mesh_, asked, orEqOp<bool>(), false);

    scalar height = GREAT;
    forAll(heights_, patchi)
    {
        const labelList& points = mesh_.boundaryMesh()[patchi].meshPoints();
        forAll(heights_[patchi], i)
        {
            if (asked[points[i]])
            {
                height = min(height, heights_[patchi][i]);
            }
        }
    }
    return returnReduce(height, minOp<scalar>());
}


// ************************************************************************* //
