/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
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
    folder = folder/name();
    controlGeometry::write(shapes, folder/time_.timeName());
    controlGeometry::writeSeries(shapes, folder);
    return true;
}


// ************************************************************************* //
