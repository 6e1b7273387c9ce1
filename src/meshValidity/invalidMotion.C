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

#include "invalidMotion.H"
#include "movedGeometry.H"
#include "syncTools.H"
#include "Tuple2.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A volume and the place it is found at
typedef Tuple2<scalar, point> volumeAt;


//- The smaller volume; of equal ones that with the lower coordinates, so that
//  the choice does not depend on the decomposition
struct smallerVolumeOp
{
    volumeAt operator()(const volumeAt& a, const volumeAt& b) const
    {
        if (a.first() != b.first())
        {
            return a.first() < b.first() ? a : b;
        }

        for (direction cmpt = 0; cmpt < point::nComponents; ++cmpt)
        {
            const scalar ac = a.second()[cmpt];
            const scalar bc = b.second()[cmpt];

            if (ac != bc)
            {
                return ac < bc ? a : b;
            }
        }

        return a;
    }
};


//- What is not a number is worse than any volume
static inline scalar worth(const scalar volume)
{
    return volume == volume ? volume : -VGREAT;
}


static inline label countAll(const bitSet& local)
{
    return returnReduce(label(local.count()), sumOp<label>());
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::invalidMotion::check
(
    const polyMesh& mesh,
    const pointField* reference,
    const pointField& points
)
{
    const movedGeometry geometry(mesh, points);
    bitSet cells(geometry.nonPositiveCells());
    bitSet faces(geometry.wrongFaces());

    // All that a valid motion pays for
    const label nLocal = faces.count() + cells.count();
    if (returnReduce(nLocal, sumOp<label>()) == 0)
    {
        return;
    }

    faces = geometry.syncedWrongFaces();

    if (reference)
    {
        const movedGeometry before(mesh, *reference);
        faces -= before.syncedWrongFaces();
        cells -= before.nonPositiveCells();
    }

    faces &= syncTools::getMasterFaces(mesh);

    nFaces_ = countAll(faces);
    nCells_ = countAll(cells);

    locate(geometry, faces, cells);
}


void Foam::invalidMotion::locate
(
    const movedGeometry& geometry,
    const bitSet& faces,
    const bitSet& cells
)
{
    const smallerVolumeOp smaller;
    volumeAt worst(VGREAT, point::max);

    if (nFaces_)
    {
        for (const label facei : faces)
        {
            worst = smaller
            (
                worst,
                volumeAt
                (
                    worth(geometry.pyramidVolume(facei)),
                    geometry.faceCentres()[facei]
                )
            );
        }
    }
    else
    {
        for (const label celli : cells)
        {
            worst = smaller
            (
                worst,
                volumeAt
                (
                    worth(geometry.cellVolumes()[celli]),
                    geometry.cellCentres()[celli]
                )
            );
        }
    }

    where_ = returnReduce(worst, smaller).second();
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::invalidMotion::invalidMotion
(
    const polyMesh& mesh,
    const pointField& points
)
:
    nFaces_(0),
    nCells_(0),
    where_(Zero)
{
    check(mesh, nullptr, points);
}


Foam::invalidMotion::invalidMotion
(
    const polyMesh& mesh,
    const pointField& reference,
    const pointField& points
)
:
    nFaces_(0),
    nCells_(0),
    where_(Zero)
{
    check(mesh, &reference, points);
}


// * * * * * * * * * * * * * * * Ostream Operator  * * * * * * * * * * * * * //

Foam::Ostream& Foam::operator<<(Ostream& os, const invalidMotion& invalid)
{
    os  << invalid.nFaces_ << " wrongly oriented faces and "
        << invalid.nCells_ << " cells without positive volume";

    if (!invalid.empty())
    {
        os  << ", the worst at " << invalid.where_;
    }

    return os;
}


// ************************************************************************* //
