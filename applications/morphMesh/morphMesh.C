/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    morphMesh

Group
    grpMeshManipulationUtilities

Description
    Applies the motion solver of constant/dynamicMeshDict once, checks the
    moved mesh, and writes its points.

    Any motion solver will do, morphFoam's or OpenFOAM's, and a dictionary
    "solvers" of several of them, whose displacements are added as
    dynamicMotionSolverListFvMesh adds them. A solver of velocities moves the
    mesh by one time step (deltaT of controlDict).

Usage
    \b morphMesh [OPTIONS]

    Options:
      - \par -time \<time\>
        Move to this time, default the start time of controlDict. The time
        need not have a folder, unless the motion solver reads a field there.

      - \par -overwrite
        Write constant/polyMesh/points. The points as they were are kept as
        points0, the reference from which motion solvers measure
        displacements; a points0 that is already there stays.

      - \par -dryRun
        Write nothing, say what would be written.

      - \par -lattice
        Also show what controls the motion, before a flow is run: control
        points of rbfMotionSolver, lattices of ffdMotionSolver, and the boundary
        for each parameter of a lattice at its bounds, as VTK files in the
        folder \c controls beside quality.dat. Also with -dryRun.

      - \par -pictures
        Like -lattice, and one sheet of the motion, motion.png in that folder:
        control points by kind, what they are told, those that are selected, the
        mesh before and after where it changed most and where it is worst, the
        worst cells and the histograms of quality (morphMeshPictures.H). For
        ffdMotionSolver also one picture of every parameter at its bounds,
        preview.png.

      - \par -derivatives \<patches\>
        Of a motion that has parameters, those of lattices or the numbers of
        displacements (rbfSensitivities.H): area, volume and centroid of
        patches, for example '(hull)', with their derivatives by each parameter,
        and dx/dmu at the points of the patches: measures.dat, derivatives.dat
        and derivatives.vtp beside quality.dat. Also with -dryRun.

      - \par -constraints
        Of such a motion: the dictionary \c constraints of its coefficients
        (shapeConstraint.H), on the patches that each names: constraints.dat and
        constraintDerivatives.dat beside quality.dat. Also with -dryRun.

      - \par -sensitivityFields
        Of such a motion: dx/dmu of the whole mesh by each parameter, as pointVectorField d_\<parameter\> in the folder of the time.
        Not with -dryRun.

      - \par -optimise
        Optimise the mesh after the motion (meshOptimiser.H), with the entries
        of system/optimiseDict (optimiseSettings.H) if there is one; \c when is
        always by default. Points of the boundary stay, but in symmetry planes.
        Targets are the cells of points0 or, without, of the mesh before the
        motion.

      - \par -noMotion
        With -optimise: no motion, dynamicMeshDict is not read. Without points0
        the target are orthogonal cells.

      - \par -region \<name\>
        The mesh region.

      - \par -version
        Print the version and stop.

    Written are

      - \<time\>/polyMesh/points, or constant/polyMesh/points (-overwrite), in
        the writeFormat of controlDict; in ascii with as many digits as it
        takes to read back the mesh that was checked;
      - \<time\>/pointDisplacement (not with -overwrite) if the motion solver
        read it from there, so that a motion that starts from that time
        continues this one. Boundary conditions such as
        angularOscillatingDisplacement keep their own reference in it;
      - to postProcessing/morphMesh/\<time\>, for a region
        postProcessing/\<region\>/morphMesh/\<time\>:
        quality.dat, a row of figures before and one after the motion;
        histogram.dat, the faces counted by non-orthogonality, skewness and
        ratio of the volumes they lie between;
        motion, a dictionary that says how much of the motion was attainable
        and how much was made (motionRecord.H), for sweeps over many designs.

    The exit status is 0 if the moved mesh is valid and written, and 1
    otherwise; then no file of the mesh is written or changed. A mesh is valid
    if all cell volumes are positive and no face is wrongly oriented. If it
    would be invalid the log has the line

        Failed: the moved mesh would be invalid

    the dictionary motion is written, and the cells that stop the motion are
    in the cellSet invalidMotionCells and in invalidCells.vtk
    (motionLimiter.H). They are of no consequence for the mesh. A set that a
    former motion left stays. With -dryRun there are none of these either.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "Time.H"
