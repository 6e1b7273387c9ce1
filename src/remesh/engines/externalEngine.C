/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "externalEngine.H"
#include "addToRunTimeSelectionTable.H"
#include "boundBox.H"
#include "dictionaryChecks.H"
#include "indexedOctree.H"
#include "OSspecific.H"
#include "treeDataPoint.H"

#include <fstream>
#include <iomanip>
#include <limits>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(externalEngine, 0);
    addToRunTimeSelectionTable(remeshEngine, externalEngine, dictionary);
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- References of triangles
static const label fixedReference = 1;
static const label firstPlane = 2;

//- A point is where a given one was within this part of the length of edges
//  there
static const scalar samePlace = 1e-6;


static void writeRequired
(
    std::ostream& os,
    const char* what,
    const label first,
    const label n
)
{
    os << what << '\n' << n << '\n';
    for (label i = 0; i < n; ++i)
    {
        os << first + i + 1 << '\n';
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::externalEngine::write
(
    const fileName& folder,
    const tetrahedralMesh& given
) const
{
    std::ofstream os(folder/"cavity.mesh");
    os << std::setprecision(std::numeric_limits<scalar>::max_digits10);
    os << "MeshVersionFormatted 2\nDimension 3\nVertices\n"
        << given.points.size() << '\n';
    for (const point& x : given.points)
    {
        os << x.x() << ' ' << x.y() << ' ' << x.z() << " 0\n";
    }
    os << "Tetrahedra\n" << given.tets.size() << '\n';
    forAll(given.tets, i)
    {
        for (const label pointi : given.tets[i])
        {
            os << pointi + 1 << ' ';
        }
        os << given.regions[i] + 1 << '\n';
    }
    os << "Triangles\n"
        << given.fixedFaces.size() + given.planeFaces.size() << '\n';
    for (const triFace& f : given.fixedFaces)
    {
        os << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << ' '
            << fixedReference << '\n';
    }
    forAll(given.planeFaces, i)
    {
        const triFace& f = given.planeFaces[i];
        os << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << ' '
            << firstPlane + given.planes[i] << '\n';
    }
    writeRequired(os, "RequiredTriangles", 0, given.fixedFaces.size());
    os << "Edges\n"
        << given.fixedEdges.size() + given.lineEdges.size() << '\n';
    for (const edge& e : given.fixedEdges)
    {
        os << e.start() + 1 << ' ' << e.end() + 1 << " 0\n";
    }
    forAll(given.lineEdges, i)
    {
        const edge& e = given.lineEdges[i];
        os << e.start() + 1 << ' ' << e.end() + 1 << ' '
            << given.lines[i] + 1 << '\n';
    }
    writeRequired(os, "RequiredEdges", 0, given.fixedEdges.size());
    writeRequired
    (
        os, "Ridges", given.fixedEdges.size(), given.lineEdges.size()
    );
    os << "RequiredVertices\n" << given.fixedPoints.size() << '\n';
    for (const label pointi : given.fixedPoints)
    {
        os << pointi + 1 << '\n';
    }
    os << "End\n";

    std::ofstream sizes(folder/"cavity.sol");
    sizes << std::setprecision(std::numeric_limits<scalar>::max_digits10);
    sizes << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n"
        << given.sizes.size() << "\n1 1\n";
    for (const scalar size : given.sizes)
    {
        sizes << size << '\n';
    }
    sizes << "End\n";
    if (!os.flush() || !sizes.flush())
    {
        FatalIOErrorInFunction(dict_)
            << "The files for the external engine cannot be written to "
            << folder << nl
            << "    Is the disk full, or the folder write-protected?" << nl
            << exit(FatalIOError);
    }
}


Foam::tetrahedralMesh Foam::externalEngine::read(const fileName& path) const
{
    tetrahedralMesh made;
    std::ifstream is(path);
    std::string keyword;
    DynamicList<triFace> faces;
    DynamicList<label> planes;
    bool good = bool(is);
    while (good && is >> keyword && keyword != "End")
    {
        if (keyword == "MeshVersionFormatted" || keyword == "Dimension")
        {
            label number;
            is >> number;
            continue;
        }
        label n = -1;
        is >> n;
        const bool vertices = keyword == "Vertices";
        const bool tetrahedra = keyword == "Tetrahedra";
        const bool triangles = keyword == "Triangles";
        const label nNumbers =
            vertices || triangles ? 4
          : tetrahedra ? 5
          : keyword == "Edges" ? 3
          : keyword.compare(0, 8, "Required") == 0 || keyword == "Ridges"
         || keyword == "Corners" ? 1
          : 0;
        good = is && n >= 0 && n <= fileSize(path) && nNumbers > 0;
        for (label i = 0; good && i < n; ++i)
        {
            if (vertices)
            {
                point x;
                label reference;
                is >> x.x() >> x.y() >> x.z() >> reference;
                made.points.setSize(n);
                made.points[i] = x;
            }
            else
            {
                FixedList<label, 5> numbers(Zero);
                for (label j = 0; j < nNumbers; ++j)
                {
                    is >> numbers[j];
                }
                if (tetrahedra)
                {
                    made.tets.setSize(n);
                    made.regions.setSize(n);
                    for (label j = 0; j < 4; ++j)
                    {
                        made.tets[i][j] = numbers[j] - 1;
                    }
                    made.regions[i] = numbers[4] - 1;
                }
                else if (triangles && numbers[3] >= firstPlane)
                {
                    faces.append
                    (
                        triFace(numbers[0] - 1, numbers[1] - 1, numbers[2] - 1)
                    );
                    planes.append(numbers[3] - firstPlane);
                }
            }
            good = bool(is);
        }
    }
    made.planeFaces.transfer(faces);
    made.planes.transfer(planes);
    const label nPoints = made.points.size();
    const auto known = [&](const label pointi)
    {
        return pointi >= 0 && pointi < nPoints;
    };
    for (const remeshMap::corners& t : made.tets)
    {
        for (const label pointi : t)
        {
            good = good && known(pointi);
        }
    }
    for (const triFace& f : made.planeFaces)
    {
        good = good && known(f[0]) && known(f[1]) && known(f[2]);
    }
    if (!good || made.tets.empty())
    {
        FatalIOErrorInFunction(dict_)
            << "The file " << path << " of the external engine cannot be read"
            << nl
            << "    It has to have vertices, tetrahedra and triangles in"
            << " Medit's text format (.mesh)" << nl
            << exit(FatalIOError);
    }
    return made;
}


void Foam::externalEngine::findOrigins
(
    const tetrahedralMesh& given,
    tetrahedralMesh& made
) const
{
    treeBoundBox bounds(given.points);
    bounds.inflate(1e-3);
    const indexedOctree<treeDataPoint> tree
    (
        treeDataPoint(given.points), bounds, 10, 10, 3
    );
    boolList taken(given.points.size(), false);
    made.origin = labelList(made.points.size(), -1);
    forAll(made.points, i)
    {
        const label near = tree.findNearest(made.points[i], GREAT).index();
        const scalar distance = mag(made.points[i] - given.points[near]);
        if (distance <= samePlace*given.sizes[near] && !taken[near])
        {
            taken[near] = true;
            made.origin[i] = near;
            made.points[i] = given.points[near];
        }
    }
    for (remeshMap::corners& t : made.tets)
    {
        const UList<point>& x = made.points;
        const scalar volume =
            ((x[t[1]] - x[t[0]])^(x[t[2]] - x[t[0]])) & (x[t[3]] - x[t[0]]);
        if (volume < 0)
        {
            Swap(t[2], t[3]);
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::externalEngine::externalEngine(const dictionary& dict)
:
    remeshEngine(dict),
    command_
    (
        dictionaryChecks::naming
        (
            dict, "command", [&]() { return dict.get<string>("command"); }
        )
    )
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tetrahedralMesh Foam::externalEngine::adapt
(
    const tetrahedralMesh& given
) const
{
    const fileName folder(cwd()/"remeshEngine");
    mkDir(folder);
    rm(folder/"new.mesh");
    write(folder, given);
    const int status = Foam::system
    (
        "cd '" + folder + "' && " + command_
      + " cavity.mesh cavity.sol new.mesh"
    );
    if (status != 0)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'command' is '" << command_.c_str()
            << "', which ends with status " << status << nl
            << "    Run it in " << folder
            << " as <command> cavity.mesh cavity.sol new.mesh to see why" << nl
            << exit(FatalIOError);
    }
    tetrahedralMesh made(read(folder/"new.mesh"));
    findOrigins(given, made);
    return made;
}


// ************************************************************************* //
