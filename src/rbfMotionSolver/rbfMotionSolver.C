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

\*---------------------------------------------------------------------------*/

#include "rbfMotionSolver.H"
#include "addToRunTimeSelectionTable.H"
#include "basicSymmetryPointPatchField.H"
#include "calculatedPointPatchField.H"
#include "clockTime.H"
#include "cyclicPolyPatch.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "incrementalSelection.hpp"
#include "invalidMotion.H"
#include "localIOdictionary.H"
#include "movedGeometry.H"
#include "pointFields.H"
#include "processorCyclicPolyPatch.H"
#include "pstreamCommunicator.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "syncTools.H"
#include "zeroGradientPointPatchField.H"

#include <limits>
#include <sstream>

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

static IOobject pointDisplacementIO(const polyMesh& mesh)
{
    return IOobject
    (
        "pointDisplacement",
        mesh.time().timeName(),
        mesh,
        IOobject::NO_READ,
        IOobject::AUTO_WRITE,
        false
    );
}


static bool slidingCondition(const pointPatchVectorField& condition)
{
    return isA<basicSymmetryPointPatchField<vector>>(condition);
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
            pointDisplacementIO(mesh),
            pointMesh::New(mesh),
            dimensionedVector(dimLength, Zero)
        ),
        pointIOField(points0IO(mesh)),
        typeName
    ),
    settings_(rbfMotionSettings::read(checkedCoeffDict())),
    largestDisplacement_(0),
    supportRadius_(0)
{
    readPointDisplacement();
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
    largestDisplacement_(0),
    supportRadius_(0)
{
    foamCompat::registerObject(pointDisplacement_);
    initialise();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::rbfMotionSolver::readPointDisplacement()
{
    foamCompat::registerObject(pointDisplacement_);

    IOobject io(pointDisplacementIO(mesh()));
    io.readOpt() = IOobject::MUST_READ;
    if (!io.typeHeaderOk<pointVectorField>(true))
    {
        return;
    }

    // Into the field that is there: some conditions cannot be copied before
    // they were evaluated, for example solidBodyMotionDisplacement
    const localIOdictionary dict(io, pointVectorField::typeName);
    auto& internal = pointDisplacement_.ref();
    internal.readField(dict, "internalField");
    pointDisplacement_.boundaryFieldRef().readField
    (
        internal, dict.subDict("boundaryField")
    );
}


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
                "controlPoints", "greedy", "selection", "featureAngle",
                "onInvalidMesh"
            }
        );
    }
    return coeffDict();
}


void Foam::rbfMotionSolver::readProperties()
{
    if (settings_.supportRadius > 0)
    {
        return;
    }
    properties_.reset
    (
        new IOdictionary
        (
            IOobject
            (
                typeName + "Properties",
                mesh().time().timeName(),
                "uniform",
                mesh(),
                IOobject::READ_IF_PRESENT,
                IOobject::AUTO_WRITE
            )
        )
    );
    string digits;
    if (properties_->readIfPresent("largestDisplacement", digits))
    {
        readScalar(digits, largestDisplacement_);
    }
}


void Foam::rbfMotionSolver::initialise()
{
    readProperties();
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
    groups_.clear();
    const dictionary* dict = coeffDict().findDict("controlPoints");
    if (dict)
    {
        groupsFromDictionary(*dict);
        addSymmetryGroups();
    }
    else if (coeffDict().found("controlPoints"))
    {
        FatalIOErrorInFunction(coeffDict())
            << "Entry 'controlPoints' has to be a dictionary of groups" << nl
            << exit(FatalIOError);
    }
    else
    {
        groupsFromField();
    }
    checkThatSomethingMoves();
}


void Foam::rbfMotionSolver::groupsFromDictionary(const dictionary& dict)
{
    for (const entry& e : dict)
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' is no group of control points"
                << nl << "    A group is a dictionary: " << e.keyword()
                << " { type ...; patches (...); }" << nl
                << exit(FatalIOError);
        }
        groups_.append(new controlPointGroup(e.keyword(), e.dict(), mesh()));
    }
}


