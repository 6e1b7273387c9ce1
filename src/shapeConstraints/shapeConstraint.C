/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "shapeConstraint.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "OSspecific.H"
#include "triSurface.H"
#include "triSurfaceSearch.H"

#include <memory>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::shapeConstraint::constraintType>
Foam::shapeConstraint::typeNames
({
    { constraintType::thickness, "thickness" },
    { constraintType::thicknessToChord, "thicknessToChord" },
    { constraintType::edge, "edge" },
    { constraintType::curvature, "curvature" },
    { constraintType::projectedArea, "projectedArea" },
    { constraintType::wettedArea, "wettedArea" },
    { constraintType::distance, "distance" },
    { constraintType::volume, "volume" },
    { constraintType::barycentre, "barycentre" },
    { constraintType::mean, "mean" },
    { constraintType::linear, "linear" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static word axisName(const label d)
{
    return d == 0 ? "x" : d == 1 ? "y" : "z";
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::shapeConstraint::shapeConstraint
(
    const dictionary& dict,
    const morph::Vectors& points,
    const morph::Triangles& triangles,
    const bool closed
)
:
    dict_(dict),
    name_(dict.dictName()),
    type_(dictionaryChecks::getChoice(dict, "type", typeNames)),
    min_(dictionaryChecks::getNumber(dict, "min", -GREAT)),
    max_(dictionaryChecks::getNumber(dict, "max", GREAT)),
    relative_(dict.getOrDefault<bool>("relative", false))
{
    dictionaryChecks::onlyKeys(dict, keys());
    if (max_ < min_)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'max' is " << max_ << ", which is less than 'min', "
            << min_ << nl << exit(FatalIOError);
    }
    read(points, triangles, closed);

    forAll(names_, i)
    {
        before_.append(functions_[std::size_t(i)](points).value);
        if (relative_ && !(mag(before_[i]) > VSMALL))
        {
            FatalIOErrorInFunction(dict)
                << "Constraint '" << names_[i] << "' is zero before anything"
                << " moves: it cannot be relative to that" << nl
                << "    Remove 'relative' and give its bounds as they are" << nl
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::wordList Foam::shapeConstraint::keys() const
{
    wordList keys({"type", "min", "max", "relative"});
    switch (type_)
    {
        case constraintType::thickness:
            keys.append(wordList({"stations", "direction"}));
            break;

        case constraintType::thicknessToChord:
            keys.append
            (
                wordList({"stations", "direction", "leading", "trailing"})
            );
            break;

        case constraintType::edge:
            keys.append(wordList({"points", "direction"}));
            break;

        case constraintType::projectedArea:
        case constraintType::barycentre:
        case constraintType::mean:
            keys.append("direction");
            break;

        case constraintType::wettedArea:
            keys.append(wordList({"point", "normal"}));
            break;

        case constraintType::linear:
            keys.append(wordList({"points", "coefficients"}));
            break;

        case constraintType::distance:
            keys.append("surface");
            break;

        default:
            break;
    }
    return keys;
}


void Foam::shapeConstraint::add(const word& suffix, const function& f)
{
    names_.append(suffix.empty() ? name_ : word(name_ + '.' + suffix));
    functions_.push_back(f);
}


Foam::vector Foam::shapeConstraint::readDirection(const word& key) const
{
    const vector v(dictionaryChecks::getVector(dict_, key));
    if (!(mag(v) > VSMALL))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry '" << key << "' is " << v
            << " but has to be a direction" << nl << exit(FatalIOError);
    }
    return v/mag(v);
}


Foam::vectorList Foam::shapeConstraint::readDirections() const
{
    if (dict_.found("direction"))
    {
        return vectorList(1, readDirection("direction"));
    }
    return vectorList({vector(1, 0, 0), vector(0, 1, 0), vector(0, 0, 1)});
}


void Foam::shapeConstraint::readThickness
(
    const morph::Vectors& points,
    const morph::Triangles& triangles
)
{
    const bool toChord = type_ == constraintType::thicknessToChord;
    const List<point> stations(dict_.lookup("stations"));
    const morph::Vector3 direction = toEigen(readDirection("direction"));
    List<point> leading, trailing;
    if (toChord)
    {
        leading = List<point>(dict_.lookup("leading"));
        trailing = List<point>(dict_.lookup("trailing"));
        if (leading.size() != stations.size()
         || trailing.size() != stations.size())
        {
            FatalIOErrorInFunction(dict_)
                << "Entries 'stations', 'leading' and 'trailing' list "
                << stations.size() << ", " << leading.size() << " and "
                << trailing.size() << " points" << nl
                << "    Give a leading and a trailing one for each station"
                << nl << exit(FatalIOError);
        }
    }
    forAll(stations, i)
    {
        morph::SurfacePlace below, above;
        const bool within = morph::placesOnLine
        (
            points, triangles, toEigen(stations[i]), direction, below, above
        );
        if (!within)
        {
            FatalIOErrorInFunction(dict_)
                << "Entry 'stations': the line through " << stations[i]
                << " along " << toFoam(direction)
                << " does not meet the surface on both sides" << nl
                << "    Stations have to be within the body" << nl
                << exit(FatalIOError);
        }
        function f = [=](const morph::Vectors& x)
        {
            return morph::distance(x, below, above);
        };
        if (toChord)
        {
            const auto front = morph::nearestPlace
            (
                points, triangles, toEigen(leading[i])
            );
            const auto rear = morph::nearestPlace
            (
                points, triangles, toEigen(trailing[i])
            );
            f = [=](const morph::Vectors& x)
            {
                auto result = morph::distance(x, below, above);
                const auto chord = morph::distance(x, front, rear);
                if (!(chord.value > 0))
                {
                    return morph::ShapeValue();
                }
                const scalar t = result.value;
                result.value /= chord.value;
                for (auto& term : result.gradient)
                {
                    term.second /= chord.value;
                }
                for (const auto& term : chord.gradient)
                {
                    result.gradient.emplace_back
                    (
                        term.first, -t/sqr(chord.value)*term.second
                    );
                }
                return result;
            };
        }
        add(Foam::name(i), f);
    }
}


void Foam::shapeConstraint::readEdge
(
    const morph::Vectors& points,
    const morph::Triangles& triangles
)
{
    const List<point> given(dict_.lookup("points"));
    const vectorList directions(readDirections());
    forAll(given, i)
    {
        const auto place = morph::nearestPlace
        (
            points, triangles, toEigen(given[i])
        );
        const morph::Vector3 rest = place.position(points);
        forAll(directions, d)
        {
            const morph::Vector3 direction = toEigen(directions[d]);
            const word suffix
            (
                directions.size() == 1 ? word() : axisName(d)
            );
            add
            (
                Foam::name(i) + suffix,
                [=](const morph::Vectors& x)
                {
                    auto result = morph::component(x, place, direction);
                    result.value = direction.dot(place.position(x) - rest);
                    return result;
                }
            );
        }
    }
}


void Foam::shapeConstraint::readLinear
(
    const morph::Vectors& points,
    const morph::Triangles& triangles
)
{
    const List<point> given(dict_.lookup("points"));
    const List<vector> coefficients(dict_.lookup("coefficients"));
    if (given.empty() || coefficients.size() != given.size())
    {
        FatalIOErrorInFunction(dict_)
            << "Entries 'points' and 'coefficients' list " << given.size()
            << " and " << coefficients.size() << " vectors" << nl
            << "    Give at least one point, and coefficients for each" << nl
            << exit(FatalIOError);
    }
    std::vector<std::pair<morph::SurfacePlace, morph::Vector3>> terms;
    forAll(given, i)
    {
        terms.emplace_back
        (
            morph::nearestPlace(points, triangles, toEigen(given[i])),
            toEigen(coefficients[i])
        );
    }
    add
    (
        "",
        [terms](const morph::Vectors& x)
        {
            morph::ShapeValue sum;
            for (const auto& term : terms)
            {
                const auto one = morph::component(x, term.first, term.second);
                sum.value += one.value;
                sum.gradient.insert
                (
                    sum.gradient.end(),
                    one.gradient.begin(), one.gradient.end()
                );
            }
            return sum;
        }
    );
}


void Foam::shapeConstraint::readDistance()
{
    fileName file(dict_.get<fileName>("surface"));
    file.expand();
    if (!isFile(file))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'surface': there is no file " << file << nl
            << "    Give the path of one" << nl << exit(FatalIOError);
    }
    const auto other = std::make_shared<triSurface>(file);
    if (other->empty())
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'surface': " << file << " is empty" << nl
            << exit(FatalIOError);
    }
    const auto search = std::make_shared<triSurfaceSearch>(*other);
    add
    (
        "",
        [other, search](const morph::Vectors& x)
        {
            morph::ShapeValue result;
            scalar least = GREAT;
            for (Eigen::Index i = 0; i < x.rows(); ++i)
            {
                const point at(toFoam(x.row(i).transpose()));
                const pointIndexHit hit
                (
                    search->tree().findNearest(at, sqr(least))
                );
                const scalar distance =
                    hit.hit() ? mag(at - hit.hitPoint()) : GREAT;
                if (distance < least)
                {
                    least = distance;
                    result.gradient =
                    {{
                        i,
                        toEigen((at - hit.hitPoint())/Foam::max(distance, VSMALL))
                    }};
                }
            }
            result.value = least;
            return result;
        }
    );
}


void Foam::shapeConstraint::read
(
    const morph::Vectors& points,
    const morph::Triangles& triangles,
    const bool closed
)
{
    const bool encloses =
        type_ == constraintType::volume || type_ == constraintType::barycentre;
    if (encloses && !closed)
    {
        FatalIOErrorInFunction(dict_)
            << "Constraint '" << name_ << "' is a " << typeNames[type_]
            << ", but the surface is open: it encloses nothing" << nl
            << "    Add the patches that close it" << nl
            << exit(FatalIOError);
    }
    switch (type_)
    {
        case constraintType::thickness:
        case constraintType::thicknessToChord:
            readThickness(points, triangles);
            break;

        case constraintType::edge:
            readEdge(points, triangles);
            break;

        case constraintType::curvature:
        {
            const auto hinges = morph::hinges(triangles);
            add
            (
                "",
                [hinges](const morph::Vectors& x)
                {
                    return morph::bending(x, hinges);
                }
            );
            break;
        }

        case constraintType::projectedArea:
        {
            const morph::Vector3 d = toEigen(readDirection("direction"));
            add
            (
                "",
                [triangles, d](const morph::Vectors& x)
                {
                    return morph::projectedArea(x, triangles, d);
                }
            );
            break;
        }

        case constraintType::wettedArea:
        {
            morph::Vector3 origin(morph::Vector3::Zero());
            morph::Vector3 normal(morph::Vector3::Zero());
            if (dict_.found("point") || dict_.found("normal"))
            {
                origin = toEigen(dictionaryChecks::getVector(dict_, "point"));
                normal = toEigen(readDirection("normal"));
            }
            add
            (
                "",
                [=](const morph::Vectors& x)
                {
                    return morph::wettedArea(x, triangles, origin, normal);
                }
            );
            break;
        }

        case constraintType::distance:
            readDistance();
            break;

        case constraintType::volume:
            add
            (
                "",
                [triangles](const morph::Vectors& x)
                {
                    return morph::volume(x, triangles);
                }
            );
            break;

        case constraintType::linear:
            readLinear(points, triangles);
            break;

        case constraintType::mean:
        {
            const vectorList directions(readDirections());
            forAll(directions, i)
            {
                const morph::Vector3 d = toEigen(directions[i]);
                add
                (
                    directions.size() == 1 ? word() : axisName(i),
                    [d](const morph::Vectors& x)
                    {
                        morph::ShapeValue mean;
                        const scalar n = x.rows();
                        mean.value = (x*d).sum()/n;
                        for (Eigen::Index j = 0; j < x.rows(); ++j)
                        {
                            mean.gradient.emplace_back(j, d/n);
                        }
                        return mean;
                    }
                );
            }
            break;
        }

        case constraintType::barycentre:
        {
            const vectorList directions(readDirections());
            forAll(directions, i)
            {
                const morph::Vector3 d = toEigen(directions[i]);
                add
                (
                    directions.size() == 1 ? word() : axisName(i),
                    [triangles, d](const morph::Vectors& x)
                    {
                        return morph::barycentre(x, triangles, d);
                    }
                );
            }
            break;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

std::vector<morph::ShapeValue> Foam::shapeConstraint::values
(
    const morph::Vectors& points
) const
{
    std::vector<morph::ShapeValue> result;
    for (std::size_t i = 0; i < functions_.size(); ++i)
    {
        result.push_back(functions_[i](points));
        if (relative_)
        {
            const scalar scale = 1/before_[label(i)];
            result.back().value *= scale;
            for (auto& term : result.back().gradient)
            {
                term.second *= scale;
            }
        }
    }
    return result;
}


// ************************************************************************* //
