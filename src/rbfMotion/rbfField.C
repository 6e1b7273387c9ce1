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

// Most renewals of directions, one selection each, for points that go far
// around their surface: each is good for some 60 degrees
static const label mostTurns = 3;

// Directions of conditions are renewed if their cosine with those of the
// surface is smaller. Before the selection this is cheap, and beyond 18 degrees
// it needs fewer points; after it, it costs another selection, and is done for
// the convergence of the iteration
static const scalar renewedCosine = 0.95;
static const scalar turnedCosine = 0.8;

// Accuracy of estimated positions of sliding points, in largest displacements
static const scalar roughTolerance = 1e-2;

// Points that determine a linear map
static const morph::Index linearPoints = 4;

// Of derivatives of conditions that follow from positions: the most renewals,
// and the change that ends them
static const label mostRenewals = 50;
static const scalar settledDerivative = 1e-12;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfField::rbfField(rbfMotionProblem& problem, const label regioni)
:
    problem_(problem),
    region_(regioni),
    cloud_(asVectors(problem.reduced().positions(regioni))),
    linear_(false),
    rough_(false),
    surfaceRadius_(0)
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
    selection_ = std::make_shared<morph::GreedySelection>
    (
        problem_.kernel(),
        problem_.settings().polynomial,
        problem_.selection(region_),
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

    // Estimates positions, in planes tangential to the surfaces
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


void Foam::rbfField::correct
(
    const morph::Vectors& residuals,
    morph::Communicator& communicator,
    morph::Vectors& s
)
{
    const scalar correctionRadius =
        problem_.correctionRadius(region_, rough_);
    if (correctionRadius <= 0)
    {
        return;
    }
    updateSurface(correctionRadius);
    exactSurface_->add
    (
        candidates().conditions,
        residuals,
        communicator,
        asVectors(positions_),
        s
    );
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
    if (selection_)
    {
        selection_->setTolerances(problem_.selection(region_));
    }
    else
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


void Foam::rbfField::updateSurface(const scalar radius)
{
    const morph::Vectors centres(candidates().positions());
    const bool same =
        exactSurface_
     && surfaceRadius_ == radius
     && surfaceCentres_.rows() == centres.rows()
     && surfaceCentres_ == centres;
    if (returnReduce(same, andOp<bool>()))
    {
        return;
    }
    exactSurface_.reset
    (
        new morph::ExactSurface(radius, problem_.images().inReach())
    );
    surfaceRadius_ = radius;
    surfaceCentres_ = centres;
    positions_ = problem_.reduced().positions(region_);
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
    const morph::SelectionResult result = select(communicator);
    rough_ = result.rough;
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


void Foam::rbfField::propagate(vectorField& inPlane)
{
    morph::Vectors s = selection_->interpolant()(cloud_);
    pstreamCommunicator communicator;
    correct
    (
        selection_->residuals(candidates().conditions), communicator, s
    );
    const labelList& evaluated = problem_.reduced().independent(region_);
    forAll(evaluated, i)
    {
        inPlane[evaluated[i]] = toFoam(s.row(i).transpose());
    }
}


void Foam::rbfField::selectFor(const std::vector<morph::ControlPoints>& sets)
{
    pstreamCommunicator communicator;
    if (problem_.mayFollow(region_))
    {
        morph::SelectionSettings few(problem_.settings().selection);
        few.maxPoints = min(few.maxPoints, linearPoints);
        selection_ = std::make_shared<morph::GreedySelection>
        (
            problem_.kernel(), morph::Polynomial::linear, few
        );
        linear_ = true;
        for (const morph::ControlPoints& values : sets)
        {
            linear_ =
                linear_ && selection_->select(values, communicator).converged();
        }
        if (linear_)
        {
            return;
        }
    }
    makeSelection(communicator);
    for (const morph::ControlPoints& values : sets)
    {
        selection_->select(values, communicator);
    }
}


void Foam::rbfField::differentiate
(
    std::vector<morph::ControlPoints>& sets,
    PtrList<vectorField>& inPlane,
    scalarList& largest,
    scalarList& open
)
{
    pstreamCommunicator communicator;
    const rbfControlPoints& controlPoints = problem_.controlPoints();
    const morph::PointCloud there(candidates().positions());
    std::vector<morph::RbfInterpolant> fields =
        selection_->interpolants(sets, communicator);
    if (controlPoints.follow())
    {
        // Where conditions follow from positions, their derivatives do from
        // those of positions: with each step of this iteration they converge as
        // Newton's method on the chord does
        const morph::Vectors s = atCandidates(*selection_);
        for (label step = 0; step < mostRenewals; ++step)
        {
            scalar change = 0, size = 0;
            const std::vector<morph::Vectors> at =
                morph::RbfInterpolant::together(fields, there);
            for (std::size_t k = 0; k < sets.size(); ++k)
            {
                const morph::ControlPoints former(sets[k]);
                controlPoints.renewDerivatives
                (
                    region_, s, at[k], sets[k]
                );
                for (std::size_t j = 0; j < former.size(); ++j)
                {
                    change = max
                    (
                        change, (former[j].g() - sets[k][j].g()).norm()
                    );
                    size = max(size, sets[k][j].g().norm());
                }
            }
            reduce(change, maxOp<scalar>());
            reduce(size, maxOp<scalar>());
            if (change <= settledDerivative*size)
            {
                break;
            }
            fields = selection_->interpolants(sets, communicator);
        }
    }

    const labelList& evaluated = problem_.reduced().independent(region_);
    std::vector<morph::Vectors> all =
        morph::RbfInterpolant::together(fields, cloud_);
    std::vector<morph::Vectors> left =
        morph::RbfInterpolant::together(fields, there);
    for (std::size_t k = 0; k < sets.size(); ++k)
    {
        morph::Vectors& s = all[k];
        morph::Vectors& residuals = left[k];
        for (std::size_t j = 0; j < sets[k].size(); ++j)
        {
            const morph::ControlPoint& p = sets[k][j];
            const morph::Vector3 r = p.residual(residuals.row(j).transpose());
            residuals.row(j) = (p.C()*r.head(p.k)).transpose();
            largest[k] = max(largest[k], p.g().norm());
            open[k] = max(open[k], r.head(p.k).norm());
        }
        correct(residuals, communicator, s);
        forAll(evaluated, i)
        {
            inPlane[k][evaluated[i]] = toFoam(s.row(i).transpose());
        }
    }
}


// ************************************************************************* //
