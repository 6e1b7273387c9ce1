/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionSolver.H"
#include "addToRunTimeSelectionTable.H"
#include "cpuTime.H"
#include "controlPointShape.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "morphVersion.H"
#include "motionRecord.H"
#include "pointDisplacementField.H"
#include "referencePoints.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(rbfMotionSolver, 0);

    addToRunTimeSelectionTable
    (
        motionSolver,
        rbfMotionSolver,
        dictionary
    );

    addToRunTimeSelectionTable
    (
        displacementMotionSolver,
        rbfMotionSolver,
        displacement
    );
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- From which mesh a time step starts
enum class referenceMesh
{
    fixed,
    moving
};

// Most steps that 'subSteps auto' takes
static const label maxSubSteps = 32;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfMotionSolver::rbfMotionSolver
(
    const polyMesh& mesh,
    const IOdictionary& dict
)
:
    displacementMotionSolver
    (
        mesh,
        dict,
        pointDisplacementField::atRest(mesh),
        referencePoints::read(mesh, &points0IO)(),
        typeName
    ),
    settings_(rbfMotionSettings::read(checkedCoeffDict())),
    report_(mesh, settings_),
    state_(mesh),
    moving_(readMoving()),
    formerIndex_(-1),
    nSteps_(1),
    fraction_(1),
    wasOptimised_(false),
    toldOfSteps_(false)
{
    pointDisplacementField::registerAndRead(pointDisplacement_);
    initialise();
}


