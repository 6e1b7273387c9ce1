/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "remesher.H"
#include "clockTime.H"
#include "fvMesh.H"
#include "plainText.H"
#include "remeshCavity.H"
#include "remeshEngine.H"
#include "tetrahedraSmoother.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Iterations that move new points
static const label smoothing = 60;


//- The first label that two zones of a kind have, and these zones
template<class Zones>
static string overlap(const Zones& zones, const label size, const char* what)
{
    labelList zoneOf(size, -1);
    forAll(zones, zonei)
    {
        for (const label i : zones[zonei])
        {
            if (zoneOf[i] >= 0 && zoneOf[i] != zonei)
            {
                OStringStream text;
                text
                    << what << " " << i << " is in zones "
                    << zones[zoneOf[i]].name() << " and "
                    << zones[zonei].name();
                return text.str();
            }
            zoneOf[i] = zonei;
        }
    }
    return string();
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::remesher::checkMesh() const
{
    if (Pstream::parRun())
    {
        FatalIOErrorInFunction(settings_.dict)
            << "A mesh that is distributed over ranks cannot be re-meshed" << nl
            << "    Run reconstructParMesh and reconstructPar, re-mesh on one"
            << " rank, and decompose again" << nl
            << exit(FatalIOError);
    }
    if (mesh_.nGeometricD() != 3)
    {
        FatalIOErrorInFunction(settings_.dict)
            << "A mesh of " << mesh_.nGeometricD() << " dimensions (patches of"
            << " type empty or wedge) cannot be re-meshed: cells are replaced"
            << " by tetrahedra" << nl
            << "    Optimise it (entry 'optimise' of the motion solver,"
            << " morphMesh -optimise)" << nl
            << exit(FatalIOError);
    }
}


void Foam::remesher::checkZones() const
{
    for
    (
        const string& fault
      : {
            overlap(mesh_.cellZones(), mesh_.nCells(), "Cell"),
            overlap(mesh_.faceZones(), mesh_.nFaces(), "Face"),
            overlap(mesh_.pointZones(), mesh_.nPoints(), "Point")
        }
    )
    {
        if (!fault.empty())
        {
            FatalIOErrorInFunction(settings_.dict)
                << fault.c_str() << ": in a mesh that changes it can be in one"
                << nl
                << "    Remove it from one of them, or make a set of one of"
                << " the zones" << nl
                << exit(FatalIOError);
        }
    }
}


Foam::autoPtr<Foam::remesher::attempt> Foam::remesher::make
(
    const labelUList& cells,
    const scalarField& sizes
) const
{
    const clockTime clock;
    autoPtr<attempt> made(new attempt);
    attempt& a = made();
    a.cavity.reset(new cavityTetrahedra(mesh_, planes_(), cells, sizes));
    const tetrahedralMesh& given = a.cavity().given();
    const labelList& blind = a.cavity().cut().blindCells();
    if (!blind.empty())
    {
        FatalIOErrorInFunction(settings_.dict)
            << blind.size() << " cells cannot be cut into tetrahedra: no point"
            << " sees all their faces. The first is cell " << blind[0] << " at "
            << mesh_.cellCentres()[blind[0]] << nl
            << "    Such a mesh is folded, or almost so: optimise it first"
            << " (morphMesh -optimise), or re-mesh earlier" << nl
            << exit(FatalIOError);
    }

    a.tetrahedra = engine_().adapt(given);
    a.faces.reset(new cavityFaces(a.cavity(), a.tetrahedra));
    if (!a.faces().fault().empty())
    {
        FatalIOErrorInFunction(settings_.dict)
            << "What the engine made cannot be used: "
            << a.faces().fault().c_str() << nl
            << "    Try another engine, more layers, or region all" << nl
            << exit(FatalIOError);
    }

    // The best of several stages of optimised points is taken
    DynamicList<vector> normals;
    for (label i = 0; i < planes_().size(); ++i)
    {
        normals.append(planes_().normal(i));
    }
    a.quality = a.faces().quality();
    pointField best(a.tetrahedra.points);
    tetrahedraSmoother::smooth
    (
        given,
        a.tetrahedra,
        normals,
        smoothing,
        [&](const pointField& points)
        {
            a.tetrahedra.points = points;
            const cavityFaces::figures quality(a.faces().quality());
            if (worst(quality) < worst(a.quality))
            {
                a.quality = quality;
                best = points;
            }
        }
    );
    a.tetrahedra.points = best;

    using plainText::rounded;
    Info<< "remesh: " << cells.size() << " cells, cut into "
        << given.tets.size() << " tetrahedra -> " << a.tetrahedra.tets.size()
        << ", non-orthogonality "
        << rounded(a.quality.nonOrthogonality).c_str() << ", skewness "
        << rounded(a.quality.skewness).c_str() << "; "
        << rounded(clock.elapsedTime()).c_str() << " s" << endl;
    return made;
}


Foam::scalar Foam::remesher::worst(const cavityFaces::figures& q) const
{
    return max
    (
        q.nonOrthogonality/settings_.nonOrthogonality,
        q.skewness/settings_.skewness
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::remesher::remesher(fvMesh& mesh, const remeshSettings& settings)
:
    mesh_(mesh),
    settings_(settings),
    engine_(remeshEngine::New(settings.dict)),
    keepPatches_(settings.keepPatches(mesh))
{}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::remesher::~remesher() = default;


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::remesher::keep(const labelUList& patches)
{
    keepPatches_.insert(patches);
}


bool Foam::remesher::prepare
(
    const scalarField& sizes,
    const bitSet& also
)
{
    checkMesh();
    checkZones();
    attempt_.clear();
    planes_.reset(new planePatches(mesh_));
    const remeshCavity cavity
    (
        mesh_, settings_, keepPatches_.sortedToc(), also
    );
    nBad_ = cavity.bad().count();
    nBadKept_ = (cavity.bad() & cavity.kept()).count();
    const bool all = settings_.region == remeshSettings::extent::all;
    if (!all && nBad_ == nBadKept_)
    {
        return false;
    }

    const scalarField wanted(settings_.sizeFactor*sizes);
    label nBefore = 0;
    for (label pass = 0; pass < settings_.passes; ++pass)
    {
        const labelList cells(cavity.cells(settings_.layers << pass));
        // More layers change nothing where there are no more cells
        if (cells.size() == nBefore)
        {
            break;
        }
        nBefore = cells.size();
        autoPtr<attempt> made(make(cells, wanted));
        if (!attempt_.valid() || worst(made().quality) < worst(found()))
        {
            attempt_ = std::move(made);
        }
        if (withinLimits())
        {
            break;
        }
    }
    if (!attempt_.valid())
    {
        return false;
    }
    map_ = remeshMap();
    map_.before.points = attempt_().cavity().given().points;
    map_.before.tets = attempt_().cavity().given().tets;
    map_.before.cells = attempt_().cavity().cut().cells();
    map_.after.points = attempt_().tetrahedra.points;
    map_.after.tets = attempt_().tetrahedra.tets;
    return true;
}


// ************************************************************************* //
