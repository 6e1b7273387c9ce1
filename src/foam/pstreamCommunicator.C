/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "pstreamCommunicator.H"
#include "foamCompat.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

int Foam::pstreamCommunicator::rank() const
{
    return Pstream::myProcNo();
}


int Foam::pstreamCommunicator::size() const
{
    return Pstream::nProcs();
}


std::vector<double> Foam::pstreamCommunicator::gather
(
    const std::vector<double>& mine
)
{
    if (!Pstream::parRun())
    {
        return mine;
    }

    List<List<double>> parts(Pstream::nProcs());
    List<double>& part = parts[Pstream::myProcNo()];
    part.setSize(mine.size());
    std::copy(mine.begin(), mine.end(), part.begin());
    foamCompat::allGatherList(parts);

    std::vector<double> all;
    for (const List<double>& values : parts)
    {
        all.insert(all.end(), values.begin(), values.end());
    }
    count(all.size());
    return all;
}


double Foam::pstreamCommunicator::max(double value)
{
    if (Pstream::parRun())
    {
        count(1);
    }
    return returnReduce(scalar(value), maxOp<scalar>());
}


std::vector<double> Foam::pstreamCommunicator::sum
(
    const std::vector<double>& mine
)
{
    if (!Pstream::parRun() || mine.empty())
    {
        return mine;
    }

    List<double> values(mine.size());
    std::copy(mine.begin(), mine.end(), values.begin());
    foamCompat::allCombineList(values, plusEqOp<double>());
    count(values.size());
    return std::vector<double>(values.begin(), values.end());
}


// ************************************************************************* //
