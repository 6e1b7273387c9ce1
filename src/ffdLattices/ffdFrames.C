/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdFrames.H"
#include "coordinateRotation.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "finiteNumbers.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * * * Constants  * * * * * * * * * * * * * * * //

const Foam::Enum<Foam::ffdFrames::boxType> Foam::ffdFrames::boxTypeNames
({
    { boxType::box, "box" },
    { boxType::cylindrical, "cylindrical" },
    { boxType::corners, "corners" },
    { boxType::lattice, "lattice" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;

static vector readSpan(const dictionary& dict)
{
    const vector span(dictionaryChecks::getVector(dict, "span"));
    for (direction d = 0; d < vector::nComponents; ++d)
    {
        if (!(span[d] >= finiteNumbers::least))
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'span' is " << span
                << " but each of its components has to be positive (at least "
                << finiteNumbers::least << ')' << nl
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
            dictionaryChecks::naming
            (
                dict,
                "rotation",
                [&]
                {
                    return coordinateRotation::New
                    (
                        dictionaryChecks::subDict(dict, "rotation")
                    )->R();
                }
            )
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
        toEigen(dictionaryChecks::getVector(dict, "origin")),
        toEigen(readSpan(dict)),
        axes
    );
}


static vector unitVector(const dictionary& dict, const word& key)
{
    const vector v(dictionaryChecks::getVector(dict, key));
    if (!(mag(v) > finiteNumbers::least))
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

    // Angle zero: as given, or the coordinate axis most nearly normal to the
    // axis
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

    vector start(dictionaryChecks::getVector(dict, "start"));
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
        toEigen(dictionaryChecks::getVector(dict, "origin")),
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
    const List<point> given
    (
        dictionaryChecks::getLengths<List<point>>(dict, "corners")
    );
    if (given.size() != 8)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'corners' lists "
            << plainText::counted(given.size(), "point").c_str()
            << " but has to list 8, in the order of blockMesh's hex" << nl
            << exit(FatalIOError);
    }

    // hex numbers the corners around each of two opposite faces
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


} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::ffdFrames::boxType Foam::ffdFrames::readType(const dictionary& dict)
{
    return dictionaryChecks::getChoice
    (
        dict, "type", boxTypeNames, boxType::box
    );
}


Foam::wordList Foam::ffdFrames::keys(const dictionary& dict)
{
    switch (readType(dict))
    {
        case boxType::cylindrical:
            return {"origin", "axis", "direction", "start", "span"};

        case boxType::corners:
            return {"corners"};

        case boxType::lattice:
            return {"file", "block"};

        default:
            return {"origin", "span", "rotation"};
    }
}


std::shared_ptr<const morph::FfdFrame> Foam::ffdFrames::read
(
    const dictionary& dict
)
{
    switch (readType(dict))
    {
        case boxType::cylindrical:
            return readCylindrical(dict);

        case boxType::corners:
            return readCorners(dict);

        default:
            return readBox(dict);
    }
}


// ************************************************************************* //
