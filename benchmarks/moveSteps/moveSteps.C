/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    moveSteps

Description
    Moves the mesh by the motion solver of dynamicMeshDict, any one, from step
    to step without a flow solver, and prints for each step the CPU time of the
    solver, that of moving the mesh with it (geometry, fluxes), and the memory
    in use.

    With -period N also, at the end of each period of N steps, the largest
    distance of points from where they were at the end of the first.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "fvMesh.H"
#include "memInfo.H"
#include "motionSolver.H"
#include "PstreamReduceOps.H"
#include "Time.H"

#include <ctime>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

// CPU time since the last call [s]; OpenFOAM's cpuTime counts in hundredths
static scalar cpuTimeIncrement()
{
    static std::clock_t last = std::clock();
    const std::clock_t now = std::clock();
    const scalar increment = scalar(now - last)/CLOCKS_PER_SEC;
    last = now;
    return increment;
}


int main(int argc, char *argv[])
{
    argList::addOption("period", "N", "steps of a period of the motion");
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
    const label period =
        args.found("period") ? args.get<label>("period") : labelMax;

    autoPtr<motionSolver> solver(motionSolver::New(mesh));
    pointField atPeriod;
    label step = 0;
    while (runTime.loop())
    {
        ++step;
        cpuTimeIncrement();
        const pointField points(solver->newPoints());
        const scalar motion = cpuTimeIncrement();
        mesh.movePoints(points);
        const scalar move = cpuTimeIncrement();
        Info<< "step " << step << " motion " << motion << " move " << move
            << " memory " << memInfo().rss() << endl;

        if (step % period == 0)
        {
            if (atPeriod.empty())
            {
                atPeriod = points;
            }
            Info<< "period " << step/period << " difference "
                << gMax(mag(points - atPeriod)) << endl;
        }
        runTime.write();
    }
    return 0;
}


// ************************************************************************* //
