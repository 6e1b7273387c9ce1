/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotion.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rbfMotion::add
(
    const label region,
    const morph::SelectionResult& result,
    const std::shared_ptr<const morph::GreedySelection>& made,
    const std::shared_ptr<const morph::ControlPoints>& candidates,
    const morph::Communicator& communicator,
    const bool report
)
{
    const label nSelected = result.selected;
    const label collectives = communicator.operations();
    const label bytes = communicator.bytes();
    for (selection& s : selections)
    {
        if (s.region == region)
        {
            if (result.largestError >= s.worst.largestError)
            {
                s.worst = result;
            }
            s.nSelections += result.added > 0;
            s.fewest = min(s.fewest, nSelected);
            s.most = max(s.most, nSelected);
            s.report = s.report || report;
            s.last = made;
            s.candidates = candidates;
            s.collectives += collectives;
            s.bytes += bytes;
            return;
        }
    }
    selections.push_back
    (
        {
            region, result, result.added > 0, nSelected, nSelected, report,
            made, made, candidates, collectives, bytes
        }
    );
}


// ************************************************************************* //