void Foam::rbfMotionSolver::groupsFromField()
{
    checkConditions();

    // Where patches meet the last one wins, as it does when OpenFOAM evaluates
    // the boundary conditions one after the other
    typedef controlPointGroup::part part;
    for (const part p : {part::moving, part::sliding})
    {
        forAllReverse(pointDisplacement_.boundaryField(), patchi)
        {
            const pointPatchVectorField& condition =
                pointDisplacement_.boundaryField()[patchi];
            const bool slides = slidingCondition(condition);
            if
            (
                p == part::sliding
              ? slides
              : !slides && condition.fixesValue()
            )
            {
                groups_.append(new controlPointGroup(mesh(), patchi, p));
            }
        }
    }
}


void Foam::rbfMotionSolver::checkConditions() const
{
    for (const pointPatchVectorField& condition
        : pointDisplacement_.boundaryField())
    {
        const polyPatch& patch =
            mesh().boundaryMesh()[condition.patch().index()];
        if
        (
            !condition.fixesValue()
         && !slidingCondition(condition)
         && !polyPatch::constraintType(patch.type())
         && !isA<zeroGradientPointPatchField<vector>>(condition)
         && !isA<calculatedPointPatchField<vector>>(condition)
        )
        {
            FatalIOErrorInFunction(*this)
                << "The pointDisplacement condition of patch '"
                << patch.name() << "' has type '" << condition.type()
                << "', which has no part in " << typeName << nl
                << "    Conditions that fix the value move points,"
                << " slip and symmetry let them slide," << nl
                << "    zeroGradient and calculated leave them free." << nl
                << "    Use one of them, or say in 'controlPoints' which"
                << " patches move, slide or are fixed" << nl
                << exit(FatalIOError);
        }
    }
}


void Foam::rbfMotionSolver::addSymmetryGroups()
{
    labelHashSet selected;
    for (const controlPointGroup& group : groups_)
    {
        selected.insert(group.patches());
    }
    forAll(mesh().boundaryMesh(), patchi)
    {
        const polyPatch& patch = mesh().boundaryMesh()[patchi];
        const bool symmetric =
            isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch);
        if (symmetric && !selected.found(patchi))
        {
            groups_.append
            (
                new controlPointGroup
                (
                    mesh(), patchi, controlPointGroup::part::sliding
                )
            );
        }
    }
}


void Foam::rbfMotionSolver::checkThatSomethingMoves() const
{
    for (const controlPointGroup& group : groups_)
    {
        if (group.moves())
        {
            return;
        }
    }

    FatalIOErrorInFunction(*this)
        << "Nothing moves the mesh, and nothing ever could" << nl
        << "    Give a patch a moving condition in "
        << pointDisplacement_.objectPath() << nl
        << "    or " << typeName << "Coeffs a group of 'controlPoints' of"
        << " type moving" << nl << exit(FatalIOError);
}


