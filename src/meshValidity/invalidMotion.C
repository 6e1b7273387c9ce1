/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "invalidMotion.H"
#include "movedGeometry.H"
#include "movedPart.H"
#include "plainText.H"
#include "provenCells.H"
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


// What round-off may be, of an area times distances from the origin
static const scalar roundOff = 1e-11;


// Of a face about its mean point; pyramids are six times their volume
static void faceGeometry
(
    const face& f,
    const pointField& points,
    vector& centre,
    vector& area
)
{
    point middle(Zero);
    for (const label pointi : f)
    {
        middle += points[pointi];
    }
    middle /= f.size();

    vector sum(Zero);
    vector weighted(Zero);
    scalar weights = 0;
    forAll(f, i)
    {
        const point& a = points[f[i]];
        const point& b = points[f.nextLabel(i)];
        const vector n((b - a) ^ (middle - a));
        const scalar weight = mag(n);
        sum += n;
        weighted += weight*(a + b + middle);
        weights += weight;
    }
    area = 0.5*sum;
    centre = weighted/(3*weights + VSMALL);
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


bool Foam::invalidMotion::surelyValid
(
    const polyMesh& mesh,
    const pointField& points,
    const movedPart& part
)
{
    const label nFaces = part.faces().size();
    const label nCells = part.cells().size();
    pointField centres(nFaces);
    vectorField areas(nFaces);
    pointField middles(nCells, Zero);
    labelList sides(nCells, Zero);

    const auto eachSide = [&](const auto& use)
    {
        for (label i = 0; i < nFaces; ++i)
        {
            if (part.owner()[i] >= 0)
            {
                use(i, part.owner()[i], 1);
            }
            if (part.neighbour()[i] >= 0)
            {
                use(i, part.neighbour()[i], -1);
            }
        }
    };

    for (label i = 0; i < nFaces; ++i)
    {
        faceGeometry
        (
            mesh.faces()[part.faces()[i]], points, centres[i], areas[i]
        );
    }
    eachSide([&](const label i, const label celli, const int)
    {
        middles[celli] += centres[i];
        ++sides[celli];
    });
    for (label celli = 0; celli < nCells; ++celli)
    {
        middles[celli] /= sides[celli];
    }

    pointField weighted(nCells, Zero);
    scalarField volumes(nCells, Zero);
    scalarField sizes(nCells, Zero);
    eachSide([&](const label i, const label celli, const int sign)
    {
        const scalar volume = sign*(areas[i] & (centres[i] - middles[celli]));
        volumes[celli] += volume;
        weighted[celli] += volume*(0.75*centres[i] + 0.25*middles[celli]);
        sizes[celli] += mag(areas[i])*mag(centres[i]);
    });

    bool valid = true;
    for (label celli = 0; celli < nCells; ++celli)
    {
        valid = valid && volumes[celli] > roundOff*sizes[celli];
        middles[celli] = weighted[celli]/volumes[celli];
    }
    eachSide([&](const label i, const label celli, const int sign)
    {
        const vector out(centres[i] - middles[celli]);
        const scalar size = mag(areas[i])*(mag(centres[i]) + mag(out));
        valid = valid && sign*(areas[i] & out) > roundOff*size;
    });
    return valid;
}


void Foam::invalidMotion::check
(
    const polyMesh& mesh,
    const pointField* reference,
    const pointField& points,
    const movedPart* part
)
{
    typedef movedGeometry geometry;

    // Nearly all motions end here
    autoPtr<geometry> made;
    bitSet cells;
    label nLocal = 1;
    if (part && !part->most())
    {
        nLocal = !surelyValid(mesh, points, *part);
    }
    else if (provenCells::New(mesh).all(points))
    {
        nLocal = 0;
    }
    else
    {
        made.reset(new geometry(mesh, points));
        cells = geometry::nonPositive(made->cellVolumes());
        nLocal =
            geometry::nonPositive(made->pyramidVolumes()).count()
          + cells.count();
    }
    if (returnReduce(nLocal, sumOp<label>()) == 0)
    {
        return;
    }

    if (!made.valid())
    {
        made.reset(new geometry(mesh, points));
        cells = geometry::nonPositive(made->cellVolumes());
    }
    const geometry& after = made();
    const scalarField pyramids(after.syncedPyramidVolumes());
    bitSet faces(geometry::nonPositive(pyramids));

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


Foam::invalidMotion::invalidMotion
(
    const polyMesh& mesh,
    const pointField& reference,
    const pointField& points,
    const movedPart& part
)
:
    nFaces_(0),
    nCells_(0),
    where_(Zero)
{
    check(mesh, &reference, points, &part);
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
