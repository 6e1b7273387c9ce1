/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionSolver.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "invalidMotion.H"
#include "morphVersion.H"
#include "motionRecord.H"
#include "pointDisplacementField.H"
#include "pstreamCommunicator.H"
#include "StringStream.H"
#include "subSteppedMotion.H"

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

// Largest radius of the surface correction, in support radii: about the
// distance of selected points, over which what they leave varies
static const scalar correctionReach = 0.1;

// How often directions are renewed, which is one selection each, for points
// that go far around their surface: each brings some 60 degrees
static const label mostTurns = 3;

// Directions of conditions are renewed where the cosine of the angle to those
// of the surface is smaller. Before the selection that costs little, and where
// they have turned by more than 18 degrees fewer points do; after it, it is
// another selection, for the iteration, which converges like the tangent
static const scalar renewedCosine = 0.95;
static const scalar turnedCosine = 0.8;

// Of where points that slide go roughly, in largest displacements
static const scalar roughTolerance = 1e-2;

// Least factor by which a support radius that follows the motion grows
static const scalar radiusGrowth = 1.5;

// Most steps that 'subSteps auto' takes
static const label maxSubSteps = 32;


static void noteMoved(const polyMesh& mesh, const scalar fraction)
{
    motionRecord* record = motionRecord::of(mesh);
    if (record)
    {
        record->set("moved", fraction);
    }
}

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
        pointVectorField
        (
            pointDisplacementField::io(mesh),
            pointMesh::New(mesh),
            dimensionedVector(dimLength, Zero)
        ),
        pointIOField(points0IO(mesh)),
        typeName
    ),
    settings_(rbfMotionSettings::read(checkedCoeffDict())),
    report_(mesh, settings_),
    state_(mesh),
    supportRadius_
    (
        settings_.supportRadius > 0
      ? settings_.supportRadius
      : state_.supportRadius()
    )
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
    supportRadius_
    (
        settings_.supportRadius > 0
      ? settings_.supportRadius
      : state_.supportRadius()
    )
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
    // Without a dictionary of coefficients this is dynamicMeshDict itself,
    // with keys of others
    if (found(typeName + "Coeffs"))
    {
        dictionaryChecks::onlyKeys
        (
            coeffDict(),
            {
                "kernel", "polynomial", "supportRadius", "supportRadiusFactor",
                "controlPoints", "greedy", "selection", "images",
                "surfaceCorrection", "featureAngle", "exactSliding",
                "onInvalidMesh", "subSteps"
            }
        );
    }
    return coeffDict();
}


void Foam::rbfMotionSolver::initialise()
{
    morphVersion::announce();
    if (!moveAllCells())
    {
        FatalIOErrorInFunction(*this)
            << "Entries 'cellZone' and 'cellSet' have no meaning for "
            << typeName << ", which moves the whole mesh" << nl
            << "    Remove them; what should stay is a group of type fixed"
            << nl << exit(FatalIOError);
    }
    makeGroups();
}


void Foam::rbfMotionSolver::makeGroups()
{
    groups_.reset
    (
        new controlPointGroups(mesh(), coeffDict(), pointDisplacement_)
    );
}


void Foam::rbfMotionSolver::makeGeometry()
{
    plane_.reset(new planarReduction(mesh(), points0()));
    images_.reset
    (
        new motionImages
        (
            mesh(), coeffDict(), points0(), plane_(), groups_(), settings_.images
        )
    );
    controlPoints_.reset
    (
        new rbfControlPoints
        (
            mesh(),
            coeffDict(),
            points0(),
            groups_(),
            plane_(),
            images_(),
            settings_.featureAngle
        )
    );

    DynamicList<label> labels;
    DynamicList<point> positions;
    forAll(points0(), pointi)
    {
        if (plane_->representative()[pointi] == pointi)
        {
            labels.append(pointi);
            positions.append(plane_->position(points0()[pointi]));
        }
    }
    evaluated_.transfer(labels);
    span_ = boundBox(points0(), true).mag();
    cloud_.reset(new morph::PointCloud(asVectors(positions)));
    if (settings_.surfaceCorrection)
    {
        positions_.transfer(positions);
    }
}


