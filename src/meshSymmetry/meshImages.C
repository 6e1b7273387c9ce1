/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshImages.H"
#include "cyclicAMIPolyPatch.H"
#include "cyclicPolyPatch.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "ListListOps.H"
#include "processorCyclicPolyPatch.H"
#include "surfaceNormals.H"
#include "syncTools.H"
#include "mathematicalConstants.H"
#include "unitConversion.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Relative to the size of the mesh: planes are flat to within this, and coupled
// patches coincide
static const scalar flatness = 1e-5;
static const scalar coincidence = 1e-3;

// Angles closer to a fraction of a turn count as equal [rad]
static const scalar sameAngle = 1e-4;


// Rounds to 40 bits of the size, above the round-off of decompositions. The
// factor keeps sizes away from powers of two, where the spacing of numbers
// jumps
static vector rounded(vector v, const scalar size)
{
    const int exponent = 40 - std::ilogb(max(1.3*size, VSMALL));
    for (scalar& component : v)
    {
        component = std::ldexp
        (
            std::round(std::ldexp(component, exponent)), -exponent
        );
    }
    return v;
}


// The first of the values on the ranks
template<class Type>
static Type firstOf(const UList<Type>& mine, const Type& none)
{
    List<List<Type>> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = mine;
    foamCompat::allGatherList(all);
    for (const List<Type>& those : all)
    {
        if (those.size())
        {
            return those[0];
        }
    }
    return none;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshImages::meshImages
(
    const polyMesh& mesh,
    const pointField& points0,
    const planarReduction& plane,
    const labelHashSet& mirrors,
    const labelHashSet& moving,
    const pointField& others
)
:
    mesh_(mesh),
    points0_(points0),
    plane_(plane),
    allPeriods_(true)
{
    findBox(others);
    forAll(mesh.boundaryMesh(), patchi)
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        const auto* cyclic = isA<cyclicPolyPatch>(patch);
        const auto* ami = isA<cyclicAMIPolyPatch>(patch);
        if (mirrors.found(patchi))
        {
            addMirror(patchi, moving);
        }
        else if (cyclic && cyclic->owner())
        {
            addPeriod
            (
                patchi,
                cyclic->neighbPatchID(),
                cyclic->separation(),
                cyclic->forwardT(),
                cyclic->transform() == coupledPolyPatch::ROTATIONAL,
                cyclic->rotationAxis(),
                cyclic->rotationCentre()
            );
        }
        else if (ami && ami->owner())
        {
            addPeriod
            (
                patchi,
                ami->neighbPatchID(),
                ami->separation(),
                ami->forwardT(),
                ami->transform() == coupledPolyPatch::ROTATIONAL,
                ami->rotationAxis(),
                ami->rotationCentre()
            );
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::meshImages::findBox(const pointField& others)
{
    boundBox box;
    for (const point& x : points0_)
    {
        box.add(plane_.position(x));
    }
    for (const point& x : others)
    {
        box.add(plane_.position(x));
    }
    box.reduce();
    box_ = {toEigen(box.min()), toEigen(box.max())};
}


Foam::boolList Foam::meshImages::onPatch(const label patchi) const
{
    boolList on(mesh_.nPoints(), false);
    UIndirectList<bool>(on, mesh_.boundaryMesh()[patchi].meshPoints()) = true;
    syncTools::syncPointList(mesh_, on, orEqOp<bool>(), false);
    return on;
}


void Foam::meshImages::addMirror
(
    const label patchi,
    const labelHashSet& moving
)
{
    const polyPatch& patch = mesh_.boundaryMesh()[patchi];
    vectorField areas(patch.size());
    forAll(patch, i)
    {
        areas[i] = plane_.reduce
        (
            patch[i].centre(points0_), patch[i].areaNormal(points0_)
        );
    }
    const surfaceNormals::plane plane = surfaceNormals::planeOf(areas);
    if (plane.empty)
    {
        return;
    }
    const vector n = plane.normal/mag(plane.normal);

    scalar lowest = GREAT, highest = -GREAT;
    for (const label pointi : patch.meshPoints())
    {
        const scalar h = plane_.position(points0_[pointi]) & n;
        lowest = min(lowest, h);
        highest = max(highest, h);
    }
    reduce(lowest, minOp<scalar>());
    reduce(highest, maxOp<scalar>());
    const scalar height = 0.5*(lowest + highest);

    const scalar tolerance = flatness*box_.diameter();
    const boolList on(onPatch(patchi));
    bool beyond = false, moves = false;
    forAll(points0_, pointi)
    {
        const scalar h = (plane_.position(points0_[pointi]) & n) - height;
        beyond = beyond || h > tolerance;
        moves =
            moves
         || (mag(h) < tolerance && !on[pointi] && moving.found(pointi));
    }
    reduce(beyond, orOp<bool>());
    reduce(moves, orOp<bool>());

    const string name("patch '" + patch.name() + "' ");
    if (highest - lowest > tolerance)
    {
        reasons_.append(name + "is not planar");
    }
    else if (beyond)
    {
        reasons_.append(name + "has the mesh on both sides of its plane");
    }
    else if (moves)
    {
        reasons_.append(name + "is in one plane with points that move");
    }
    else
    {
        mirrors_.push_back
        (
            morph::RigidMap::reflection(toEigen(height*n), toEigen(n))
        );
    }
}


void Foam::meshImages::addPeriod
(
    const label patchi,
    const label neighbour,
    const vectorField& separation,
    const tensorField& forwardT,
    const bool axisGiven,
    const vector& axis,
    const point& centre
)
{
    // Only ranks with faces may know them
    const vector t = firstOf(separation, vector(Zero));
    const tensor R = firstOf(forwardT, tensor(I));
    const label before = periods_.size();
    if (mag(R - tensor(I)) > sameAngle)
    {
        if
        (
           !addRotation
            (
                patchi, R,
                axisGiven ? axis : vector(Zero),
                axisGiven ? centre : point(Zero)
            )
        )
        {
            return;
        }
    }
    else if (mag(t) > flatness*box_.diameter())
    {
        periods_.push_back
        (
            morph::RigidMap::translation(toEigen(rounded(t, mag(t))))
        );
    }

    if
    (
        label(periods_.size()) > before
     && !matches(patchi, neighbour, periods_.back())
    )
    {
        periods_.pop_back();
        allPeriods_ = false;
        reasons_.append
        (
            "patches '" + mesh_.boundaryMesh()[patchi].name() + "' and '"
          + mesh_.boundaryMesh()[neighbour].name()
          + "' are not where their transformation brings them"
        );
    }
}


bool Foam::meshImages::addRotation
(
    const label patchi,
    const tensor& R,
    vector axis,
    const point& centre
)
{
    // R - R^T = 2 sin(angle) [axis]_x
    const vector twist
    (
        0.5*vector(R.zy() - R.yz(), R.xz() - R.zx(), R.yx() - R.xy())
    );
    const scalar angle = std::atan2(mag(twist), 0.5*(tr(R) - 1));
    if (mag(axis) < VSMALL)
    {
        axis = rounded(twist/max(mag(twist), VSMALL), 1);
    }
    axis /= max(mag(axis), VSMALL);

    const scalar turn = constant::mathematical::twoPi;
    const scalar n = std::round(turn/angle);
    if (mag(turn/n - angle) > sameAngle || mag(axis) < 0.5)
    {
        allPeriods_ = false;
        reasons_.append
        (
            "patch '" + mesh_.boundaryMesh()[patchi].name()
          + "' rotates by " + name(radToDeg(angle))
          + " degrees, which is no fraction of a turn"
        );
        return false;
    }
    periods_.push_back
    (
        morph::RigidMap::rotation(toEigen(centre), toEigen(axis), turn/n)
    );
    return true;
}


Foam::labelList Foam::meshImages::facesOf(const label patchi) const
{
    DynamicList<label> faces;
    forAll(mesh_.boundaryMesh(), i)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[i];
        const auto* between = isA<processorCyclicPolyPatch>(patch);
        if (i == patchi || (between && between->referPatchID() == patchi))
        {
            faces.append(identity(patch.size(), patch.start()));
        }
    }
    return labelList(faces);
}


bool Foam::meshImages::matches
(
    const label patchi,
    const label neighbour,
    const morph::RigidMap& map
) const
{
    morph::Vector3 centres[2];
    label side = 0;
    for (const label i : {patchi, neighbour})
    {
        vector sum(Zero);
        scalar area = 0;
        for (const label facei : facesOf(i))
        {
            const face& f = mesh_.faces()[facei];
            sum += f.mag(points0_)*plane_.position(f.centre(points0_));
            area += f.mag(points0_);
        }
        reduce(sum, sumOp<vector>());
        reduce(area, sumOp<scalar>());
        centres[side++] = toEigen(sum/max(area, VSMALL));
    }
    const scalar there = (map(centres[0]) - centres[1]).norm();
    const scalar back = (map(centres[1]) - centres[0]).norm();
    return min(there, back) < coincidence*box_.diameter();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

std::vector<morph::RigidMap> Foam::meshImages::generators() const
{
    std::vector<morph::RigidMap> all(mirrors_);
    all.insert(all.end(), periods_.begin(), periods_.end());
    return all;
}


// ************************************************************************* //