#include "fvMesh.H"
#include "caseSelection.H"
#include "clockTime.H"
#include "guardedRun.H"
#include "meshFiles.H"
#include "morphMeshControls.H"
#include "morphMeshInput.H"
#include "morphMeshOptimise.H"
#include "morphMeshOutput.H"
#include "morphMeshPictures.H"
#include "morphVersion.H"
#include "motionLimiter.H"
#include "motionRecord.H"
#include "plainText.H"
#include "validFraction.H"


using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- The points after the motion. The mesh stays where it is
static pointField moved(const fvMesh& mesh, PtrList<motionSolver>& solvers)
{
    pointField points(solvers[0].newPoints());

    for (label i = 1; i < solvers.size(); ++i)
    {
        points += solvers[i].newPoints() - mesh.points();
    }

    return points;
}


//- Say what makes the mesh invalid
static void reportInvalid
(
    const fvMesh& mesh,
    const pointField& newPoints,
    motionRecord& record
)
{
    const vectorField displacement(newPoints - mesh.points());
    const validFraction fraction(mesh, mesh.points(), displacement);

    Info<< nl << "The moved mesh would be invalid: it has "
        << invalidMotion(mesh, newPoints) << '.' << nl
        << "Of these the motion makes " << fraction.whole() << '.' << nl
        << "Nothing was written to the mesh. Move by less, or let the motion"
        << " reach further into the mesh (larger support radius, other"
        << " diffusivity). What was invalid before needs a better mesh to"
        << " start from." << endl;

    if (fraction.stoppedBy() != validFraction::criterion::none)
    {
        Info<< "It is valid up to the fraction " << fraction.value()
            << " of the motion, where the first cell breaks at "
            << fraction.where() << endl;
        motionLimiter::report(fraction);
        record.note(fraction, fraction.value(), 0, 1);
    }
    record.set("moved", 0);
    record.writeReport();
}


static void addOptions()
{
    argList::addNote
    (
        "Apply the motion solver of dynamicMeshDict once, check the moved mesh"
        " and write its points"
    );
    argList::noFunctionObjects();
    argList::addOption
    (
        "time",
        "time",
        "Move to this time (default: the start time of controlDict)"
    );
    argList::addBoolOption
    (
        "overwrite",
        "Write constant/polyMesh/points, keep the reference as points0"
    );
    argList::addBoolOption
    (
        "dryRun",
        "Write nothing, say what would be written"
    );
    argList::addBoolOption
    (
        "lattice",
        "Write control points, lattices and each parameter at its bounds as VTK"
    );
    argList::addBoolOption
    (
        "pictures",
        "Like -lattice, and draw them: the motion, and parameters at bounds"
    );
    argList::addOption
    (
        "derivatives",
        "patches",
        "Write derivatives of area, volume and centroid of these patches"
    );
    argList::addBoolOption
    (
        "constraints",
        "Write constraints of shapes with their derivatives"
    );
    argList::addBoolOption
    (
        "sensitivityFields",
        "Write dx/dmu of the whole mesh for each parameter, as fields"
    );
    argList::addBoolOption
    (
        "optimise",
        "Optimise the mesh after the motion, as system/optimiseDict says"
    );
    argList::addBoolOption
    (
        "noMotion",
        "With -optimise: do not move the mesh"
    );
    #include "addRegionOption.H"
}


