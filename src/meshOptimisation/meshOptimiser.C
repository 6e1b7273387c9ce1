/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshOptimiser.H"
#include "clockTime.H"
#include "distortionMinimiser.hpp"
#include "meshQuality.H"
#include "movedGeometry.H"
#include "plainText.H"
#include "polyMeshTools.H"
#include "pstreamCommunicator.H"
#include "syncTools.H"
#include "unitConversion.H"
#include "untrapped.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Iterations between two lines of the log
static const label reportEvery = 50;


//- The freedom of points as the numerical core asks for it
class coreMotion
:
    public morph::PointMotion
{
    const polyMesh& mesh_;
    const simplexCells& cells_;
    const pointFreedom& freedom_;
    const boolList& free_;

    //- Positions without displacement
    const morph::Vectors x0_;

    vectorField toMesh(const morph::Vectors& v) const
    {
        vectorField field(mesh_.nPoints(), Zero);
        forAll(cells_.points(), i)
        {
            field[cells_.points()[i]] = cells_.fromCore(v, i);
        }
        return field;
    }

public:

    coreMotion
    (
        const polyMesh& mesh,
        const simplexCells& cells,
        const pointFreedom& freedom,
        const boolList& free,
        const morph::Vectors& x0
    )
    :
        mesh_(mesh),
        cells_(cells),
        freedom_(freedom),
        free_(free),
        x0_(x0)
    {}

    virtual void exchange(morph::Vectors& v) override
    {
        cells_.exchange(v);
    }

    virtual std::vector<bool> free() override
    {
        return cells_.exchanged(free_);
    }

    virtual void project(const morph::Vectors& x, morph::Vectors& v) override
    {
        morph::Vectors all(morph::Vectors::Zero(x.rows(), 3));
        const label n = cells_.nOwned();
        all.topRows(n) = v.topRows(n);
        cells_.exchange(all);
        vectorField velocity(toMesh(all));
        forAll(velocity, pointi)
        {
            velocity[pointi] = free_[pointi] ? velocity[pointi] : Zero;
        }
        freedom_.project(toMesh(x - x0_), velocity);
        for (label i = 0; i < n; ++i)
        {
            const vector& u = velocity[cells_.points()[i]];
            v.row(i) = cells_.toCore(u).transpose();
        }
    }

    virtual void retract(morph::Vectors& x) override
    {
        vectorField displacement(toMesh(x - x0_));
        const vectorField before(displacement);
        freedom_.retract(displacement);
        for (label i = 0; i < cells_.nOwned(); ++i)
        {
            const label pointi = cells_.points()[i];
            if (displacement[pointi] != before[pointi])
            {
                x.row(i) =
                    x0_.row(i)
                  + cells_.toCore(displacement[pointi]).transpose();
            }
        }
        cells_.exchange(x);
    }

    vectorField displacement(const morph::Vectors& x) const
    {
        return toMesh(x - x0_);
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshOptimiser::meshOptimiser
(
    const polyMesh& mesh,
    const optimiseSettings& settings,
    const pointField& target,
    const reducedMesh& reduced
)
:
    mesh_(mesh),
    settings_(settings),
    reduced_(reduced),
    cells_(mesh, target, reduced.plane(), settings.target)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::meshOptimiser::worst(const quality& q) const
{
    return max
    (
        q.nonOrthogonality/settings_.nonOrthogonality,
        q.skewness/settings_.skewness
    );
}


bool Foam::meshOptimiser::exceeds(const quality& q) const
{
    return
        q.nInvalid > 0 || worst(q) > 1
     || q.determinant < settings_.determinant;
}


bool Foam::meshOptimiser::better(const quality& a, const quality& b) const
{
    if (a.nInvalid != b.nInvalid)
    {
        return a.nInvalid < b.nInvalid;
    }
    const bool flat = b.determinant < settings_.determinant;
    return
        worst(a) < worst(b)
     || (flat && a.determinant > b.determinant && worst(a) <= 1);
}


Foam::boolList Foam::meshOptimiser::aroundBad(const pointField& points) const
{
    const movedGeometry geometry(mesh_, points);
    const scalarField cosines
    (
        polyMeshTools::faceOrthogonality
        (
            mesh_, geometry.faceAreas(), geometry.cellCentres()
        )
    );
    const scalarField skewness
    (
        polyMeshTools::faceSkewness
        (
            mesh_,
            points,
            geometry.faceCentres(),
            geometry.faceAreas(),
            geometry.cellCentres()
        )
    );
    const scalarField pyramids(geometry.syncedPyramidVolumes());
    const scalar least = Foam::cos(degToRad(settings_.nonOrthogonality));
    boolList around(mesh_.nPoints(), false);
    const auto addCell = [&](const label celli)
    {
        for (const label facei : mesh_.cells()[celli])
        {
            UIndirectList<bool>(around, mesh_.faces()[facei]) = true;
        }
    };
    forAll(cosines, facei)
    {
        const bool good =
            cosines[facei] >= least
         && skewness[facei] <= settings_.skewness
         && pyramids[facei] > 0;
        if (!good)
        {
            addCell(mesh_.faceOwner()[facei]);
            if (mesh_.isInternalFace(facei))
            {
                addCell(mesh_.faceNeighbour()[facei]);
            }
        }
    }
    pointField inPlane(points.size());
    forAll(points, pointi)
    {
        inPlane[pointi] = reduced_.plane().position(points[pointi]);
    }
    const std::vector<double> determinants
    (
        cells_.simplices().cellState(cells_.positions(inPlane), {}).determinant
    );
    forAll(cells_.cells(), celli)
    {
        const label i = cells_.cells()[celli];
        if (i >= 0 && determinants[i] < settings_.determinant)
        {
            addCell(celli);
        }
    }
    syncTools::syncPointList(mesh_, around, orEqOp<bool>(), false);

    for (label layer = 1; layer < settings_.layers; ++layer)
    {
        const boolList former(around);
        forAll(mesh_.cells(), celli)
        {
            bool touches = false;
            for (const label facei : mesh_.cells()[celli])
            {
                for (const label pointi : mesh_.faces()[facei])
                {
                    touches = touches || former[pointi];
                }
            }
            if (touches)
            {
                addCell(celli);
            }
        }
        syncTools::syncPointList(mesh_, around, orEqOp<bool>(), false);
    }
    return around;
}


void Foam::meshOptimiser::report
(
    const quality& before,
    const quality& after,
    const label nIterations,
    const scalar time
) const
{
    using plainText::rounded;
    const auto change = [](const scalar a, const scalar b)
    {
        return rounded(a) + " -> " + rounded(b);
    };
    Info<< "optimise: non-orthogonality "
        << change(before.nonOrthogonality, after.nonOrthogonality).c_str()
        << ", skewness " << change(before.skewness, after.skewness).c_str()
        << ", determinant "
        << change(before.determinant, after.determinant).c_str()
        << ", invalid " << before.nInvalid << " -> " << after.nInvalid << "; "
        << nIterations << " iterations, " << rounded(time).c_str() << " s"
        << endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::meshOptimiser::quality Foam::meshOptimiser::judge
(
    const pointField& points
) const
{
    const meshQuality q(mesh_, points);
    pointField inPlane(points.size());
    forAll(points, pointi)
    {
        inPlane[pointi] = reduced_.plane().position(points[pointi]);
    }
    const morph::SimplexMesh& simplices = cells_.simplices();
    const std::vector<double> determinants
    (
        simplices.cellState(cells_.positions(inPlane), {}).determinant
    );
    const scalar least =
        determinants.empty()
      ? GREAT
      : *std::min_element(determinants.begin(), determinants.end());
    return
    {
        q.nWrongFaces() + q.nNonPositiveCells(),
        q.maxNonOrthogonality(),
        q.maxSkewness(),
        returnReduce(least, minOp<scalar>())
    };
}


bool Foam::meshOptimiser::improve
(
    const pointFreedom& freedom,
    const pointField& points0,
    vectorField& inPlane
) const
{
    if (settings_.never())
    {
        return false;
    }
    const clockTime clock;
    const auto moved = [&](const vectorField& d)
    {
        return pointField(points0 + reduced_.expand(d));
    };
    const quality before(judge(moved(inPlane)));
    if
    (
        settings_.when == optimiseSettings::trigger::needed
     && !exceeds(before)
    )
    {
        return false;
    }

    boolList free(freedom.free());
    if (settings_.layers >= 0)
    {
        const boolList around(aroundBad(moved(inPlane)));
        forAll(free, pointi)
        {
            free[pointi] = free[pointi] && around[pointi];
        }
    }
    pointField start(points0.size());
    forAll(start, pointi)
    {
        start[pointi] = reduced_.plane().position(points0[pointi]);
    }
    const morph::Vectors x0(cells_.positions(start));
    coreMotion motion(mesh_, cells_, freedom, free, x0);
    pstreamCommunicator communicator;
    morph::DistortionMinimiser minimiser
    (
        cells_.simplices(), motion, communicator
    );

    label nStages = 1;
    for (label p = 1; p < settings_.power; p *= 2)
    {
        ++nStages;
    }
    forAll(start, pointi)
    {
        start[pointi] += inPlane[pointi];
    }
    morph::Vectors x(cells_.positions(start));
    const vectorField given(inPlane);
    quality best(before);
    bool changed = false;
    label nIterations = 0;
    // Powers of a step that goes too far may be beyond all numbers: it is made
    // shorter then
    const untrapped numbers;
    label stagei = 0;
    while (stagei < nStages && nIterations < settings_.iterations)
    {
        morph::DistortionMinimiser::Stage stage;
        stage.power = min(label(1) << stagei, settings_.power);
        stage.sizeWeight = settings_.sizeWeight;
        stage.iterations = max
        (
            label(1),
            (settings_.iterations - nIterations)/(nStages - stagei)
        );
        const label nMade = minimiser.run
        (
            stage,
            x,
            [&](const morph::DistortionMinimiser::Progress& progress)
            {
                if (progress.iteration % reportEvery == 0)
                {
                    Info<< "optimise: power " << stage.power << ", iteration "
                        << nIterations + progress.iteration
                        << ", mean distortion " << progress.distortion
                        << ", determinant " << progress.leastDeterminant
                        << endl;
                }
            }
        );
        nIterations += nMade;

        // What stays, stays to the last bit
        vectorField found(motion.displacement(x));
        forAll(found, pointi)
        {
            found[pointi] = free[pointi] ? found[pointi] : given[pointi];
        }
        freedom.retract(found);
        const quality now(judge(moved(found)));
        if (better(now, best))
        {
            best = now;
            changed = true;
            inPlane = found;
        }

        // Higher powers of what is folded are beyond all numbers
        if (now.determinant > 0 || nMade == 0)
        {
            ++stagei;
        }
    }
    report(before, best, nIterations, clock.elapsedTime());
    if (!changed)
    {
        Info<< "optimise: the worst face got no better, the mesh stays as it"
            << " was" << endl;
    }
    return changed;
}


// ************************************************************************* //
