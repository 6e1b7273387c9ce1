/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdAxisDeformation.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "ListOps.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdAxisDeformation::ffdAxisDeformation
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    ffdDeformation(dict),
    axis_(dict, parameters_, registry)
{
    wordList keys(ffdAxis::keys());
    keys.append("type");
    dictionaryChecks::onlyKeys(dict, keys);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::ffdAxisDeformation::update()
{
    axis_.update(parameters_);
}


Foam::pointField Foam::ffdAxisDeformation::lattice(const bool moved) const
{
    return axis_.shown(moved);
}


Foam::labelListList Foam::ffdAxisDeformation::latticeLines() const
{
    return labelListList(1, identity(axis_.shown(false).size()));
}


void Foam::ffdAxisDeformation::setPoints(const pointField& points)
{
    inside_ = identity(points.size());
    scalar least = GREAT;
    scalar most = -GREAT;
    for (const point& x : points)
    {
        const scalar u = axis_.axis().fraction(toEigen(x));
        least = min(least, u);
        most = max(most, u);
    }
    axis_.checkMet(least, most);
}


Foam::vectorField Foam::ffdAxisDeformation::displacement
(
    const pointField& points
) const
{
    vectorField d(points.size());
    forAll(points, i)
    {
        const morph::Vector3 x = toEigen(points[i]);
        const scalar u = axis_.axis().fraction(x);
        const auto section = axis_.section(u);
        d[i] = toFoam
        (
            section.shift + section.change*(x - axis_.axis().at(u))
        );
    }
    return d;
}


Foam::vectorField Foam::ffdAxisDeformation::derivative
(
    const pointField& points,
    const label parameteri
) const
{
    vectorField d(points.size());
    forAll(points, i)
    {
        const morph::Vector3 x = toEigen(points[i]);
        const scalar u = axis_.axis().fraction(x);
        const auto section = axis_.byParameter(u, parameteri);
        d[i] = toFoam
        (
            section.shift + section.change*(x - axis_.axis().at(u))
        );
    }
    return d;
}


Foam::vectorField Foam::ffdAxisDeformation::directional
(
    const pointField& points,
    const vectorField& v
) const
{
    const morph::SectionAxis& axis = axis_.axis();
    vectorField d(points.size());
    forAll(points, i)
    {
        const morph::Vector3 x = toEigen(points[i]);
        const morph::Vector3 velocity = toEigen(v[i]);
        const scalar u = axis.fraction(x);
        const scalar rate = axis.rate(velocity);
        const auto slope = axis_.byFraction(u);
        d[i] = toFoam
        (
            rate*(slope.shift + slope.change*(x - axis.at(u)))
          + axis_.section(u).change*(velocity - rate*axis.slope(u))
        );
    }
    return d;
}


// ************************************************************************* //
