/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionSummary.H"
#include "IOstreams.H"
#include "plainText.H"

using Foam::plainText::counted;
using Foam::plainText::rounded;

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionSummary::motionSummary()
:
    nSteps_(0),
    nSelections_(0),
    nSelected_(0),
    nCandidates_(0),
    error_(0),
    displacement_(0)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::motionSummary::write(Ostream& os, const motionTimes& t)
{
    static const char* const names[motionTimes::nPhases] =
        {"conditions", "selection", "propagation", "mesh check"};

    for (label i = 0; i < motionTimes::nPhases; ++i)
    {
        os  << (i ? ", " : "") << names[i] << ' ' << rounded(t[i]).c_str()
            << " s";
    }
    os  << endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::motionSummary::add(const motionTimes& t)
{
    ++nSteps_;
    ofStep_ = t;
    ofAll_ += t;
}


void Foam::motionSummary::add(const rbfMotion& motion)
{
    add(motion.times);
    if (motion.selections.empty())
    {
        return;
    }
    nSelected_ = nCandidates_ = 0;
    for (const rbfMotion::selection& s : motion.selections)
    {
        nSelections_ += s.nSelections;
        nSelected_ += s.most;
        nCandidates_ += s.worst.candidates;
        if (s.worst.largestError >= error_)
        {
            error_ = s.worst.largestError;
            displacement_ = s.worst.largestDisplacement;
        }
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
    scalar motion = 0;
    for (label i = 0; i < motionTimes::nPhases; ++i)
    {
        motion += ofAll_[i];
    }
    const scalar run = run_.elapsedTime();
    os  << nl << solver.c_str() << ": "
        << counted(nSteps_, "step").c_str() << ", "
        << counted(nSelections_, "selection").c_str() << ", " << nSelected_
        << " of " << counted(nCandidates_, "control point").c_str() << ',' << nl
        << "    largest error " << rounded(error_).c_str()
        << " m of a displacement of " << rounded(displacement_).c_str()
        << " m" << nl
        << "    " << rounded(motion).c_str() << " s of "
        << rounded(run).c_str() << " s ("
        << rounded(100*motion/max(run, SMALL)).c_str() << " %): ";
    write(os, ofAll_);
}


// ************************************************************************* //
