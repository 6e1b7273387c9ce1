/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    morphSurface

Group
    grpSurfaceUtilities

Description
    Applies the boxes of ffdMotionSolver to a surface file: the shape alone,
    without a mesh or a flow. Prints area, centroid and, of closed surfaces,
    volume before and after.

Usage
    \b morphSurface [OPTIONS] input output

    Formats are told by the extensions: all that OpenFOAM's triSurface reads
    and writes (stl, obj, vtk, off, tri, ..., also with .gz). Numbers are
    written with 17 digits, which are read back as they were, where the format
    has text; binary stl has single precision.

    Options:
      - \par -dict \<file\>
        Dictionary with the entries \c boxes and \c combine of ffdMotionSolver,
        or with a sub-dictionary ffdMotionSolverCoeffs that has them. Default
        constant/dynamicMeshDict.

      - \par -time \<time\>
        For values that are functions of time, default 0.

      - \par -derivatives
        Also write derivatives of area, volume and centroid by each parameter,
        to \<output without extension\>.derivatives.dat

      - \par -constraints
        Evaluate the dictionary \c constraints beside \c boxes
        (shapeConstraint.H) on the surface: values, bounds and by how much they
        are missed, and exact derivatives by each parameter, to \<output without
        extension\>.constraints.dat and .constraintDerivatives.dat

      - \par -lattice
        Also write the lattices, and the surface for each parameter at its
        bounds, as VTK files to the folder \<output without extension\>.lattice

      - \par -version
        Print the version and stop.

      - \par -preview
        The same, and one picture of it all: preview.png in that folder.

    The output is not written if a box folds, has none of the surface's points
    or any entry is wrong; the exit status is then 1. It is written beside the
    output, read back and only then takes its name: a full disk leaves a former
    file as it was.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "dictionaryEntries.H"
#include "ffdFit.H"
#include "ffdPreview.H"
#include "finiteNumbers.H"
#include "guardedRun.H"
#include "IFstream.H"
#include "morphVersion.H"
#include "OSspecific.H"
#include "shapeConstraints.H"
#include "shapeMeasures.H"
#include "surfaceFile.H"
#include "untrapped.H"
#include "wholeFile.H"

#include <cstdlib>
#include <limits>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static void checkReadable(const fileName& file, const string& what)
{
    if (!isFile(file))
    {
        FatalErrorInFunction
            << "There is no " << what.c_str() << ' ' << file << nl
            << "    Give the path of one" << nl << exit(FatalError);
    }
}


//- The dictionary in which boxes are
static dictionary readBoxes(const fileName& file)
{
    checkReadable(file, "dictionary (-dict)");
    const untrapped numbers;
    IFstream is(file);
    const dictionary dict(is);
    if (!dict.found("boxes") && !dict.isDict("ffdMotionSolverCoeffs"))
    {
        FatalIOErrorInFunction(dict)
            << "There are no boxes: neither an entry 'boxes' nor a dictionary"
            << " ffdMotionSolverCoeffs that has one" << nl
            << exit(FatalIOError);
    }
    return dict.optionalSubDict("ffdMotionSolverCoeffs");
}


//- The time of the parameters
static scalar readTime(const argList& args)
{
    const untrapped numbers;
    const string given(args.getOrDefault<string>("time", "0"));
    scalar time;
    if (!readScalar(given, time) || !finiteNumbers::usable(time))
    {
        FatalErrorInFunction
            << "The option -time is '" << given.c_str() << "', which is no"
            << " time" << nl
            << "    Give a number of seconds, for example -time 0" << nl
            << exit(FatalError);
    }
    return time;
}


static autoPtr<triSurface> readSurface(const fileName& input)
{
    checkReadable(input, "surface");
    string wrong;
    autoPtr<triSurface> surface(surfaceFile::read(input, wrong));
    if (!wrong.empty())
    {
        FatalErrorInFunction
            << "The surface cannot be used: " << wrong.c_str() << nl
            << "    Repair the file" << nl << exit(FatalError);
    }
    return surface;
}


static void writeSurface(const fileName& output, const triSurface& surface)
{
    // Of a shape that was calculated all digits
    const unsigned int digits = IOstream::defaultPrecision();
    IOstream::defaultPrecision(std::numeric_limits<scalar>::max_digits10);
    const string wrong(surfaceFile::write(output, surface));
    IOstream::defaultPrecision(digits);
    if (!wrong.empty())
    {
        FatalErrorInFunction << wrong.c_str() << nl << exit(FatalError);
    }
    Info<< nl << "Wrote " << output.c_str() << endl;
}


static wordList regionNames(const triSurface& surface)
{
    wordList names(surface.patches().size());
    forAll(names, i)
    {
        names[i] = surface.patches()[i].name();
    }
    return names;
}


//- Boxes around regions of the surface get their place
static dictionary fitted(const dictionary& dict, const triSurface& surface)
{
    return ffdFit::fitted
    (
        dict,
        regionNames(surface),
        [&](const label region)
        {
            DynamicList<point> points;
            for (const labelledTri& t : surface)
            {
                if (t.region() == region)
                {
                    for (const label pointi : t)
                    {
                        points.append(surface.points()[pointi]);
                    }
                }
            }
            return pointField(std::move(points));
        }
    );
}


