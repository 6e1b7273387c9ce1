/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfField.H"
#include "eigenFields.H"
#include "pstreamCommunicator.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

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

// Points that determine a linear map
static const morph::Index linearPoints = 4;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfField::rbfField(rbfMotionProblem& problem, const label regioni)
:
    problem_(problem),
    region_(regioni),
    cloud_(asVectors(problem.reduced().positions(regioni))),
    linear_(false)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

morph::Vectors Foam::rbfField::atCandidates
(
    const morph::GreedySelection& field
) const
{
    return field.interpolant()(candidates().positions());
}


void Foam::rbfField::makeSelection(morph::Communicator& communicator)
{
    exactSurface_.reset();
    selection_ = std::make_shared<morph::GreedySelection>
    (
        problem_.kernel(),
        problem_.settings().polynomial,
        problem_.settings().selection,
        problem_.images().inReach()
    );
    if (!restored_.empty())
    {
        selection_->restore
        (
            restored_, candidates().conditions, communicator
        );
        restored_.clear();
    }
}


void Foam::rbfField::alignDirections(morph::Communicator& communicator)
{
    rbfControlPoints& controlPoints = problem_.controlPoints();
    if (!controlPoints.follow())
    {
        return;
    }

    // Where points go roughly, in planes tangential to their surfaces
    morph::SelectionSettings rough;
    rough.tolerance = roughTolerance;
    morph::GreedySelection selection
    (
        problem_.kernel(),
        problem_.settings().polynomial,
        rough,
        problem_.images().inReach()
    );
    selection.select(candidates().conditions, communicator);
    const morph::Vectors s = atCandidates(selection);
    if (controlPoints.turned(region_, s, renewedCosine))
    {
        controlPoints.renewDirections(region_, s);
    }
}


bool Foam::rbfField::selectLinear
(
    morph::Communicator& communicator,
    morph::SelectionResult& result
)
{
    // A selection of more points is none of a linear map
    const bool mayBe =
        linear_
     || (
            !selection_
         && morph::Index(restored_.size()) <= linearPoints
         && problem_.mayFollow(region_)
        );
    if (!mayBe)
    {
        return false;
    }
    if (!linear_)
    {
        morph::SelectionSettings few(problem_.settings().selection);
        few.maxPoints = min(few.maxPoints, linearPoints);
        exactSurface_.reset();
        selection_ = std::make_shared<morph::GreedySelection>
        (
            problem_.kernel(), morph::Polynomial::linear, few
        );
    }
    result = selection_->select(candidates().conditions, communicator);
    linear_ = result.converged();
    if (linear_)
    {
        restored_.clear();
    }
    else
    {
        selection_.reset();
    }
    return linear_;
}


morph::SelectionResult Foam::rbfField::select
(
    morph::Communicator& communicator
)
{
    morph::SelectionResult result;
    if (selectLinear(communicator, result))
    {
        return result;
    }
    if (!selection_)
    {
        alignDirections(communicator);
        makeSelection(communicator);
    }

    rbfControlPoints& controlPoints = problem_.controlPoints();
    controlCandidates& offered = controlPoints.candidates(region_);
    const morph::GreedySelection::Renewal renewal = problem_.renewal(region_);
    result = selection_->select(offered.conditions, communicator, renewal);
    for (label n = 0; n < mostTurns && controlPoints.follow(); ++n)
    {
        const morph::Vectors s = atCandidates(*selection_);
        if (!controlPoints.turned(region_, s, turnedCosine))
        {
            break;
        }
        controlPoints.renewDirections(region_, s);
        makeSelection(communicator);
        result = selection_->select(offered.conditions, communicator, renewal);
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::rbfField::active() const
{
    return selection_ || !restored_.empty() || problem_.moves(region_);
}


std::vector<morph::Vector3> Foam::rbfField::selectedPositions() const
{
    return
        selection_ ? selection_->selectedPositions()
      : std::vector<morph::Vector3>();
}


void Foam::rbfField::restart(const std::vector<morph::Vector3>& positions)
{
    restored_ = positions;
    selection_.reset();
    linear_ = false;
}


void Foam::rbfField::select(rbfMotion& motion, const bool anew)
{
    const bool restored = !restored_.empty();
    const bool newSystem = !selection_;
    pstreamCommunicator communicator;
    try
    {
        const morph::SelectionResult result = select(communicator);
        motion.add
        (
            region_,
            result,
            selection_,
            nullptr,
            communicator,
            result.added > 0 || (newSystem && (anew || !restored))
        );
    }
    catch (const std::exception& wrong)
    {
        FatalIOErrorInFunction(problem_.dict())
            << wrong.what() << nl << exit(FatalIOError);
    }
}


void Foam::rbfField::propagate(vectorField& inPlane)
{
    morph::Vectors s = selection_->interpolant()(cloud_);
    const scalar correctionRadius = problem_.correctionRadius(region_);
    if (correctionRadius > 0)
    {
        if (!exactSurface_)
        {
            exactSurface_.reset
            (
                new morph::ExactSurface
                (
                    correctionRadius, problem_.images().inReach()
                )
            );
            positions_ = problem_.reduced().positions(region_);
        }
        pstreamCommunicator communicator;
        exactSurface_->add
        (
            candidates().conditions,
            selection_->residuals(candidates().conditions),
            communicator,
            asVectors(positions_),
            s
        );
    }
    const labelList& evaluated = problem_.reduced().independent(region_);
    forAll(evaluated, i)
    {
        inPlane[evaluated[i]] = toFoam(s.row(i).transpose());
    }
}


// ************************************************************************* //
