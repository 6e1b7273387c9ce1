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

#include "rbfControlPoints.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "globalMeshData.H"
#include "syncTools.H"
#include "StringStream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Points this close to the axis of a wedge, in units of the mesh's size, are on
// it
static const scalar samePlace = 1e-8;

// Directions of conditions are renewed where the cosine of the angle to those
// of the surface is smaller: the iteration converges like the tangent
static const scalar turnedCosine = 0.8;

// More than any displacement, for points whose displacement is not known yet;
// its square is still a number
static const vector unknown = vector::uniform(GREAT);

// In units of the largest displacement: what those of coupled points, and those
// in a plane of symmetry, may lack
static const scalar samePeriod = 1e-6;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfControlPoints::rbfControlPoints
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const planarReduction& plane,
    motionImages& images,
    const scalar featureAngle
)
:
    mesh_(mesh),
    dict_(dict),
    points0_(points0),
    groups_(groups),
    plane_(plane),
    images_(images),
    listedPoints_(points0, groups, plane),
    follow_(false),
    farthest_(boundBox(points0, true).mag())
{
    assign();
    own();

    sliding_.reset
    (
        new slidingPoints
        (
            mesh, dict, points0, groups, plane, featureAngle, controlled_,
            onAxis_
        )
    );
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::rbfControlPoints::assign()
{
    const label none = labelMax;
    labelList group(mesh_.nPoints(), none);
    labelList listed(mesh_.nPoints(), -1);

    const scalar axisTolerance =
        samePlace*boundBox(points0_, true).mag();
    forAll(points0_, pointi)
    {
        if (plane_.onAxis(points0_[pointi], axisTolerance))
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
    listedPoints_.assign(group, listed);
    syncTools::syncPointList(mesh_, group, minEqOp<label>(), none);

    DynamicList<label> labels;
    forAll(group, pointi)
    {
        if (group[pointi] != none && plane_.representative()[pointi] == pointi)
        {
            labels.append(pointi);
        }
    }
    controlled_.transfer(labels);
    onAxis_.setSize(controlled_.size());
    forAll(controlled_, i)
    {
        onAxis_[i] = plane_.onAxis(points0_[controlled_[i]], axisTolerance);
    }
    group_ = UIndirectList<label>(group, controlled_);
    listed_ = UIndirectList<label>(listed, controlled_);

    members_.setSize(groups_.size());
    forAll(groups_, groupi)
    {
        const labelHashSet there(groups_[groupi].meshPoints());
        DynamicList<label> mine;
        forAll(controlled_, i)
        {
            const bool has = listed_[i] >= 0 || there.found(controlled_[i]);
            if (group_[i] == groupi && has)
            {
                mine.append(i);
            }
        }
        members_[groupi].transfer(mine);
    }
}


void Foam::rbfControlPoints::own()
{
    // The master of points that ranks share tells the others that they are
    // slaves. Points coupled by a cyclic are different points, of which one
    // copy each is no slave: those with one transformation are the same point
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
    owned_.setSize(controlled_.size());
    forAll(controlled_, i)
    {
        owned_[i] = !slave.test(controlled_[i]);
    }

    firstCopy_ = boolList(controlled_.size(), true);
    const boolList first(images_.coupled().first());
    const labelList places(coupledPlaces());
    forAll(places, i)
    {
        if (places[i] >= 0)
        {
            firstCopy_[places[i]] = first[i];
        }
    }
}


Foam::labelList Foam::rbfControlPoints::coupledPlaces() const
{
    Map<label> placeOf(2*controlled_.size());
    forAll(controlled_, i)
    {
        placeOf.insert(controlled_[i], i);
    }
    labelList places(images_.coupled().points());
    for (label& place : places)
    {
        place = placeOf.lookup(place, -1);
    }
    return places;
}


void Foam::rbfControlPoints::matchCopies
(
    const vectorField& told,
    vectorField& d
) const
{
    const cyclicCopies& coupled = images_.coupled();
    if (coupled.empty())
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
    const List<vectorField> copies(coupled.values(known, unknown));

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
                mag(value - *taken) > samePeriod*largest
             && !groups_[group_[place]].slides()
             && message.str().empty()
            )
            {
                message
                    << "Periodic sides are told to move differently: the point "
                    << points0_[controlled_[place]] << " by " << *taken
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


Foam::vectorField Foam::rbfControlPoints::displacements() const
{
    vectorField d(controlled_.size(), unknown);
    forAll(groups_, groupi)
    {
        const labelList& mine = members_[groupi];
        const labelList meshPoints(UIndirectList<label>(controlled_, mine));
        const labelList listed(UIndirectList<label>(listed_, mine));
        const pointField positions(points0_, meshPoints);
        const tmp<vectorField> tvalues
        (
            groups_[groupi].displacement({positions, meshPoints, listed})
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

    const vectorField told(d);
    syncTools::syncPointList
    (
        mesh_, controlled_, d, minMagSqrEqOp<vector>(), unknown
    );
    matchCopies(told, d);
    forAll(d, i)
    {
        d[i] = plane_.reduce(points0_[controlled_[i]], d[i]);
        if (onAxis_[i])
        {
            d[i] -= (d[i] & plane_.radial())*plane_.radial();
        }
    }
    return d;
}


morph::ControlPoint Foam::rbfControlPoints::condition
(
    const point& x,
    const bool slides,
    const List<vector>& normals,
    const vector& d
) const
{
    const morph::Vector3 position = toEigen(plane_.position(x));

    // In a plane two directions are all there are
    const label dimensions = plane_.active() ? 2 : 3;
    if (!slides || normals.size() >= dimensions)
    {
        return morph::ControlPoint::prescribed(position, toEigen(d));
    }
    std::vector<morph::Vector3> n;
    for (const vector& normal : normals)
    {
        n.push_back(toEigen(normal));
    }
    return morph::ControlPoint::sliding(position, n, toEigen(d));
}


void Foam::rbfControlPoints::collectCandidates(const vectorField& freeValues)
{
    morph::ControlPoints all;
    DynamicList<label> places;
    forAll(controlled_, i)
    {
        if (owned_[i] && (firstCopy_[i] || !images_.periodic()))
        {
            all.push_back(conditions_[i]);
            places.append(i);
        }
    }
    forAll(freeValues, i)
    {
        const point x = listedPoints_.position(i);
        all.push_back(condition(x, false, List<vector>(), freeValues[i]));
        places.append(-1);
    }

    OStringStream message;
    double largest = 0;
    for (const morph::ControlPoint& p : all)
    {
        if (!p.value.allFinite() || p.value.norm() > 0.1*GREAT)
        {
            message
                << "The prescribed displacement at " << toFoam(p.position)
                << " is no finite number: " << toFoam(p.value);
            break;
        }
        largest = std::max(largest, p.value.norm());
    }

    std::vector<morph::Index> kept;
    if (message.str().empty())
    {
        try
        {
            kept = morph::withoutDuplicates(all, 1e-8*largest);
        }
        catch (const morph::ConflictingControlPoints& conflict)
        {
            message
                << "Contradicting control points: " << conflict.what() << nl
                << "    Give coincident points one displacement, or remove"
                << " all but one of them";
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());

    candidates_.clear();
    candidatePoints_.setSize(kept.size());
    places_.setSize(kept.size());
    forAll(candidatePoints_, j)
    {
        const label i = places[kept[j]];
        candidates_.push_back(all[kept[j]]);
        candidatePoints_[j] = i < 0 ? -1 : controlled_[i];
        places_[j] = i;
    }
    whole_ = candidates_;
    if (images_.active())
    {
        leaveToImages();
    }
}


void Foam::rbfControlPoints::leaveToImages()
{
    const scalar largest = largestValue();
    OStringStream message;
    morph::ControlPoints left, whole;
    DynamicList<label> labels, places;
    forAll(candidatePoints_, j)
    {
        const morph::ControlPoint& p = candidates_[j];
        scalar contradiction = 0;
        const morph::ControlPoint rest = images_.restricted(p, contradiction);
        if (contradiction > samePeriod*largest && message.str().empty())
        {
            message
                << "what is prescribed at " << toFoam(p.position) << ", "
                << toFoam(p.C()*p.g()) << ", leaves the plane of symmetry or"
                << " axis of rotation there by " << contradiction;
        }
        if (rest.k > 0)
        {
            left.push_back(rest);
            whole.push_back(p);
            labels.append(candidatePoints_[j]);
            places.append(places_[j]);
        }
    }
    images_.renounceIf(message.str());
    if (images_.active())
    {
        candidates_.swap(left);
        whole_.swap(whole);
        candidatePoints_.transfer(labels);
        places_.transfer(places);
    }
}


morph::ControlPoint Foam::rbfControlPoints::restricted
(
    const morph::ControlPoint& p
) const
{
    scalar contradiction = 0;
    return
        images_.active() ? images_.restricted(p, contradiction)
      : p;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::rbfControlPoints::largestValue() const
{
    scalar largest = 0;
    for (const morph::ControlPoint& p : candidates_)
    {
        largest = max(largest, p.g().norm());
    }
    return returnReduce(largest, maxOp<scalar>());
}


bool Foam::rbfControlPoints::surfacesMove() const
{
    for (const controlPointGroup& group : groups_)
    {
        if (group.slides() && group.moves())
        {
            return true;
        }
    }
    return false;
}


bool Foam::rbfControlPoints::surfacesStay() const
{
    for (const controlPointGroup& group : groups_)
    {
        if (group.slides() && group.hasTarget())
        {
            return false;
        }
    }
    return !surfacesMove();
}


bool Foam::rbfControlPoints::update(const bool anew)
{
    const bool changed = sliding_->update(anew);
    const vectorField d(displacements());
    if (changed || anew || start_.size() != d.size())
    {
        start_.setSize(d.size());
        start_ = Zero;
    }

    follow_ = false;
    conditions_.setSize(controlled_.size());
    forAll(controlled_, i)
    {
        conditions_[i] = condition
        (
            points0_[controlled_[i]], slides(i), sliding_->normals(i), d[i]
        );
        morph::ControlPoint& p = conditions_[i];
        if (p.slides() && sliding_->follows(i))
        {
            follow_ = true;
            const vector s = d[i] + start_[i];
            morph::slideOnto(p, toEigen(s), sliding_->planes(i, s));
        }
    }
    follow_ = returnReduce(follow_, orOp<bool>());

    const bool withImages = images_.active();
    const vectorField freeValues(listedPoints_.displacements());
    collectCandidates(freeValues);
    if (withImages && !images_.active())
    {
        collectCandidates(freeValues);
        return true;
    }
    return changed;
}


morph::Vectors Foam::rbfControlPoints::atCandidates
(
    const morph::RbfInterpolant& field
) const
{
    morph::Vectors positions(candidates_.size(), 3);
    for (std::size_t j = 0; j < candidates_.size(); ++j)
    {
        positions.row(j) = candidates_[j].position.transpose();
    }
    return field(positions);
}


void Foam::rbfControlPoints::renew
(
    const morph::Vectors& s,
    morph::ControlPoints& candidates
)
{
    forAll(places_, j)
    {
        const label i = places_[j];
        morph::ControlPoint& p = whole_[j];
        const morph::Vector3 here = s.row(j).transpose();

        // Not for an iteration that gets lost
        if (p.slides() && sliding_->follows(i) && here.norm() < farthest_)
        {
            morph::slideOnto(p, here, sliding_->planes(i, toFoam(here)));
            candidates[j].value = restricted(p).value;
        }
    }
}


bool Foam::rbfControlPoints::turned(const morph::RbfInterpolant& field) const
{
    if (!follow_)
    {
        return false;
    }
    scalar least = 1;
    const morph::Vectors s = atCandidates(field);
    forAll(places_, j)
    {
        const label i = places_[j];
        morph::ControlPoint p = whole_[j];
        const morph::Vector3 here = s.row(j).transpose();
        if (p.slides() && sliding_->follows(i) && here.norm() < farthest_)
        {
            const scalar cosine =
                morph::slideOnto(p, here, sliding_->planes(i, toFoam(here)));
            least = min(least, cosine);
        }
    }
    return returnReduce(least, minOp<scalar>()) < turnedCosine;
}


void Foam::rbfControlPoints::renewDirections
(
    const morph::RbfInterpolant& field
)
{
    const morph::Vectors s = atCandidates(field);
    forAll(places_, j)
    {
        const label i = places_[j];
        morph::ControlPoint& p = whole_[j];
        const morph::Vector3 here = s.row(j).transpose();
        if (p.slides() && sliding_->follows(i) && here.norm() < farthest_)
        {
            start_[i] = sliding_->onto(i, toFoam(here));
            sliding_->renewDirections(i, start_[i]);
            p = condition
            (
                points0_[controlled_[i]],
                true,
                sliding_->normals(i),
                start_[i]
            );
            candidates_[j] = restricted(p);
        }
    }
}


void Foam::rbfControlPoints::impose
(
    vectorField& displacement,
    const bool slidingToo,
    const scalar fraction
) const
{
    // Where surfaces are half-way is not known
    const bool slide = slidingToo && (fraction >= 1 || surfacesStay());
    forAll(controlled_, i)
    {
        vector& d = displacement[controlled_[i]];
        const morph::ControlPoint& p = conditions_[i];
        if (!p.slides())
        {
            d = fraction*toFoam(p.value);
        }
        else if (slide && sliding_->follows(i))
        {
            d = sliding_->onto(i, d);
        }
        else if (slide)
        {
            const morph::Vector3 s = toEigen(d);
            d += toFoam(p.C()*p.residual(s).head(p.k));
        }
    }
}


// ************************************************************************* //
