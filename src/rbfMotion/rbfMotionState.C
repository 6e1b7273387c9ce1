/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionState.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "IFstream.H"
#include "OSspecific.H"
#include "positionTable.H"
#include "SHA1.H"
#include "StringStream.H"
#include "SubField.H"
#include "Time.H"
#include "Tuple2.H"
#include "untrapped.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Writing a mesh with six digits, the default, moves its points by no more than
// this, in units of their largest coordinate
static const scalar writeTolerance = 1e-5;


//- A position, and its distance from the requested one
typedef Tuple2<scalar, point> nearPosition;


//- The nearer one; of two at the same distance, one that does not depend on the
//  ranks
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
            IOobject::NO_READ,
            IOobject::AUTO_WRITE
        )
    ),
    mesh_(mesh),
    found_(false),
    supportRadius_(0),
    written_(false)
{
    // By hand: a file that cannot be read is not the same as none, and in
    // parallel the reader of OpenFOAM does not know its name
    const fileName path(foamCompat::filePath<IOdictionary>(*this));
    string fault;
    if (Pstream::master())
    {
        found_ = path.size() || exists(objectPath());
        fault = found_ ? read(path.size() ? path : objectPath()) : string();
    }
    dictionaryChecks::stopIf(objectPath(), fault);
    foamCompat::broadcast(found_);
    foamCompat::broadcast(supportRadius_);
    foamCompat::broadcast(positions_);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::string Foam::rbfMotionState::checksum() const
{
    OStringStream os;
    os.precision(std::numeric_limits<scalar>::max_digits10);
    os  << supportRadius_ << positions_;
    return SHA1(os.str()).str();
}


Foam::string Foam::rbfMotionState::read(const fileName& path)
{
    const untrapped numbers;
    string fault;
    try
    {
        const throwing errors;
        IFstream is(path);
        const dictionary dict(is);
        dictionaryChecks::checkNumbers(dict);
        supportRadius_ = dict.get<scalar>("supportRadius");
        const pointField all(dict.get<pointField>("controlPoints"));

        // One size for each region, if there is more than one
        const labelList sizes
        (
            dict.getOrDefault<labelList>
            (
                "regionSizes", labelList(1, all.size())
            )
        );
        label start = 0;
        for (const label size : sizes)
        {
            if (size < 0 || size > all.size() - start)
            {
                fault = "'regionSizes' does not add up to the 'controlPoints'";
                break;
            }
            positions_.append(pointField(SubField<point>(all, size, start)));
            start += size;
        }
        const string sum(dict.get<string>("checksum"));
        if (all.empty() && sum != checksum())
        {
            // None of any region is written like none of one
            positions_.clear();
        }
        if (fault.empty() && sum != checksum())
        {
            fault = "its checksum is that of other contents";
        }
    }
    catch (const Foam::error& wrong)
    {
        fault = said(wrong);
    }
    catch (const std::exception& wrong)
    {
        fault = wrong.what();
    }
    return fault.empty() ? fault : string
    (
        path + " is not as it was written: " + fault + nl
      + "    It keeps what a restart needs to continue as the run would have."
        " Restore it, or restart from another time"
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rbfMotionState::require(const dictionary& coeffs) const
{
    // A run, not one application of morphMesh, has moved the mesh
    const bool restart =
        time().startTimeIndex() > 0
     && mesh_.pointsInstance() == time().timeName()
     && time().timeIndex() == time().startTimeIndex();
    if (found_ || !restart || coeffs.found("supportRadius"))
    {
        return;
    }
    FatalIOErrorInFunction(coeffs)
        << "There is no file " << objectPath() << ", which keeps the support"
        << " radius over a restart" << nl
        << "    Restore it. Where another motion solver moved the mesh so far,"
        << " give the entry 'supportRadius', a length [m]" << nl
        << exit(FatalIOError);
}


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
    if (sizes.size() != 1)
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
    os  << token::END_LIST << token::END_STATEMENT << nl << nl;
    os.writeKeyword("checksum") << checksum() << token::END_STATEMENT << nl;
    os.precision(precision);
    return os.good();
}


// ************************************************************************* //
