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

Foam::scalar Foam::movedGeometry::pyramidVolume(const label facei) const
{
    const vector& area = faceAreas_[facei];
    const point& centre = faceCentres_[facei];

    const scalar own =
        (area & (centre - cellCentres_[mesh_.faceOwner()[facei]]))/3;

    if (!mesh_.isInternalFace(facei))
    {
        return own;
    }

    const scalar nei =
        (area & (cellCentres_[mesh_.faceNeighbour()[facei]] - centre))/3;

    // Not min(): it hides the one that is not a number
    return own == own && !(nei > own) ? nei : own;
}


Foam::bitSet Foam::movedGeometry::nonPositiveCells() const
{
    bitSet wrong(mesh_.nCells());

    forAll(cellVolumes_, celli)
    {
        if (!(cellVolumes_[celli] > 0))
        {
            wrong.set(celli);
        }
    }

    return wrong;
}


Foam::bitSet Foam::movedGeometry::wrongFaces() const
{
    bitSet wrong(mesh_.nFaces());

    forAll(faceAreas_, facei)
    {
        if (!(pyramidVolume(facei) > 0))
        {
            wrong.set(facei);
        }
    }

    return wrong;
}


Foam::bitSet Foam::movedGeometry::syncedWrongFaces() const
{
    bitSet wrong(wrongFaces());
    syncTools::syncFaceList(mesh_, wrong, orEqOp<unsigned int>());
    return wrong;
}


// ************************************************************************* //
