/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

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

      - \par -region \<name\>
        The mesh region.

    Written are

      - \<time\>/polyMesh/points, or constant/polyMesh/points (-overwrite), in
        the writeFormat of controlDict; in ascii with as many digits as it
        takes to read back the mesh that was checked;
      - \<time\>/pointDisplacement (not with -overwrite) if the motion solver
        read it from there, so that a motion that starts from that time
        continues this one. Boundary conditions such as
        angularOscillatingDisplacement keep their own reference in it;
      - postProcessing/morphMesh/\<time\>/quality.dat, for a region
        postProcessing/\<region\>/morphMesh/\<time\>/quality.dat: a row of
        figures before and one after the motion.

    The exit status is 0 if the moved mesh is valid and written, and 1
    otherwise; then nothing is written. A mesh is valid if all cell volumes
    are positive and no face is wrongly oriented.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "Time.H"
#include "fvMesh.H"
#include "motionSolver.H"
#include "displacementMotionSolver.H"
#include "pointIOField.H"
#include "clockTime.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "meshQuality.H"
#include "invalidMotion.H"

#include <limits>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- The times that have a folder, for messages
static wordList timeNames(const Time& runTime)
{
    DynamicList<word> names;
    for (const instant& time : runTime.times())
    {
        if (time.name() != runTime.constant())
        {
            names.append(time.name());
        }
    }
    return wordList(names);
}


//- The existing time that option -time means, or else the time it names
static void selectTime(const argList& args, Time& runTime)
{
    word name;
    if (!args.readIfPresent("time", name))
    {
        return;
    }

    scalar value;
    if (!readScalar(name, value))
    {
        FatalErrorInFunction
            << "The option -time is '" << name << "', which is no number."
            << " The times of this case are "
            << flatOutput(timeNames(runTime)) << "; give one time, for example"
            << " -time 0" << exit(FatalError);
    }

    const instantList times(runTime.times());
    const label index = Time::findClosestTimeIndex(times, value, "constant");
    const bool found =
        index >= 0
     && mag(times[index].value() - value) <= 10*SMALL*mag(value);

    if (returnReduce(found, andOp<bool>()))
    {
        runTime.setTime(times[index], 0);
        return;
    }

    runTime.setTime(value, 0);
    Info<< "Time " << runTime.timeName() << " has no folder (there are "
        << flatOutput(timeNames(runTime))
        << "): the mesh is that of the time before,"
        << " and a motion solver that reads a field from this time will stop."
        << nl << endl;
}


//- Stop unless there is a mesh to read
static void checkRegion(const Time& runTime, const word& regionName)
{
    const fileName local
    (
        regionName == polyMesh::defaultRegion ? word::null : regionName
    );
    const fileName meshDir(local/polyMesh::meshSubDir);

    IOobject io
    (
        "faces",
        runTime.findInstance(meshDir, "faces", IOobject::READ_IF_PRESENT),
        meshDir,
        runTime
    );

    const bool found = io.typeHeaderOk<faceIOList>(false);
    if (!returnReduce(found, andOp<bool>()))
    {
        FatalErrorInFunction
            << "There is no mesh in " << runTime.constant()/meshDir
            << " of case " << runTime.caseName()
            << ": nothing to move. Make the mesh, or give the region"
            << " (-region), the case (-case) or, for a decomposed case,"
            << " -parallel" << exit(FatalError);
    }
}


//- The dictionary as it is, not yet that of a motion solver
static IOdictionary readDynamicMeshDict(const fvMesh& mesh)
{
    IOobject io
    (
        "dynamicMeshDict",
        mesh.time().constant(),
        mesh,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );

    const bool found = io.typeHeaderOk<IOdictionary>(true);
    if (!returnReduce(found, andOp<bool>()))
    {
        FatalErrorInFunction
            << "There is no dictionary "
            << mesh.time().relativePath(io.objectPath())
            << ": it names the motion solver that morphMesh applies."
            << " Write it, with the entries motionSolver and, for solvers of"
            << " a library, motionSolverLibs" << exit(FatalError);
    }

    return IOdictionary(io);
}


