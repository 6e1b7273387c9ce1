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

#include "ffdBoxSettings.H"
#include "coordinateRotation.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "Tuple2.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::ffdBoxSettings::boxType>
Foam::ffdBoxSettings::boxTypeNames
({
    { boxType::box, "box" },
    { boxType::cylindrical, "cylindrical" },
    { boxType::corners, "corners" }
});


const Foam::Enum<Foam::ffdBoxSettings::basisType>
Foam::ffdBoxSettings::basisTypeNames
({
    { basisType::bernstein, "bernstein" },
    { basisType::bSpline, "bSpline" }
});


const Foam::Enum<Foam::ffdBoxSettings::unitType>
Foam::ffdBoxSettings::unitTypeNames
({
    { unitType::box, "box" },
    { unitType::metres, "metres" }
});


const Foam::wordList Foam::ffdBoxSettings::continuityNames
({
    "none", "C0", "C1", "C2"
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;

static vector readSpan(const dictionary& dict)
{
    const vector span(dict.get<vector>("span"));
    for (direction d = 0; d < vector::nComponents; ++d)
    {
        if (!(span[d] > 0))
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'span' is " << span
                << " but each of its components has to be positive" << nl
                << "    The box reaches from its corner 'origin' along its"
                << " axes; move the origin instead" << nl
                << exit(FatalIOError);
        }
    }
    return span;
}


static Eigen::Matrix3d columns(const vector& a, const vector& b, const vector& c)
{
    Eigen::Matrix3d m;
    m << toEigen(a), toEigen(b), toEigen(c);
    return m;
}


static std::shared_ptr<const morph::FfdFrame> readBox(const dictionary& dict)
{
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (dict.found("rotation"))
    {
        const tensor R
        (
            coordinateRotation::New(dict.subDict("rotation"))->R()
        );
        axes = columns
        (
            vector(R.xx(), R.yx(), R.zx()),
            vector(R.xy(), R.yy(), R.zy()),
            vector(R.xz(), R.yz(), R.zz())
        );
    }
    return std::make_shared<morph::AffineFrame>
    (
        toEigen(dict.get<vector>("origin")), toEigen(readSpan(dict)), axes
    );
}


static vector unitVector(const dictionary& dict, const word& key)
{
    const vector v(dict.get<vector>(key));
    if (!(mag(v) > VSMALL))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << v
            << " but has to be a direction" << nl << exit(FatalIOError);
    }
    return v/mag(v);
}


static std::shared_ptr<const morph::FfdFrame> readCylindrical
(
    const dictionary& dict
)
{
    const vector axis(unitVector(dict, "axis"));

    // Angle zero: as told, or the axis of space most normal to the cylinder's
    vector radial(Zero);
    if (dict.found("direction"))
    {
        radial = unitVector(dict, "direction");
    }
    else
    {
        direction least = 0;
        for (direction d = 1; d < vector::nComponents; ++d)
        {
            least = mag(axis[d]) < mag(axis[least]) - SMALL ? d : least;
        }
        radial[least] = 1;
    }
    radial -= (radial & axis)*axis;
    if (mag(radial) < 1e-6)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'direction' is that of the axis" << nl
            << "    It says where the angle is zero: give one normal to the"
            << " axis" << nl << exit(FatalIOError);
    }
    radial /= mag(radial);

    vector start(dict.get<vector>("start"));
    vector span(readSpan(dict));
    if (start.x() < 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'start' is " << start << ": its first component is a"
            << " radius and may not be negative" << nl << exit(FatalIOError);
    }
    if (span.y() > 360*(1 + 1e-12))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'span' is " << span << ": its second component is an"
            << " angle of at most 360 degrees" << nl << exit(FatalIOError);
    }
    start.y() = degToRad(start.y());
    span.y() = degToRad(span.y());
    return std::make_shared<morph::CylindricalFrame>
    (
        toEigen(dict.get<vector>("origin")),
        columns(radial, axis ^ radial, axis),
        toEigen(start),
        toEigen(span)
    );
}


static std::shared_ptr<const morph::FfdFrame> readCorners
(
    const dictionary& dict
)
{
    const List<point> given(dict.lookup("corners"));
    if (given.size() != 8)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'corners' lists " << given.size()
            << " points but has to list 8, in the order of blockMesh's hex"
            << nl << exit(FatalIOError);
    }

    // hex goes around each of the two faces
    const label places[] = {0, 1, 3, 2, 4, 5, 7, 6};
    std::array<Vector3, 8> corners;
    forAll(given, i)
    {
        corners[std::size_t(i)] = toEigen(given[places[i]]);
    }
    try
    {
        return std::make_shared<morph::HexahedralFrame>(corners);
    }
    catch (const std::invalid_argument& wrong)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'corners': " << wrong.what() << nl << exit(FatalIOError);
    }
    return nullptr;
}


