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
    Test of motion solvers of several meshes in one process: moves the regions
    given as arguments by turns, through all times, and writes their points.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "fvMesh.H"
#include "motionSolver.H"
#include "Time.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char *argv[])
{
    argList::noMandatoryArgs();
    argList::addArgument("first region");
    argList::addArgument("second region");
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);

    PtrList<fvMesh> meshes;
    PtrList<motionSolver> solvers;
    for (label i = 1; i <= 2; ++i)
    {
        meshes.append
        (
            new fvMesh
            (
                IOobject
                (
                    args[i], runTime.timeName(), runTime, IOobject::MUST_READ
                )
            )
        );
        solvers.append(motionSolver::New(meshes.last()).ptr());
    }

    while (runTime.loop())
    {
        forAll(meshes, i)
        {
            meshes[i].movePoints(solvers[i].newPoints());
        }
        runTime.write();
    }
    Info<< "End" << endl;
    return 0;
}


// ************************************************************************* //
