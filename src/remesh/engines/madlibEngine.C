/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "madlibEngine.H"
#include "addToRunTimeSelectionTable.H"
#include "ListOps.H"
#include "untrapped.H"

#include <csignal>
#include <cstring>
#include <iostream>
#include <sstream>
#include <unistd.h>

#ifdef MORPHFOAM_MADLIB
#include <MAdLib/MAdLib.h>
#endif

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(madlibEngine, 0);
    addToRunTimeSelectionTable(remeshEngine, madlibEngine, dictionary);
}


#ifndef MORPHFOAM_MADLIB

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::madlibEngine::madlibEngine(const dictionary& dict)
:
    remeshEngine(dict)
{
    FatalIOErrorInFunction(dict)
        << "Entry 'engine' is madlib, but libmorphRemesh was built without"
        << " MAdLib" << nl
        << "    Install it (Debian: libmadlib-dev) and run ./Allwmake again,"
        << " or use 'engine external'" << nl
        << exit(FatalIOError);
}


Foam::tetrahedralMesh Foam::madlibEngine::adapt(const tetrahedralMesh&) const
{
    NotImplemented;
    return tetrahedralMesh();
}

#else

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Rounds of collapses, swaps and splits, at most, and the changes, as a part of
//  all tetrahedra, that a round has to make for another one
static const label maxRounds = 12;
static const scalar enough = 0.02;

//- Rounds of swaps alone, after that
static const label maxSwaps = 5;

//- Tags of MAdLib's model: its surface 1 is that of all fixed faces
static const int fixedTag = 1;
static const int firstPlaneTag = 2;


//- MAdLib's parts of a mesh are entities, which its interface does not say
template<class Part>
static MAd::pEntity entity(Part* part)
{
    return reinterpret_cast<MAd::pEntity>(part);
}


//- While one lives, what MAdLib says goes nowhere
class quietly
{
    std::ostringstream said_;
    std::streambuf* const former_;

public:

    quietly()
    :
        former_(std::cout.rdbuf(said_.rdbuf()))
    {}

    ~quietly()
    {
        std::cout.rdbuf(former_);
    }
};


// Only what a signal handler may call
static void onAbort(int)
{
    static const char words[] =
        "\n--> FOAM FATAL ERROR:\nMAdLib has found an error of its own and"
        " stops. Nothing is written\n    Try more layers, region all, another"
        " sizeFactor, or engine external\n\n";
    if (::write(STDERR_FILENO, words, sizeof(words) - 1) < 0)
    {
        ::_exit(2);
    }
    ::_exit(1);
}


//- While one lives, an abort has a message: MAdLib knows no other error
class explainedAbort
{
    struct sigaction former_;

public:

    explainedAbort()
    {
        struct sigaction mine;
        std::memset(&mine, 0, sizeof(mine));
        mine.sa_handler = onAbort;
        ::sigaction(SIGABRT, &mine, &former_);
    }

    ~explainedAbort()
    {
        ::sigaction(SIGABRT, &former_, nullptr);
    }
};


//- A mesh of MAdLib's with the model that its parts belong to
class madlibMesh
{
    MAd::pGModel model_ = nullptr;
    MAd::pMesh mesh_ = nullptr;
    List<MAd::pVertex> vertices_;

    MAd::pEdge edgeOf(const label a, const label b)
    {
        MAd::pEdge e = MAd::E_exist(vertices_[a], vertices_[b]);
        return
            e
          ? e
          : MAd::M_createE
            (
                mesh_, vertices_[a], vertices_[b], MAd::pGEntity(nullptr)
            );
    }

    void classify(MAd::pEntity part, const int dimension, const int tag)
    {
        MAd::EN_setWhatIn
        (
            part, MAd::GM_entityByTag(model_, dimension, tag)
        );
    }

