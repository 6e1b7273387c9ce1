/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "invalidMotion.H"
#include "movedGeometry.H"
#include "plainText.H"
#include "syncTools.H"
#include "Tuple2.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A position, and its order among equally bad positions
typedef Tuple2<scalar, point> rankedPoint;


struct lowerRankOp
{
    rankedPoint operator()(const rankedPoint& a, const rankedPoint& b) const
    {
        return b.first() < a.first() ? b : a;
    }
};


//- Not a number is worse than any volume
static inline scalar worth(const scalar volume)
{
    return volume == volume ? volume : -VGREAT;
}


static inline label countAll(const bitSet& local)
{
    return returnReduce(label(local.count()), sumOp<label>());
}


//- The position of the smallest of the selected volumes over all ranks. In
//  regular meshes several are equal up to round-off, which depends on the
//  decomposition: of these, take the first along a direction that no mesh is
//  aligned with
static point worstOf
(
    const bitSet& selected,
    const scalarField& volumes,
    const vectorField& centres
)
{
    const vector direction(1, 0.7548776662466927, 0.5698402909980532);

    scalar smallest = VGREAT;
    for (const label i : selected)
    {
        smallest = min(smallest, worth(volumes[i]));
    }
    reduce(smallest, minOp<scalar>());

    rankedPoint worst(VGREAT, Zero);
    for (const label i : selected)
    {
        if (worth(volumes[i]) <= smallest + 1e-6*mag(smallest))
        {
            worst = lowerRankOp()
            (
                worst,
                rankedPoint(centres[i] & direction, centres[i])
            );
        }
    }
    reduce(worst, lowerRankOp());

    return worst.second();
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::invalidMotion::addCellsOf
(
    const bitSet& faces,
    const polyMesh& mesh,
    const movedGeometry& geometry
)
{
    const auto wrong = [&](const label facei, const label celli, const int sign)
    {
        const vector out
        (
            geometry.faceCentres()[facei] - geometry.cellCentres()[celli]
        );
        return !(sign*(geometry.faceAreas()[facei] & out) > 0);
    };

    for (const label facei : faces)
    {
        const label own = mesh.faceOwner()[facei];
        if (wrong(facei, own, 1))
        {
            cells_.set(own);
        }
        if (mesh.isInternalFace(facei))
        {
            const label nei = mesh.faceNeighbour()[facei];
            if (wrong(facei, nei, -1))
            {
                cells_.set(nei);
            }
        }
    }
}


void Foam::invalidMotion::check
(
    const polyMesh& mesh,
    const pointField* reference,
    const pointField& points
)
{
    typedef movedGeometry geometry;

    const geometry after(mesh, points);
    bitSet faces(geometry::nonPositive(after.pyramidVolumes()));
    bitSet cells(geometry::nonPositive(after.cellVolumes()));

    // A valid motion costs no more than this
    const label nLocal = faces.count() + cells.count();
    if (returnReduce(nLocal, sumOp<label>()) == 0)
    {
        return;
    }

    const scalarField pyramids(after.syncedPyramidVolumes());
    faces = geometry::nonPositive(pyramids);

    if (reference)
    {
        const geometry before(mesh, *reference);
        faces -= geometry::nonPositive(before.syncedPyramidVolumes());
        cells -= geometry::nonPositive(before.cellVolumes());
    }

    cells_ = cells;
    cells_.resize(mesh.nCells());
    addCellsOf(faces, mesh, after);

    faces &= syncTools::getMasterFaces(mesh);

    nFaces_ = countAll(faces);
    nCells_ = countAll(cells);

    if (nFaces_)
    {
        where_ = worstOf(faces, pyramids, after.faceCentres());
    }
    else if (nCells_)
    {
        where_ = worstOf(cells, after.cellVolumes(), after.cellCentres());
    }
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
    os  << plainText::counted(invalid.nFaces_, "wrongly oriented face").c_str()
        << " and " << plainText::counted(invalid.nCells_, "cell").c_str()
        << " without positive volume";

    if (!invalid.empty())
    {
        os  << ", the worst at " << invalid.where_;
    }

    return os;
}


// ************************************************************************* //
