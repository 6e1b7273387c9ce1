/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphRemeshFvMesh.H"
#include "addToRunTimeSelectionTable.H"
#include "conservativeMapping.H"
#include "cpuTime.H"
#include "dictionaryChecks.H"
#include "mapPolyMesh.H"
#include "motionOrigin.H"
#include "remesher.H"
#include "remeshSizes.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(morphRemeshFvMesh, 0);

    addToRunTimeSelectionTable
    (
        dynamicFvMesh,
        morphRemeshFvMesh,
        IOobject
    );
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static IOobject dictionaryIO(const fvMesh& mesh)
{
    return IOobject
    (
        "dynamicMeshDict",
        mesh.time().constant(),
        mesh,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::morphRemeshFvMesh::morphRemeshFvMesh(const IOobject& io)
:
    dynamicFvMesh(io),
    settings_(readSettings()),
    motionPtr_(newMotionSolver()),
    state_
    (
        IOobject
        (
            "morphRemeshFvMeshProperties",
            time().timeName(),
            "uniform",
            *this,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        )
    ),
    updated_(-1),
    cpuTime_(0)
{
    checkSchemes();
    remeshSizes::of(*this);
}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::morphRemeshFvMesh::~morphRemeshFvMesh()
{
    Info<< type() << ": " << nRemeshes() << " re-meshings, " << cpuTime_
        << " s of " << time().elapsedCpuTime() << " s of CPU time" << endl;
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::remeshSettings Foam::morphRemeshFvMesh::readSettings() const
{
    const IOdictionary dict(dictionaryIO(*this));
    return remeshSettings::read
    (
        dict.isDict("remesh") ? dict.subDict("remesh") : dictionary()
    );
}


Foam::autoPtr<Foam::motionSolver> Foam::morphRemeshFvMesh::newMotionSolver()
{
    IOdictionary dict(dictionaryIO(*this));
    const word solver(dict.get<word>("motionSolver"));
    if (solver != "rbfMotionSolver")
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'motionSolver' is " << solver << ", but "
            << typeName << " goes on from a mesh that was re-meshed with"
            << " rbfMotionSolver alone" << nl
            << "    Use 'motionSolver rbfMotionSolver'" << nl
            << exit(FatalIOError);
    }

    // What an invalid mesh leads to is decided here
    const word coeffs(solver + "Coeffs");
    dictionary& decided = dict.isDict(coeffs) ? dict.subDict(coeffs) : dict;
    decided.set("onInvalidMesh", "ignore");
    return motionSolver::New(*this, dict);
}


Foam::points0MotionSolver& Foam::morphRemeshFvMesh::motion()
{
    return refCast<points0MotionSolver>(motionPtr_());
}


void Foam::morphRemeshFvMesh::checkSchemes() const
{
    const dictionary schemes(schemesDict().subOrEmptyDict("ddtSchemes"));
    const wordHashSet oneLevel
    (
        {"Euler", "localEuler", "steadyState", "none"}
    );
    for (const entry& e : schemes)
    {
        if (!e.isStream())
        {
            continue;
        }
        for (const token& t : e.stream())
        {
            if (t.isWord() && t.wordToken() != "bounded"
             && !oneLevel.found(t.wordToken()))
            {
                FatalIOErrorInFunction(schemesDict().subDict("ddtSchemes"))
                    << "Entry '" << e.keyword() << "' is " << t.wordToken()
                    << ", which needs more than the last time level: after a"
                    << " re-meshing there is no other" << nl
                    << "    Use Euler" << nl
                    << exit(FatalIOError);
            }
        }
    }
}


void Foam::morphRemeshFvMesh::checkCorrection() const
{
    for (const char* name : {"PIMPLE", "PISO"})
    {
        const dictionary controls(solutionDict().subOrEmptyDict(name));
        if (!controls.getOrDefault<bool>("correctPhi", true))
        {
            FatalIOErrorInFunction(solutionDict().subDict(name))
                << "Entry 'correctPhi' is off, but after a re-meshing fluxes"
                << " have to be corrected" << nl
                << "    Remove it" << nl
                << exit(FatalIOError);
        }
    }
}


Foam::word Foam::morphRemeshFvMesh::writeLastValid()
{
    Time& runTime = const_cast<Time&>(time());
    runTime.setTime
    (
        runTime.value() - runTime.deltaTValue(), runTime.timeIndex() - 1
    );
    runTime.writeNow();
    return runTime.timeName();
}


Foam::scalar Foam::morphRemeshFvMesh::excess
(
    const scalar nonOrthogonality,
    const scalar skewness
) const
{
    return max
    (
        nonOrthogonality/settings_.nonOrthogonality,
        skewness/settings_.skewness
    );
}


bool Foam::morphRemeshFvMesh::remesh(const predictedMesh& predicted)
{
    const scalar start = time().elapsedCpuTime();
    Info<< "Re-meshing, as the mesh would be " << predicted << endl;
    checkCorrection();
    if (nRemeshes() >= settings_.maxRemeshes)
    {
        const word written(writeLastValid());
        FatalIOErrorInFunction(settings_.dict)
            << "The mesh has been re-meshed " << nRemeshes() << " times, which"
            << " is all that 'maxRemeshes' allows" << nl
            << "    The last valid mesh and its fields have been written to "
            << written << ". Allow more, make keepLayers less, or limits wider"
            << nl << exit(FatalIOError);
    }
    motionOrigin::start(*this, motion().points0());

    const label nBefore = nCells();
    remesher change(*this, settings_);
    if (!change.prepare(remeshSizes::of(*this).primitiveField(), predicted.bad()))
    {
        const word written(writeLastValid());
        FatalIOErrorInFunction(settings_.dict)
            << "Nothing can be re-meshed: the cells that stand in the way are"
            << " all kept" << nl
            << "    The last valid mesh and its fields have been written to "
            << written << ". Make keepLayers less, or the time step smaller"
            << nl << exit(FatalIOError);
    }
    state_.set("lastStep", time().timeIndex());
    const cavityFaces::figures& made = change.found();
    const scalar ofNew = excess(made.nonOrthogonality, made.skewness);
    const scalar ofOld =
        excess(predicted.nonOrthogonality(), predicted.skewness());
    if (predicted.valid() && ofNew > 1 && ofNew >= ofOld)
    {
        state_.set("inVain", ofOld);
        Info<< "    New cells would be no better: the old ones stay" << endl;
        cpuTime_ += time().elapsedCpuTime() - start;
        return false;
    }

    conservativeMapping mapping(*this, change.map());
    const autoPtr<mapPolyMesh> changed(change.change());
    mapping.map();

    // The step begins with the new mesh
    setV0() = V();
    motion().updateMesh(changed());
    motion().points0() = points();

    state_.set("remeshings", nRemeshes() + 1);
    state_.remove("inVain");
    const scalar seconds = time().elapsedCpuTime() - start;
    cpuTime_ += seconds;
    Info<< "    Re-meshing " << nRemeshes() << ": " << nBefore << " cells, then "
        << nCells() << "; volumes agree to " << mapping.mismatch() << "; "
        << seconds << " s" << endl;
    return true;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::morphRemeshFvMesh::update()
{
    const bool first = updated_ != time().timeIndex();
    updated_ = time().timeIndex();

    bool changed = false;
    pointField next(motionPtr_->newPoints());
    predictedMesh predicted(*this, next, settings_);

    // A mesh that was just made, and does not keep to the limits, is not made
    // better by doing it again at once, nor one of which new cells were no
    // better until it is worse than it was then
    const bool wait =
        state_.getOrDefault<label>("lastStep", -1) == updated_ - 1
     || excess(predicted.nonOrthogonality(), predicted.skewness())
      < 1.03*state_.getOrDefault<scalar>("inVain", 0);
    if (first && (wait ? !predicted.valid() : !predicted.good()))
    {
        changed = remesh(predicted);
    }
    if (changed)
    {
        next = motionPtr_->newPoints();
        predicted = predictedMesh(*this, next, settings_);
        if (predicted.valid() && !predicted.good())
        {
            OStringStream figures;
            figures << predicted;
            WarningInFunction
                << "The new mesh does not keep to the limits once it has moved:"
                << " " << figures.str().c_str() << nl
                << "    Make the time step or keepLayers smaller, or limits"
                << " wider" << endl;
        }
    }
    if (!predicted.valid())
    {
        const word written(writeLastValid());
        FatalIOErrorInFunction(settings_.dict)
            << "The motion of one time step makes the mesh invalid"
            << (changed ? ", which was just made" : "") << nl
            << "    The last valid mesh and its fields have been written to "
            << written << ". Make the time step smaller, or keepLayers less"
            << nl << exit(FatalIOError);
    }

    movePoints(next);
    topoChanging(changed);

    if (volVectorField* U = getObjectPtr<volVectorField>("U"))
    {
        U->correctBoundaryConditions();
    }
    return true;
}


// ************************************************************************* //
