/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    benchmarkShapes

Description
    Times of global variables and of constraints of shapes on the boundary of a
    mesh, in CPU seconds of one core.

    Reads constant/benchmarkDict: \c cases, a dictionary with the entries
    \c boxes and \c constraints for each.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "benchmarkClock.H"
#include "ffdBoxes.H"
#include "fvMesh.H"
#include "IOdictionary.H"
#include "shapeConstraints.H"
#include "Time.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static void measure
(
    const dictionary& dict,
    const pointField& points,
    const faceList& faces
)
{
    const label repeats = 7;
    ffdBoxes boxes(dict, nullptr);
    const dictionary& given = dict.subDict("constraints");
    passed();
    shapeConstraints constraints(given, points, faces);
    const scalar preparation = passed();
    boxes.setPoints(points, edgeList());
    boxes.displacement();
    passed();

    const label n = boxes.nParameters();
    scalarList variables(repeats), slopes(repeats), bounds(repeats);
    for (label i = 0; i < repeats; ++i)
    {
        scalarField values(boxes.values());
        forAll(values, p)
        {
            values[p] *= 1 + 1e-3*(i + 1);
        }
        passed();
        boxes.update(values);
        const pointField moved(points + boxes.displacement());
        variables[i] = passed();
        PtrList<vectorField> velocities(n);
        forAll(velocities, p)
        {
            velocities.set(p, new vectorField(boxes.derivative(p)));
        }
        slopes[i] = passed();
        constraints.evaluate
        (
            moved,
            boxes.parameterNames(),
            [&](const label p) { return tmp<vectorField>(velocities[p]); }
        );
        bounds[i] = passed();
    }
    Info<< "shapes " << dict.dictName() << ' ' << points.size() << ' ' << n
        << ' ' << preparation << ' ' << median(variables) << ' '
        << median(slopes) << ' ' << median(bounds) << endl;
}


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
            "benchmarkDict", runTime.constant(), runTime, IOobject::MUST_READ
        )
    );

    const primitivePatch boundary
    (
        SubList<face>
        (
            mesh.faces(),
            mesh.nFaces() - mesh.nInternalFaces(),
            mesh.nInternalFaces()
        ),
        mesh.points()
    );
    for (const entry& e : dict.subDict("cases"))
    {
        measure(e.dict(), boundary.localPoints(), boundary.localFaces());
    }
    return 0;
}


// ************************************************************************* //
