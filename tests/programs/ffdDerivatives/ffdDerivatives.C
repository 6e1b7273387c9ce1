/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    ffdDerivatives

Description
    Test of ffdBoxes, which needs no mesh: reads boxes from constant/ffdDict,
    deforms the points of a triangulated ellipsoid, and prints for each
    parameter how far dx/dmu, and the derivatives of area, volume and centroids,
    are from central differences.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "ffdBoxes.H"
#include "eigenFields.H"
#include "IOdictionary.H"
#include "mathematicalConstants.H"
#include "surfaceMeasures.hpp"
#include "Time.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

// An ellipsoid about the middle of the unit cube: rings of points, and poles
static const label nRings = 24;
static const label nAround = 40;

static pointField ellipsoid()
{
    DynamicList<point> points;
    points.append(point(0.5, 0.5, 0.5 - 0.4));
    for (label i = 1; i < nRings; ++i)
    {
        const scalar a = constant::mathematical::pi*i/nRings;
        for (label j = 0; j < nAround; ++j)
        {
            const scalar b = constant::mathematical::twoPi*j/nAround;
            points.append
            (
                point
                (
                    0.5 + 0.3*Foam::sin(a)*Foam::cos(b),
                    0.5 + 0.2*Foam::sin(a)*Foam::sin(b),
                    0.5 - 0.4*Foam::cos(a)
                )
            );
        }
    }
    points.append(point(0.5, 0.5, 0.5 + 0.4));
    return pointField(std::move(points));
}


static morph::Triangles triangles()
{
    DynamicList<FixedList<label, 3>> faces;
    const label last = 1 + (nRings - 1)*nAround;
    for (label j = 0; j < nAround; ++j)
    {
        const label next = (j + 1) % nAround;
        faces.append(FixedList<label, 3>({0, 1 + next, 1 + j}));
        for (label i = 0; i < nRings - 2; ++i)
        {
            const label a = 1 + i*nAround + j;
            const label b = 1 + i*nAround + next;
            faces.append(FixedList<label, 3>({a, b, a + nAround}));
            faces.append(FixedList<label, 3>({b, b + nAround, a + nAround}));
        }
        const label ring = last - nAround;
        faces.append(FixedList<label, 3>({ring + j, ring + next, last}));
    }
    morph::Triangles t(faces.size(), 3);
    forAll(faces, i)
    {
        t.row(i) << faces[i][0], faces[i][1], faces[i][2];
    }
    return t;
}


// Volume, area and both centroids in one list
static scalarField listed(const morph::SurfaceMeasures& m)
{
    return scalarField
    ({
        m.volume, m.area,
        m.volumeCentroid[0], m.volumeCentroid[1], m.volumeCentroid[2],
        m.areaCentroid[0], m.areaCentroid[1], m.areaCentroid[2]
    });
}


int main(int argc, char *argv[])
{
    argList::noParallel();
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);
    const IOdictionary dict
    (
        IOobject("ffdDict", runTime.constant(), runTime, IOobject::MUST_READ)
    );

    const pointField points(ellipsoid());
    const morph::Triangles faces(triangles());
    ffdBoxes boxes(dict, &runTime);
    boxes.setPoints(points, edgeList());
    boxes.update(runTime.value());
    const scalarField values(boxes.values());
    const wordList names(boxes.parameterNames());

    const pointField now(points + boxes.displacement());
    Info<< "closed " << morph::isClosed(faces) << " measures "
        << listed(morph::surfaceMeasures(asVectors(now), faces)) << endl;

    const scalar h = 1e-5;
    forAll(values, i)
    {
        boxes.update(values);
        boxes.displacement();
        const vectorField exact(boxes.derivative(i));
        const scalarField exactMeasures
        (
            listed
            (
                morph::surfaceMeasuresDerivative
                (
                    asVectors(now), faces, asVectors(exact)
                )
            )
        );

        scalarField changed(values);
        changed[i] = values[i] + h;
        boxes.update(changed);
        const pointField above(points + boxes.displacement());
        changed[i] = values[i] - h;
        boxes.update(changed);
        const pointField below(points + boxes.displacement());
        const vectorField difference((above - below)/(2*h));
        const scalarField measures
        (
            (
                listed(morph::surfaceMeasures(asVectors(above), faces))
              - listed(morph::surfaceMeasures(asVectors(below), faces))
            )/(2*h)
        );
        Info<< "parameter " << names[i]
            << " dx " << max(mag(exact)) << " error "
            << max(mag(exact - difference))
            << " measures " << max(mag(exactMeasures)) << " error "
            << max(mag(exactMeasures - measures)) << endl;
    }
    Info<< "End" << endl;
    return 0;
}


// ************************************************************************* //
