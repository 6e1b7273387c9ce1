/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later

Application
    morphRemesh

Group
    grpMeshManipulationUtilities

Description
    Replaces bad cells of a mesh, or all, by tetrahedra, and maps the fields of
    the time to it (remesher.H, conservativeMapping.H).

Usage
    \b morphRemesh [OPTIONS]

    Options:
      - \par -time \<time\>
        The mesh and fields of this time, default the start time of controlDict.

      - \par -latestTime
        Those of the latest time.

      - \par -overwrite
        Write the mesh to where it was, and the fields to their time. Without,
        both are written to the next time (deltaT of controlDict).

      - \par -dict \<file\>
        The file with the dictionary \c remesh (remeshSettings.H), default
        system/remeshDict.

      - \par -dryRun
        Write nothing, print what would be made.

      - \par -region \<name\>
        The mesh region.

      - \par -version
        Print the version and stop.

    Where the new cells cannot keep to the limits, nothing is written and the
    exit status is 1.

    The mesh that is written is its own reference: points0 is replaced by its
    points, and fields pointDisplacement and cellDisplacement are zero.

\*---------------------------------------------------------------------------*/

#include "allFields.H"
#include "argList.H"
#include "caseSelection.H"
#include "clockTime.H"
#include "conservativeMapping.H"
#include "dictionaryChecks.H"
#include "fvMesh.H"
#include "guardedRun.H"
#include "IOdictionary.H"
#include "meshFiles.H"
#include "meshQuality.H"
#include "morphVersion.H"
#include "plainText.H"
#include "pointFields.H"
#include "referencePoints.H"
#include "remesher.H"
#include "remeshSizes.H"
#include "Time.H"
#include "untrapped.H"
#include "volFields.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

static void addOptions()
{
    argList::addNote
    (
        "Replace bad cells of a mesh by tetrahedra and map the fields to it"
    );
    argList::addOption("time", "time", "The mesh and fields of this time");
    argList::addBoolOption("latestTime", "Those of the latest time");
    argList::addBoolOption("overwrite", "Write to where the mesh was");
    argList::addOption
    (
        "dict", "file", "Read the dictionary remesh from this file"
    );
    argList::addBoolOption("dryRun", "Write nothing");
    #include "addRegionOption.H"
}


//- The settings of the dictionary
static remeshSettings readSettings(const argList& args, const fvMesh& mesh)
{
    const untrapped numbers;
    fileName path(mesh.time().system()/"remeshDict");
    args.readIfPresent("dict", path);
    const IOobject io
    (
        fileName(path).expand(),
        mesh.time(),
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );
    if (!IOobject(io).typeHeaderOk<IOdictionary>(true))
    {
        FatalErrorInFunction
            << "There is no dictionary " << path << ", or it has no FoamFile"
            << " header" << nl
            << "    Write one with the dictionary remesh, for example"
            << " remesh { engine madlib; region cavity; layers 4; }" << nl
            << exit(FatalError);
    }
    IOdictionary dict(io);
    dictionaryChecks::restoreNames(dict, dict.objectPath());
    dictionaryChecks::checkNumbers(dict);
    if (!dict.isDict("remesh"))
    {
        FatalIOErrorInFunction(dict)
            << "There is no dictionary 'remesh'" << nl
            << "    Add one, for example"
            << " remesh { engine madlib; region cavity; layers 4; }" << nl
            << exit(FatalIOError);
    }
    return remeshSettings::read(dict.subDict("remesh"));
}


//- The mesh is its own reference from now on
static void resetReference(fvMesh& mesh)
{
    const word points("pointDisplacement");
    const word cells("cellDisplacement");
    if (mesh.foundObject<pointVectorField>(points))
    {
        mesh.lookupObjectRef<pointVectorField>(points)
            .primitiveFieldRef() = Zero;
    }
    if (mesh.foundObject<volVectorField>(cells))
    {
        mesh.lookupObjectRef<volVectorField>(cells)
            .primitiveFieldRef() = Zero;
    }
}


