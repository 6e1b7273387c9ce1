/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    invalidCells

Description
    Test of what is skipped when a motion is checked: throws the points of a
    mesh about, by a little and by much, each time differently, and compares
    what invalidMotion says with the geometry that the mesh itself has with its
    points there: volumes of cells, and pyramids of faces with the centres of
    both cells. Prints a line for each attempt:

        amplitude, valid by the mesh, valid by invalidMotion, proven

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "invalidMotion.H"
#include "polyMesh.H"
#include "provenCells.H"
#include "Time.H"

#include <cmath>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- Between -1 and 1, by position, so that ranks agree
static scalar thrown(const point& x, const label attempt, const direction d)
{
    const vector way(12.9898, 78.233, 37.719);
    const scalar many =
        43758.5453*Foam::sin((x & way) + 1.7*attempt + 4.1*d);
    return 2*(many - std::floor(many)) - 1;
}


static bool validByMesh(const polyMesh& mesh)
{
    bool valid = true;
    for (const scalar volume : mesh.cellVolumes())
    {
        valid = valid && volume > 0;
    }
    forAll(mesh.faces(), facei)
    {
        const vector& area = mesh.faceAreas()[facei];
        const point& centre = mesh.faceCentres()[facei];
        const point& own = mesh.cellCentres()[mesh.faceOwner()[facei]];
        valid = valid && (area & (centre - own)) > 0;
        if (mesh.isInternalFace(facei))
        {
            const point& nei = mesh.cellCentres()[mesh.faceNeighbour()[facei]];
            valid = valid && (area & (nei - centre)) > 0;
        }
    }
    return returnReduce(valid, andOp<bool>());
}


int main(int argc, char *argv[])
{
    argList::addArgument("attempts");
    argList::addArgument("largest amplitude");
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);
    polyMesh mesh
    (
        IOobject
        (
            polyMesh::defaultRegion,
            runTime.timeName(),
            runTime,
            IOobject::MUST_READ
        )
    );

    const pointField start(mesh.points());
    const label attempts = args.get<label>(1);
    const scalar largest = args.get<scalar>(2);
    for (label i = 0; i < attempts; ++i)
    {
        const scalar amplitude = largest*scalar(i)/attempts;
        pointField points(start);
        forAll(points, pointi)
        {
            for (direction d = 0; d < 3; ++d)
            {
                points[pointi][d] += amplitude*thrown(start[pointi], i, d);
            }
        }
        const bool said = invalidMotion(mesh, points).empty();
        const bool proven = returnReduce
        (
            provenCells::New(mesh).all(points), andOp<bool>()
        );
        mesh.movePoints(points);
        Info<< "attempt " << amplitude << ' ' << validByMesh(mesh) << ' '
            << said << ' ' << proven << endl;
    }
    return 0;
}


// ************************************************************************* //
