/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

\*---------------------------------------------------------------------------*/

#include "surfaceNormals.H"
#include "ListOps.H"
#include "PstreamReduceOps.H"

#include <cmath>

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::surfaceNormals::plane Foam::surfaceNormals::planeOf
(
    const vectorField& areas
)
{
    const vector total = gSum(areas);

    // Rounded to well above round-off, so that the order of summation, which
    // is another for each decomposition, leaves no trace
    vector normal = total/max(mag(total), VSMALL);
    for (direction d = 0; d < vector::nComponents; ++d)
    {
        normal[d] = std::ldexp(std::round(std::ldexp(normal[d], 40)), -40);
    }

    scalar sine = 0;
    for (const vector& area : areas)
    {
        const vector tangential = area - (area & normal)*normal;
        sine = max(sine, mag(tangential)/max(mag(area), VSMALL));
    }
    reduce(sine, maxOp<scalar>());

    const bool empty = returnReduce(areas.size(), sumOp<label>()) == 0;
    return {normal, Foam::asin(min(sine, scalar(1))), empty};
}


Foam::List<Foam::vector> Foam::surfaceNormals::distinct
(
    List<vector> normals,
    const scalar featureAngle
)
{
    // One order, whichever rank has which faces
    std::sort
    (
        normals.begin(),
        normals.end(),
        [](const vector& a, const vector& b)
        {
            return std::lexicographical_compare
            (
                a.cdata(), a.cdata() + 3, b.cdata(), b.cdata() + 3
            );
        }
    );

    DynamicList<vector> first, sum;
    for (const vector& n : normals)
    {
        label group = 0;
        while
        (
            group < first.size()
         && mag(n & first[group]) < Foam::cos(featureAngle)
        )
        {
            ++group;
        }
        if (group == first.size())
        {
            first.append(n);
            sum.append(n);
        }
        else
        {
            sum[group] += sign(n & first[group])*n;
        }
    }

    // Those that the ones before do not imply, to within the angle
    DynamicList<vector> independent, orthogonal;
    for (vector n : sum)
    {
        n /= mag(n);
        vector rest = n;
        for (const vector& o : orthogonal)
        {
            rest -= (rest & o)*o;
        }
        if
        (
            independent.size() < 3
         && mag(rest) > 0.5*Foam::sin(featureAngle)
        )
        {
            independent.append(n);
            orthogonal.append(rest/mag(rest));
        }
    }
    return List<vector>(independent);
}


// ************************************************************************* //