static void write
(
    fvMesh& mesh,
    const fileName& instance,
    const UPtrList<topoSet>& sets,
    const mapPolyMesh& changed,
    const bool hadPoints0
)
{
    // Points as they are, to the bit
    const unsigned digits = IOstream::defaultPrecision();
    if (mesh.time().writeFormat() == IOstream::ASCII)
    {
        IOstream::defaultPrecision(17);
    }
    mesh.setInstance(instance);
    if (!mesh.write())
    {
        FatalErrorInFunction
            << "The mesh cannot be written to " << instance << nl
            << "    Is the disk full, or the folder write-protected?" << nl
            << exit(FatalError);
    }
    if (hadPoints0)
    {
        pointIOField
        (
            IOobject
            (
                "points0",
                instance,
                polyMesh::meshSubDir,
                mesh,
                IOobject::NO_READ,
                IOobject::NO_WRITE,
                false
            ),
            mesh.points()
        ).write();
    }
    allFields::writeSets(mesh, sets, changed);
    IOstream::defaultPrecision(digits);
}


//- False where the limits cannot be kept
static bool remesh(const argList& args)
{
    #include "createTime.H"
    word regionName(polyMesh::defaultRegion);
    args.readIfPresent("region", regionName);
    const clockTime clock;

    if (args.found("latestTime"))
    {
        const instantList times(runTime.times());
        runTime.setTime(times.last(), times.size() - 1);
    }
    caseSelection::selectTime(args, runTime);
    caseSelection::checkRegion(runTime, regionName);
    Info<< "Re-meshing mesh " << regionName << " at time "
        << runTime.timeName() << nl << endl;
    autoPtr<fvMesh> meshPtr(meshFiles::read(runTime, regionName));
    fvMesh& mesh = meshPtr();
    const remeshSettings settings(readSettings(args, mesh));
    remesher remeshing(mesh, settings);

    const wordList names(allFields::read(mesh));
    const PtrList<topoSet> sets(allFields::readSets(mesh));
    const scalarField sizes(remeshSizes::of(mesh).primitiveField());
    const fileName instance(mesh.facesInstance());
    const bool hadPoints0 = referencePoints::find(mesh).found;
    const scalar readTime = clock.timeIncrement();

    const meshQuality before(mesh, mesh.points());
    const scalar volume = gSum(mesh.V());
    const bool any = remeshing.prepare(sizes);
    Info<< "remesh: " << remeshing.nBad() << " cells exceed the limits, "
        << remeshing.nBadKept() << " of them are kept" << endl;
    if (!any)
    {
        Info<< "There is nothing to replace, nothing is written" << nl << nl
            << "End" << nl << endl;
        return true;
    }
    if (!remeshing.withinLimits())
    {
        const cavityFaces::figures& found = remeshing.found();
        FatalIOErrorInFunction(settings.dict)
            << "New cells exceed the limits in all of " << settings.passes
            << " passes; the best has non-orthogonality "
            << found.nonOrthogonality << " (limit "
            << settings.nonOrthogonality << "), skewness " << found.skewness
            << " (limit " << settings.skewness << "); nothing is written" << nl
            << "    Raise the limits, keep fewer layers (keepLayers), or change"
            << " sizeFactor" << nl
            << exit(FatalIOError);
    }
    const scalar makeTime = clock.timeIncrement();

    conservativeMapping mapping(mesh, remeshing.map());
    const autoPtr<mapPolyMesh> changed(remeshing.change());
    mapping.map();
    const scalar changeTime = clock.timeIncrement();
    const meshQuality after(mesh, mesh.points());
    const scalar newVolume = gSum(mesh.V());

    Info<< nl;
    meshQuality::writeHeader(Info);
    before.writeRow(Info, "before");
    after.writeRow(Info, "after");
    Info<< nl << "Volume " << volume << ", relative change "
        << (newVolume - volume)/volume << nl
        << "Fields " << names << endl;
    if (args.found("dryRun"))
    {
        Info<< nl << "Dry run, nothing is written." << endl;
    }
    else
    {
        resetReference(mesh);
        if (!args.found("overwrite"))
        {
            ++runTime;
        }
        write
        (
            mesh,
            args.found("overwrite") ? instance : fileName(runTime.timeName()),
            sets,
            changed(),
            hadPoints0
        );
    }

    using plainText::rounded;
    Info<< nl << "Wall time [s]: reading " << rounded(readTime).c_str()
        << ", new cells " << rounded(makeTime).c_str()
        << ", mapping " << rounded(changeTime).c_str()
        << ", check and write " << rounded(clock.timeIncrement()).c_str()
        << nl << nl << "End" << nl << endl;
    return true;
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
    guardedRun::run("morphRemesh", [&]() { return remesh(args); });
    return 0;
}


// ************************************************************************* //
