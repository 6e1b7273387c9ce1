/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "polylineDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(polylineDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        polylineDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::polylineDisplacement::polylineDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    tabulatedDisplacement(dict, mesh, {"vertices", "values"}),
    vertices_(dictionaryChecks::getLengths<pointField>(dict, "vertices")),
    values_(dictionaryChecks::getLengths<vectorField>(dict, "values"))
{
    if (vertices_.size() < 2 || values_.size() != vertices_.size())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'vertices' has "
            << plainText::counted(vertices_.size(), "position").c_str()
            << " and 'values' has "
            << plainText::counted(values_.size(), "displacement").c_str() << nl
            << "    Give at least two vertices and one value for each" << nl
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::polylineDisplacement::place Foam::polylineDisplacement::nearest
(
    const point& x
) const
{
    place found{-1, 0, false};
    scalar least = GREAT;
    for (label i = 0; i + 1 < vertices_.size(); ++i)
    {
        const vector edge = vertices_[i + 1] - vertices_[i];
        const scalar along =
            max((x - vertices_[i]) & edge, scalar(0))
           /max(magSqr(edge), VSMALL);
        const scalar t = min(along, scalar(1));
        const scalar distance = mag(x - vertices_[i] - t*edge);
        if (distance < least)
        {
            least = distance;
            found = {i, t, t > 0 && along < 1};
        }
    }
    return found;
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::polylineDisplacement::unscaled
(
    const points& p
) const
{
    auto d = tmp<vectorField>::New(p.positions.size(), Zero);
    forAll(p.positions, i)
    {
        const place at(nearest(p.positions[i]));
        if (at.edge >= 0)
        {
            d.ref()[i] =
                (1 - at.t)*values_[at.edge] + at.t*values_[at.edge + 1];
        }
    }
    return d;
}


Foam::List<Foam::motionParameter>
Foam::polylineDisplacement::tableParameters(const word& group) const
{
    DynamicList<motionParameter> list;
    forAll(values_, i)
    {
        append(list, group + ".values." + Foam::name(i), values_[i]);
    }
    forAll(vertices_, i)
    {
        append(list, group + ".vertices." + Foam::name(i), vertices_[i]);
    }
    return List<motionParameter>(list);
}


Foam::tmp<Foam::vectorField> Foam::polylineDisplacement::tableDerivative
(
    const points& p,
    const label parameteri
) const
{
    const vector e(unit(parameteri % vector::nComponents));
    const label row = parameteri/vector::nComponents;
    const bool ofVertex = row >= values_.size();
    const label vertexi = ofVertex ? row - values_.size() : row;

    auto d = tmp<vectorField>::New(p.positions.size(), Zero);
    forAll(p.positions, i)
    {
        const place at(nearest(p.positions[i]));
        const bool ofEnd = vertexi == at.edge + 1;
        if (at.edge < 0 || (vertexi != at.edge && !ofEnd))
        {
            continue;
        }
        if (!ofVertex)
        {
            d.ref()[i] = (ofEnd ? at.t : 1 - at.t)*e;
        }
        else if (at.inside)
        {
            // Of t = (x - a) . (b - a)/|b - a|^2
            const point& a = vertices_[at.edge];
            const vector edge = vertices_[at.edge + 1] - a;
            const vector off = p.positions[i] - a;
            const vector dt =
                ofEnd ? off - 2*at.t*edge : (2*at.t - 1)*edge - off;
            d.ref()[i] =
                (dt & e)/magSqr(edge)
               *(values_[at.edge + 1] - values_[at.edge]);
        }
    }
    return d;
}


// ************************************************************************* //
