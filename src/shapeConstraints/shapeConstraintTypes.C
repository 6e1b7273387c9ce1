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

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

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
                directions.size() == 1 ? word() : word(vector::componentNames[d])
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


// ************************************************************************* //
