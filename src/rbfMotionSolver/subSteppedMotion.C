/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "subSteppedMotion.H"
#include "eigenFields.H"
#include "invalidMotion.H"
#include "pstreamCommunicator.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::subSteppedMotion::subSteppedMotion
(
    const polyMesh& mesh,
    const pointField& points0,
    const planarReduction& plane,
    rbfControlPoints& controlPoints,
    const labelList& evaluated,
    const morph::SubStepSettings& settings,
    const morph::GreedySelection::Renewal& renewal,
    const constraint& constrain,
    const expansion& expand
)
:
    mesh_(mesh),
    points0_(points0),
    plane_(plane),
    controlPoints_(controlPoints),
    evaluated_(evaluated),
    settings_(settings),
    renewal_(renewal),
    constrain_(constrain),
    expand_(expand),
    nMade_(0),
    fewest_(0),
    most_(0)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

morph::Vectors Foam::subSteppedMotion::reachedByControlPoints
(
    const scalar fraction
) const
{
    const morph::ControlPoints& conditions = controlPoints_.candidates();
    const labelList& meshPoints = controlPoints_.candidatePoints();

    // Those off the mesh are prescribed
    morph::Vectors reached(conditions.size(), 3);
    forAll(meshPoints, i)
    {
        const morph::Vector3 s =
            meshPoints[i] < 0
          ? morph::Vector3(fraction*conditions[i].value)
          : toEigen(reached_[meshPoints[i]]);
        reached.row(i) = s.transpose();
    }
    return reached;
}


Foam::vectorField Foam::subSteppedMotion::next(const label n)
{
    pointField positions(evaluated_.size());
    forAll(evaluated_, i)
    {
        const label pointi = evaluated_[i];
        positions[i] = plane_.position(points0_[pointi]) + reached_[pointi];
    }

    // On curved surfaces conditions turn with the points
    const morph::Vectors reached =
        reachedByControlPoints(scalar(nMade_)/n);
    controlPoints_.setDirections(reached);

    pstreamCommunicator communicator;
    morph::SelectionResult result;
    const morph::Vectors s = morph::subStep
    (
        settings_,
        controlPoints_.candidates(),
        reached,
        n - nMade_,
        renewal_,
        asVectors(positions),
        communicator,
        result
    );
    fewest_ = nMade_ ? min(fewest_, label(result.selected)) : result.selected;
    most_ = nMade_ ? max(most_, label(result.selected)) : result.selected;

    vectorField moved(reached_);
    forAll(evaluated_, i)
    {
        moved[evaluated_[i]] += toFoam(s.row(i).transpose());
    }
    constrain_(moved, scalar(nMade_ + 1)/n);
    return moved;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::subSteppedMotion::run
(
    const label n,
    const bool check,
    const scalar fraction
)
{
    nMade_ = 0;
    reached_.setSize(mesh_.nPoints());
    reached_ = Zero;

    while (nMade_ < fraction*n)
    {
        vectorField moved(next(n));
        const scalar part = fraction*n - nMade_;
        if (part < 1)
        {
            moved = reached_ + part*(moved - reached_);
            constrain_(moved, fraction);
        }

        if (check)
        {
            const pointField points(points0_ + expand_(moved));
            if (!invalidMotion(mesh_, points0_, points).empty())
            {
                increment_ = moved - reached_;
                return false;
            }
        }
        reached_.transfer(moved);
        ++nMade_;
    }
    return true;
}


// ************************************************************************* //
