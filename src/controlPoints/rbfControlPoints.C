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

// In units of the largest displacement: what those in a plane of symmetry may
// lack
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
    dict_(dict),
    groups_(groups),
    plane_(plane),
    images_(images),
    listedPoints_(points0, groups, plane),
    controlled_
    (
        mesh, dict, points0, groups, plane, images.coupled(), listedPoints_
    ),
    sliding_
    (
        mesh, dict, points0, groups, plane, featureAngle, controlled_.labels(),
        controlled_.onAxis()
    ),
    follow_(false),
    farthest_(boundBox(points0, true).mag())
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
    for (label i = 0; i < controlled_.size(); ++i)
    {
        const bool first = controlled_.firstCopy(i) || !images_.periodic();
        if (controlled_.owned(i) && first)
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
        candidatePoints_[j] = i < 0 ? -1 : controlled_.labels()[i];
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
    images_.disableIf(message.str());
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


bool Foam::rbfControlPoints::update(const bool rebuild)
{
    const bool changed = sliding_.update(rebuild);
    const vectorField d(controlled_.displacements());
    if (changed || rebuild || start_.size() != d.size())
    {
        start_.setSize(d.size());
        start_ = Zero;
    }

    follow_ = false;
    conditions_.setSize(controlled_.size());
    for (label i = 0; i < controlled_.size(); ++i)
    {
        conditions_[i] = condition
        (
            controlled_.position(i), controlled_.slides(i), sliding_.normals(i), d[i]
        );
        morph::ControlPoint& p = conditions_[i];
        if (p.slides() && sliding_.follows(i))
        {
            follow_ = true;
            const vector s = d[i] + start_[i];
            morph::slideOnto(p, toEigen(s), sliding_.planes(i, s));
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
        if (p.slides() && sliding_.follows(i) && here.norm() < farthest_)
        {
            morph::slideOnto(p, here, sliding_.planes(i, toFoam(here)));
            candidates[j].value = restricted(p).value;
        }
    }
}


bool Foam::rbfControlPoints::turned
(
    const morph::RbfInterpolant& field,
    const scalar cosine
) const
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
        if (p.slides() && sliding_.follows(i) && here.norm() < farthest_)
        {
            const scalar present =
                morph::slideOnto(p, here, sliding_.planes(i, toFoam(here)));
            least = min(least, present);
        }
    }
    return returnReduce(least, minOp<scalar>()) < cosine;
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
        if (p.slides() && sliding_.follows(i) && here.norm() < farthest_)
        {
            start_[i] = sliding_.onto(i, toFoam(here));
            sliding_.renewDirections(i, start_[i]);
            p = condition
            (
                controlled_.position(i),
                true,
                sliding_.normals(i),
                start_[i]
            );
            candidates_[j] = restricted(p);
        }
    }
}


void Foam::rbfControlPoints::setDirections(const morph::Vectors& reached)
{
    forAll(places_, j)
    {
        const label i = places_[j];
        morph::ControlPoint& p = whole_[j];
        if (p.slides() && sliding_.follows(i))
        {
            const morph::Vector3 here = reached.row(j).transpose();
            const morph::TangentPlanes planes =
                sliding_.planes(i, toFoam(here));
            List<vector> normals(planes.k);
            forAll(normals, k)
            {
                normals[k] =
                    toFoam(morph::Vector3(planes.normals.col(k)));
            }
            p = condition
            (
                controlled_.position(i), true, normals, toFoam(here)
            );
            morph::slideOnto(p, here, planes);
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
    for (label i = 0; i < controlled_.size(); ++i)
    {
        vector& d = displacement[controlled_.labels()[i]];
        const morph::ControlPoint& p = conditions_[i];
        if (!p.slides())
        {
            d = fraction*toFoam(p.value);
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
}


// ************************************************************************* //
