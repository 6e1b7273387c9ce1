/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "movedGeometry.H"
#include "foamCompat.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::movedGeometry::movedGeometry
(
    const polyMesh& mesh,
    const pointField& points
)
:
    mesh_(mesh),
    faceCentres_(mesh.nFaces()),
    faceAreas_(mesh.nFaces()),
    cellCentres_(mesh.nCells()),
    cellVolumes_(mesh.nCells())
{
    foamCompat::makeFaceCentresAndAreas
    (
        mesh, points, faceCentres_, faceAreas_
    );
    foamCompat::makeCellCentresAndVols
    (
        mesh, faceCentres_, faceAreas_, cellCentres_, cellVolumes_
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalarField Foam::movedGeometry::pyramidVolumes() const
{
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();

    scalarField volumes(mesh_.nFaces());

    forAll(volumes, facei)
    {
        volumes[facei] =
            faceAreas_[facei]
          & (faceCentres_[facei] - cellCentres_[own[facei]]);
    }

    forAll(nei, facei)
    {
        const scalar other =
            faceAreas_[facei]
          & (cellCentres_[nei[facei]] - faceCentres_[facei]);

        // Unlike min() this keeps what is not a number
        if (!(other >= volumes[facei]) && volumes[facei] == volumes[facei])
        {
            volumes[facei] = other;
        }
    }

    volumes /= 3;
    return volumes;
}


Foam::scalarField Foam::movedGeometry::syncedPyramidVolumes() const
{
    scalarField volumes(pyramidVolumes());

    // With not-a-numbers the result would depend on the order of comparison
    for (scalar& volume : volumes)
    {
        if (volume != volume)
        {
            volume = -VGREAT;
        }
    }

    syncTools::syncFaceList(mesh_, volumes, minEqOp<scalar>());
    return volumes;
}


Foam::bitSet Foam::movedGeometry::nonPositive(const scalarField& volumes)
{
    bitSet wrong(volumes.size());

    forAll(volumes, i)
    {
        if (!(volumes[i] > 0))
        {
            wrong.set(i);
        }
    }

    return wrong;
}


// ************************************************************************* //