    //- A face, its edges and its points, those with a place already left out
    void addFace(const triFace& f, const int tag)
    {
        MAd::pVertex corners[3] =
            {vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]};
        MAd::M_createF
        (
            mesh_, 3, corners, MAd::GM_entityByTag(model_, 2, tag)
        );
        for (int i = 0; i < 3; ++i)
        {
            MAd::pEdge e = edgeOf(f[i], f[(i + 1)%3]);
            if (!MAd::E_whatIn(e))
            {
                classify(entity(e), 2, tag);
            }
        }
        for (const label pointi : f)
        {
            if (!MAd::V_whatIn(vertices_[pointi]))
            {
                classify(entity(vertices_[pointi]), 2, tag);
            }
        }
    }

    void addSurface(const tetrahedralMesh& given);
    void addLines(const tetrahedralMesh& given);

public:

    explicit madlibMesh(const tetrahedralMesh& given);

    ~madlibMesh()
    {
        MAd::M_delete(mesh_);
        MAd::GM_delete(model_);
    }

    MAd::pMesh mesh() const
    {
        return mesh_;
    }

    const List<MAd::pVertex>& vertices() const
    {
        return vertices_;
    }

    //- Tell the adapter what has to stay
    void constrain
    (
        MAd::MeshAdapter& adapter,
        const tetrahedralMesh& given
    );

    tetrahedralMesh result(const label nGiven) const;
};


madlibMesh::madlibMesh(const tetrahedralMesh& given)
:
    vertices_(given.points.size())
{
    MAd::GM_create(&model_, "cavity");
    mesh_ = MAd::M_new(model_);
    forAll(given.points, i)
    {
        const point& x = given.points[i];
        vertices_[i] = MAd::M_createV(mesh_, x.x(), x.y(), x.z(), i + 1);
    }
    addLines(given);
    addSurface(given);
    forAll(given.tets, i)
    {
        MAd::pVertex corners[4];
        for (int j = 0; j < 4; ++j)
        {
            corners[j] = vertices_[given.tets[i][j]];
        }
        MAd::M_createR
        (
            mesh_, 4, corners, MAd::GM_entityByTag(model_, 3, given.regions[i] + 1)
        );
    }
    // What is not on the surface gets the region around it
    MAd::M_classifyEntities(mesh_);
}


void madlibMesh::addLines(const tetrahedralMesh& given)
{
    // A point where lines meet or end, or that a line passes twice, stays
    labelList lineOf(given.points.size(), -1);
    labelList nEdges(given.points.size(), 0);
    boolList corner(given.points.size(), false);
    forAll(given.lineEdges, i)
    {
        const edge& e = given.lineEdges[i];
        classify
        (
            entity(edgeOf(e.start(), e.end())), 1, given.lines[i] + 1
        );
        for (const label pointi : {e.start(), e.end()})
        {
            corner[pointi] =
                corner[pointi]
             || (lineOf[pointi] >= 0 && lineOf[pointi] != given.lines[i])
             || ++nEdges[pointi] > 2;
            lineOf[pointi] = given.lines[i];
        }
    }
    forAll(lineOf, pointi)
    {
        if (lineOf[pointi] >= 0)
        {
            const bool stays = corner[pointi] || nEdges[pointi] != 2;
            classify
            (
                entity(vertices_[pointi]),
                stays ? 0 : 1,
                stays ? pointi + 1 : lineOf[pointi] + 1
            );
        }
    }
}


void madlibMesh::addSurface(const tetrahedralMesh& given)
{
    for (const triFace& f : given.fixedFaces)
    {
        addFace(f, fixedTag);
    }
    forAll(given.planeFaces, i)
    {
        addFace(given.planeFaces[i], firstPlaneTag + given.planes[i]);
    }
}


void madlibMesh::constrain
(
    MAd::MeshAdapter& adapter,
    const tetrahedralMesh& given
)
{
    for (const triFace& f : given.fixedFaces)
    {
        MAd::pFace face = MAd::F_exist
        (
            edgeOf(f[0], f[1]), vertices_[f[2]]
        );
        adapter.setConstraint(entity(face));
    }
    for (const edge& e : given.fixedEdges)
    {
        adapter.setConstraint(entity(edgeOf(e.start(), e.end())));
    }
    for (const label pointi : given.fixedPoints)
    {
        adapter.setConstraint(entity(vertices_[pointi]));
    }
}


