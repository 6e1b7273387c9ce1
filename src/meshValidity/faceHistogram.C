/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "faceHistogram.H"
#include "IOmanip.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::faceHistogram::faceHistogram(const word& name, const scalarList& from)
:
    name_(name),
    from_(from),
    counts_(from.size(), Zero)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::faceHistogram::count
(
    const scalarField& figure,
    const bitSet& faces
)
{
    for (const label facei : faces)
    {
        label bin = from_.size() - 1;
        while (bin > 0 && figure[facei] < from_[bin])
        {
            --bin;
        }
        ++counts_[bin];
    }
    Foam::reduce(counts_, sumOp<labelList>());
}


// * * * * * * * * * * * * * * * * * Write * * * * * * * * * * * * * * * * * //

void Foam::faceHistogram::writeHeader(Ostream& os)
{
    os  << "# figure          " << setw(8) << "from" << ' ' << setw(8) << "to"
        << ' ' << setw(12) << "before" << ' ' << setw(12) << "after" << endl;
}


void Foam::faceHistogram::writeRows
(
    Ostream& os,
    const faceHistogram& before,
    const faceHistogram& after
)
{
    forAll(before.from_, bin)
    {
        os  << before.name_.c_str();
        for (label i = before.name_.size(); i < 18; ++i)
        {
            os  << ' ';
        }
        os  << setw(8) << before.from_[bin] << ' ' << setw(8);
        if (bin + 1 < before.from_.size())
        {
            os  << before.from_[bin + 1];
        }
        else
        {
            os  << "inf";
        }
        os  << ' ' << setw(12) << before.counts_[bin]
            << ' ' << setw(12) << after.counts_[bin] << endl;
    }
}


// ************************************************************************* //
