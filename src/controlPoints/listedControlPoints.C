/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "listedControlPoints.H"
#include "eigenFields.H"
#include "positionTable.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Listed points closer to a mesh point than this, in units of the mesh's size,
// are that point
static const scalar samePlace = 1e-8;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::listedControlPoints::listedControlPoints
(
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const planarReduction& plane
)
:
    points0_(points0),
    groups_(groups),
    plane_(plane),
    twins_(groups.size())
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::boolList Foam::listedControlPoints::firstAtPosition
(
    const pointField& positions,
    const labelList& groupOf,
    const labelList& placeOf
)
{
    labelList order(identity(positions.size()));
    std::sort
    (
        order.begin(),
        order.end(),
        [&](const label a, const label b)
        {
            const point& x = positions[a];
            const point& y = positions[b];
            return
                x != y
              ? before(x, y)
              : a < b;
        }
    );

    boolList first(positions.size(), true);
    label former = -1;
    for (const label i : order)
    {
        if (former < 0 || positions[i] != positions[former])
        {
            former = i;
            continue;
        }

        // In the order of the groups: the first is in the earlier one
        first[i] = false;
        if (groupOf[i] == groupOf[former])
        {
            twins_[groupOf[i]].append(placeOf[former]);
            twins_[groupOf[i]].append(placeOf[i]);
        }
    }
    return first;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::listedControlPoints::assign(labelList& group, labelList& listed)
{
    DynamicList<point> all;
    DynamicList<label> groupOf, placeOf;
    forAll(groups_, groupi)
    {
        const pointField& x = groups_[groupi].listed();
        forAll(x, i)
        {
            all.append(plane_.position(x[i]));
            groupOf.append(groupi);
            placeOf.append(i);
        }
    }
    if (all.empty())
    {
        return;
    }

    const boolList first
    (
        firstAtPosition(pointField(all), groupOf, placeOf)
    );
    inplaceSubset(first, all);
    inplaceSubset(first, groupOf);
    inplaceSubset(first, placeOf);

    const pointField positions(all);
    const positionTable table(positions);
    const scalar tolerance = samePlace*boundBox(points0_, true).mag();
    boolList onMesh(positions.size(), false);
    forAll(points0_, pointi)
    {
        const label i =
            table.find(plane_.position(points0_[pointi]), tolerance);
        if (i >= 0)
        {
            onMesh[i] = true;
            if (groupOf[i] <= group[pointi])
            {
                group[pointi] = groupOf[i];
                listed[pointi] = placeOf[i];
            }
        }
    }

    Pstream::listCombineGather(onMesh, orEqOp<bool>());
    if (Pstream::master())
    {
        forAll(onMesh, i)
        {
            if (!onMesh[i])
            {
                group_.append(groupOf[i]);
                place_.append(placeOf[i]);
            }
        }
    }
}


Foam::point Foam::listedControlPoints::position(const label i) const
{
    return groups_[group_[i]].listed()[place_[i]];
}


void Foam::listedControlPoints::checkTwins() const
{
    forAll(twins_, groupi)
    {
        const labelList places(twins_[groupi]);
        if (places.empty())
        {
            continue;
        }

        // The same on every rank
        const controlPointGroup& group = groups_[groupi];
        const pointField x(group.listed(), places);
        const labelList meshPoints(places.size(), -1);
        const tmp<vectorField> td(group.displacement({x, meshPoints, places}));
        const vectorField& d = td();
        for (label i = 0; i < d.size(); i += 2)
        {
            const vector a = plane_.reduce(x[i], d[i]);
            const vector b = plane_.reduce(x[i + 1], d[i + 1]);
            if (mag(a - b) > 1e-8*max(mag(a), mag(b)))
            {
                FatalIOErrorInFunction(group.dict())
                    << "Contradicting control points: group '" << group.name()
                    << "' lists " << x[i] << " twice, with displacements "
                    << d[i] << " and " << d[i + 1] << nl
                    << "    Give coincident points one displacement, or remove"
                    << " all but one of them" << nl << exit(FatalIOError);
            }
        }
    }
}


Foam::vectorField Foam::listedControlPoints::displacements
(
    const controlPointSource& told
) const
{
    vectorField d(group_.size());
    forAll(groups_, groupi)
    {
        DynamicList<label> mine, listed;
        DynamicList<point> positions;
        forAll(group_, i)
        {
            if (group_[i] == groupi)
            {
                mine.append(i);
                listed.append(place_[i]);
                positions.append(groups_[groupi].listed()[place_[i]]);
            }
        }
        if (groups_[groupi].listed().empty())
        {
            continue;
        }
        const pointField x(positions);
        const labelList meshPoints(mine.size(), -1);
        const labelList places(listed);
        const tmp<vectorField> tvalues
        (
            told(groupi, {x, meshPoints, places})
        );
        forAll(mine, i)
        {
            d[mine[i]] = plane_.reduce(x[i], tvalues()[i]);
        }
    }
    return d;
}


// ************************************************************************* //
