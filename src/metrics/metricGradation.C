/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "metricGradation.H"
#include "eigenFields.H"
#include "metricFields.H"
#include "syncTools.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// A metric is finer than another by more than round-off
static const scalar refined = 1e-6;

// Sizes grow from cell to cell in so many passes at the latest
static const label mostPasses = 200;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::metricGradation::metricGradation(const polyMesh& mesh)
:
    mesh_(mesh),
    neighbours_(mesh.nCells())
{
    const pointField& centres = mesh.cellCentres();
    const label nInternal = mesh.nInternalFaces();
    pointField otherCentres;
    syncTools::swapBoundaryCellPositions(mesh, centres, otherCentres);

    boolList coupled(mesh.nFaces() - nInternal, false);
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.coupled())
        {
            SubList<bool>(coupled, patch.size(), patch.start() - nInternal) =
                true;
        }
    }

    const vector along(0.754877666, 0.569840291, 0.324717957);
    DynamicList<neighbour> around;
    forAll(neighbours_, celli)
    {
        around.clear();
        const auto add = [&](const label cell, const point& centre)
        {
            around.append({centre & along, cell, centres[celli] - centre});
        };
        for (const label facei : mesh.cells()[celli])
        {
            const label i = facei - nInternal;
            if (i < 0)
            {
                const label own = mesh.faceOwner()[facei];
                const label other =
                    own == celli ? mesh.faceNeighbour()[facei] : own;
                add(other, centres[other]);
            }
            else if (coupled[i])
            {
                add(-1 - i, otherCentres[i]);
            }
        }
        std::sort
        (
            around.begin(),
            around.end(),
            [](const neighbour& a, const neighbour& b)
            {
                return a.place < b.place;
            }
        );
        neighbours_[celli] = around;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::metricGradation::grade
(
    std::vector<morph::Metric>& metrics,
    const scalar growth
) const
{
    bool changed = true;
    for (label pass = 0; changed && pass < mostPasses; ++pass)
    {
        changed = false;
        symmTensorField mine(neighbours_.size());
        forAll(mine, celli)
        {
            mine[celli] = toTensor(metrics[celli]);
        }
        symmTensorField others;
        syncTools::swapBoundaryCellList(mesh_, mine, others);
        std::vector<morph::Metric> next(metrics);
        forAll(neighbours_, celli)
        {
            morph::Metric& m = next[celli];
            for (const neighbour& other : neighbours_[celli])
            {
                const morph::Metric wanted = morph::grown
                (
                    other.cell < 0
                  ? toMetric(others[-1 - other.cell])
                  : metrics[other.cell],
                    toEigen(other.from),
                    growth
                );
                const morph::Metric both = morph::intersection(m, wanted);
                if (both.trace() > (1 + refined)*m.trace())
                {
                    m = both;
                    changed = true;
                }
            }
        }
        metrics.swap(next);
        reduce(changed, orOp<bool>());
    }
}


// ************************************************************************* //
