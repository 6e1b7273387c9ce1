/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "shapeMeasures.H"
#include "gatheredSurface.H"
#include "IOmanip.H"
#include "Pstream.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::shapeMeasures::shapeMeasures
(
    const pointField& points,
    const pointField& moved,
    const faceList& faces,
    const List<motionParameter>& parameters,
    const std::function<tmp<vectorField>(const label)>& derivative
)
:
    parameters_(parameters)
{
    const gatheredSurface surface(points, faces);
    closed_ = surface.closed();
    const morph::Triangles& triangles = surface.triangles();
    const morph::Vectors after(surface.gather(moved));
    before_ = morph::surfaceMeasures(surface.points(), triangles);
    after_ = morph::surfaceMeasures(after, triangles);
    forAll(parameters_, i)
    {
        derivatives_.push_back
        (
            morph::surfaceMeasuresDerivative
            (
                after, triangles, surface.gather(derivative(i)())
            )
        );
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::shapeMeasures::writeColumns(Ostream& os, const string& prefix) const
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


void Foam::shapeMeasures::writeRow
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

void Foam::shapeMeasures::writeMeasures(Ostream& os) const
{
    os  << "# shape";
    writeColumns(os, "");
    os  << "before ";
    writeRow(os, before_);
    os  << "after  ";
    writeRow(os, after_);
}


void Foam::shapeMeasures::writeDerivatives(Ostream& os) const
{
    os  << "# parameter             " << setw(18) << "value";
    writeColumns(os, "d");
    for (label i = 0; i < parameters_.size(); ++i)
    {
        const word& name = parameters_[i].name;
        os  << name.c_str() << ' ';
        for (label n = name.size() + 1; n < 24; ++n)
        {
            os  << ' ';
        }
        os  << setw(18) << parameters_[i].value;
        if (Pstream::master())
        {
            writeRow(os, derivatives_[i]);
        }
    }
}


// ************************************************************************* //
