/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshInput.H"
#include "dictionaryChecks.H"
#include "fvMesh.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

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
