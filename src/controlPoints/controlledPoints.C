/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlledPoints.H"
#include "dictionaryChecks.H"
#include "globalMeshData.H"
#include "StringStream.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Larger than any displacement, for points whose displacement is not known yet;
// can be squared
static const vector unknown = vector::uniform(GREAT);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::controlledPoints::controlledPoints
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const reducedMesh& reduced,
    listedControlPoints& listedPoints
)
:
    mesh_(mesh),
    dict_(dict),
    points0_(points0),
    groups_(groups),
    plane_(reduced.plane()),
    coupled_(reduced.coupled()),
    constraints_(mesh, points0, &plane_)
{
    assign(listedPoints);
    findMembers();
    own();
    findFirstCopies();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::controlledPoints::assign(listedControlPoints& listedPoints)
{
    const label none = labelMax;
    labelList group(mesh_.nPoints(), none);
    labelList listed(mesh_.nPoints(), -1);

    forAll(points0_, pointi)
    {
        if (plane_.onAxis(points0_[pointi]))
        {
            group[pointi] = groups_.size();
        }
    }
    forAllReverse(groups_, groupi)
    {
        for (const label pointi : groups_[groupi].meshPoints())
        {
            group[pointi] = groupi;
        }
    }
    listedPoints.assign(group, listed);
    syncTools::syncPointList(mesh_, group, minEqOp<label>(), none);

    DynamicList<label> labels;
    forAll(group, pointi)
    {
        if (group[pointi] != none && plane_.representative()[pointi] == pointi)
        {
            labels.append(pointi);
        }
    }
    labels_.transfer(labels);
    onAxis_.setSize(labels_.size());
    forAll(labels_, i)
    {
        onAxis_[i] = plane_.onAxis(points0_[labels_[i]]);
    }
    group_ = UIndirectList<label>(group, labels_);
    listed_ = UIndirectList<label>(listed, labels_);
}


void Foam::controlledPoints::findMembers()
{
    members_.setSize(groups_.size());
    forAll(groups_, groupi)
    {
        const labelHashSet there(groups_[groupi].meshPoints());
        DynamicList<label> mine;
        forAll(labels_, i)
        {
            const bool has = listed_[i] >= 0 || there.found(labels_[i]);
            if (group_[i] == groupi && has)
            {
                mine.append(i);
            }
        }
        members_[groupi].transfer(mine);
    }
}


void Foam::controlledPoints::own()
{
    // Shared points have one master, the others are slaves. Points coupled by a
    // cyclic are different points, each with one copy that is not a slave:
    // those with the same transformation are the same point
    const globalMeshData& global = mesh_.globalData();
    const labelList& coupled = global.coupledPatch().meshPoints();
    const labelListList& slaves = global.globalPointSlaves();
    const mapDistribute& map = global.globalPointSlavesMap();

    labelList isSlave(map.constructSize(), Zero);
    for (const labelList& these : slaves)
    {
        for (const label slot : these)
        {
            isSlave[slot] = 1;
        }
    }
    for (const labelList& these : global.globalPointTransformedSlaves())
    {
        labelHashSet known;
        for (const label slot : these)
        {
            // The last transformation whose slots start before this one
            label transformi = map.transformStart().size() - 1;
            while (map.transformStart()[transformi] > slot)
            {
                --transformi;
            }
            if (!known.insert(transformi))
            {
                const label start = map.transformStart()[transformi];
                isSlave[map.transformElements()[transformi][slot - start]] = 1;
            }
        }
    }
    map.reverseDistribute(coupled.size(), isSlave, false);

    bitSet slave(mesh_.nPoints());
    forAll(coupled, i)
    {
        slave.set(coupled[i], isSlave[i] == 1);
    }
    owned_.setSize(labels_.size());
    forAll(labels_, i)
    {
        owned_[i] = !slave.test(labels_[i]);
    }
}


void Foam::controlledPoints::findFirstCopies()
{
    firstCopy_ = boolList(labels_.size(), true);
    const boolList first(coupled_.first());
    const labelList places(coupledPlaces());
    forAll(places, i)
    {
        if (places[i] >= 0)
        {
            firstCopy_[places[i]] = first[i];
        }
    }
}


Foam::labelList Foam::controlledPoints::coupledPlaces() const
{
    Map<label> placeOf(2*labels_.size());
    forAll(labels_, i)
    {
        placeOf.insert(labels_[i], i);
    }
    labelList places(coupled_.points());
    for (label& place : places)
    {
        place = placeOf.lookup(place, -1);
    }
    return places;
}


void Foam::controlledPoints::matchCopies
(
    const vectorField& told,
    vectorField& d
) const
{
    if (coupled_.empty())
    {
        return;
    }

    scalar largest = 0;
    for (const vector& t : told)
    {
        largest = max(largest, t == unknown ? 0 : mag(t));
    }
    reduce(largest, maxOp<scalar>());

    const labelList places(coupledPlaces());
    vectorField known(places.size(), unknown);
    forAll(places, i)
    {
        if (places[i] >= 0)
        {
            known[i] = told[places[i]];
        }
    }
    const List<vectorField> copies(coupled_.values(known, unknown));

    OStringStream message;
    forAll(places, i)
    {
        const label place = places[i];
        if (place < 0)
        {
            continue;
        }
        const vector* taken = nullptr;
        for (const vector& value : copies[i])
        {
            if (value == unknown)
            {
                continue;
            }
            if (!taken)
            {
                taken = &value;
                d[place] = value;
            }
            else if
            (
                mag(value - *taken) > cyclicCopies::tolerance*largest
             && !groups_[group_[place]].slides()
             && message.str().empty()
            )
            {
                message
                    << "Periodic sides are told to move differently: the point "
                    << points0_[labels_[place]] << " by " << *taken
                    << " from the one side, by " << value << " from the other"
                    << " (as seen here)" << nl
                    << "    Coupled patches would not match any more. Give"
                    << " both sides one displacement, turned with them where"
                    << " the period is a rotation";
            }
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::vectorField Foam::controlledPoints::displacements
(
    const controlPointSource& told,
    string& lost
) const
{
    vectorField d(labels_.size(), unknown);
    forAll(groups_, groupi)
    {
        const labelList& mine = members_[groupi];
        const labelList meshPoints(UIndirectList<label>(labels_, mine));
        const labelList listed(UIndirectList<label>(listed_, mine));
        const pointField positions(points0_, meshPoints);
        const tmp<vectorField> tvalues
        (
            told(groupi, {positions, meshPoints, listed})
        );
        forAll(mine, i)
        {
            d[mine[i]] = tvalues()[i];
        }
    }
    forAll(group_, i)
    {
        if (group_[i] == groups_.size())
        {
            d[i] = Zero;
        }
    }

    const vectorField here(d);
    syncTools::syncPointList
    (
        mesh_, labels_, d, minMagSqrEqOp<vector>(), unknown
    );
    matchCopies(here, d);
    scalar largest = 0, most = 0;
    label worst = -1;
    forAll(d, i)
    {
        const label pointi = labels_[i];
        d[i] = plane_.reduceMotion(points0_[pointi], d[i]);
        if (!slides(i))
        {
            // Surfaces to slide on see to it themselves
            const vector kept = constraints_.kept(pointi, d[i]);
            if (mag(d[i] - kept) > most)
            {
                most = mag(d[i] - kept);
                worst = i;
            }
            d[i] = kept;
        }
        largest = max(largest, mag(d[i]));
    }

    OStringStream words;
    if (worst >= 0 && most > 1e-6*(largest + most))
    {
        const polyPatch& patch =
            mesh_.boundaryMesh()[constraints_.patchOf(labels_[worst])];
        words
            << "group '" << groups_[group_[worst]].name()
            << "' tells the point at " << points0_[labels_[worst]]
            << " to leave patch '" << patch.name() << "' of type "
            << patch.type() << " by " << most << " m";
    }
    lost = words.str();
    return d;
}


// ************************************************************************* //
