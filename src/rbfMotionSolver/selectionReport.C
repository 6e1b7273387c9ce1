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

#include "selectionReport.H"
#include "movedGeometry.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::selectionReport::selectionReport
(
    const polyMesh& mesh,
    const rbfMotionSettings& settings
)
:
    mesh_(mesh),
    settings_(settings)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::selectionReport::findFirstCellHeight(const pointField& points0)
{
    const movedGeometry geometry(mesh_, points0);
    firstCellHeight_.setSize(mesh_.nPoints(), GREAT);
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        forAll(patch, i)
        {
            const scalar height =
                geometry.cellVolumes()[patch.faceCells()[i]]
               /max(mag(geometry.faceAreas()[patch.start() + i]), VSMALL);
            for (const label pointi : patch[i])
            {
                scalar& least = firstCellHeight_[pointi];
                least = min(least, height);
            }
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::selectionReport::summary
(
    const morph::SelectionResult& result
) const
{
    Info<< "rbfMotionSolver: selected " << label(result.selected)
        << " of " << label(result.candidates) << " control points, largest error "
        << result.largestError << " (tolerance " << result.tolerance
        << "), selection "
        << result.sweepTime + result.listTime + result.solveTime << " s"
        << endl;
}


void Foam::selectionReport::warnOfTolerance
(
    const morph::SelectionResult& result,
    const scalar supportRadius
) const
{
    if (!result.converged() && !settings_.selection.all)
    {
        WarningInFunction
            << "The largest error, " << result.largestError
            << " m, exceeds the tolerance of " << result.tolerance << " m: ";
        if (result.rejected > 0)
        {
            Info<< label(result.rejected) << " control points are too close"
                << " to others for a support radius of " << supportRadius
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
            << "    Reduce the support radius (" << supportRadius
            << " m), or raise greedy/tolerance" << endl;
    }
}


void Foam::selectionReport::warnOfFirstCells
(
    const pointField& points0,
    const labelList& meshPoints,
    const std::vector<double>& errors,
    const scalar largestDisplacement
)
{
    Map<scalar> error;
    forAll(meshPoints, i)
    {
        error.insert(meshPoints[i], errors[i]);
    }
    if (firstCellHeight_.empty())
    {
        findFirstCellHeight(points0);
    }

    scalar worst = 0;
    word worstPatch;

    // A tolerance this small would leave no error above a tenth of a height
    scalar allowed = GREAT;
    const label nPatches = mesh_.boundaryMesh().nNonProcessor();
    for (label patchi = 0; patchi < nPatches; ++patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        scalar ratio = 0;
        scalar height = GREAT;
        if (!polyPatch::constraintType(patch.type()))
        {
            for (const label pointi : patch.meshPoints())
            {
                const auto found = error.cfind(pointi);
                if (found.found())
                {
                    const scalar h = firstCellHeight_[pointi];
                    ratio = max(ratio, found.val()/h);
                    height = min(height, h);
                }
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
            << " points is off by " << worst << " heights of the first cell"
            << nl << "    The patch itself moves exactly; the cells at it"
            << " would with 'surfaceCorrection yes'," << nl
            << "    or with greedy/tolerance "
            << allowed/largestDisplacement << endl;
    }
}


void Foam::selectionReport::debugInfo
(
    const morph::SelectionResult& result,
    const morph::Communicator& communicator
) const
{
    Info<< "rbfMotionSolver: sweep " << result.sweepTime << " s, list "
        << result.listTime << " s, solve " << result.solveTime << " s, "
        << label(result.sweeps) << " sweeps, "
        << label(communicator.operations()) << " collectives, "
        << communicator.bytes() << " B" << endl;
}


// ************************************************************************* //
