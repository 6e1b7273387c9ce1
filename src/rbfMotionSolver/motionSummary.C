/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionSummary.H"
#include "IOstreams.H"

#include <cstdio>
#include <numeric>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// To three digits, whatever the precision of the log
static string rounded(const scalar x)
{
    char digits[32];
    std::snprintf(digits, sizeof(digits), "%.3g", x);
    return digits;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionSummary::motionSummary()
:
    ofStep_(Zero),
    ofAll_(Zero),
    nSteps_(0),
    nSelections_(0),
    nSelected_(0),
    nCandidates_(0),
    error_(0),
    displacement_(0)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::motionSummary::write(Ostream& os, const times& t)
{
    static const char* const names[nPhases] =
        {"conditions", "selection", "propagation", "mesh check"};

    for (label i = 0; i < nPhases; ++i)
    {
        os  << (i ? ", " : "") << names[i] << ' ' << rounded(t[i]).c_str()
            << " s";
    }
    os  << endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::motionSummary::startStep()
{
    ++nSteps_;
    ofStep_ = Zero;
    step_.timeIncrement();
}


void Foam::motionSummary::add(const phase p)
{
    const scalar seconds = step_.timeIncrement();
    ofStep_[p] += seconds;
    ofAll_[p] += seconds;
}


void Foam::motionSummary::add
(
    const morph::SelectionResult& result,
    const bool rebuild
)
{
    nSelections_ += rebuild;
    nSelected_ = result.selected;
    nCandidates_ = result.candidates;
    if (result.largestError >= error_)
    {
        error_ = result.largestError;
        displacement_ = result.largestDisplacement;
    }
}


void Foam::motionSummary::writeStep(Ostream& os, const word& solver) const
{
    os  << solver.c_str() << ": ";
    write(os, ofStep_);
}


void Foam::motionSummary::write(Ostream& os, const word& solver) const
{
    if (nSteps_ < 2)
    {
        return;
    }
    const scalar motion =
        std::accumulate(ofAll_.begin(), ofAll_.end(), scalar(0));
    const scalar run = run_.elapsedTime();
    os  << nl << solver.c_str() << ": " << nSteps_ << " steps, "
        << nSelections_ << " selections, " << nSelected_ << " of "
        << nCandidates_ << " control points," << nl
        << "    largest error " << rounded(error_).c_str()
        << " m of a displacement of " << rounded(displacement_).c_str()
        << " m" << nl
        << "    " << rounded(motion).c_str() << " s of "
        << rounded(run).c_str() << " s ("
        << rounded(100*motion/max(run, SMALL)).c_str() << " %): ";
    write(os, ofAll_);
}


// ************************************************************************* //
