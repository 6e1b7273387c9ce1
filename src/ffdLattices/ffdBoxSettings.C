/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBoxSettings.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "ffdFrames.H"
#include "ffdLatticeFile.H"
#include "ListOps.H"
#include "splineFrame.hpp"
#include "Tuple2.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

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


const Foam::Enum<Foam::ffdBoxSettings::formType>
Foam::ffdBoxSettings::formTypeNames
({
    { formType::displacement, "displacement" },
    { formType::position, "position" }
});


const Foam::wordList Foam::ffdBoxSettings::continuityNames
({
    "none", "C0", "C1", "C2"
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The entries that all boxes have, and those of the frame
static void checkKeys(const dictionary& dict)
{
    const wordList always
    ({
        "type", "order", "basis", "form", "units", "continuity", "weights"
    });
    dictionaryChecks::checkValues(dict, always);
    wordList keys(ffdFrames::keys(dict));
    keys.append(always);
    if (dict.getOrDefault<word>("basis", "bernstein") == "bSpline")
    {
        keys.append("degree");
    }
    wordList values(keys);
    inplaceSubsetList
    (
        values,
        [](const word& key) { return key != "rotation" && key != "axis"; }
    );
    dictionaryChecks::checkValues(dict, values);
    keys.append(wordList({"parameters", "bulk", "axis", "parent"}));
    dictionaryChecks::onlyKeys(dict, keys);
}


// The basis of a direction with L + 1 control points; in a ring, the first and
// the last coincide
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


// Binomial coefficients of products of three polynomials of a higher order are
// infinite, and more points would not fit into memory
static void checkSize(const dictionary& dict, const labelVector& order)
{
    const scalar most = 3e5;
    const label mostBernstein = 100;
    const bool spline =
        dict.getOrDefault<word>("basis", "bernstein") == "bSpline";
    const scalar n =
        (scalar(order.x()) + 1)*(scalar(order.y()) + 1)*(scalar(order.z()) + 1);
    if (n > most || (!spline && cmptMax(order) > mostBernstein))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'order' is " << order << ", but it may be at most "
            << mostBernstein << " with Bernstein polynomials," << nl
            << "    and there may be at most " << most
            << " control points" << nl
            << "    Use 'basis bSpline' with a small degree for fine lattices"
            << nl << exit(FatalIOError);
    }
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
    checkSize(dict, order);
    return order;
}


// The map of the position form: the volume that control points span
static std::shared_ptr<const morph::FfdFrame> splineFrame
(
    const dictionary& dict,
    const std::array<morph::BSpline, 3>& basis,
    const morph::Vectors& controlPoints
)
{
    if (dict.found("weights"))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'weights' has no meaning where control points span the"
            << " box themselves" << nl
            << "    Remove it, or use a box with 'form displacement'" << nl
            << exit(FatalIOError);
    }
    for (const morph::BSpline& one : basis)
    {
        if (one.size() < 2)
        {
            FatalIOErrorInFunction(dict)
                << "With 'form position' every component of 'order' has to be"
                << " one at least" << nl
                << "    Control points span the box themselves" << nl
                << exit(FatalIOError);
        }
    }
    try
    {
        return std::make_shared<morph::SplineFrame>(basis, controlPoints);
    }
    catch (const std::invalid_argument& wrong)
    {
        FatalIOErrorInFunction(dict)
            << "Box '" << dict.dictName() << "': " << wrong.what() << nl
            << exit(FatalIOError);
    }
    return nullptr;
}


static morph::Vectors restPositions
(
    const ffdBoxSettings& settings,
    const morph::FfdLattice& lattice
)
{
    morph::Vectors points(lattice.size(), 3);
    labelVector p;
    for (p.z() = 0; p.z() <= settings.order.z(); ++p.z())
    {
        for (p.y() = 0; p.y() <= settings.order.y(); ++p.y())
        {
            for (p.x() = 0; p.x() <= settings.order.x(); ++p.x())
            {
                points.row(lattice.number(p.x(), p.y(), p.z())) =
                    settings.frame->position(settings.rest(p)).transpose();
            }
        }
    }
    return points;
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
            << plainText::listed(ffdBoxSettings::continuityNames).c_str() << nl
            << exit(FatalIOError);
    }
    return layers;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::ffdBoxSettings Foam::ffdBoxSettings::read(const dictionary& dict)
{
    checkKeys(dict);
    ffdBoxSettings settings;
    const bool fromFile =
        ffdFrames::readType(dict) == ffdFrames::boxType::lattice;
    pointField controlPoints;
    if (fromFile)
    {
        const ffdLatticeFile file(dict);
        settings.order = file.order();
        controlPoints = file.points();
        checkSize(dict, settings.order);
    }
    else
    {
        settings.frame = ffdFrames::read(dict);
        settings.order = readOrder(dict);
    }
    settings.units = dictionaryChecks::getChoice
    (
        dict,
        "units",
        unitTypeNames,
        fromFile ? unitType::metres : unitType::box
    );
    settings.frozenLayers = readContinuity(dict);

    const bool ring = !fromFile && settings.frame->ring();
    const std::array<morph::BSpline, 3> basis
    {{
        readBasis(dict, settings.order, 0, false),
        readBasis(dict, settings.order, 1, ring),
        readBasis(dict, settings.order, 2, false)
    }};
    const bool position = dictionaryChecks::getChoice
    (
        dict, "form", formTypeNames, formType::displacement
    ) == formType::position;
    if (fromFile)
    {
        settings.frame = splineFrame(dict, basis, asVectors(controlPoints));
    }
    else if (position)
    {
        if (settings.frame->radial())
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'form' is position, which cylindrical boxes do not"
                << " have" << nl
                << "    Remove it, or use a box of type corners or lattice"
                << nl << exit(FatalIOError);
        }
        settings.frame = splineFrame
        (
            dict,
            basis,
            restPositions(settings, morph::FfdLattice(basis))
        );
    }
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
    morph::Vector3 xi;
    for (direction d = 0; d < 3; ++d)
    {
        xi[d] = order[d] > 0 ? scalar(point[d])/order[d] : 0.5;
    }
    return xi;
}


morph::Vector3 Foam::ffdBoxSettings::restPosition
(
    const labelVector& point
) const
{
    const morph::Vectors* points = frame->controlPoints();
    return
        points
      ? morph::Vector3
        (
            points->row
            (
                lattice->number(point.x(), point.y(), point.z())
            ).transpose()
        )
      : frame->position(rest(point));
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
