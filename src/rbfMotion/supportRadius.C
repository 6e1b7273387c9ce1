/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "supportRadius.H"
#include "boundBox.H"
#include "eigenFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Smallest factor by which the radius grows: every new radius needs a new
// selection
static const scalar growth = 1.5;

// Points that move by less than this, in largest displacements, count as fixed:
// their displacement is round-off
static const scalar atRest = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::supportRadius::supportRadius
(
    const rbfMotionSettings& settings,
    const scalar former
)
:
    settings_(settings),
    value_(settings.supportRadius > 0 ? settings.supportRadius : former)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::supportRadius::needed
(
    const rbfControlPoints& controlPoints
) const
{
    if (settings_.supportRadius > 0)
    {
        return settings_.supportRadius;
    }

    scalar largest = 0;
    for (label regioni = 0; regioni < controlPoints.nRegions(); ++regioni)
    {
        largest = max(largest, controlPoints.largestValue(regioni));
    }

    scalar span = 0;
    for (label regioni = 0; regioni < controlPoints.nRegions(); ++regioni)
    {
        boundBox moving;
        for
        (
            const morph::ControlPoint& p
          : controlPoints.candidates(regioni).conditions
        )
        {
            if (p.g().norm() > atRest*largest)
            {
                moving.add(toFoam(p.position));
            }
        }
        moving.reduce();
        span = max(span, moving.valid() ? moving.mag() : 0);
    }
    return max
    (
        settings_.supportRadiusFactor*largest,
        settings_.supportRadiusSpans*span
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::supportRadius::provide(const scalar span)
{
    if (value_ == 0)
    {
        value_ = settings_.supportRadiusSpans*span;
    }
    return value_ > 0;
}


bool Foam::supportRadius::update(const rbfControlPoints& controlPoints)
{
    const scalar former = value_;
    const scalar least = needed(controlPoints);
    if (least > former)
    {
        value_ = max(least, growth*former);
    }
    return value_ != former;
}


// ************************************************************************* //
