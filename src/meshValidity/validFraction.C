/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "validFraction.H"
#include "movingCells.H"
#include "Tuple2.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::validFraction::criterion>
Foam::validFraction::criterionNames
({
    { criterion::none, "none" },
    { criterion::tetrahedra, "tetrahedra" },
    { criterion::facesAndCells, "facesAndCells" }
});

const Foam::scalar Foam::validFraction::margin = 0.1;


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The golden section: no mesh breaks at such a fraction by design, so that
// round-off never decides
static const scalar goldenSection = 0.6180339887498949;

// The fraction by OpenFOAM's criterion is known to this, and where both
// criteria agree to this, it is that of the tetrahedra
static const scalar tolerance = 1e-6;

// Number of sections to reach that accuracy
static const label nSections = 30;

// Orders positions that break at the same fraction; no mesh is aligned with it
static const vector obliqueDirection(1, 0.7548776662466927, 0.5698402909980532);

//- Orders cells by fraction, then position
typedef Tuple2<scalar, Tuple2<scalar, point>> rankedCell;


struct firstCellOp
{
    rankedCell operator()(const rankedCell& a, const rankedCell& b) const
    {
        const bool equal = a.first() == b.first();
        const bool later =
            equal
          ? b.second().first() < a.second().first()
          : b.first() < a.first();
        return later ? b : a;
    }
};


static bool allFinite(const vectorField& displacement)
{
    bool finite = true;
    for (const vector& d : displacement)
    {
        finite =
            finite
         && std::isfinite(d.x())
         && std::isfinite(d.y())
         && std::isfinite(d.z());
    }
    return returnReduce(finite, andOp<bool>());
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::validFraction::validFraction
(
    const polyMesh& mesh,
    const pointField& reference,
    const vectorField& displacement
)
:
    mesh_(mesh),
    reference_(reference),
    displacement_(displacement),
    whole_(invalidAt(1)),
    value_(1),
    criterion_(criterion::none),
    where_(Zero)
{
    if (whole_.empty())
    {
        return;
    }

    cells_ = whole_.cells();
    cellFractions_.setSize(mesh.nCells(), 1);
    if (allFinite(displacement))
    {
        limitByTetrahedra();
        limitByFacesAndCells();
    }
    else
    {
        value_ = 0;
        criterion_ = criterion::facesAndCells;
        where_ = whole_.where();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::validFraction::pointsAt
(
    const scalar fraction
) const
{
    return reference_ + fraction*displacement_;
}


Foam::invalidMotion Foam::validFraction::invalidAt(const scalar fraction) const
{
    return invalidMotion(mesh_, reference_, pointsAt(fraction)());
}


void Foam::validFraction::limitByTetrahedra()
{
    const pointField after(pointsAt(1));
    const movingCells moving(mesh_, reference_, after);

    const auto rank = [&](const label celli, const scalar fraction)
    {
        const point x(movingCells::average(mesh_, celli, reference_));
        return rankedCell
        (
            fraction, Tuple2<scalar, point>(x & obliqueDirection, x)
        );
    };

    rankedCell first(VGREAT, Tuple2<scalar, point>(VGREAT, Zero));
    label firstCell = -1;
    forAll(cellFractions_, celli)
    {
        const scalar fraction = moving.positiveUpTo(celli);
        cellFractions_[celli] = min(fraction, 1);
        if (fraction > 1 || fraction > first.first())
        {
            continue;
        }
        const rankedCell candidate(rank(celli, fraction));
        if (firstCellOp()(first, candidate) == candidate)
        {
            first = candidate;
            firstCell = celli;
        }
    }

    const rankedCell mine(first);
    reduce(first, firstCellOp());
    if (first.first() <= 1)
    {
        value_ = first.first();
        criterion_ = criterion::tetrahedra;
        where_ = first.second().second();
        if (firstCell >= 0 && mine == first)
        {
            cells_.set(firstCell);
        }
    }
}


void Foam::validFraction::limitByFacesAndCells()
{
    if (invalidAt((1 - tolerance)*value_).empty())
    {
        return;
    }

    scalar valid = 0;
    scalar broken = (1 - tolerance)*value_;
    for (label i = 0; i < nSections; ++i)
    {
        const scalar fraction = valid + goldenSection*(broken - valid);
        (invalidAt(fraction).empty() ? valid : broken) = fraction;
    }

    const invalidMotion first(invalidAt(broken));
    cells_ |= first.cells();
    value_ = valid;
    criterion_ = criterion::facesAndCells;
    where_ = first.where();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::validFraction::withMargin() const
{
    if (criterion_ == criterion::none)
    {
        return 1;
    }

    // Reduce further in the rare case that the mesh was invalid on the way
    scalar fraction = (1 - margin)*value_;
    for (label i = 0; i < nSections && !invalidAt(fraction).empty(); ++i)
    {
        fraction *= goldenSection;
    }
    return invalidAt(fraction).empty() ? fraction : 0;
}


// ************************************************************************* //
