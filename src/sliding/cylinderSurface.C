/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cylinderSurface.H"
#include "dictionaryChecks.H"
#include "finiteNumbers.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::word Foam::cylinderSurface::searchableType("searchableCylinder");


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cylinderSurface::cylinderSurface(const dictionary& dict)
:
    origin_(dictionaryChecks::getLengths<point>(dict, "point1")),
    axis_(dictionaryChecks::getLengths<point>(dict, "point2") - origin_),
    radius_(dictionaryChecks::getPositive(dict, "radius"))
{
    dictionaryChecks::onlyKeys(dict, {"type", "point1", "point2", "radius"}, {});
    if (mag(axis_) < finiteNumbers::least)
    {
        FatalIOErrorInFunction(dict)
            << "Entries 'point1' and 'point2' are both " << origin_ << nl
            << "    Give two points of the cylinder's axis" << nl
            << exit(FatalIOError);
    }
    axis_ /= mag(axis_);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::slidingSurface::contact Foam::cylinderSurface::nearest
(
    const point& x
) const
{
    const scalar along = (x - origin_) & axis_;
    vector r = x - origin_ - along*axis_;
    if (mag(r) < SMALL*radius_)
    {
        // On the axis every direction is equally near
        r = axis_ ^ (mag(axis_.x()) < 0.7 ? vector(1, 0, 0) : vector(0, 1, 0));
    }
    const vector n = r/mag(r);
    return {origin_ + along*axis_ + radius_*n, n, false};
}


// ************************************************************************* //
