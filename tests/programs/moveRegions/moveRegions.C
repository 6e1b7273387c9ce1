/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

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