//- The solvers of sub-dictionaries, as dynamicMotionSolverListFvMesh has them
static void readSolverList
(
    const fvMesh& mesh,
    const IOdictionary& dict,
    PtrList<motionSolver>& solvers
)
{
    label n = 0;
    const dictionary& list = dict.subDict("solvers");
    solvers.setSize(list.size());

    for (const entry& item : list)
    {
        if (item.isDict())
        {
            const IOobject io
            (
                item.keyword(),
                mesh.time().constant(),
                mesh,
                IOobject::NO_READ,
                IOobject::NO_WRITE,
                false
            );
            const IOdictionary solverDict(io, item.dict());
            solvers.set(n++, motionSolver::New(mesh, solverDict));
        }
    }

    solvers.setSize(n);
    if (n == 0)
    {
        FatalIOErrorInFunction(list)
            << "The entry solvers holds no dictionary: no motion solver is"
            << " given. Add one dictionary for each" << exit(FatalIOError);
    }
}


static void readSolvers(const fvMesh& mesh, PtrList<motionSolver>& solvers)
{
    const IOdictionary dict(readDynamicMeshDict(mesh));

    if (dict.isDict("solvers"))
    {
        readSolverList(mesh, dict, solvers);
    }
    else if (dict.found("motionSolver") || dict.found("solver"))
    {
        solvers.setSize(1);
        solvers.set(0, motionSolver::New(mesh));
    }
    else
    {
        FatalIOErrorInFunction(dict)
            << "There is neither an entry motionSolver nor a dictionary"
            << " solvers: nothing says how to move the mesh. Add for example"
            << " 'motionSolver rbfMotionSolver;' and"
            << " 'motionSolverLibs (morphMotionSolvers);'"
            << exit(FatalIOError);
    }
}


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


static void write(const regIOobject& object)
{
    const bool written = object.write();
    if (!returnReduce(written, andOp<bool>()))
    {
        FatalErrorInFunction
            << "Could not write " << object.objectPath()
            << ": is the disk full, or the folder read-only?"
            << exit(FatalError);
    }
    Info<< "Wrote "
        << (object.instance()/object.db().dbDir()/object.local()/object.name())
            .c_str()
        << endl;
}


static pointIOField pointsFile
(
    const word& name,
    const fileName& instance,
    const fvMesh& mesh,
    const IOobject::readOption readOpt
)
{
    return pointIOField
    (
        IOobject
        (
            name,
            instance,
            polyMesh::meshSubDir,
            mesh,
            readOpt,
            IOobject::NO_WRITE,
            false
        )
    );
}


//- Keep constant/polyMesh/points as points0, unless there is one already
static void keepReference(const fvMesh& mesh)
{
    const fileName& constant = mesh.time().constant();

    IOobject io
    (
        "points0",
        constant,
        polyMesh::meshSubDir,
        mesh
    );

    const bool found = io.typeHeaderOk<pointIOField>(true);
    if (returnReduce(found, andOp<bool>()))
    {
        const pointIOField points0
        (
            pointsFile("points0", constant, mesh, IOobject::MUST_READ)
        );
        const bool fits = points0.size() == mesh.nPoints();
        if (!returnReduce(fits, andOp<bool>()))
        {
            FatalErrorInFunction
                << "There are " << points0.size() << " points in "
                << mesh.time().relativePath(io.objectPath())
                << " and " << mesh.nPoints() << " in the mesh: it is left"
                << " from another mesh. Remove it" << exit(FatalError);
        }
        Info<< "Kept the points0 there is" << endl;
        return;
    }

    pointIOField points0
    (
        pointsFile("points", constant, mesh, IOobject::MUST_READ)
    );
    points0.rename("points0");
    write(points0);
}


static void writePoints
(
    const fvMesh& mesh,
    const pointField& newPoints,
    const bool overwrite
)
{
    if (overwrite)
    {
        keepReference(mesh);
    }

    const fileName instance
    (
        overwrite ? mesh.time().constant() : mesh.time().timeName()
    );
    pointIOField points
    (
        pointsFile("points", instance, mesh, IOobject::NO_READ)
    );
    points = newPoints;
    write(points);

    if (overwrite && mesh.pointsInstance() != mesh.time().constant())
    {
        WarningInFunction
            << "The mesh at time " << mesh.time().timeName()
            << " has points of its own in " << mesh.pointsInstance()
            << ": they hide what was written to constant. Remove them to use"
            << " the new mesh" << endl;
    }
}


//- The displacements that a motion from this time starts with
static void writeDisplacement(const PtrList<motionSolver>& solvers)
{
    for (const motionSolver& solver : solvers)
    {
        const auto* displacement = isA<displacementMotionSolver>(solver);

        if (displacement)
        {
            const pointVectorField& field =
                const_cast<displacementMotionSolver*>(displacement)
              ->pointDisplacement();

            IOobject io(field);
            const bool found = io.typeHeaderOk<pointVectorField>(true);

            // One that the solver made up itself is no input of the case
            if (returnReduce(found, andOp<bool>()))
            {
                write(field);
            }
        }
    }
}


