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
    state_(mesh)
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
    state_(mesh)
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
    if (!maker_.valid())
    {
        maker_.reset
        (
            new motionMaker
            (
                mesh(), coeffDict(), points0(), groups_(), settings_, zone_(),
                state_
            )
        );
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

    maker_->update();
}

void Foam::rbfMotionSolver::deform()
{
    motionTimes times;
    const bool first = !maker_.valid();
    sensitivities_.clear();
    last_ = rbfSensitivities::motion();
    prepare();
    times.lap(motionTimes::conditions);

    const bool moves = maker_->active();
    if (moves)
    {
        rbfMotion motion(maker_->move());
        report_.write(maker_->problem(), motion);
        const bool optimised = maker_->optimise(motion);
        maker_->limit(motion);
        motion.times += times;
        report(motion);
        pointDisplacement_.primitiveFieldRef().transfer(motion.displacement);
        selections_ = motion.selections;
        last_ = {motion.nSteps, motion.fraction, optimised};
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
        cellDisplacement_->tell
        (
            maker_->part(pointDisplacement_.primitiveField())
        );
    }
    if (debug)
    {
        summary_.writeStep(Info, type());
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
        const bool all = rigid_->wholeMesh();
        return rigid_->moved(points0(), all ? points0() : mesh().points());
    }
    const bool whole = zone_->wholeMesh();
    tmp<pointField> rigid
    (
        rigid_->moved(points0(), whole ? points0() : mesh().points())
    );
    return zone_->moved(rigid(), displacement, mesh().points());
}


void Foam::rbfMotionSolver::solve()
{
    if (deforms())
    {
        dictionaryChecks::explaining(coeffDict(), [this]{ deform(); });
    }
}


Foam::List<Foam::controlShape> Foam::rbfMotionSolver::shapes() const
{
    return List<controlShape>
    (
        1,
        maker_.valid()
      ? controlPointShape
        (
            maker_->problem(), selections_, pointDisplacement_.primitiveField()
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
{
    if (!maker_.valid())
    {
        FatalErrorInFunction
            << "Derivatives of a motion are asked for before the motion" << nl
            << exit(FatalError);
    }
    const cpuTime clock;
    tmp<vectorField> derivative;
    dictionaryChecks::explaining(coeffDict(), [&]
    {
        if (!sensitivities_.valid())
        {
            sensitivities_.reset
            (
                new rbfSensitivities
                (
                    groups_(), maker_->oneStep(), last_,
                    pointDisplacement_.primitiveField()
                )
            );
        }
        derivative = sensitivities_()(parameteri);
    });
    if (debug)
    {
        Info<< type() << ": dx/dmu of parameter " << parameteri << ": "
            << clock.elapsedCpuTime() << " s of CPU time" << endl;
    }
    return derivative;
}


void Foam::rbfMotionSolver::updateMesh(const mapPolyMesh& map)
{
    displacementMotionSolver::updateMesh(map);

    selections_.clear();
    state_.clearPositions();
    sensitivities_.clear();
    maker_.clear();
    report_.clear();
    if (cellDisplacement_.valid())
    {
        cellDisplacement_->forget();
    }
    makeGroups();
}


// ************************************************************************* //