void Foam::rbfMotionSolver::makeGeometry()
{
    plane_.reset(new planarReduction(mesh(), points0()));
    controlPoints_.reset
    (
        new rbfControlPoints
        (
            mesh(),
            coeffDict(),
            points0(),
            groups_,
            plane_(),
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
    cloud_.reset(new morph::PointCloud(asVectors(positions)));
}


bool Foam::rbfMotionSolver::updateSupportRadius()
{
    scalar largest = 0;
    for (const morph::ControlPoint& p : controlPoints_->candidates())
    {
        largest = max(largest, scalar(p.g().norm()));
    }
    largestDisplacement_ =
        max(largestDisplacement_, returnReduce(largest, maxOp<scalar>()));

    if (properties_.valid())
    {
        // A string, since numbers are written with writePrecision digits
        std::ostringstream digits;
        digits.precision(std::numeric_limits<scalar>::max_digits10);
        digits << largestDisplacement_;
        properties_->set("largestDisplacement", string(digits.str()));
    }

    const scalar former = supportRadius_;
    supportRadius_ =
        settings_.supportRadius > 0
      ? settings_.supportRadius
      : settings_.supportRadiusFactor*largestDisplacement_;
    return supportRadius_ != former;
}


void Foam::rbfMotionSolver::select()
{
    const bool newSystem = !selection_;
    pstreamCommunicator communicator;
    morph::SelectionResult result;
    try
    {
        if (newSystem)
        {
            selection_.reset
            (
                new morph::IncrementalSelection
                (
                    morph::Kernel(settings_.kernel, supportRadius_),
                    settings_.polynomial,
                    settings_.selection
                )
            );
        }
        result = selection_->select
        (
            controlPoints_->candidates(), communicator
        );
    }
    catch (const std::invalid_argument& wrong)
    {
        FatalIOErrorInFunction(coeffDict())
            << wrong.what() << nl << exit(FatalIOError);
    }

    if (newSystem || result.added > 0)
    {
        report(result);
        warn(result);
        warnOfFirstCells(result);
    }
    if (debug)
    {
        Info<< type() << ": sweep " << result.sweepTime << " s, list "
            << result.listTime << " s, solve " << result.solveTime << " s, "
            << result.sweeps << " sweeps, " << communicator.operations()
            << " collectives, " << communicator.bytes() << " B" << endl;
    }
}


void Foam::rbfMotionSolver::report(const morph::SelectionResult& result) const
{
    Info<< type() << ": selected " << label(result.selected) << " of "
        << label(result.candidates) << " control points, largest error "
        << result.largestError << " (tolerance " << result.tolerance
        << "), selection "
        << result.sweepTime + result.listTime + result.solveTime << " s"
        << endl;
}


void Foam::rbfMotionSolver::warn(const morph::SelectionResult& result)
{
    if (!result.converged() && !settings_.selection.all)
    {
        WarningInFunction
            << "The largest error, " << result.largestError
            << " m, exceeds the tolerance of " << result.tolerance << " m: ";
        if (result.rejected > 0)
        {
            Info<< label(result.rejected) << " control points are too close"
                << " to others for a support radius of " << supportRadius_
                << " m" << nl << "    Reduce the support radius" << endl;
        }
        else
        {
            Info<< "greedy/maxPoints is reached" << nl
                << "    Raise it, or the tolerance" << endl;
        }
    }
    if (result.roundOff > 0.1*result.tolerance)
    {
        WarningInFunction
            << "Round-off of about " << result.roundOff << " m is not small"
            << " against the tolerance of " << result.tolerance << " m" << nl
            << "    Reduce the support radius (" << supportRadius_
            << " m), or raise greedy/tolerance" << endl;
    }
}


const Foam::List<Foam::scalarField>& Foam::rbfMotionSolver::firstCellHeight()
{
    if (firstCellHeight_.empty())
    {
        const movedGeometry geometry(mesh(), points0());
        firstCellHeight_.setSize(mesh().boundaryMesh().nNonProcessor());
        forAll(firstCellHeight_, patchi)
        {
            const polyPatch& patch = mesh().boundaryMesh()[patchi];
            scalarField& least = firstCellHeight_[patchi];
            least.setSize(patch.nPoints(), GREAT);
            forAll(patch, i)
            {
                const scalar height =
                    geometry.cellVolumes()[patch.faceCells()[i]]
                   /max(mag(geometry.faceAreas()[patch.start() + i]), VSMALL);
                for (const label pointi : patch.localFaces()[i])
                {
                    least[pointi] = min(least[pointi], height);
                }
            }
        }
    }
    return firstCellHeight_;
}


void Foam::rbfMotionSolver::warnOfFirstCells
(
    const morph::SelectionResult& result
)
{
    scalarField error(mesh().nPoints(), Zero);
    forAll(controlPoints_->candidatePoints(), i)
    {
        const label pointi = controlPoints_->candidatePoints()[i];
        if (pointi >= 0)
        {
            error[pointi] = selection_->errors()[i];
        }
    }
    syncTools::syncPointList(mesh(), error, maxEqOp<scalar>(), scalar(0));

    const List<scalarField>& height = firstCellHeight();
    scalar worst = 0;
    word worstPatch;
    forAll(height, patchi)
    {
        const polyPatch& patch = mesh().boundaryMesh()[patchi];
        scalar ratio = 0;
        if (!polyPatch::constraintType(patch.type()))
        {
            forAll(patch.meshPoints(), i)
            {
                ratio =
                    max(ratio, error[patch.meshPoints()[i]]/height[patchi][i]);
            }
        }
        reduce(ratio, maxOp<scalar>());
        if (ratio > worst)
        {
            worst = ratio;
            worstPatch = patch.name();
        }
    }

    if (worst > 0.1)
    {
        WarningInFunction
            << "At patch '" << worstPatch << "' the motion around the control"
            << " points is off by " << worst << " heights of the first cell"
            << nl << "    The patch itself moves exactly, the cells at it"
            << " would with greedy/tolerance "
            << settings_.selection.tolerance*0.1/worst << endl;
    }
}


Foam::tmp<Foam::vectorField> Foam::rbfMotionSolver::propagate() const
{
    const morph::Vectors s = selection_->interpolant()(*cloud_);
    vectorField inPlane(mesh().nPoints(), Zero);
    forAll(evaluated_, i)
    {
        inPlane[evaluated_[i]] = toFoam(s.row(i).transpose());
    }
    matchCyclics(inPlane);
    controlPoints_->impose(inPlane);

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


void Foam::rbfMotionSolver::matchCyclics(vectorField& displacement) const
{
    boolList isCyclic(mesh().nPoints(), false);
    bool some = false;
    for (const polyPatch& patch : mesh().boundaryMesh())
    {
        if (isA<cyclicPolyPatch>(patch) || isA<processorCyclicPolyPatch>(patch))
        {
            some = true;
            UIndirectList<bool>(isCyclic, patch.meshPoints()) = true;
        }
    }
    if (!returnReduce(some, orOp<bool>()))
    {
        return;
    }
    syncTools::syncPointList(mesh(), isCyclic, orEqOp<bool>(), false);

    // Mean of both sides as half of smallest plus largest: ranks that share a
    // point leave no trace in it
    const vector none = vector::uniform(GREAT);
    vectorField smallest(displacement);
    vectorField largest(displacement);
    syncTools::syncPointList(mesh(), smallest, minEqOp<vector>(), none);
    syncTools::syncPointList(mesh(), largest, maxEqOp<vector>(), -none);
    forAll(displacement, pointi)
    {
        if (isCyclic[pointi])
        {
            displacement[pointi] = 0.5*(smallest[pointi] + largest[pointi]);
        }
    }
}


void Foam::rbfMotionSolver::check(const vectorField& displacement) const
{
    if (settings_.onInvalidMesh == rbfMotionSettings::invalidMesh::ignore)
    {
        return;
    }
    const invalidMotion invalid(mesh(), points0(), points0() + displacement);
    if (!invalid.empty())
    {
        FatalIOErrorInFunction(coeffDict())
            << "The motion makes the mesh invalid: " << invalid << nl
            << "    The mesh is left as it was. Make the motion smaller, the"
            << " support radius (" << supportRadius_ << " m) larger, or let"
            << nl << "    more patches slide; 'onInvalidMesh ignore' moves the"
            << " mesh all the same" << nl << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::rbfMotionSolver::curPoints() const
{
    return points0() + pointDisplacement_.primitiveField();
}


void Foam::rbfMotionSolver::solve()
{
    if (!controlPoints_.valid())
    {
        makeGeometry();
    }

    bool fromField = false;
    for (const controlPointGroup& group : groups_)
    {
        fromField = fromField || group.fromField();
    }
    if (fromField)
    {
        pointDisplacement_.boundaryFieldRef().updateCoeffs();
        pointDisplacement_.correctBoundaryConditions();
    }

    const bool newDirections = controlPoints_->update();
    const bool newRadius = updateSupportRadius();
    if (newDirections || newRadius)
    {
        selection_.reset();
    }

    if (supportRadius_ > 0)
    {
        select();
        clockTime timer;
        const tmp<vectorField> displacement(propagate());
        const scalar propagation = timer.timeIncrement();
        check(displacement());
        pointDisplacement_.primitiveFieldRef() = displacement;
        if (debug)
        {
            Info<< type() << ": propagation " << propagation
                << " s, mesh check " << timer.timeIncrement() << " s" << endl;
        }
    }
    else
    {
        pointDisplacement_.primitiveFieldRef() = Zero;
    }
}


void Foam::rbfMotionSolver::updateMesh(const mapPolyMesh& map)
{
    displacementMotionSolver::updateMesh(map);

    selection_.reset();
    cloud_.reset();
    controlPoints_.clear();
    plane_.clear();
    firstCellHeight_.clear();
    makeGroups();
}


// ************************************************************************* //
