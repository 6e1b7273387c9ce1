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

\*---------------------------------------------------------------------------*/

#include "motionControls.H"
#include "addToRunTimeSelectionTable.H"
#include "controlGeometry.H"
#include "fvMesh.H"
#include "Time.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(motionControls, 0);
    addToRunTimeSelectionTable(functionObject, motionControls, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::motionControls::motionControls
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    fvMeshFunctionObject(name, runTime, dict)
{
    read(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::motionControls::execute()
{
    return true;
}


bool Foam::functionObjects::motionControls::write()
{
    const List<controlShape> shapes(controlGeometry::shapesOf(mesh_));
    if (shapes.empty())
    {
        WarningInFunction
            << "Mesh " << mesh_.name() << " has no motion solver that could"
            << " show its controls (rbfMotionSolver, ffdMotionSolver):"
            << " nothing is written" << endl;
        return false;
    }

    fileName folder(time_.globalPath()/"postProcessing");
    if (mesh_.name() != polyMesh::defaultRegion)
    {
        folder = folder/mesh_.name();
    }
    controlGeometry::write(shapes, folder/name()/time_.timeName());
    return true;
}


// ************************************************************************* //
