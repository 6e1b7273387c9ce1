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


void Foam::remesher::make(const labelUList& cells, const scalarField& sizes)
{
    faces_.clear();
    cavity_.reset
    (
        new cavityTetrahedra(mesh_, planes_(), cells, sizes)
    );
    const tetrahedralMesh& given = cavity_().given();
    const labelList& blind = cavity_().cut().blindCells();
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

    const clockTime clock;
    made_ = remeshEngine::New(settings_.dict)->adapt(given);
    DynamicList<vector> normals;
    for (label i = 0; i < planes_().size(); ++i)
    {
        normals.append(planes_().normal(i));
    }
    faces_.reset(new cavityFaces(cavity_(), made_));
    if (!faces_().fault().empty())
    {
        FatalIOErrorInFunction(settings_.dict)
            << "What the engine made cannot be used: "
            << faces_().fault().c_str() << nl
            << "    Try another engine, more layers, or region all" << nl
            << exit(FatalIOError);
    }
    const pointField made(made_.points);
    const cavityFaces::figures before(faces_().quality());
    made_.points = tetrahedraSmoother::smoothed
    (
        given, made_, normals, smoothing
    );
    const cavityFaces::figures after(faces_().quality());
    const auto worst = [&](const cavityFaces::figures& q)
    {
        return max
        (
            q.nonOrthogonality/settings_.nonOrthogonality,
            q.skewness/settings_.skewness
        );
    };
    const bool better = worst(after) < worst(before);
    if (!better)
    {
        made_.points = made;
    }
    report_.time = clock.elapsedTime();
    report_.nReplaced = cells.size();
    report_.nCut = given.tets.size();
    report_.nNew = made_.tets.size();
    report_.nonOrthogonality =
        better ? after.nonOrthogonality : before.nonOrthogonality;
    report_.skewness = better ? after.skewness : before.skewness;
}


bool Foam::remesher::exceeds(const report& r) const
{
    return
        r.nonOrthogonality > settings_.nonOrthogonality
     || r.skewness > settings_.skewness;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::remesher::remesher(fvMesh& mesh, const remeshSettings& settings)
:
    mesh_(mesh),
    settings_(settings),
    keepPatches_(settings.keepPatches(mesh))
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::remesher::keep(const labelUList& patches)
{
    keepPatches_.insert(patches);
}


bool Foam::remesher::prepare(const scalarField& sizes)
{
    checkMesh();
    checkZones();
    const remeshCavity cavity(mesh_, settings_, keepPatches_.sortedToc());
    report_ = report();
    report_.nBad = cavity.bad().count();
    report_.nBadKept = (cavity.bad() & cavity.kept()).count();
    if
    (
        settings_.region == remeshSettings::extent::cavity
     && report_.nBad == report_.nBadKept
    )
    {
        return false;
    }

    planes_.reset(new planePatches(mesh_));
    const scalarField wanted(settings_.sizeFactor*sizes);
    label nBefore = -1;
    for (label pass = 0; pass < settings_.passes; ++pass)
    {
        const label layers = settings_.layers << pass;
        const labelList cells(cavity.cells(layers));
        // More layers change nothing where there are no more cells
        if (cells.empty() || cells.size() == nBefore)
        {
            break;
        }
        nBefore = cells.size();
        report_.layers = layers;
        make(cells, wanted);
        using plainText::rounded;
        Info<< "remesh: " << report_.nReplaced << " cells, cut into "
            << report_.nCut << " tetrahedra -> " << report_.nNew
            << ", non-orthogonality "
            << rounded(report_.nonOrthogonality).c_str() << ", skewness "
            << rounded(report_.skewness).c_str() << "; "
            << rounded(report_.time).c_str() << " s" << endl;
        if (!exceeds(report_))
        {
            break;
        }
    }
    if (nBefore < 0)
    {
        return false;
    }
    map_ = remeshMap();
    map_.before.points = cavity_().given().points;
    map_.before.tets = cavity_().given().tets;
    map_.before.cells = cavity_().cut().cells();
    map_.after.points = made_.points;
    map_.after.tets = made_.tets;
    return true;
}


// ************************************************************************* //
