/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "narrowGap.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "pointCloud.hpp"
#include "pstreamCommunicator.H"
#include "StringStream.H"
#include "Tuple2.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Of what is prescribed, how far a motion may reach without a word
static const scalar mostOvershoot = 2;

// Difference of the displacements of two control points, in their distance,
// that is no sign of a gap: a rigid rotation has up to two
static const scalar mostSlope = 2;

// Points that carry no more than a linear map, which has no gap
static const std::size_t linearPoints = 4;


//- The largest displacement of some points [m], and where. The same on all
//  ranks
static Tuple2<scalar, point> largest
(
    const vectorField& displacements,
    const pointField& positions
)
{
    Tuple2<scalar, point> farthest(0, point::zero);
    forAll(displacements, i)
    {
        const scalar distance = mag(displacements[i]);
        if (distance > farthest.first())
        {
            farthest = Tuple2<scalar, point>(distance, positions[i]);
        }
    }
    List<Tuple2<scalar, point>> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = farthest;
    foamCompat::allGatherList(all);
    for (const Tuple2<scalar, point>& one : all)
    {
        const bool first =
            one.first() == farthest.first()
         && before(one.second(), farthest.second());
        if (one.first() > farthest.first() || first)
        {
            farthest = one;
        }
    }
    return farthest;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::string Foam::narrowGap::rougherKernel
(
    const rbfMotionProblem& problem,
    const label regioni,
    const scalar allowed
)
{
    const morph::Kernel rough
    (
        morph::KernelType::wendlandC0, problem.radius()
    );
    if (problem.settings().kernel == rough.type())
    {
        return "";
    }
    morph::GreedySelection selection
    (
        rough,
        morph::Polynomial::none,
        problem.selection(regioni),
        problem.images().inReach()
    );
    pstreamCommunicator communicator;
    selection.select
    (
        problem.controlPoints().candidates(regioni).conditions, communicator
    );
    const pointField positions(problem.reduced().positions(regioni));
    const morph::Vectors s =
        selection.interpolant()(morph::PointCloud(asVectors(positions)));
    vectorField displacements(positions.size());
    forAll(displacements, i)
    {
        displacements[i] = toFoam(s.row(i).transpose());
    }
    const scalar distance = largest(displacements, positions).first();
    if (distance > allowed)
    {
        return "";
    }
    OStringStream remedy;
    remedy.precision(3);
    remedy << "Use 'kernel wendlandC0', with which they go no further than "
        << distance << " m, or m";
    return remedy.str();
}


void Foam::narrowGap::warn
(
    const rbfMotionProblem& problem,
    const rbfMotion::selection& made,
    const label nSteps,
    const scalar reached,
    const point& where
)
{
    // The two that contradict most: by difference over distance
    const std::vector<morph::Vector3> x(made.first->selectedPositions());
    morph::Vectors at(x.size(), 3);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        at.row(i) = x[i].transpose();
    }
    const morph::Vectors s = nSteps*made.first->interpolant()(at);
    scalar steepest = 0;
    std::size_t first = 0;
    std::size_t second = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            const scalar slope = (s.row(i) - s.row(j)).norm()
               /max((x[i] - x[j]).norm(), VSMALL);
            if (slope > steepest)
            {
                steepest = slope;
                first = i;
                second = j;
            }
        }
    }
    if (steepest <= mostSlope)
    {
        return;
    }
    warned_[made.region] = true;

    const scalar told = problem.controlPoints().largestValue(made.region);
    const string rougher
    (
        rougherKernel(problem, made.region, mostOvershoot*told)
    );
    OStringStream message;
    message.precision(3);
    message
        << "Points move by up to " << reached << " m, at " << where
        << ", where no control point moves by more than " << told << " m" << nl
        << "    The control points at " << toFoam(x[first]) << " and "
        << toFoam(x[second]) << ", " << (x[first] - x[second]).norm()
        << " m apart, move by " << toFoam(s.row(first).transpose()) << " and "
        << toFoam(s.row(second).transpose()) << nl
        << "    " << (rougher.empty() ? "M" : rougher.c_str())
        << "ove them less differently: let one of their patches slide, or give"
        << " the step between them a gradual displacement";
    WarningInFunction << message.str().c_str() << endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::narrowGap::warn
(
    const rbfMotionProblem& problem,
    const rbfMotion& motion
)
{
    warned_.setSize(problem.reduced().nRegions(), false);
    for (const rbfMotion::selection& made : motion.selections)
    {
        if
        (
            warned_[made.region]
         || made.first->selectedPositions().size() <= linearPoints
        )
        {
            continue;
        }
        // Of a step that is not valid as well. Most motions go no further
        const labelList& points = problem.reduced().independent(made.region);
        const bool more = !motion.increment.empty();
        scalar most = 0;
        for (const label pointi : points)
        {
            const vector& d = motion.inPlane[pointi];
            most = max(most, magSqr(more ? d + motion.increment[pointi] : d));
        }
        most = sqrt(returnReduce(most, maxOp<scalar>()));
        const scalar told = problem.controlPoints().largestValue(made.region);
        if (most <= mostOvershoot*told)
        {
            continue;
        }

        vectorField displacements(motion.inPlane, points);
        if (more)
        {
            displacements += vectorField(motion.increment, points);
        }
        const Tuple2<scalar, point> farthest
        (
            largest(displacements, pointField(problem.points0(), points))
        );
        warn
        (
            problem, made, motion.nSteps, farthest.first(), farthest.second()
        );
    }
}


// ************************************************************************* //
