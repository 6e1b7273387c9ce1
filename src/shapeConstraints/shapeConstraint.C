/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "shapeConstraint.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "OSspecific.H"

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
                    directions.size() == 1 ? word() : word(vector::componentNames[i]),
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
                    directions.size() == 1 ? word() : word(vector::componentNames[i]),
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
