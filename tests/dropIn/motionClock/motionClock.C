/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Description
    Preloaded before any solver, measures the CPU time that a motion solver
    takes for new points, OpenFOAM's and ours alike. At the end of the program
    it writes the seconds of each call, a line each, into the file that the
    environment variable MOTION_CLOCK names.

\*---------------------------------------------------------------------------*/

#include "motionSolver.H"
#include "pointField.H"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

double cpuSeconds()
{
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9*double(now.tv_nsec);
}


struct calls
{
    std::vector<double> all;

    ~calls()
    {
        const char* file = std::getenv("MOTION_CLOCK");
        std::FILE* out = file && all.size() ? std::fopen(file, "w") : nullptr;
        if (out)
        {
            for (const double seconds : all)
            {
                std::fprintf(out, "%.9f\n", seconds);
            }
            std::fclose(out);
        }
    }
};


calls& made()
{
    static calls all;
    return all;
}

} // End namespace


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

// Takes the place of OpenFOAM's function, which says the same
Foam::tmp<Foam::pointField> Foam::motionSolver::newPoints()
{
    const double start = cpuSeconds();
    solve();
    tmp<pointField> points(curPoints());
    made().all.push_back(cpuSeconds() - start);
    return points;
}


// ************************************************************************* //