static fileName qualityFile(const fvMesh& mesh)
{
    fileName dir("postProcessing");
    if (mesh.name() != polyMesh::defaultRegion)
    {
        dir = dir/mesh.name();
    }
    return dir/"morphMesh"/mesh.time().timeName()/"quality.dat";
}


static void writeQuality
(
    const fvMesh& mesh,
    const meshQuality& before,
    const meshQuality& after
)
{
    const fileName file(qualityFile(mesh));

    if (Pstream::master())
    {
        const fileName path(mesh.time().globalPath()/file);
        mkDir(path.path());

        OFstream os(path);
        os.precision(12);
        meshQuality::writeHeader(os);
        before.writeRow(os, "before");
        after.writeRow(os, "after");
    }
    Info<< "Wrote " << file.c_str() << endl;
}


//- Say what makes the mesh invalid
static void reportInvalid(const fvMesh& mesh, const pointField& newPoints)
{
    Info<< nl << "The moved mesh would be invalid: it has "
        << invalidMotion(mesh, newPoints) << '.' << nl
        << "Of these the motion makes "
        << invalidMotion(mesh, mesh.points(), newPoints) << '.' << nl
        << "Nothing was written. Move by less, or let the motion reach"
        << " further into the mesh (larger support radius, other diffusivity);"
        << " what the motion does not make needs a better mesh to start from."
        << endl;
}


static void writeAll
(
    const fvMesh& mesh,
    const pointField& newPoints,
    const PtrList<motionSolver>& solvers,
    const bool overwrite
)
{
    // Fewer digits round the points, which can fold the flat cells of a
    // boundary layer: with these the file has the very points that were checked
    const unsigned int digits = IOstream::defaultPrecision();
    IOstream::defaultPrecision
    (
        max(digits, unsigned(std::numeric_limits<scalar>::max_digits10))
    );

    if (mesh.time().writeFormat() == IOstream::ASCII)
    {
        Info<< "Points are written with " << IOstream::defaultPrecision()
            << " digits" << endl;
    }

    writePoints(mesh, newPoints, overwrite);
    if (!overwrite)
    {
        writeDisplacement(solvers);
    }

    IOstream::defaultPrecision(digits);
}


int main(int argc, char *argv[])
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
    #include "addRegionOption.H"
    #include "setRootCase.H"
    #include "createTime.H"

    const bool overwrite = args.found("overwrite");
    word regionName(polyMesh::defaultRegion);
    args.readIfPresent("region", regionName);

    const clockTime clock;

    selectTime(args, runTime);
    checkRegion(runTime, regionName);

    Info<< "Moving mesh " << regionName << " at time " << runTime.timeName()
        << nl << endl;
    fvMesh mesh
    (
        IOobject
        (
            regionName,
            runTime.timeName(),
            runTime,
            IOobject::MUST_READ
        )
    );
    const scalar readTime = clock.timeIncrement();

    PtrList<motionSolver> solvers;
    readSolvers(mesh, solvers);
    const scalar constructTime = clock.timeIncrement();

    const pointField newPoints(moved(mesh, solvers));
    const scalar solveTime = clock.timeIncrement();

    const meshQuality before(mesh, mesh.points());
    const meshQuality after(mesh, newPoints);
    const scalar checkTime = clock.timeIncrement();

    Info<< nl;
    meshQuality::writeHeader(Info);
    before.writeRow(Info, "before");
    after.writeRow(Info, "after");
    Info<< endl;

    if (!after.valid())
    {
        reportInvalid(mesh, newPoints);
    }
    else if (args.found("dryRun"))
    {
        Info<< "Dry run, nothing is written. The moved mesh is valid: "
            << (overwrite ? runTime.constant() : runTime.timeName())
            << "/polyMesh/points and " << qualityFile(mesh).c_str()
            << " would be written." << endl;
    }
    else
    {
        writeAll(mesh, newPoints, solvers, overwrite);
        writeQuality(mesh, before, after);
    }

    Info<< nl << "Wall time [s]: reading " << readTime
        << ", solver construction " << constructTime
        << ", solve " << solveTime << ", check " << checkTime
        << ", write " << clock.timeIncrement()
        << nl << nl << (after.valid() ? "End" : "Failed") << nl << endl;

    if (!after.valid())
    {
        // Not by return: the end of argList ends the program with status 0.
        // The reduction lets the master finish what it has to say
        returnReduce(true, andOp<bool>());
        Pstream::exit(1);
    }

    return 0;
}


// ************************************************************************* //
