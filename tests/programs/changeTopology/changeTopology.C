/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    changeTopology

Description
    Test of a motion solver over a change of topology: moves the mesh, removes
    the cells whose centres have x < 0.3 z, moves it at the next time, and
    compares with a solver that is made for the changed mesh. Prints the largest
    difference.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "displacementMotionSolver.H"
#include "fvMesh.H"
#include "mapPolyMesh.H"
#include "pointFields.H"
#include "polyTopoChange.H"
#include "removeCells.H"
#include "Time.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static autoPtr<mapPolyMesh> removeCorner(fvMesh& mesh)
{
    DynamicList<label> gone;
    forAll(mesh.cellCentres(), celli)
    {
        const point& x = mesh.cellCentres()[celli];
        if (x.x() < 0.3*x.z())
        {
            gone.append(celli);
        }
    }

    removeCells remover(mesh);
    const labelList exposed(remover.getExposedFaces(gone));
    polyTopoChange change(mesh);
    remover.setRefinement
    (
        gone, exposed, labelList(exposed.size(), Zero), change
    );
    autoPtr<mapPolyMesh> map = change.changeMesh(mesh, false);
    mesh.updateMesh(map());
    return map;
}


int main(int argc, char *argv[])
{
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);
    fvMesh mesh
    (
        IOobject
        (
            fvMesh::defaultRegion,
            runTime.timeName(),
            runTime,
            IOobject::MUST_READ
        )
    );

    autoPtr<motionSolver> solver(motionSolver::New(mesh));
    ++runTime;
    mesh.movePoints(solver->newPoints());

    const label before = mesh.nCells();
    solver->updateMesh(removeCorner(mesh)());
    ++runTime;
    const pointField moved(solver->newPoints());

    auto& followed = refCast<displacementMotionSolver>(solver());
    const pointIOField points0
    (
        IOobject
        (
            "reference",
            runTime.timeName(),
            mesh,
            IOobject::NO_READ,
            IOobject::NO_WRITE,
            false
        ),
        followed.points0()
    );
    const IOdictionary dict
    (
        IOobject
        (
            "dynamicMeshDict",
            runTime.constant(),
            mesh,
            IOobject::MUST_READ,
            IOobject::NO_WRITE,
            false
        )
    );
    const pointVectorField field(followed.pointDisplacement());
    solver.clear();
    autoPtr<displacementMotionSolver> fresh
    (
        displacementMotionSolver::New
        (
            dict.get<word>("motionSolver"), mesh, dict, field, points0
        )
    );

    const pointField again(fresh->newPoints());

    Info<< "cells " << before << " then " << mesh.nCells() << nl
        << "largest motion " << gMax(mag(moved - points0)) << nl
        << "largest difference "
        << gMax(mag(moved - again)) << nl << endl;
    return 0;
}


// ************************************************************************* //