Foam::rbfMotionSolver::rbfMotionSolver
(
    const polyMesh& mesh,
    const IOdictionary& dict,
    const pointVectorField& pointDisplacement,
    const pointIOField& points0
)
:
    displacementMotionSolver(mesh, dict, pointDisplacement, points0, typeName),
    settings_(rbfMotionSettings::read(checkedCoeffDict())),
    report_(mesh, settings_),
    state_(mesh),
    moving_(readMoving()),
    formerIndex_(-1),
    nSteps_(1),
    fraction_(1),
    wasOptimised_(false),
    toldOfSteps_(false)
{
    foamCompat::registerObject(pointDisplacement_);
    initialise();
}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::rbfMotionSolver::~rbfMotionSolver()
{
    summary_.write
    (
        Info,
        mesh().name() == polyMesh::defaultRegion
      ? word(type())
      : word(type() + '(' + mesh().name() + ')', false)
    );
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

const Foam::dictionary& Foam::rbfMotionSolver::checkedCoeffDict() const
{
    dictionaryChecks::restoreNames(coeffDict(), objectPath());

    // Without a dictionary of coefficients this is dynamicMeshDict itself,
    // with keys of others
    rbfMotionSettings::check(coeffDict(), !found(typeName + "Coeffs"));
    return coeffDict();
}


void Foam::rbfMotionSolver::initialise()
{
    morphVersion::announce();
    cellDisplacement_ =
        cellDisplacementField::New(mesh(), points0(), pointDisplacement_);
    makeGroups();
    if (deforms())
    {
        state_.require(coeffDict());
    }
}


void Foam::rbfMotionSolver::makeGroups()
{
    groups_.clear();
    rigid_ = rigidMotion::New(*this, coeffDict(), mesh());
    const bool whole = !rigid_.valid() || rigid_->byZones();
    zone_.reset
    (
        new motionZone(*this, whole ? coeffDict() : rigid_->zoned(), mesh())
    );
    groups_.reset
    (
        new controlPointGroups
        (
            mesh(),
            *this,
            coeffDict(),
            typeName,
            pointDisplacement_,
            rigid_.valid() ? &rigid_() : nullptr
        )
    );
    if (rigid_.valid())
    {
        rigid_->report();
    }
}


bool Foam::rbfMotionSolver::deforms() const
{
    return !rigid_.valid() || (!rigid_->alone() && groups_->mayMove());
}


void Foam::rbfMotionSolver::prepare()
{
    const bool first = !problem_.valid();
    if (first)
    {
        problem_.reset
        (
            new rbfMotionProblem
            (
                mesh(), coeffDict(), points0(), groups_(), settings_, zone_(),
                state_.supportRadius()
            )
        );
        oneStep_.reset(new oneStepMotion(problem_(), state_));
    }

    if (cellDisplacement_.valid())
    {
        cellDisplacement_->hear();
    }
    groups_->update();
    if (groups_->fromField())
    {
        pointDisplacement_.boundaryFieldRef().updateCoeffs();
        pointDisplacement_.correctBoundaryConditions();
    }

    // After a write this run goes on as one that restarts from it does
    const bool rebuild = state_.wasWritten() || first;
    const rbfMotionProblem::change changed = problem_->update(first, rebuild);
    state_.setSupportRadius(problem_->radius());
    if (rebuild || changed.directions || changed.radius)
    {
        oneStep_->rebuild(changed.radius);
    }
}


bool Foam::rbfMotionSolver::readMoving() const
{
    const Enum<referenceMesh> names
    ({
        { referenceMesh::fixed, "fixed" },
        { referenceMesh::moving, "moving" }
    });
    const bool moving =
        dictionaryChecks::getChoice
        (
            coeffDict(), "reference", names, referenceMesh::fixed
        )
     == referenceMesh::moving;
    if (moving && coeffDict().found("subSteps"))
    {
        FatalIOErrorInFunction(coeffDict())
            << "Entry 'subSteps' starts from the reference mesh at each time,"
            << " which 'reference moving' does not" << nl
            << "    Remove subSteps; where a step is too large, make the time"
            << " step smaller" << nl << exit(FatalIOError);
    }
    return moving;
}


bool Foam::rbfMotionSolver::active()
{
    if (!moving_)
    {
        return oneStep_->active();
    }
    bool offMesh = false;
    for (label i = 0; i < problem_->controlPoints().nRegions(); ++i)
    {
        offMesh =
            offMesh
         || problem_->controlPoints().candidates(i).meshPoints.found(-1);
    }
    dictionaryChecks::stopIf
    (
        coeffDict(),
        offMesh
      ? "Entry 'reference' is moving, but there are control points off the"
        " mesh, which a restart would not find\n"
        "    Use 'reference fixed', or points of the mesh"
      : ""
    );

    // Outer correctors of a time step all start from the same mesh
    if (formerIndex_ != mesh().time().timeIndex())
    {
        formerIndex_ = mesh().time().timeIndex();
        const planarReduction& plane = problem_->reduced().plane();
        former_.setSize(points0().size());
        forAll(former_, pointi)
        {
            former_[pointi] =
                plane.position(mesh().points()[pointi])
              - plane.position(points0()[pointi]);
        }
    }
    return oneStep_->active() || gMax(mag(former_)) > 0;
}


Foam::rbfMotion Foam::rbfMotionSolver::move()
{
    if (moving_)
    {
        return subSteppedMotion(problem_()).moveOn
        (
            former_, settings_.onInvalidMesh != motionLimiter::policy::ignore
        );
    }
    const label n = settings_.subSteps;
    const bool check =
        settings_.onInvalidMesh != motionLimiter::policy::ignore;
    const subSteppedMotion several(problem_());
    if (n > 1)
    {
        return several.move(n, check);
    }

    // Where one step is valid this costs nothing: that is checked in any case
    const bool automatic = n == 0;
    const rbfMotion one(oneStep_->move(check || automatic));
    if (!automatic || one.complete())
    {
        return one;
    }
    rbfMotion motion(one);
    for
    (
        label more = 2;
        !motion.complete() && more <= maxSubSteps;
        more *= 2
    )
    {
        const motionTimes former(motion.times);
        motion = several.move(more, check || more < maxSubSteps);
        motion.times += former;
    }
    if (!motion.complete() && !settings_.subStepsGiven)
    {
        // How far it goes is said of what was asked for: one step
        return one;
    }
    if (!settings_.subStepsGiven && !toldOfSteps_)
    {
        toldOfSteps_ = true;
        Info<< "rbfMotionSolver: one step would make the mesh invalid: the"
            << " motion is made in sub-steps. 'subSteps 1' makes that an error"
            << endl;
    }
    return motion;
}


void Foam::rbfMotionSolver::optimise(rbfMotion& motion)
{
    if (settings_.optimise.never())
    {
        return;
    }
    if (!optimised_.valid())
    {
        optimised_.reset(new optimisedMotion(problem_(), points0()));
    }
    if (motion.complete())
    {
        optimised_->improve(motion);
    }
    else if (motion.nSteps == 1)
    {
        optimised_->untangle
        (
            motion, vectorField(motion.inPlane + motion.increment)
        );
    }
    else
    {
        const rbfMotion whole
        (
            subSteppedMotion(problem_()).move(motion.nSteps, false)
        );
        optimised_->untangle(motion, whole.inPlane);
    }
}


void Foam::rbfMotionSolver::limit(rbfMotion& motion)
{
    if (motion.complete())
    {
        return;
    }
    const motionLimiter limiter(mesh(), coeffDict(), settings_.onInvalidMesh);
    const scalar n = motion.nSteps;
    const motionLimiter::limit found = limiter.limitPart
    (
        points0() + motion.displacement,
        problem_->expand(motion.increment)(),
        {motion.nMade/n, (motion.nMade + 1)/n, motion.nSteps},
        moving_
      ? string
        (
            "Make the time step smaller, or add 'optimise {}', which untangles"
            " the mesh"
        )
      : problem_->remedy()
    );
    if (moving_)
    {
        motion.fraction = found.fraction;
        motion.inPlane += found.fraction*motion.increment;
        motion.displacement = problem_->expand(motion.inPlane);
    }
    else if (motion.nSteps == 1)
    {
        oneStep_->makePart(motion, found.fraction);
    }
    else
    {
        subSteppedMotion(problem_()).makePart(motion, found.fraction);
    }
    limiter.note(found, motion.fraction);
}


void Foam::rbfMotionSolver::checkDifferentiable() const
{
    if (!problem_.valid())
    {
        FatalErrorInFunction
            << "Derivatives of a motion are asked for before the motion" << nl
            << exit(FatalError);
    }
    if (nSteps_ > 1)
    {
        FatalIOErrorInFunction(coeffDict())
            << "The motion was made in " << nSteps_ << " steps: dx/dmu is that"
            << " of motions in one step" << nl
            << "    Use 'subSteps 1', with a larger 'supportRadius' where the"
            << " mesh is invalid then" << nl << exit(FatalIOError);
    }
    if (moving_)
    {
        FatalIOErrorInFunction(coeffDict())
            << "With 'reference moving' a mesh depends on all steps before: there"
            << " is no dx/dmu of one" << nl
            << "    Use 'reference fixed'" << nl << exit(FatalIOError);
    }
    if (wasOptimised_)
    {
        FatalIOErrorInFunction(coeffDict())
            << "The mesh was optimised after the motion: dx/dmu is that of the"
            << " motion alone" << nl
            << "    Remove 'optimise', or ask for derivatives of a smaller"
            << " motion, which needs none" << nl << exit(FatalIOError);
    }
    if (fraction_ < 1)
    {
        FatalIOErrorInFunction(coeffDict())
            << "The motion was limited to " << fraction_ << " of what is"
            << " prescribed ('onInvalidMesh limit'), which depends on no"
            << " parameter smoothly" << nl
            << "    " << problem_->remedy().c_str() << nl
            << exit(FatalIOError);
    }
}


void Foam::rbfMotionSolver::report(const rbfMotion& motion)
{
    motionRecord* record = motionRecord::of(mesh());
    if (record && motion.nSteps > 1)
    {
        record->set("subSteps", motion.nSteps);
    }
    report_.steps(motion);
    summary_.add(motion);
    if (debug)
    {
        report_.debugInfo(motion);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::rbfMotionSolver::curPoints() const
{
    const vectorField& displacement = pointDisplacement_.primitiveField();
    if (!rigid_.valid())
    {
        return zone_->moved(points0(), displacement, mesh().points());
    }
    if (!deforms())
    {
        return rigid_->moved(points0(), mesh().points());
    }
    const bool whole = zone_->wholeMesh();
    tmp<pointField> rigid
    (
        rigid_->moved(points0(), whole ? points0() : mesh().points())
    );
    return zone_->moved(rigid(), displacement, mesh().points());
}


void Foam::rbfMotionSolver::solve()
try
{
    if (!deforms())
    {
        return;
    }
    motionTimes times;
    const bool first = !problem_.valid();
    sensitivities_.clear();
    nSteps_ = 1;
    fraction_ = 1;
    wasOptimised_ = false;
    prepare();
    times.lap(motionTimes::conditions);

    const bool moves = active();
    if (moves)
    {
        rbfMotion motion(move());
        report_.write(problem_(), motion);
        const vectorField told(motion.displacement);
        optimise(motion);
        wasOptimised_ =
            returnReduce(motion.displacement != told, orOp<bool>());
        limit(motion);
        motion.times += times;
        report(motion);
        pointDisplacement_.primitiveFieldRef() = motion.displacement;
        selections_ = motion.selections;
        nSteps_ = motion.nSteps;
        fraction_ = motion.fraction;
    }
    else
    {
        pointDisplacement_.primitiveFieldRef() = Zero;
        summary_.add(times);
    }
    if (first)
    {
        groups_->report(moves);
    }
    if (cellDisplacement_.valid())
    {
        cellDisplacement_->tell();
    }
    if (debug)
    {
        summary_.writeStep(Info, type());
    }
}
catch (const Foam::error&)
{
    throw;
}
catch (const std::exception& wrong)
{
    FatalIOErrorInFunction(coeffDict())
        << wrong.what() << nl << exit(FatalIOError);
}


Foam::List<Foam::controlShape> Foam::rbfMotionSolver::shapes() const
{
    return List<controlShape>
    (
        1,
        problem_.valid()
      ? controlPointShape
        (
            problem_(), selections_, pointDisplacement_.primitiveField()
        )
      : controlPointShape()
    );
}


Foam::List<Foam::motionParameter> Foam::rbfMotionSolver::parameters() const
{
    List<DynamicList<labelPair>> sources;
    return rbfSensitivities::parameters(groups_(), sources);
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionSolver::sensitivity
(
    const label parameteri
)
try
{
    if (!sensitivities_.valid())
    {
        checkDifferentiable();
        sensitivities_.reset
        (
            new rbfSensitivities
            (
                coeffDict(), problem_(), groups_(), oneStep_(),
                pointDisplacement_.primitiveField()
            )
        );
    }
    const cpuTime clock;
    tmp<vectorField> derivative(sensitivities_()(parameteri));
    if (debug)
    {
        Info<< type() << ": dx/dmu of parameter " << parameteri << ": "
            << clock.elapsedCpuTime() << " s of CPU time" << endl;
    }
    return derivative;
}
catch (const Foam::error&)
{
    throw;
}
catch (const std::exception& wrong)
{
    FatalIOErrorInFunction(coeffDict())
        << wrong.what() << nl << exit(FatalIOError);
    return nullptr;
}


void Foam::rbfMotionSolver::updateMesh(const mapPolyMesh& map)
{
    displacementMotionSolver::updateMesh(map);

    selections_.clear();
    formerIndex_ = -1;
    state_.clearPositions();
    optimised_.clear();
    sensitivities_.clear();
    oneStep_.clear();
    problem_.clear();
    report_.clear();
    if (cellDisplacement_.valid())
    {
        cellDisplacement_->forget();
    }
    makeGroups();
}


// ************************************************************************* //