Foam::scalar Foam::rbfMotionSolver::neededSupportRadius() const
{
    if (settings_.supportRadius > 0)
    {
        return settings_.supportRadius;
    }

    scalar largest = 0;
    boundBox moving;
    for (const morph::ControlPoint& p : controlPoints_->candidates())
    {
        const scalar displacement = p.g().norm();
        largest = max(largest, displacement);
        if (displacement > 0)
        {
            moving.add(toFoam(p.position));
        }
    }
    Foam::reduce(largest, maxOp<scalar>());
    moving.reduce();
    return max
    (
        settings_.supportRadiusFactor*largest,
        moving.valid() ? settings_.supportRadiusSpans*moving.mag() : 0
    );
}


bool Foam::rbfMotionSolver::moves() const
{
    if (selection_ || !restored_.empty())
    {
        return true;
    }

    // A body that is about to start moves by round-off, a pattern not worth
    // control points
    scalar largest = 0;
    for (const morph::ControlPoint& p : controlPoints_->candidates())
    {
        largest = max(largest, p.g().norm());
    }
    return returnReduce(largest, maxOp<scalar>()) > SMALL*span_;
}


bool Foam::rbfMotionSolver::updateSupportRadius()
{
    const scalar former = supportRadius_;
    const scalar needed = neededSupportRadius();
    if (needed > former)
    {
        // In steps, since every new radius is a new selection
        supportRadius_ = max(needed, radiusGrowth*former);
    }
    state_.setSupportRadius(supportRadius_);
    return supportRadius_ != former;
}


morph::GreedySelection::Renewal Foam::rbfMotionSolver::renewal()
{
    if (!controlPoints_->follow())
    {
        return morph::GreedySelection::Renewal();
    }
    return [this](const morph::Vectors& s, morph::ControlPoints& candidates)
    {
        controlPoints_->renew(s, candidates);
    };
}


void Foam::rbfMotionSolver::dropSelection
(
    const bool first,
    const bool newRadius
)
{
    // Directions that change from step to step are not known to a restart
    restored_.clear();
    if (!newRadius && !controlPoints_->surfacesMove())
    {
        if (first)
        {
            restored_ = state_.positionsAmong(controlPoints_->candidates());
        }
        else if (selection_)
        {
            restored_ = selection_->selectedPositions();
        }
    }
    selection_.reset();
}


void Foam::rbfMotionSolver::makeSelection(morph::Communicator& communicator)
{
    exactSurface_.reset
    (
        new morph::ExactSurface(correctionReach*supportRadius_)
    );
    selection_.reset
    (
        new morph::GreedySelection
        (
            morph::Kernel(settings_.kernel, supportRadius_),
            settings_.polynomial,
            settings_.selection,
            images_->inReach()
        )
    );
    if (!restored_.empty())
    {
        selection_->restore
        (
            restored_, controlPoints_->candidates(), communicator
        );
        restored_.clear();
    }
}


void Foam::rbfMotionSolver::alignDirections(morph::Communicator& communicator)
{
    if (!controlPoints_->follow())
    {
        return;
    }

    // Where points go roughly, in planes tangential to their surfaces
    morph::SelectionSettings rough;
    rough.tolerance = roughTolerance;
    morph::GreedySelection selection
    (
        morph::Kernel(settings_.kernel, supportRadius_),
        settings_.polynomial,
        rough,
        images_->inReach()
    );
    const morph::ControlPoints& candidates = controlPoints_->candidates();
    selection.select(candidates, communicator);
    if (controlPoints_->turned(selection.interpolant(), renewedCosine))
    {
        controlPoints_->renewDirections(selection.interpolant());
    }
}


void Foam::rbfMotionSolver::select(const bool first)
{
    const bool restored = !restored_.empty();
    const bool newSystem = !selection_;
    pstreamCommunicator communicator;
    morph::SelectionResult result;
    try
    {
        if (newSystem)
        {
            alignDirections(communicator);
            makeSelection(communicator);
        }
        result = selection_->select
        (
            controlPoints_->candidates(), communicator, renewal()
        );
        for
        (
            label n = 0;
            n < mostTurns
             && controlPoints_->turned(selection_->interpolant(), turnedCosine);
            ++n
        )
        {
            controlPoints_->renewDirections(selection_->interpolant());
            makeSelection(communicator);
            result = selection_->select
            (
                controlPoints_->candidates(), communicator, renewal()
            );
        }
    }
    catch (const std::exception& wrong)
    {
        FatalIOErrorInFunction(coeffDict())
            << wrong.what() << nl << exit(FatalIOError);
    }

    if (newSystem || result.added > 0)
    {
        if (controlPoints_->surfacesMove())
        {
            state_.clearPositions();
        }
        else
        {
            state_.setPositions(selection_->selectedPositions());
        }
    }
    summary_.add(result, result.added > 0);
    if (result.added > 0 || (newSystem && (first || !restored)))
    {
        report_.summary(result);
        report_.warnOfTolerance(result, supportRadius_);
        if (!settings_.surfaceCorrection)
        {
            report_.warnOfFirstCells
            (
                points0(),
                controlPoints_->candidatePoints(),
                selection_->errors(),
                result.largestDisplacement
            );
        }
    }
    if (debug)
    {
        report_.debugInfo(result, communicator);
    }
}