tetrahedralMesh madlibMesh::result(const label nGiven) const
{
    tetrahedralMesh made;

    // Points of the input in their order, then new ones
    DynamicList<point> points;
    DynamicList<label> origin;
    Map<label> place;
    MAd::VIter vi = MAd::M_vertexIter(mesh_);
    while (MAd::pVertex v = MAd::VIter_next(vi))
    {
        const label id = MAd::V_id(v);
        double x[3];
        MAd::V_coord(v, x);
        place.insert(id, points.size());
        points.append(point(x[0], x[1], x[2]));
        origin.append(id <= nGiven ? id - 1 : -1);
    }
    MAd::VIter_delete(vi);
    made.points.transfer(points);
    made.origin.transfer(origin);

    DynamicList<remeshMap::corners> tets;
    DynamicList<label> regions;
    MAd::RIter ri = MAd::M_regionIter(mesh_);
    while (MAd::pRegion r = MAd::RIter_next(ri))
    {
        remeshMap::corners tet;
        forAll(tet, j)
        {
            tet[j] = place[MAd::V_id(MAd::R_vertex(r, j))];
        }
        tets.append(tet);
        regions.append(MAd::GEN_tag(MAd::EN_whatIn(entity(r))) - 1);
    }
    MAd::RIter_delete(ri);
    made.tets.transfer(tets);
    made.regions.transfer(regions);

    DynamicList<triFace> faces;
    DynamicList<label> planes;
    MAd::FIter fi = MAd::M_faceIter(mesh_);
    while (MAd::pFace f = MAd::FIter_next(fi))
    {
        const label tag =
            MAd::F_whatInType(f) == 2
          ? MAd::GEN_tag(MAd::EN_whatIn(entity(f)))
          : -1;
        if (tag >= firstPlaneTag)
        {
            triFace corners;
            forAll(corners, j)
            {
                corners[j] = place[MAd::V_id(MAd::F_vertex(f, j))];
            }
            faces.append(corners);
            planes.append(tag - firstPlaneTag);
        }
    }
    MAd::FIter_delete(fi);
    made.planeFaces.transfer(faces);
    made.planes.transfer(planes);
    return made;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::madlibEngine::madlibEngine(const dictionary& dict)
:
    remeshEngine(dict)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tetrahedralMesh Foam::madlibEngine::adapt
(
    const tetrahedralMesh& given
) const
{
    // It divides by the volumes of flat tetrahedra
    const untrapped numbers;
    const quietly nothing;
    const explainedAbort message;

    madlibMesh mesh(given);
    MAd::PWLSField sizes(mesh.mesh());
    forAll(given.sizes, i)
    {
        sizes.setSize(entity(mesh.vertices()[i]), given.sizes[i]);
    }
    // Neither removeSlivers() nor LaplaceSmoothing(): in sequence they abort
    MAd::MeshAdapter adapter(mesh.mesh(), &sizes);
    adapter.setVerbosity(-1);
    mesh.constrain(adapter, given);
    adapter.setEdgeLenSqBounds(0.5, 2);
    adapter.setCollapseOnBoundary(true, 1e-12);
    adapter.setSwapOnBoundary(true, 1e-12);
    adapter.setNoSwapQuality(0.4);
    adapter.setSwapMinImproveRatio(1.02);
    for (label round = 0; round < maxRounds; ++round)
    {
        label nChanges = adapter.eCollapseLoop();
        nChanges += adapter.edgeSwapLoop();
        nChanges += adapter.eSplitLoop();
        MAd::M_clean(mesh.mesh());
        if (nChanges < enough*MAd::M_numTets(mesh.mesh()))
        {
            break;
        }
    }
    for (label round = 0; round < maxSwaps; ++round)
    {
        label nChanges = adapter.edgeSwapLoop();
        nChanges += adapter.faceSwapLoop();
        if (nChanges == 0)
        {
            break;
        }
    }
    MAd::M_clean(mesh.mesh());
    return mesh.result(given.points.size());
}

#endif

// ************************************************************************* //