static edgeList edgesOf(const triSurface& surface)
{
    edgeList edges(surface.nEdges());
    forAll(edges, i)
    {
        const edge& e = surface.edges()[i];
        edges[i] = edge
        (
            surface.meshPoints()[e.start()], surface.meshPoints()[e.end()]
        );
    }
    return edges;
}


static faceList facesOf(const triSurface& surface)
{
    faceList faces(surface.size());
    forAll(faces, i)
    {
        faces[i] = surface[i].triFaceFace();
    }
    return faces;
}


//- Those of the regions that an entry 'patches' selects, all without it
static faceList facesOf(const triSurface& surface, const dictionary& dict)
{
    if (!dict.found("patches"))
    {
        return facesOf(surface);
    }
    const labelList regions
    (
        dictionaryChecks::select(dict, "patches", regionNames(surface))
    );
    DynamicList<face> faces;
    for (const labelledTri& t : surface)
    {
        if (regions.found(t.region()))
        {
            faces.append(t.triFaceFace());
        }
    }
    return faceList(std::move(faces));
}


static void addOptions()
{
    argList::addNote
    (
        "Apply the boxes of ffdMotionSolver to a surface file"
    );
    argList::noParallel();
    argList::noFunctionObjects();
    argList::noCheckProcessorDirectories();
    argList::addArgument("input", "The surface to read");
    argList::addArgument("output", "The surface to write");
    argList::addOption
    (
        "dict",
        "file",
        "Dictionary with the boxes (default: constant/dynamicMeshDict)"
    );
    argList::addOption("time", "time", "Time of the parameters (default: 0)");
    argList::addBoolOption
    (
        "derivatives",
        "Write derivatives of area, volume and centroid by the parameters"
    );
    argList::addBoolOption
    (
        "constraints",
        "Write the values and derivatives of the dictionary 'constraints'"
    );
    argList::addBoolOption
    (
        "lattice",
        "Write the lattices and each parameter at its bounds as VTK files"
    );

    argList::addBoolOption
    (
        "preview",
        "Like -lattice, and draw each parameter at its bounds in one picture"
    );
}


static void deform(const argList& args)
{
    const fileName input(args[1]);
    const fileName output(args[2]);
    if (!triSurface::canWriteType(output.ext()))
    {
        FatalErrorInFunction
            << "Surfaces cannot be written as " << output << nl
            << "    Use one of the extensions "
            << plainText::listed
               (
                   triSurface::writeTypes().sortedToc()
               ).c_str()
            << nl
            << exit(FatalError);
    }

    autoPtr<triSurface> read(readSurface(input));
    triSurface& surface = read();
    const pointField points(surface.points());
    const dictionary dict
    (
        readBoxes
        (
            args.getOrDefault<fileName>("dict", "constant/dynamicMeshDict")
        )
    );
    ffdBoxes boxes(fitted(dict, surface), nullptr);
    boxes.setPoints(points, edgesOf(surface));
    if (boxes.keeps())
    {
        boxes.setKept(points, facesOf(surface, boxes.keep()));
    }
    boxes.update(readTime(args));
    const pointField moved(points + boxes.displacement());
    const faceList faces(facesOf(surface));
    const shapeMeasures measures
    (
        points,
        moved,
        faces,
        boxes.parameterList(),
        [&](const label i) { return boxes.derivative(i); }
    );

    Info<< nl << "Surface of " << surface.size() << " triangles, "
        << (measures.closed() ? "closed" : "open") << nl << nl;
    measures.writeMeasures(Info);

    surface.movePoints(moved);
    writeSurface(output, surface);

    if (args.found("derivatives"))
    {
        const fileName path(output.lessExt() + ".derivatives.dat");
        wholeFile::writeOrStop
        (
            path,
            [&](Ostream& os)
            {
                os.precision(std::numeric_limits<scalar>::max_digits10);
                measures.writeDerivatives(os);
            }
        );
        measures.writeDerivatives(Info);
        Info<< "Wrote " << path.c_str() << endl;
    }
    if (args.found("constraints"))
    {
        const dictionary& given =
            dictionaryChecks::subDict(dict, "constraints");
        shapeConstraints constraints
        (
            given, points, facesOf(surface, given)
        );
        constraints.evaluate
        (
            moved,
            boxes.parameterNames(),
            [&](const label i) { return boxes.derivative(i); }
        );
        constraints.write(output.lessExt() + '.');
    }
    if (args.found("lattice") || args.found("preview"))
    {
        const fileName folder(output.lessExt() + ".lattice");
        ffdPreview::write(boxes, points, faces, folder);
        if (args.found("preview"))
        {
            ffdPreview::draw(folder);
        }
    }

    Info<< nl << "End" << nl << endl;
}


int main(int argc, char *argv[])
{
    if (morphVersion::asked(argc, argv))
    {
        return 0;
    }

    guardedRun::prepare();

    addOptions();
    const argList args(argc, argv);
    guardedRun::run
    (
        "morphSurface", [&]() { deform(args); return true; }
    );
    return 0;
}


// ************************************************************************* //
