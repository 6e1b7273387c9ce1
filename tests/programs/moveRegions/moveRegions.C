/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    moveRegions

Description
    Test of several regions with a motion solver each: moves the meshes named
    on the command line through the time steps, one after the other, and writes
    them.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "fvMesh.H"
#include "motionSolver.H"
#include "PtrList.H"
#include "Time.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char *argv[])
{
    argList::addArgument("regions", "list of regions");
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);

    const wordList regions(args.get<wordList>(1));
    PtrList<fvMesh> meshes(regions.size());
    PtrList<motionSolver> solvers(regions.size());
    forAll(regions, i)
    {
        meshes.set
        (
            i,
            new fvMesh
            (
                IOobject
                (
                    regions[i],
                    runTime.timeName(),
                    runTime,
                    IOobject::MUST_READ
                )
            )
        );
        solvers.set(i, motionSolver::New(meshes[i]));
    }

    while (runTime.loop())
    {
        forAll(regions, i)
        {
            meshes[i].movePoints(solvers[i].newPoints());
        }
        runTime.write();
    }
    return 0;
}


// ************************************************************************* //
