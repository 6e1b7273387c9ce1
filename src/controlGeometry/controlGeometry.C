/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlGeometry.H"
#include "foamCompat.H"
#include "instantList.H"
#include "ListListOps.H"
#include "motionSolver.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "wholeFile.H"

#include <algorithm>
#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The values of all ranks in rank order, on the master only
template<class Type>
static List<Type> gathered(const List<Type>& mine)
{
    List<List<Type>> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = mine;
    Pstream::gatherList(all);
    return
        Pstream::master()
      ? ListListOps::combine<List<Type>>(all, accessOp<List<Type>>())
      : List<Type>();
}


static List<labelList> gatheredLines(const controlShape& shape)
{
    labelList nPoints(Pstream::nProcs(), Zero);
    nPoints[Pstream::myProcNo()] = shape.points.size();
    foamCompat::allGatherList(nPoints);

    label offset = 0;
    for (label rank = 0; rank < Pstream::myProcNo(); ++rank)
    {
        offset += nPoints[rank];
    }
    labelListList lines(shape.lines);
    for (labelList& line : lines)
    {
        for (label& pointi : line)
        {
            pointi += offset;
        }
    }
    return gathered(lines);
}


static controlShape gatheredShape(const controlShape& shape)
{
    controlShape all;
    all.name = shape.name;
    all.points = pointField(gathered<point>(shape.points));
    all.lines = gatheredLines(shape);
    for (const word& name : shape.scalars.sortedToc())
    {
        all.scalars.insert
        (
            name, scalarField(gathered<scalar>(shape.scalars[name]))
        );
    }
    for (const word& name : shape.vectors.sortedToc())
    {
        all.vectors.insert
        (
            name, vectorField(gathered<vector>(shape.vectors[name]))
        );
    }
    return all;
}


static void writeCells(Ostream& os, const controlShape& shape)
{
    if (shape.lines.empty())
    {
        os  << "VERTICES " << shape.points.size() << ' '
            << 2*shape.points.size() << nl;
        forAll(shape.points, i)
        {
            os  << "1 " << i << nl;
        }
        return;
    }

    label n = 0;
    for (const labelList& line : shape.lines)
    {
        n += 1 + line.size();
    }
    os  << "LINES " << shape.lines.size() << ' ' << n << nl;
    for (const labelList& line : shape.lines)
    {
        os  << line.size();
        for (const label pointi : line)
        {
            os  << ' ' << pointi;
        }
        os  << nl;
    }
}


static void writeVector(Ostream& os, const vector& v)
{
    os  << v.x() << ' ' << v.y() << ' ' << v.z() << nl;
}


static void writeShape(Ostream& os, const controlShape& shape)
{
    os  << "# vtk DataFile Version 2.0" << nl
        << shape.name.c_str() << nl
        << "ASCII" << nl
        << "DATASET POLYDATA" << nl
        << "POINTS " << shape.points.size() << " double" << nl;
    for (const point& x : shape.points)
    {
        writeVector(os, x);
    }
    writeCells(os, shape);

    os  << "POINT_DATA " << shape.points.size() << nl
        << "FIELD values " << shape.scalars.size() + shape.vectors.size() << nl;
    for (const word& name : shape.scalars.sortedToc())
    {
        const scalarField& values = shape.scalars[name];
        os  << name.c_str() << " 1 " << values.size() << " double" << nl;
        for (const scalar value : values)
        {
            os  << value << nl;
        }
    }
    for (const word& name : shape.vectors.sortedToc())
    {
        const vectorField& values = shape.vectors[name];
        os  << name.c_str() << " 3 " << values.size() << " double" << nl;
        for (const vector& value : values)
        {
            writeVector(os, value);
        }
    }
}


//- Folders whose names are numbers, in their order. Without OpenFOAM's file
//  handlers, which may ask all ranks
static instantList timesIn(const fileName& folder)
{
    DynamicList<instant> times;
    for (const fileName& name : readDir(folder, fileName::DIRECTORY))
    {
        scalar value;
        if (readScalar(name, value))
        {
            times.append(instant(value, name));
        }
    }
    std::sort
    (
        times.begin(),
        times.end(),
        [](const instant& a, const instant& b) { return a.value() < b.value(); }
    );
    return instantList(times);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::List<Foam::controlShape> Foam::controlGeometry::shapesOf
(
    const polyMesh& mesh
)
{
    const auto solvers = mesh.lookupClass<motionSolver>();
    List<controlShape> all;
    for (const word& name : solvers.sortedToc())
    {
        const auto* control =
            dynamic_cast<const controlGeometry*>(solvers[name]);
        if (control)
        {
            List<controlShape> these(control->shapes());
            for (controlShape& shape : these)
            {
                if (solvers.size() > 1)
                {
                    shape.name = name + '_' + shape.name;
                }
            }
            all.append(these);
        }
    }
    return all;
}


void Foam::controlGeometry::write
(
    const List<controlShape>& shapes,
    const fileName& folder
)
{
    for (const controlShape& mine : shapes)
    {
        const controlShape shape(gatheredShape(mine));
        if (Pstream::master())
        {
            wholeFile::writeOrStop
            (
                folder/(shape.name + ".vtk"),
                [&](Ostream& os)
                {
                    os.precision(std::numeric_limits<scalar>::max_digits10);
                    writeShape(os, shape);
                }
            );
        }
    }
}


void Foam::controlGeometry::writeSeries
(
    const List<controlShape>& shapes,
    const fileName& folder,
    const fileName& within
)
{
    if (!Pstream::master())
    {
        return;
    }
    const instantList times(timesIn(folder));
    for (const controlShape& shape : shapes)
    {
        const fileName name(shape.name + ".vtk");
        wholeFile::writeOrStop
        (
            folder/(name + ".series"),
            [&](Ostream& os)
            {
                os.precision(std::numeric_limits<scalar>::max_digits10);
                os  << "{" << nl
                    << "  \"file-series-version\" : \"1.0\"," << nl
                    << "  \"files\" : [";
                bool first = true;
                for (const instant& time : times)
                {
                    fileName file(time.name());
                    file = (within.empty() ? file : file/within)/name;
                    if (!isFile(folder/file, false))
                    {
                        continue;
                    }
                    os  << (first ? "" : ",") << nl
                        << "    { \"name\" : \"" << file.c_str()
                        << "\", \"time\" : " << time.value() << " }";
                    first = false;
                }
                os  << nl << "  ]" << nl << "}" << nl;
            }
        );
    }
}


// ************************************************************************* //
