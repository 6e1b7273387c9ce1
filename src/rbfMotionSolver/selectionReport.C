/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "selectionReport.H"
#include "plainText.H"
#include "StringStream.H"
#include "syncTools.H"

using Foam::plainText::counted;
using Foam::plainText::rounded;

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::selectionReport::selectionReport
(
    const polyMesh& mesh,
    const rbfMotionSettings& settings
)
:
    mesh_(mesh),
    settings_(settings),
    toldOfSteps_(false)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::selectionReport::summary(const morph::SelectionResult& result)
{
    Info<< "rbfMotionSolver: selected " << label(result.selected)
        << " of "
        << counted(label(result.candidates), "control point").c_str()
        << ", largest error " << rounded(result.largestError).c_str()
        << " (tolerance " << rounded(result.tolerance).c_str()
        << "), selection "
        << rounded
           (
               result.sweepTime + result.listTime + result.solveTime
           ).c_str()
        << " s" << endl;
}


void Foam::selectionReport::warnOfTolerance
(
    const morph::SelectionResult& result,
    const scalar supportRadius
) const
{
    const bool incomplete =
        result.rejected > 0 || result.renewals > 0 || !settings_.selection.all;

    // Positions on a surface are known to round-off only
    const bool onSurface =
        result.renewals > 0
     && result.largestError < 1e-12*mesh_.bounds().mag();
    if (!result.converged() && incomplete && !onSurface)
    {
        OStringStream why;
        if (result.rejected > 0)
        {
            why << counted(label(result.rejected), "control point").c_str()
                << (result.rejected == 1 ? " is" : " are") << " too close to"
                << " others for a support radius of "
                << rounded(supportRadius).c_str() << " m" << nl << "    Reduce the support radius";
        }
        else if (result.selected >= settings_.selection.maxPoints)
        {
            why << "greedy/maxPoints is reached" << nl
                << "    Raise it, or the tolerance";
        }
        else
        {
            why << "sliding points do not come nearer to their surface"
                << nl << "    Make the motion smaller, or the surface smoother:"
                << " along an edge of it only its own points can slide";
        }
        WarningInFunction
            << "The largest error, " << rounded(result.largestError).c_str()
            << " m, exceeds the tolerance of "
            << rounded(result.tolerance).c_str() << " m: "
            << why.str().c_str() << endl;
    }
    if (result.roundOff > 0.1*result.tolerance)
    {
        WarningInFunction
            << "Round-off of about " << rounded(result.roundOff).c_str()
            << " m is not small against the tolerance of "
            << rounded(result.tolerance).c_str() << " m" << nl
            << "    Reduce the support radius ("
            << rounded(supportRadius).c_str()
            << " m), or raise greedy/tolerance" << endl;
    }
}


void Foam::selectionReport::warnOfFirstCells
(
    const rbfMotionProblem& problem,
    const rbfMotion::selection& made
)
{
    // Negative if there is no control point. Of shared points, one rank has the
    // candidate
    scalarField error(mesh_.nPoints(), -1);
    const labelList& meshPoints =
        problem.controlPoints().candidates(made.region).meshPoints;
    forAll(meshPoints, i)
    {
        if (meshPoints[i] >= 0)
        {
            error[meshPoints[i]] = made.last->errors()[i];
        }
    }
    syncTools::syncPointList(mesh_, error, maxEqOp<scalar>(), scalar(-1));
    if (!firstCells_)
    {
        firstCells_.reset(new firstCells(mesh_, problem.points0()));
    }

    scalar worst = 0;
    word worstPatch;

    // The tolerance that would leave no error above a tenth of a height
    scalar allowed = GREAT;
    for (label patchi = 0; patchi < firstCells_->nPatches(); ++patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        const scalarField& heights = firstCells_->heights(patchi);
        scalar ratio = 0;
        scalar height = GREAT;
        forAll(heights, i)
        {
            const scalar e = error[patch.meshPoints()[i]];
            if (e >= 0)
            {
                ratio = max(ratio, e/heights[i]);
                height = min(height, heights[i]);
            }
        }
        reduce(ratio, maxOp<scalar>());
        reduce(height, minOp<scalar>());
        if (ratio > 0.1)
        {
            allowed = min(allowed, 0.1*height);
        }
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
            << " points is off by " << rounded(worst).c_str()
            << " heights of the first cell"
            << nl << "    The patch itself moves exactly; the cells at it"
            << " would with 'surfaceCorrection yes'," << nl
            << "    or with greedy/tolerance "
            << allowed/made.worst.largestDisplacement << endl;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::selectionReport::write
(
    const rbfMotionProblem& problem,
    const rbfMotion& motion
)
{
    for (const rbfMotion::selection& made : motion.selections)
    {
        if (made.report)
        {
            summary(made.worst);
            warnOfTolerance(made.worst, problem.radius());
            if (problem.correctionRadius(made.region, made.worst.rough) == 0)
            {
                warnOfFirstCells(problem, made);
            }
        }
    }
    gaps_.warn(problem, motion);
}


void Foam::selectionReport::steps(const rbfMotion& motion)
{
    if (motion.nSteps == 1)
    {
        return;
    }
    if (!settings_.subStepsGiven && !toldOfSteps_)
    {
        toldOfSteps_ = true;
        Info<< "rbfMotionSolver: one step would make the mesh invalid: the"
            << " motion is made in sub-steps. 'subSteps 1' makes that an error"
            << endl;
    }
    label fewest = 0;
    label most = 0;
    for (const rbfMotion::selection& s : motion.selections)
    {
        fewest += s.fewest;
        most += s.most;
    }
    Info<< "rbfMotionSolver: moved in "
        << counted(motion.nMade, "sub-step").c_str();
    if (motion.fraction < 1)
    {
        Info<< " of " << motion.nSteps << ", to the fraction "
            << motion.fraction;
    }
    Info<< ", with " << fewest << " to "
        << counted(most, "control point").c_str() << endl;
}


void Foam::selectionReport::debugInfo(const rbfMotion& motion)
{
    for (const rbfMotion::selection& made : motion.selections)
    {
        const morph::SelectionResult& result = made.worst;
        Info<< "rbfMotionSolver: sweep " << result.sweepTime << " s, list "
            << result.listTime << " s, solve " << result.solveTime << " s, "
            << label(result.sweeps) << " sweeps, "
            << made.collectives << " collectives, "
            << made.bytes << " B" << endl;
    }
}


// ************************************************************************* //
