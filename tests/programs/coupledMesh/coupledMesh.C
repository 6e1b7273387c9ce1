/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    coupledMesh

Description
    Moves a mesh as a coupling adapter does: before each step the displacement
    of a patch, which a table of system/couplingDict gives, is written

    - at \c faces: into the boundary values of cellDisplacement alone,
    - at \c both: also to the points, interpolated by OpenFOAM's
      primitivePatchInterpolation, as the OpenFOAM adapter of preCICE does,
    - at \c nodes: into the fixedValue of pointDisplacement.

    The displacement is value(t)*(1 + gradient & x).

\*---------------------------------------------------------------------------*/

#include "fvCFD.H"
#include "fixedValuePointPatchFields.H"
#include "Function1.H"
#include "motionSolver.H"
#include "pointFields.H"
#include "primitivePatchInterpolation.H"

int main(int argc, char* argv[])
{
    #include "setRootCase.H"
    #include "createTime.H"
    #include "createMesh.H"
    autoPtr<motionSolver> motion(motionSolver::New(mesh));

    const IOdictionary dict
    (
        IOobject("couplingDict", runTime.system(), runTime, IOobject::MUST_READ)
    );
    const label patchi =
        mesh.boundaryMesh().findPatchID(dict.get<word>("patch"));
    const word at(dict.get<word>("at"));
    const autoPtr<Function1<vector>> value
    (
        Function1<vector>::New("value", dict)
    );
    const vector gradient(dict.getOrDefault<vector>("gradient", Zero));

    // As in the reference mesh
    const polyPatch& patch = mesh.boundaryMesh()[patchi];
    const scalarField faceFactor(1 + (gradient & patch.faceCentres()));
    const scalarField nodeFactor(1 + (gradient & patch.localPoints()));
    const primitivePatchInterpolation interpolation(patch);

    auto& cells = const_cast<volVectorField&>
    (
        mesh.lookupObject<volVectorField>("cellDisplacement")
    );
    auto& points = const_cast<pointVectorField&>
    (
        mesh.lookupObject<pointVectorField>("pointDisplacement")
    );

    while (runTime.loop())
    {
        const vector d(value->value(runTime.value()));
        vectorField& faces = cells.boundaryFieldRef()[patchi];
        if (at != "nodes")
        {
            faces = faceFactor*d;
        }
        if (at != "faces")
        {
            auto& nodes = refCast<fixedValuePointPatchVectorField>
            (
                points.boundaryFieldRef()[patchi]
            );
            if (at == "both")
            {
                nodes == interpolation.faceToPointInterpolate(faces);
            }
            else
            {
                nodes == nodeFactor*d;
            }
        }
        mesh.movePoints(motion->newPoints());
        runTime.write();
    }
    Info<< "End" << nl << endl;
    return 0;
}


// ************************************************************************* //
