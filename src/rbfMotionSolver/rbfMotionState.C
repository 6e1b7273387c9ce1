/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionState.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "positionTable.H"
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
             && std::lexicographical_compare
                (
                    y.cdata(), y.cdata() + 3, x.cdata(), x.cdata() + 3
                )
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
        is >> positions_;
    }
    dictionary::clear();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rbfMotionState::setPositions
(
    const std::vector<morph::Vector3>& positions
)
{
    positions_.setSize(positions.size());
    forAll(positions_, i)
    {
        positions_[i] = toFoam(positions[i]);
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
    const morph::ControlPoints& controlPoints
) const
{
    List<nearPosition> nearest
    (
        positions_.size(), nearPosition(GREAT, point::uniform(GREAT))
    );
    const positionTable table(positions_);
    const scalar tolerance = writeTolerance*largestCoordinate(positions_);
    for (const morph::ControlPoint& p : controlPoints)
    {
        const point x(toFoam(p.position));
        const label i = table.find(x, tolerance);
        if (i >= 0)
        {
            nearerEqOp()(nearest[i], nearPosition(mag(x - positions_[i]), x));
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
    os.writeKeyword("controlPoints") << nl << positions_.size() << nl
        << token::BEGIN_LIST << nl;
    for (const point& x : positions_)
    {
        os  << x << nl;
    }
    os  << token::END_LIST << token::END_STATEMENT << nl;
    os.precision(precision);
    return os.good();
}


// ************************************************************************* //
