/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "wallAccuracy.H"
#include "firstCells.H"
#include "plainText.H"
#include "StringStream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// An error above this part of the height of a first cell is one that the cell
// notices: a shear of six degrees
static const scalar noticed = 0.1;

// Part of that height that a selection is asked for
static const scalar ofHeight = 0.05;

// Bounds of the tolerance, in largest displacements. Below the lower one the
// correction is cheaper than more points, and the field does not get better
static const scalar least = 1e-3;
static const scalar leastUncorrected = 1e-5;
static const scalar most = 1e-2;

// A selection is kept until an error exceeds so many tolerances
static const scalar kept = noticed/ofHeight;

// Of rough fields: the tolerance, and the points from which on it applies, by
// number and of all. Without the number a small mesh would count as rough
static const scalar rough = 4e-2;
static const label roughPoints = 500;
static const scalar roughShare = 0.05;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::wallAccuracy::wallAccuracy
(
    const polyMesh& mesh,
    const pointField& points0,
    const rbfMotionSettings& settings,
    const label nRegions
)
:
    mesh_(mesh),
    points0_(points0),
    settings_(settings),
    tolerance_(nRegions, settings.selection.tolerance),
    corrects_
    (
        nRegions,
        settings.surfaceCorrection == rbfMotionSettings::correctionPolicy::yes
    ),
    told_(nRegions)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallAccuracy::findHeights(const rbfControlPoints& controlPoints)
{
    const firstCells cells(mesh_, points0_);
    height_.setSize(corrects_.size());
    forAll(height_, regioni)
    {
        height_[regioni] =
            cells.least(controlPoints.candidates(regioni).meshPoints);
    }
}


Foam::scalar Foam::wallAccuracy::tolerance
(
    const label regioni,
    const scalar largest,
    string& why
) const
{
    typedef rbfMotionSettings::correctionPolicy policy;
    const scalar lower =
        settings_.surfaceCorrection == policy::no ? leastUncorrected : least;
    const scalar height = height_[regioni];
    const scalar wanted = ofHeight*height;
    OStringStream reason;
    reason.precision(3);
    scalar tolerance = wanted;
    if (height == GREAT)
    {
        reason << lower << " of the largest displacement";
        tolerance = lower*largest;
    }
    else if (wanted < lower*largest)
    {
        reason
            << lower << " of the largest displacement, more than " << ofHeight
            << " of the first cells' height of " << height << " m";
        tolerance = lower*largest;
    }
    else if (wanted > most*largest)
    {
        reason
            << most << " of the largest displacement, less than " << ofHeight
            << " of the first cells' height of " << height << " m";
        tolerance = most*largest;
    }
    else
    {
        reason
            << ofHeight << " of the first cells' height of " << height << " m";
    }
    why = reason.str();
    return tolerance;
}


void Foam::wallAccuracy::tell
(
    const label regioni,
    const scalar tolerance,
    const string& why
)
{
    if (told_[regioni] != why)
    {
        told_[regioni] = word(why, false);
        Info<< "rbfMotionSolver: tolerance "
            << plainText::rounded(tolerance).c_str() << " m, "
            << why.c_str() << endl;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallAccuracy::update
(
    const rbfControlPoints& controlPoints,
    const boolList& moves
)
{
    typedef rbfMotionSettings::correctionPolicy policy;
    const bool decides =
        settings_.surfaceCorrection == policy::automatic
     && !settings_.selection.all;
    if (!decides && !automatic())
    {
        return;
    }
    forAll(corrects_, regioni)
    {
        const bool former = corrects_[regioni];
        if (!moves[regioni])
        {
            corrects_[regioni] = former && !decides;
            continue;
        }
        if (height_.empty())
        {
            findHeights(controlPoints);
        }
        const scalar largest = controlPoints.largestValue(regioni);
        const scalar height = height_[regioni];
        if (automatic())
        {
            string why;
            const scalar length = tolerance(regioni, largest, why);
            tolerance_[regioni] = length/largest;
            tell(regioni, length, why);
        }
        const scalar length = tolerance_[regioni]*largest;
        if (decides)
        {
            corrects_[regioni] = length > noticed*height;
            if (corrects_[regioni] && !former)
            {
                Info<< "rbfMotionSolver: the first cells, " << height
                    << " m high, would notice the tolerance of " << length
                    << " m: surfaceCorrection is on" << endl;
            }
        }
    }
}


morph::SelectionSettings Foam::wallAccuracy::selection
(
    const label regioni
) const
{
    morph::SelectionSettings selection(settings_.selection);
    if (automatic())
    {
        selection.tolerance = tolerance_[regioni];
        selection.keep = kept;
        if
        (
            settings_.surfaceCorrection
         != rbfMotionSettings::correctionPolicy::no
        )
        {
            selection.roughTolerance = rough;
            selection.roughPoints = roughPoints;
            selection.roughShare = roughShare;
        }
    }
    return selection;
}


// ************************************************************************* //