//- Whether the moved mesh is valid
static bool morph(const argList& args)
{
    #include "createTime.H"

    const bool overwrite = args.found("overwrite");
    const bool dryRun = args.found("dryRun");
    word regionName(polyMesh::defaultRegion);
    args.readIfPresent("region", regionName);

    const clockTime clock;

    caseSelection::selectTime(args, runTime);
    caseSelection::checkRegion(runTime, regionName);

    Info<< "Moving mesh " << regionName << " at time " << runTime.timeName()
        << nl << endl;
    const autoPtr<fvMesh> meshPtr(meshFiles::read(runTime, regionName));
    const fvMesh& mesh = meshPtr();
    const scalar readTime = clock.timeIncrement();

    motionRecord record(mesh, morphMeshOutput::folder(mesh), !dryRun);
    PtrList<motionSolver> solvers;
    const bool moves = !args.found("noMotion");
    if (moves)
    {
        morphMeshInput::readSolvers(mesh, solvers);
    }
    const scalar constructTime = clock.timeIncrement();

    pointField newPoints(moves ? moved(mesh, solvers) : mesh.points());
    if (args.found("optimise"))
    {
        newPoints = morphMeshOptimise::points(mesh, newPoints, moves);
    }
    const scalar solveTime = clock.timeIncrement();

    if (args.found("lattice") || args.found("pictures"))
    {
        morphMeshControls::write
        (
            mesh,
            solvers,
            runTime.globalPath()/morphMeshOutput::folder(mesh)/"controls",
            args.found("pictures")
        );
    }
    wordRes patches;
    if (args.readIfPresent("derivatives", patches))
    {
        morphMeshControls::writeDerivatives
        (
            mesh,
            solvers,
            patches,
            runTime.globalPath()/morphMeshOutput::folder(mesh)
        );
    }

    if (args.found("constraints"))
    {
        morphMeshControls::writeConstraints
        (
            mesh,
            solvers,
            runTime.globalPath()/morphMeshOutput::folder(mesh)
        );
    }

    const scalar showTime = clock.timeIncrement();

    const meshQuality before(mesh, mesh.points());
    const meshQuality after(mesh, newPoints);
    const scalar checkTime = clock.timeIncrement();
    if (args.found("pictures"))
    {
        const fileName folder
        (
            runTime.globalPath()/morphMeshOutput::folder(mesh)/"controls"
        );
        morphMeshPictures::write(mesh, newPoints, before, after, folder);
        morphMeshPictures::draw(folder);
    }
    const scalar drawTime = clock.timeIncrement();

    Info<< nl;
    meshQuality::writeHeader(Info);
    before.writeRow(Info, "before");
    after.writeRow(Info, "after");
    Info<< endl;

    if (!after.valid())
    {
        reportInvalid(mesh, newPoints, record);
    }
    else if (dryRun)
    {
        Info<< "Dry run, nothing is written. The moved mesh is valid: "
            << (overwrite ? runTime.constant() : runTime.timeName())
            << "/polyMesh/points and " << morphMeshOutput::folder(mesh).c_str()
            << "/quality.dat would be written, and histogram.dat and motion"
            << " beside it." << endl;
    }
    else
    {
        morphMeshOutput::writeMesh(mesh, newPoints, solvers, overwrite);
        morphMeshOutput::writeQuality(mesh, before, after);
        if (args.found("sensitivityFields"))
        {
            morphMeshControls::writeSensitivities(mesh, solvers);
        }
        record.writeReport();
    }

    using plainText::rounded;
    Info<< nl << "Wall time [s]: reading " << rounded(readTime).c_str()
        << ", solver construction " << rounded(constructTime).c_str()
        << ", solve " << rounded(solveTime).c_str()
        << ", check " << rounded(checkTime).c_str()
        << ", write " << rounded(showTime + drawTime + clock.timeIncrement()).c_str()
        << nl << nl << (after.valid() ? "End" : motionLimiter::failed) << nl
        << endl;

    return after.valid();
}


int main(int argc, char *argv[])
{
    guardedRun::prepare();

    if (morphVersion::asked(argc, argv))
    {
        return 0;
    }
    addOptions();
    #include "setRootCase.H"
    if (args.found("noMotion") && !args.found("optimise"))
    {
        FatalErrorInFunction
            << "Option -noMotion without -optimise: there is nothing to do"
            << nl << "    Add -optimise, or leave -noMotion out" << nl
            << exit(FatalError);
    }

    const bool valid = guardedRun::run
    (
        "morphMesh", [&]() { return morph(args); }
    );
    if (!valid)
    {
        // Not by return: the end of argList ends the program with status 0.
        // The reduction lets the master finish what it has to say
        returnReduce(true, andOp<bool>());
        Pstream::exit(1);
    }
    return 0;
}


// ************************************************************************* //