Foam::vectorField Foam::rbfMotionSolver::propagate() const
{
    morph::Vectors s = selection_->interpolant()(*cloud_);
    if (settings_.surfaceCorrection)
    {
        pstreamCommunicator communicator;
        exactSurface_->add
        (
            controlPoints_->candidates(),
            selection_->residuals(controlPoints_->candidates()),
            communicator,
            asVectors(positions_),
            s
        );
    }
    vectorField inPlane(mesh().nPoints(), Zero);
    forAll(evaluated_, i)
    {
        inPlane[evaluated_[i]] = toFoam(s.row(i).transpose());
    }
    images_->match(inPlane);
    controlPoints_->impose(inPlane, settings_.exactSliding);
    return inPlane;
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionSolver::expand
(
    const vectorField& inPlane
) const
{
    auto displacement = tmp<vectorField>::New(mesh().nPoints());
    forAll(inPlane, pointi)
    {
        displacement.ref()[pointi] = plane_->expand
        (
            points0()[pointi],
            inPlane[plane_->representative()[pointi]]
        );
    }
    return displacement;
}


Foam::string Foam::rbfMotionSolver::remedy() const
{
    OStringStream remedy;
    remedy
        << "Make the motion smaller, the support radius (" << supportRadius_
        << " m) larger, let more patches slide," << nl
        << "    or move in several steps ('subSteps auto')";
    return remedy.str();
}


Foam::vectorField Foam::rbfMotionSolver::inOneStep(const bool first)
{
    select(first);
    summary_.add(motionSummary::selection);
    vectorField inPlane(propagate());
    summary_.add(motionSummary::propagation);
    return inPlane;
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionSolver::limited
(
    const vectorField& inPlane
) const
{
    tmp<vectorField> displacement(expand(inPlane));
    scalar made =
        motionLimiter(mesh(), coeffDict(), settings_.onInvalidMesh).apply
        (
            points0(), displacement.ref(), remedy()
        );
    if (made == 1 || !controlPoints_->follow())
    {
        return displacement;
    }

    // A part of the way along its chord is off a curved surface
    for (label i = 0; i < maxSubSteps; ++i)
    {
        vectorField part(made*inPlane);
        controlPoints_->impose(part, settings_.exactSliding, made);
        tmp<vectorField> onSurface(expand(part));
        if (isValid(onSurface()))
        {
            noteMoved(mesh(), made);
            return onSurface;
        }
        made *= 0.9;
    }
    return displacement;
}


bool Foam::rbfMotionSolver::isValid(const vectorField& displacement) const
{
    return
        invalidMotion(mesh(), points0(), points0() + displacement).empty();
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionSolver::inSubSteps
(
    const label n,
    const bool last
)
{
    const auto constrain = [&](vectorField& inPlane, const scalar fraction)
    {
        images_->match(inPlane);
        controlPoints_->impose(inPlane, settings_.exactSliding, fraction);
    };
    const morph::SubStepSettings settings
    {
        morph::Kernel(settings_.kernel, supportRadius_),
        settings_.polynomial,
        settings_.selection,
        settings_.surfaceCorrection ? correctionReach*supportRadius_ : 0,
        images_->inReach(controlPoints_->largestValue())
    };
    subSteppedMotion motion
    (
        mesh(), points0(), plane_(), controlPoints_(), evaluated_, settings,
        renewal(), constrain,
        [&](const vectorField& inPlane) { return expand(inPlane); }
    );

    const motionLimiter limiter(mesh(), coeffDict(), settings_.onInvalidMesh);
    const bool check = !last || !limiter.ignores();
    scalar made = 1;
    try
    {
        if (!motion.run(n, check))
        {
            if (!last)
            {
                return tmp<vectorField>();
            }
            made = limiter.limitPart
            (
                points0() + motion.displacement(),
                motion.increment()(),
                {scalar(motion.nMade())/n, scalar(motion.nMade() + 1)/n, n},
                remedy()
            );
            motion.run(n, check, made);
        }
    }
    catch (const std::exception& wrong)
    {
        FatalIOErrorInFunction(coeffDict())
            << wrong.what() << nl << exit(FatalIOError);
    }

    motionRecord* record = motionRecord::of(mesh());
    if (record)
    {
        record->set("subSteps", n);
    }
    Info<< type() << ": moved in " << motion.nMade() << " sub-steps";
    if (made < 1)
    {
        Info<< " of " << n << ", to the fraction " << made;
    }
    Info<< ", with " << motion.fewestSelected() << " to "
        << motion.mostSelected() << " control points" << endl;
    return motion.displacement();
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionSolver::moved(const bool first)
{
    if (settings_.subSteps > 1)
    {
        return inSubSteps(settings_.subSteps, true);
    }

    const vectorField inPlane(inOneStep(first));
    if (settings_.subSteps == 1)
    {
        return limited(inPlane);
    }
    tmp<vectorField> displacement(expand(inPlane));
    if (!isValid(displacement()))
    {
        for (label n = 2; n < maxSubSteps; n *= 2)
        {
            tmp<vectorField> several(inSubSteps(n, false));
            if (several.valid())
            {
                return several;
            }
        }
        return inSubSteps(maxSubSteps, true);
    }
    return displacement;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::rbfMotionSolver::curPoints() const
{
    return points0() + pointDisplacement_.primitiveField();
}


void Foam::rbfMotionSolver::solve()
{
    summary_.startStep();
    const bool first = !controlPoints_.valid();
    if (first)
    {
        makeGeometry();
    }

    if (groups_->fromField())
    {
        pointDisplacement_.boundaryFieldRef().updateCoeffs();
        pointDisplacement_.correctBoundaryConditions();
    }

    // After a write this run goes on as one that restarts from it does
    const bool rebuild = state_.wasWritten() || first;
    const bool newDirections = controlPoints_->update(rebuild);
    const bool newRadius = updateSupportRadius();
    if ((first || newRadius) && !images_->reach(supportRadius_))
    {
        controlPoints_->update(rebuild);
    }
    if (rebuild || newDirections || newRadius)
    {
        dropSelection(first, newRadius);
    }
    summary_.add(motionSummary::conditions);

    if (supportRadius_ > 0 && moves())
    {
        pointDisplacement_.primitiveFieldRef() = moved(first);
    }
    else
    {
        pointDisplacement_.primitiveFieldRef() = Zero;
    }
    summary_.add(motionSummary::meshCheck);
    if (debug)
    {
        summary_.writeStep(Info, type());
    }
}


Foam::List<Foam::controlShape> Foam::rbfMotionSolver::shapes() const
{
    controlShape shape;
    shape.name = "controlPoints";
    shape.points.setSize(selection_ ? controlPoints_->candidates().size() : 0);
    const label n = shape.points.size();
    scalarField conditions(n), selected(n, Zero), error(n);
    vectorField displacement(n), weight(n);
    if (selection_)
    {
        const morph::ControlPoints& candidates = controlPoints_->candidates();
        const morph::Vectors gamma(selection_->weights(candidates));
        for (label i = 0; i < n; ++i)
        {
            const morph::ControlPoint& p = candidates[i];
            const label pointi = controlPoints_->candidatePoints()[i];
            displacement[i] =
                pointi < 0
              ? toFoam(p.C()*p.g())
              : pointDisplacement_.primitiveField()[pointi];
            shape.points[i] = displacement[i]
              + (pointi < 0 ? toFoam(p.position) : points0()[pointi]);
            conditions[i] = p.k;
            error[i] = selection_->errors()[i];
            weight[i] = toFoam(gamma.row(i).transpose());
        }
        for (const morph::Index i : selection_->selected())
        {
            selected[i] = 1;
        }
    }
    shape.scalars.insert("conditions", conditions);
    shape.scalars.insert("selected", selected);
    shape.scalars.insert("error", error);
    shape.vectors.insert("displacement", displacement);
    shape.vectors.insert("weight", weight);
    return List<controlShape>(1, shape);
}


void Foam::rbfMotionSolver::updateMesh(const mapPolyMesh& map)
{
    displacementMotionSolver::updateMesh(map);

    selection_.reset();
    state_.clearPositions();
    cloud_.reset();
    controlPoints_.clear();
    images_.clear();
    plane_.clear();
    report_.clear();
    makeGroups();
}


// ************************************************************************* //
