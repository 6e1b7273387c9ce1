/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfaceNormals.H"
#include "eigenFields.H"
#include "ListOps.H"
#include "PstreamReduceOps.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Sine of the angle below which opposite normals belong to one plane
static const scalar opposite = 0.02;

// Sine of the angle below which two edges of a face are nearly in line
static const scalar straight = 0.8;


static bool taggedBefore
(
    const surfaceNormals::taggedNormal& a,
    const surfaceNormals::taggedNormal& b
)
{
    return
        a.normal == b.normal
      ? a.surface < b.surface
      : before(a.normal, b.normal);
}


// Sine of the largest angle between faces and a plane
static scalar tilt(const vectorField& areas, const vector& normal)
{
    scalar sine = 0;
    for (const vector& area : areas)
    {
        const vector tangential = area - (area & normal)*normal;
        sine = max(sine, mag(tangential)/max(mag(area), VSMALL));
    }
    return sine;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::vector Foam::surfaceNormals::rounded(const vector& total)
{
    vector normal = total/max(mag(total), VSMALL);
    for (scalar& component : normal)
    {
        component = std::ldexp(std::round(std::ldexp(component, 40)), -40);
    }
    return normal;
}


Foam::vector Foam::surfaceNormals::withoutLastBits(vector v)
{
    // The factor keeps lengths away from powers of two, where the spacing of
    // numbers jumps
    const int exponent = 46 - std::ilogb(max(1.3*mag(v), VSMALL));
    for (scalar& component : v)
    {
        component = std::ldexp
        (
            std::round(std::ldexp(component, exponent)), -exponent
        );
    }
    return v;
}


Foam::surfaceNormals::plane Foam::surfaceNormals::planeOf
(
    const vectorField& areas
)
{
    const vector normal = rounded(gSum(areas));
    const scalar sine = returnReduce(tilt(areas, normal), maxOp<scalar>());
    const bool empty = returnReduce(areas.size(), sumOp<label>()) == 0;
    return {normal, Foam::asin(min(sine, scalar(1))), empty};
}


Foam::surfaceNormals::plane Foam::surfaceNormals::planeThrough
(
    const vectorField& areas
)
{
    vector total(Zero);
    for (const vector& area : areas)
    {
        total += (area & total) < 0 ? -area : area;
    }
    const vector normal = rounded(total);
    const scalar sine = tilt(areas, normal);
    return {normal, Foam::asin(min(sine, scalar(1))), areas.empty()};
}


Foam::vector Foam::surfaceNormals::cornerNormal
(
    const vector& a,
    const vector& b,
    const vector& area
)
{
    // A face without area has no direction
    const scalar size = mag(a)*mag(b);
    if (size < VSMALL || mag(area) < 1e-12*size)
    {
        return Zero;
    }
    const vector unit = area/mag(area);
    const vector between = (a ^ b)/size;

    // Between two nearly collinear edges a corner of the face cannot be
    // distinguished from one of the surface: use the direction of the whole
    // face
    const scalar sine = mag(between);
    const vector n = sine > straight ? between : max(sine, 1e-6)*unit;
    return ((n & unit) < 0 ? -n : n)/size;
}


Foam::List<Foam::surfaceNormals::taggedNormal> Foam::surfaceNormals::distinct
(
    List<taggedNormal> normals,
    const scalar featureAngle
)
{
    // Faces without area have none
    inplaceSubsetList
    (
        normals,
        [](const taggedNormal& n) { return mag(n.normal) > 0; }
    );

    // One order, whichever rank has which faces
    std::sort(normals.begin(), normals.end(), taggedBefore);

    DynamicList<taggedNormal> first;
    DynamicList<vector> sum;
    for (const taggedNormal& n : normals)
    {
        const vector unit = n.normal/mag(n.normal);
        label group = 0;
        while
        (
            group < first.size()
         && (unit & first[group].normal) < Foam::cos(featureAngle)
        )
        {
            ++group;
        }
        if (group == first.size())
        {
            first.append({unit, n.surface});
            sum.append(n.normal);
        }
        else
        {
            first[group].surface = min(first[group].surface, n.surface);
            sum[group] += n.normal;
        }
    }

    // Keep those that differ from the preceding ones by more than the angle
    DynamicList<taggedNormal> independent;
    DynamicList<vector> orthogonal;
    forAll(sum, i)
    {
        const vector n = sum[i]/mag(sum[i]);
        vector rest = n;
        for (const vector& o : orthogonal)
        {
            rest -= (rest & o)*o;
        }
        const scalar least =
            orthogonal.size() == 1 ? opposite : 0.5*Foam::sin(featureAngle);
        if (independent.size() < 3 && mag(rest) > least)
        {
            independent.append({n, first[i].surface});
            orthogonal.append(rest/mag(rest));
        }
    }
    return List<taggedNormal>(independent);
}


// ************************************************************************* //