// One direction: the contract counts L + 1 points, of which the first and the
// last of a ring are one
static morph::BSpline readBasis
(
    const dictionary& dict,
    const labelVector& order,
    const direction d,
    const bool ring
)
{
    const bool spline = dictionaryChecks::getChoice
    (
        dict,
        "basis",
        ffdBoxSettings::basisTypeNames,
        ffdBoxSettings::basisType::bernstein
    ) == ffdBoxSettings::basisType::bSpline;

    if (!spline)
    {
        return morph::BSpline::bernstein(order[d]);
    }

    const labelVector degree(dict.get<labelVector>("degree"));
    const label n = ring && order[d] > 0 ? order[d] : order[d] + 1;
    const label least = order[d] > 0 ? 1 : 0;
    if (degree[d] < least || degree[d] >= n)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'degree' is " << degree << " but with 'order' " << order
            << " its component " << label(d) << " has to be from " << least
            << " to " << n - 1 << ": less than the number of control points, "
            << n << nl << exit(FatalIOError);
    }
    return morph::BSpline
    (
        n,
        degree[d],
        ring && order[d] > 0
      ? morph::BSpline::Ends::periodic
      : morph::BSpline::Ends::clamped
    );
}


static labelVector readOrder(const dictionary& dict)
{
    const labelVector order(dict.get<labelVector>("order"));
    if (cmptMin(order) < 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'order' is " << order
            << " but no component may be negative" << nl
            << "    There is one control point more in each direction; 0 moves"
            << " all points along it alike" << nl << exit(FatalIOError);
    }
    return order;
}


static label readContinuity(const dictionary& dict)
{
    const word given(dict.getOrDefault<word>("continuity", "C0"));
    const label layers = ffdBoxSettings::continuityNames.find(given);
    if (layers < 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'continuity' is '" << given << "'" << nl
            << "    Use one of "
            << flatOutput(ffdBoxSettings::continuityNames) << nl
            << exit(FatalIOError);
    }
    return layers;
}


static void checkKeys(const dictionary& dict, const wordList& ofType)
{
    wordList keys
    ({
        "type", "order", "basis", "units", "continuity", "weights",
        "parameters"
    });
    if (dict.getOrDefault<word>("basis", "bernstein") == "bSpline")
    {
        keys.append("degree");
    }
    keys.append(ofType);
    dictionaryChecks::onlyKeys(dict, keys);
}


static std::shared_ptr<const morph::FfdFrame> readFrame(const dictionary& dict)
{
    using boxType = ffdBoxSettings::boxType;
    switch
    (
        dictionaryChecks::getChoice
        (
            dict, "type", ffdBoxSettings::boxTypeNames, boxType::box
        )
    )
    {
        case boxType::cylindrical:
        {
            checkKeys(dict, {"origin", "axis", "direction", "start", "span"});
            return readCylindrical(dict);
        }
        case boxType::corners:
        {
            checkKeys(dict, {"corners"});
            return readCorners(dict);
        }
        default:
        {
            checkKeys(dict, {"origin", "span", "rotation"});
            return readBox(dict);
        }
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::ffdBoxSettings Foam::ffdBoxSettings::read(const dictionary& dict)
{
    ffdBoxSettings settings;
    settings.frame = readFrame(dict);
    settings.order = readOrder(dict);
    settings.units = dictionaryChecks::getChoice
    (
        dict, "units", unitTypeNames, unitType::box
    );
    settings.frozenLayers = readContinuity(dict);

    const bool ring = settings.frame->ring();
    const std::array<morph::BSpline, 3> basis
    {{
        readBasis(dict, settings.order, 0, false),
        readBasis(dict, settings.order, 1, ring),
        readBasis(dict, settings.order, 2, false)
    }};
    settings.lattice = std::make_shared<morph::FfdLattice>(basis);

    if (dict.found("weights"))
    {
        std::vector<double> weights(std::size_t(settings.lattice->size()), 1.0);
        const List<Tuple2<labelVector, scalar>> given(dict.lookup("weights"));
        for (const auto& weight : given)
        {
            if (!(weight.second() > 0))
            {
                FatalIOErrorInFunction(dict)
                    << "Entry 'weights': that of point " << weight.first()
                    << " is " << weight.second() << " but has to be positive"
                    << nl << exit(FatalIOError);
            }
            if (settings.numbers(weight.first()).empty())
            {
                FatalIOErrorInFunction(dict)
                    << "Entry 'weights': there is no point " << weight.first()
                    << " in a lattice of order " << settings.order << nl
                    << exit(FatalIOError);
            }
            for (const label i : settings.numbers(weight.first()))
            {
                weights[std::size_t(i)] = weight.second();
            }
        }
        settings.lattice = std::make_shared<morph::FfdLattice>(basis, weights);
    }
    return settings;
}


morph::Vector3 Foam::ffdBoxSettings::rest(const labelVector& point) const
{
    Vector3 xi;
    for (direction d = 0; d < 3; ++d)
    {
        xi[d] = order[d] > 0 ? scalar(point[d])/order[d] : 0.5;
    }
    return xi;
}


Foam::label Foam::ffdBoxSettings::nPoints(const direction d) const
{
    return d == 1 && frame->ring() && order[d] > 0 ? order[d] : order[d] + 1;
}


Foam::labelList Foam::ffdBoxSettings::numbers(const labelVector& point) const
{
    for (direction d = 0; d < 3; ++d)
    {
        if (point[d] < 0 || point[d] >= nPoints(d))
        {
            return labelList();
        }
    }
    labelList numbers
    (
        1, label(lattice->number(point.x(), point.y(), point.z()))
    );
    const bool closes =
        frame->ring() && order.y() > 0 && !lattice->basis(1).periodic();
    if (closes && point.y() == 0)
    {
        numbers.append
        (
            label(lattice->number(point.x(), order.y(), point.z()))
        );
    }
    return numbers;
}


// ************************************************************************* //
