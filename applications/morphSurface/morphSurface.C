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
    and writes (stl, obj, vtk, off, tri, ..., also with .gz).

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

      - \par -lattice
        Also write the lattices, and the surface for each parameter at its
        bounds, as VTK files to the folder \<output without extension\>.lattice

      - \par -version
        Print the version and stop.

    The output is not written if a box folds, has none of the surface's points
    or any entry is wrong; the exit status is then 1.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "dictionaryChecks.H"
#include "ffdMeasures.H"
#include "ffdPreview.H"
#include "IFstream.H"
#include "morphVersion.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "triSurface.H"

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


int main(int argc, char *argv[])
{
    if (morphVersion::asked(argc, argv))
    {
        return 0;
    }
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
        "lattice",
        "Write the lattices and each parameter at its bounds as VTK files"
    );

    const argList args(argc, argv);
    const fileName input(args[1]);
    const fileName output(args[2]);
    checkReadable(input, "surface");
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

    ffdBoxes boxes
    (
        readBoxes
        (
            args.getOrDefault<fileName>("dict", "constant/dynamicMeshDict")
        ),
        nullptr
    );
    triSurface surface(input);
    const pointField points(surface.points());
    boxes.setPoints(points, edgesOf(surface));
    boxes.update(args.getOrDefault<scalar>("time", 0));
    const pointField moved(points + boxes.displacement());
    const faceList faces(facesOf(surface));
    const ffdMeasures measures(boxes, points, faces);

    Info<< nl << "Surface of " << surface.size() << " triangles, "
        << (measures.closed() ? "closed" : "open") << nl << nl;
    measures.writeMeasures(Info);

    if (output.hasPath())
    {
        mkDir(output.path());
    }
    surface.movePoints(moved);
    surface.write(output, true);
    Info<< nl << "Wrote " << output.c_str() << endl;

    if (args.found("derivatives"))
    {
        OFstream os(output.lessExt() + ".derivatives.dat");
        os.precision(std::numeric_limits<scalar>::max_digits10);
        measures.writeDerivatives(os);
        measures.writeDerivatives(Info);
        Info<< "Wrote " << os.name().c_str() << endl;
    }
    if (args.found("lattice"))
    {
        ffdPreview::write
        (
            boxes, points, faces, output.lessExt() + ".lattice"
        );
    }

    Info<< nl << "End" << nl << endl;
    return 0;
}


// ************************************************************************* //
