/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    benchmarkFfd

Description
    Times of free-form deformation of the points of a mesh by boxes that
    contain it, in CPU seconds of one core: preparation once, evaluation for
    new values (the fold certificate apart).

    Reads constant/benchmarkDict: \c cases, a dictionary with the entry \c boxes
    for each; and \c volumetricBSplines, if that is given, for OpenFOAM's
    NURBS3DVolume.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "benchmarkClock.H"
#include "ffdBoxes.H"
#include "fvMesh.H"
#include "IOdictionary.H"
#include "NURBS3DVolume.H"
#include "Time.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static void ours(const dictionary& dict, const polyMesh& mesh)
{
    const label repeats = 7;
    const pointField& points = mesh.points();
    ffdBoxes boxes(dict, &mesh);
    scalarList certificate(repeats), preparation(repeats), evaluation(repeats);
    scalar largest = 0;
    for (label i = 0; i < repeats; ++i)
    {
        // Small, and different enough not to be a translation
        scalarField values(boxes.nParameters());
        forAll(values, p)
        {
            values[p] = 1e-3*(i + 1)*(p*7 % 5 - 2.5);
        }
        passed();
        boxes.update(values);
        certificate[i] = passed();
        boxes.setPoints(points, edgeList());
        boxes.displacement();
        preparation[i] = passed();
        const vectorField d(boxes.displacement());
        evaluation[i] = passed();
        preparation[i] -= evaluation[i];
        largest = max(mag(d));
    }
    Info<< "ours " << dict.dictName() << ' ' << boxes.nParameters() << ' '
        << median(preparation) << ' ' << median(evaluation) << ' '
        << median(certificate) << ' ' << largest << endl;
}


static void theirs(const dictionary& dict, const fvMesh& mesh)
{
    passed();
    autoPtr<NURBS3DVolume> box(NURBS3DVolume::New(dict, mesh));
    box->getParametricCoordinates();
    const scalar preparation = passed();
    vectorField movement(box->getControlPoints().size(), Zero);
    const pointField moved(box->computeNewPoints(movement));
    const scalar evaluation = passed();
    Info<< "theirs " << box->getMap().size() << ' ' << preparation << ' '
        << evaluation << ' ' << max(mag(moved - mesh.points())) << endl;
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

    for (const entry& e : dict.subDict("cases"))
    {
        ours(e.dict(), mesh);
    }
    if (dict.found("volumetricBSplines"))
    {
        theirs(dict.subDict("volumetricBSplines"), mesh);
    }
    return 0;
}


// ************************************************************************* //
