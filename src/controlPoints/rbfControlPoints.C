/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfControlPoints.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "StringStream.H"


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// In units of the mesh's size: what corners may be off their surfaces
static const scalar cornerTolerance = 1e-6;

// In units of the largest displacement, what control points at one place may
// differ by: what a selection leaves by default. The two sides of a baffle are
// told by a coupling, which maps to each
static const scalar sameDisplacement = 1e-5;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfControlPoints::rbfControlPoints
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const reducedMesh& reduced,
    motionImages& images,
    const scalar featureAngle
)
:
    dict_(dict),
    groups_(groups),
    reduced_(reduced),
    images_(images),
    listedPoints_(points0, groups, reduced.plane()),
    controlled_(mesh, dict, points0, groups, reduced, listedPoints_),
    sliding_
    (
        mesh, dict, points0, groups, reduced.plane(), featureAngle,
        controlled_.labels(), controlled_.onAxis()
    ),
    warned_(false),
    follow_(false),
    farthest_(boundBox(points0, true).mag()),
    listedRegions_(regionsOfListed())
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

morph::ControlPoint Foam::rbfControlPoints::condition
(
    const point& x,
    const bool slides,
    const List<vector>& normals,
    const vector& d
) const
{
    const morph::Vector3 position = toEigen(reduced_.plane().position(x));

    // In a plane there are only two directions
    const label dimensions = reduced_.plane().active() ? 2 : 3;
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


Foam::labelList Foam::rbfControlPoints::regionsOfListed() const
{
    pointField positions(listedPoints_.nFree());
    forAll(positions, i)
    {
        positions[i] = listedPoints_.position(i);
    }
    return reduced_.regionsAt(positions);
}


void Foam::rbfControlPoints::warnOf(const string& lost)
{
    if (warned_)
    {
        return;
    }
    const string first(dictionaryChecks::firstOf(lost));
    warned_ = first.size();
    if (warned_)
    {
        IOWarningInFunction(dict_)
            << "Displacements leave patches that keep their points: "
            << first.c_str() << nl
            << "    The part that leaves them is taken away. Tell the group to"
            << " move along them, or change the type of the patch" << endl;
    }
}


void Foam::rbfControlPoints::takeCorners(vectorField& d) const
{
    OStringStream message;
    forAll(d, i)
    {
        if (!controlled_.slides(i) || !sliding_.cornerMoves(i))
        {
            continue;
        }
        scalar off = 0;
        d[i] = sliding_.corner(i, off);
        if (off > cornerTolerance*farthest_ && message.str().empty())
        {
            message
                << "The corner at " << controlled_.position(i) << " cannot be"
                << " on all of its surfaces: it ends " << off << " m from them."
                << " Those of group '" << controlled_.group(i).name()
                << "' do not meet their neighbours" << nl
                << "    Give it a target that meets the others there, or do not"
                << " let those slide";
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
}


void Foam::rbfControlPoints::collectCandidates(const vectorField& freeValues)
{
    List<controlCandidates> all(reduced_.nRegions());
    List<DynamicList<label>> places(all.size());
    if (all.size() == 1)
    {
        all[0].whole.reserve(controlled_.size() + freeValues.size());
    }
    for (label i = 0; i < controlled_.size(); ++i)
    {
        const bool first = controlled_.firstCopy(i) || !images_.periodic();
        if (controlled_.owned(i) && first)
        {
            const label regioni = reduced_.regionOf(controlled_.labels()[i]);
            all[regioni].whole.push_back(conditions_[i]);
            places[regioni].append(i);
        }
    }
    forAll(freeValues, i)
    {
        const label regioni = listedRegions_[i];
        all[regioni].whole.push_back
        (
            condition
            (
                listedPoints_.position(i), false, List<vector>(), freeValues[i]
            )
        );
        places[regioni].append(-1 - i);
    }
    forAll(all, regioni)
    {
        all[regioni].places.transfer(places[regioni]);
    }

    checkFinite(all);
    mergeDuplicates(all);
    if (images_.active())
    {
        leaveToImages();
    }
}


const morph::Coincident& Foam::rbfControlPoints::coincident
(
    const label regioni,
    const controlCandidates& c
)
{
    coincident_.setSize(reduced_.nRegions());
    coincidentPlaces& known = coincident_[regioni];
    if (known.places != c.places)
    {
        known.places = c.places;
        known.sets = morph::coincident(c.whole);
    }
    return known.sets;
}


void Foam::rbfControlPoints::checkFinite
(
    const List<controlCandidates>& all
) const
{
    OStringStream message;
    for (const controlCandidates& c : all)
    {
        for (const morph::ControlPoint& p : c.whole)
        {
            const bool finite =
                p.value.allFinite()
             && p.value.lpNorm<Eigen::Infinity>() < 0.1*GREAT;
            if (!finite && message.str().empty())
            {
                message
                    << "The prescribed displacement at " << toFoam(p.position)
                    << " is not finite: " << toFoam(p.value);
            }
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
}


void Foam::rbfControlPoints::mergeDuplicates(List<controlCandidates>& all)
{
    scalar largest = 0;
    for (const controlCandidates& c : all)
    {
        for (const morph::ControlPoint& p : c.whole)
        {
            largest = max(largest, p.value.norm());
        }
    }

    OStringStream message;
    forAll(all, regioni)
    {
        controlCandidates& c = all[regioni];
        std::vector<morph::Index> kept;
        try
        {
            kept = morph::withoutDuplicates
            (
                c.whole, coincident(regioni, c), sameDisplacement*largest
            );
        }
        catch (const morph::ConflictingControlPoints& conflict)
        {
            message
                << "Contradicting control points: " << conflict.what() << nl
                << "    Give coincident points one displacement, or remove"
                << " all but one of them";
            break;
        }

        for (label j = 0; j < label(kept.size()); ++j)
        {
            if (kept[j] != j)
            {
                c.whole[j] = c.whole[kept[j]];
                c.places[j] = c.places[kept[j]];
            }
        }
        c.whole.resize(kept.size());
        c.places.setSize(kept.size());
        c.meshPoints.setSize(kept.size());
        forAll(c.places, j)
        {
            const label i = c.places[j];
            c.meshPoints[j] = i < 0 ? -1 : controlled_.labels()[i];
        }
        c.conditions = c.whole;
    }
    dictionaryChecks::stopIf(dict_, message.str());
    candidates_.transfer(all);
}


void Foam::rbfControlPoints::leaveToImages()
{
    scalar largest = 0;
    for (const controlCandidates& c : candidates_)
    {
        largest = max(largest, c.largestValue());
    }
    reduce(largest, maxOp<scalar>());

    OStringStream message;
    List<controlCandidates> left(candidates_.size());
    forAll(candidates_, regioni)
    {
        const controlCandidates& c = candidates_[regioni];
        DynamicList<label> kept;
        for (label j = 0; j < c.size(); ++j)
        {
            const morph::ControlPoint& p = c.whole[j];
            scalar contradiction = 0;
            const morph::ControlPoint rest =
                images_.restricted(p, contradiction);
            if
            (
                contradiction > cyclicCopies::tolerance*largest
             && message.str().empty()
            )
            {
                message
                    << "what is prescribed at " << toFoam(p.position) << ", "
                    << toFoam(p.C()*p.g()) << ", leaves the plane of symmetry"
                    << " or axis of rotation there by " << contradiction;
            }
            if (rest.k > 0)
            {
                left[regioni].conditions.push_back(rest);
                left[regioni].whole.push_back(p);
                kept.append(j);
            }
        }
        left[regioni].meshPoints = UIndirectList<label>(c.meshPoints, kept);
        left[regioni].places = UIndirectList<label>(c.places, kept);
    }
    images_.disableIf(message.str());
    if (images_.active())
    {
        candidates_.transfer(left);
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

Foam::scalar Foam::rbfControlPoints::largestValue(const label regioni) const
{
    return returnReduce(candidates_[regioni].largestValue(), maxOp<scalar>());
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


bool Foam::rbfControlPoints::surfacesAreOwn() const
{
    for (const controlPointGroup& group : groups_)
    {
        if
        (
            group.slides()
         && group.surface() == controlPointGroup::surfaceType::named
        )
        {
            return false;
        }
    }
    return surfacesStay();
}


bool Foam::rbfControlPoints::update(const bool rebuild)
{
    const bool changed = sliding_.update(rebuild);
    string lost;
    const controlPointSource displacement
    (
        [&](const label groupi, const prescribedDisplacement::points& p)
        {
            return groups_[groupi].displacement(p);
        }
    );
    vectorField d(controlled_.displacements(displacement, lost));
    warnOf(lost);
    takeCorners(d);
    if (changed || rebuild || start_.size() != d.size())
    {
        start_.setSize(d.size());
        start_ = Zero;
    }

    // Directions that do not follow from positions stay until they are rebuilt
    const bool stay =
        !changed && !rebuild && conditions_.size() == controlled_.size();
    follow_ = false;
    conditions_.setSize(controlled_.size());
    for (label i = 0; i < controlled_.size(); ++i)
    {
        morph::ControlPoint& p = conditions_[i];
        if (stay && !(controlled_.slides(i) && sliding_.follows(i)))
        {
            p.setDisplacement(toEigen(d[i]));
            continue;
        }
        p = condition
        (
            controlled_.position(i), controlled_.slides(i), sliding_.normals(i), d[i]
        );
        if (p.slides() && sliding_.follows(i))
        {
            follow_ = true;
            const vector s = d[i] + start_[i];
            morph::slideOnto(p, toEigen(s), sliding_.planes(i, s));
        }
    }
    follow_ = returnReduce(follow_, orOp<bool>());

    const bool withImages = images_.active();
    listedPoints_.checkTwins();
    const vectorField freeValues(listedPoints_.displacements(displacement));
    collectCandidates(freeValues);
    if (withImages && !images_.active())
    {
        collectCandidates(freeValues);
        return true;
    }
    return changed;
}


Foam::labelList Foam::rbfControlPoints::prescribed() const
{
    DynamicList<label> points;
    for (label i = 0; i < controlled_.size(); ++i)
    {
        if (!conditions_[i].slides())
        {
            points.append(controlled_.labels()[i]);
        }
    }
    return labelList(points);
}


void Foam::rbfControlPoints::restrict
(
    const vectorField& displacement,
    vectorField& velocity
) const
{
    for (label i = 0; i < controlled_.size(); ++i)
    {
        const label pointi = controlled_.labels()[i];
        const morph::ControlPoint& p = conditions_[i];
        vector& v = velocity[pointi];
        if (!p.slides())
        {
            v = Zero;
        }
        else if (sliding_.follows(i))
        {
            const morph::TangentPlanes planes =
                sliding_.planes(i, displacement[pointi]);
            vector first(Zero);
            for (int j = 0; j < planes.k; ++j)
            {
                const morph::Vector3 column = planes.normals.col(j);
                vector n(toFoam(column));
                n -= (n & first)*first;
                const scalar size = mag(n);
                if (size > SMALL)
                {
                    n /= size;
                    v -= (v & n)*n;
                    first = n;
                }
            }
        }
        else
        {
            const morph::Vector3 u = toEigen(v);
            v -= toFoam(p.C()*(p.C().transpose()*u));
        }
    }
}


void Foam::rbfControlPoints::impose
(
    vectorField& displacement,
    const bool slidingToo,
    const scalar fraction,
    const motionPaths& paths
) const
{
    // Half-way positions of moving surfaces are not known
    const bool slide = slidingToo && (fraction >= 1 || surfacesStay());
    for (label i = 0; i < controlled_.size(); ++i)
    {
        vector& d = displacement[controlled_.labels()[i]];
        const morph::ControlPoint& p = conditions_[i];
        if (!p.slides())
        {
            d = paths.part(controlled_.groupIndex(i), p, fraction);
        }
        else if (slide && sliding_.follows(i))
        {
            d = sliding_.onto(i, d);
        }
        else if (slide)
        {
            const morph::Vector3 s = toEigen(d);
            d += toFoam(p.C()*p.residual(s).head(p.k));
        }
    }
    for (const label pointi : controlled_.constraints().onPlanes())
    {
        vector& d = displacement[pointi];
        d = controlled_.constraints().kept(pointi, d);
    }
}


// ************************************************************************* //
