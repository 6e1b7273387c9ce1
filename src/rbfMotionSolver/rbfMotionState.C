/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionState.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "positionTable.H"
#include "SubField.H"
#include "Time.H"
#include "Tuple2.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// A mesh that is written with six digits, the default, moves its points by no
// more than this, in units of their largest coordinate
static const scalar writeTolerance = 1e-5;


//- A position and how far it is from the one asked for
typedef Tuple2<scalar, point> nearPosition;


//- The nearer one; of two that are as near one that does not depend on ranks
struct nearerEqOp
{
    void operator()(nearPosition& a, const nearPosition& b) const
    {
        const point& x = a.second();
        const point& y = b.second();
        if
        (
            b.first() < a.first()
         || (
                b.first() == a.first()
             && before(y, x)
            )
        )
        {
            a = b;
        }
    }
};


static scalar largestCoordinate(const pointField& positions)
{
    scalar largest = 0;
    for (const point& x : positions)
    {
        largest = max(largest, cmptMax(cmptMag(x)));
    }
    return largest;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfMotionState::rbfMotionState(const polyMesh& mesh)
:
    IOdictionary
    (
        IOobject
        (
            "rbfMotionSolverProperties",
            mesh.time().timeName(),
            "uniform",
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        )
    ),
    supportRadius_(getOrDefault<scalar>("supportRadius", 0)),
    written_(false)
{
    if (found("controlPoints"))
    {
        // Its numbers are text in binary files as well
        ITstream& is = lookup("controlPoints");
        is.format(IOstream::ASCII);
        const pointField all(is);

        // One size for each region, if there is more than one
        const labelList sizes
        (
            getOrDefault<labelList>("regionSizes", labelList(1, all.size()))
        );
        label start = 0;
        for (const label size : sizes)
        {
            if (size < 0 || size > all.size() - start)
            {
                FatalIOErrorInFunction(*this)
                    << "Entry 'regionSizes' does not add up to the "
                    << all.size() << " 'controlPoints'" << nl
                    << "    The file is damaged: restore it, or remove it to"
                    << " let the run select anew" << nl << exit(FatalIOError);
            }
            positions_.append(pointField(SubField<point>(all, size, start)));
            start += size;
        }
    }
    dictionary::clear();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rbfMotionState::setPositions
(
    const label regioni,
    const std::vector<morph::Vector3>& positions
)
{
    positions_.setSize(max(positions_.size(), regioni + 1));
    pointField& mine = positions_[regioni];
    mine.setSize(positions.size());
    forAll(mine, i)
    {
        mine[i] = toFoam(positions[i]);
    }
}


bool Foam::rbfMotionState::wasWritten()
{
    const bool written = returnReduce(written_, orOp<bool>());
    written_ = false;
    return written;
}


std::vector<morph::Vector3> Foam::rbfMotionState::positionsAmong
(
    const label regioni,
    const morph::ControlPoints& controlPoints
) const
{
    if (regioni >= positions_.size() || positions_[regioni].empty())
    {
        return std::vector<morph::Vector3>();
    }
    const pointField& written = positions_[regioni];
    List<nearPosition> nearest
    (
        written.size(), nearPosition(GREAT, point::uniform(GREAT))
    );
    const positionTable table(written);
    const scalar tolerance = writeTolerance*largestCoordinate(written);
    for (const morph::ControlPoint& p : controlPoints)
    {
        const point x(toFoam(p.position));
        const label i = table.find(x, tolerance);
        if (i >= 0)
        {
            nearerEqOp()(nearest[i], nearPosition(mag(x - written[i]), x));
        }
    }
    foamCompat::allCombineList(nearest, nearerEqOp());

    std::vector<morph::Vector3> positions;
    for (const nearPosition& x : nearest)
    {
        if (x.first() > tolerance)
        {
            WarningInFunction
                << "Some control points that were selected before the restart"
                << " are not there any more" << nl
                << "    They are selected anew: the run goes on within the"
                << " tolerance. Where that was not intended, restore the mesh"
                << nl << "    and the groups of control points, or remove "
                << objectPath() << endl;
            return std::vector<morph::Vector3>();
        }
        positions.push_back(toEigen(x.second()));
    }
    return positions;
}


bool Foam::rbfMotionState::writeData(Ostream& os) const
{
    written_ = true;

    const int precision = os.precision(std::numeric_limits<scalar>::max_digits10);
    os.writeKeyword("supportRadius") << supportRadius_
        << token::END_STATEMENT << nl << nl;
    labelList sizes(positions_.size());
    forAll(sizes, i)
    {
        sizes[i] = positions_[i].size();
    }
    if (sizes.size() > 1)
    {
        os.writeEntry("regionSizes", sizes);
    }
    os.writeKeyword("controlPoints") << nl << sum(sizes) << nl
        << token::BEGIN_LIST << nl;
    for (const pointField& positions : positions_)
    {
        for (const point& x : positions)
        {
            os  << x << nl;
        }
    }
    os  << token::END_LIST << token::END_STATEMENT << nl;
    os.precision(precision);
    return os.good();
}


// ************************************************************************* //
