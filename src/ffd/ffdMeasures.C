/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdMeasures.H"
#include "gatheredSurface.H"
#include "IOmanip.H"
#include "Pstream.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdMeasures::ffdMeasures
(
    ffdBoxes& boxes,
    const pointField& points,
    const faceList& faces
)
:
    names_(boxes.parameterNames()),
    values_(boxes.values())
{
    const gatheredSurface surface(points, faces);
    closed_ = surface.closed();
    const morph::Triangles& triangles = surface.triangles();
    const morph::Vectors after
    (
        surface.gather(points + boxes.displacement())
    );
    before_ = morph::surfaceMeasures(surface.points(), triangles);
    after_ = morph::surfaceMeasures(after, triangles);
    forAll(names_, i)
    {
        derivatives_.push_back
        (
            morph::surfaceMeasuresDerivative
            (
                after, triangles, surface.gather(boxes.derivative(i)())
            )
        );
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdMeasures::writeColumns(Ostream& os, const string& prefix) const
{
    const string centroid = prefix + (closed_ ? "volumeC" : "areaC");
    os  << ' ' << setw(18) << (prefix + "area").c_str();
    if (closed_)
    {
        os  << ' ' << setw(18) << (prefix + "volume").c_str();
    }
    for (const char axis : {'x', 'y', 'z'})
    {
        os  << ' ' << setw(18) << (centroid + axis).c_str();
    }
    os  << endl;
}


void Foam::ffdMeasures::writeRow
(
    Ostream& os,
    const morph::SurfaceMeasures& m
) const
{
    const morph::Vector3& c = closed_ ? m.volumeCentroid : m.areaCentroid;
    os  << ' ' << setw(18) << m.area;
    if (closed_)
    {
        os  << ' ' << setw(18) << m.volume;
    }
    for (int i = 0; i < 3; ++i)
    {
        os  << ' ' << setw(18) << c[i];
    }
    os  << endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::ffdMeasures::writeMeasures(Ostream& os) const
{
    os  << "# shape";
    writeColumns(os, "");
    os  << "before ";
    writeRow(os, before_);
    os  << "after  ";
    writeRow(os, after_);
}


void Foam::ffdMeasures::writeDerivatives(Ostream& os) const
{
    os  << "# parameter             " << setw(18) << "value";
    writeColumns(os, "d");
    forAll(names_, i)
    {
        os  << names_[i].c_str();
        for (label n = names_[i].size(); n < 24; ++n)
        {
            os  << ' ';
        }
        os  << setw(18) << values_[i];
        if (Pstream::master())
        {
            writeRow(os, derivatives_[i]);
        }
    }
}


// ************************************************************************* //
