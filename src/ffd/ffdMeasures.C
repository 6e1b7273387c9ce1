/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdMeasures.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "IOmanip.H"
#include "ListListOps.H"
#include "Pstream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The corners of the triangles of all ranks, on the master
static vectorField corners(const vectorField& values, const faceList& faces)
{
    DynamicList<vector> mine;
    for (const face& f : faces)
    {
        for (label i = 1; i < f.size() - 1; ++i)
        {
            mine.append(values[f[0]]);
            mine.append(values[f[i]]);
            mine.append(values[f[i + 1]]);
        }
    }
    List<vectorField> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = mine;
    Pstream::gatherList(all);
    return ListListOps::combine<vectorField>(all, accessOp<vectorField>());
}


static morph::Triangles inOrder(const label nCorners)
{
    morph::Triangles triangles(nCorners/3, 3);
    for (label i = 0; i < nCorners; ++i)
    {
        triangles(i/3, i%3) = i;
    }
    return triangles;
}


// By their area vectors, whose sum is zero where they enclose something
static bool encloses(const vectorField& x)
{
    vector sum(Zero);
    scalar sumMag = 0;
    for (label i = 0; i + 2 < x.size(); i += 3)
    {
        const vector area = 0.5*((x[i + 1] - x[i]) ^ (x[i + 2] - x[i]));
        sum += area;
        sumMag += mag(area);
    }
    return sumMag > 0 && mag(sum) < 1e-8*sumMag;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdMeasures::ffdMeasures
(
    ffdBoxes& boxes,
    const pointField& points,
    const faceList& faces
)
:
    names_(boxes.parameterNames()),
    values_(boxes.values()),
    closed_(false)
{
    const pointField moved(points + boxes.displacement());
    const vectorField before(corners(points, faces));
    const vectorField after(corners(moved, faces));
    const morph::Triangles triangles(inOrder(after.size()));
    if (Pstream::master())
    {
        closed_ = encloses(before);
        before_ = morph::surfaceMeasures(asVectors(before), triangles);
        after_ = morph::surfaceMeasures(asVectors(after), triangles);
    }
    foamCompat::broadcast(closed_);

    forAll(names_, i)
    {
        const vectorField d(corners(boxes.derivative(i), faces));
        if (Pstream::master())
        {
            derivatives_.push_back
            (
                morph::surfaceMeasuresDerivative
                (
                    asVectors(after), triangles, asVectors(d)
                )
            );
        }
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
