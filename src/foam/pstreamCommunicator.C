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
