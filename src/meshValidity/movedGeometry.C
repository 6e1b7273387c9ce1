/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

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

        // Unlike min() this does not lose what is not a number
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

    // What is not a number would depend on the order of comparison
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
