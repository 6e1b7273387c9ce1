/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    volumetricBSplines

Description
    For tests: moves a mesh by the first box of constant/lattices, and by
    OpenFOAM's volumetric B-splines (NURBS3DVolume, dictionary
    volumetricBSplines) with the same moves of the same control points. Prints
    how far points move and how far apart both end:

        moved <largest> apart <largest> controlPointsApart <largest>

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "Time.H"
#include "fvMesh.H"
#include "NURBS3DVolume.H"
#include "ffdBoxes.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char *argv[])
{
    argList::noParallel();
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);
    const fvMesh mesh
    (
        IOobject
        (
            fvMesh::defaultRegion,
            runTime.timeName(),
            runTime,
            IOobject::MUST_READ
        )
    );
    const IOdictionary dict
    (
        IOobject
        (
            "lattices", runTime.constant(), runTime, IOobject::MUST_READ
        )
    );

    ffdBoxes boxes(dict, &mesh);
    boxes.setPoints(mesh.points(), mesh.edges());
    boxes.update(runTime.value());
    const vectorField d(boxes.displacement());
    const pointField rest(boxes.boxes()[0].lattice(false));
    const vectorField moves(boxes.boxes()[0].lattice(true) - rest);

    autoPtr<NURBS3DVolume> theirs
    (
        NURBS3DVolume::New(dict.subDict("volumetricBSplines"), mesh)
    );
    const scalar apart = max(mag(theirs->getControlPoints() - rest));
    const vectorField theirD
    (
        theirs->computeNewPoints(moves) - mesh.points()
    );
    Info<< "moved " << max(mag(d)) << " apart " << max(mag(d - theirD))
        << " controlPointsApart " << apart << endl;
    return 0;
}


// ************************************************************************* //
