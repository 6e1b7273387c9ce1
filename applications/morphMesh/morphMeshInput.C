/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshInput.H"
#include "argList.H"
#include "dictionaryChecks.H"
#include "faceIOList.H"
#include "finiteNumbers.H"
#include "fvMesh.H"
#include "plainText.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

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


//- The dictionary as it is, not yet that of a motion solver
static IOdictionary readDynamicMeshDict(const fvMesh& mesh)
{
    const untrapped numbers;
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
            << ", or it has no FoamFile header. It names the motion solver"
            << " that morphMesh applies: write it, with the header and the"
            << " entries motionSolver and, for solvers of a library,"
            << " motionSolverLibs" << exit(FatalError);
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

} // End namespace Foam


// * * * * * * * * * * * * * * * * Functions  * * * * * * * * * * * * * * * //

void Foam::morphMeshInput::selectTime(const argList& args, Time& runTime)
{
    word name;
    if (!args.readIfPresent("time", name))
    {
        return;
    }

    const untrapped numbers;
    scalar value;
    if (!readScalar(name, value) || !finiteNumbers::usable(value))
    {
        FatalErrorInFunction
            << "The option -time is '" << name << "', which is not a number."
            << " The times of this case are "
            << plainText::listed(timeNames(runTime)).c_str()
            << "; give one time, for example"
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
    Info<< "Time " << runTime.timeName() << " has no folder; those of the case"
        << " are " << plainText::listed(timeNames(runTime)).c_str() << '.' << nl
        << "The mesh is that of the preceding time. A motion solver that reads"
        << " a field at this time will stop." << nl << endl;
}


void Foam::morphMeshInput::checkRegion(const Time& runTime, const word& regionName)
{
    // Looking for a file reads its head, where any number may be
    const untrapped numbers;
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
            << ": no file faces that can be read, nothing to move. Make the"
            << " mesh, or give the region (-region), the case (-case) or, for a decomposed case,"
            << " -parallel" << exit(FatalError);
    }
}


void Foam::morphMeshInput::readSolvers(const fvMesh& mesh, PtrList<motionSolver>& solvers)
{
    const IOdictionary dict(readDynamicMeshDict(mesh));
    dictionaryChecks::restoreNames(dict, dict.objectPath());
    dictionaryChecks::checkNumbers(dict);
    dictionaryChecks::checkValues(dict, {"motionSolver", "motionSolverLibs"});

    // Solvers read the dictionary again, its header as well
    const untrapped numbers;

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


// ************************************************************************* //
