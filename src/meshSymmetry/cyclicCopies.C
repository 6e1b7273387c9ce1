/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cyclicCopies.H"
#include "cyclicPolyPatch.H"
#include "eigenFields.H"
#include "processorCyclicPolyPatch.H"
#include "syncTools.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Leaves exchanged values as they are
struct untransformed
{
    template<class Type>
    void operator()(const vectorTensorTransform&, bool, List<Type>&) const
    {}
};


// The rotation of the map that brings one position to the other
static tensor rotationBetween
(
    const point& from,
    const point& to,
    const morph::ImageGroup& periods
)
{
    const morph::Vector3 x = toEigen(from), y = toEigen(to);
    const morph::RigidMap* nearest = nullptr;
    for (const morph::RigidMap& map : periods.maps())
    {
        if
        (
            !nearest
         || (map(x) - y).squaredNorm() < ((*nearest)(x) - y).squaredNorm()
        )
        {
            nearest = &map;
        }
    }
    const Eigen::Matrix3d& R = nearest->R;
    return tensor
    (
        R(0, 0), R(0, 1), R(0, 2),
        R(1, 0), R(1, 1), R(1, 2),
        R(2, 0), R(2, 1), R(2, 2)
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cyclicCopies::cyclicCopies
(
    const polyMesh& mesh,
    const pointField& points0,
    const morph::ImageGroup& periods
)
:
    mesh_(mesh),
    points0_(points0)
{
    boolList isCyclic(mesh.nPoints(), false);
    bool some = false;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (isA<cyclicPolyPatch>(patch) || isA<processorCyclicPolyPatch>(patch))
        {
            some = true;
            UIndirectList<bool>(isCyclic, patch.meshPoints()) = true;
        }
    }
    if (returnReduce(some, orOp<bool>()))
    {
        syncTools::syncPointList(mesh, isCyclic, orEqOp<bool>(), false);
        points_ = findIndices(isCyclic, true);
        findCopies(periods);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::List<Foam::vectorField> Foam::cyclicCopies::exchanged
(
    const vectorField& values
) const
{
    List<List<vector>> pairs(points_.size());
    forAll(points_, i)
    {
        pairs[i].append(points0_[points_[i]]);
        pairs[i].append(values[i]);
    }
    syncTools::syncPointList
    (
        mesh_,
        points_,
        pairs,
        ListOps::appendEqOp<vector>(),
        List<vector>(),
        untransformed()
    );
    List<vectorField> result(points_.size());
    forAll(result, i)
    {
        result[i].transfer(pairs[i]);
    }
    return result;
}


void Foam::cyclicCopies::findCopies(const morph::ImageGroup& periods)
{
    const List<vectorField> pairs
    (
        exchanged(vectorField(points_.size(), Zero))
    );
    copies_.setSize(points_.size());
    forAll(points_, i)
    {
        List<point> positions(pairs[i].size()/2);
        forAll(positions, j)
        {
            positions[j] = pairs[i][2*j];
        }
        std::sort(positions.begin(), positions.end(), before);
        for (const point& x : positions)
        {
            const bool known =
                copies_[i].size() && copies_[i].last().position == x;
            if (!known)
            {
                copies_[i].append
                (
                    {x, rotationBetween(x, points0_[points_[i]], periods)}
                );
            }
        }
    }
}


Foam::autoPtr<Foam::cyclicCopies> Foam::cyclicCopies::New
(
    const polyMesh& mesh,
    const pointField& points0,
    const meshImages& found
)
{
    return autoPtr<cyclicCopies>
    (
        new cyclicCopies
        (
            mesh,
            points0,
            morph::ImageGroup
            (
                found.periods(),
                found.box(),
                found.touch(),
                std::numeric_limits<int>::max()
            )
        )
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::boolList Foam::cyclicCopies::first() const
{
    boolList is(points_.size());
    forAll(points_, i)
    {
        is[i] = copies_[i][0].position == points0_[points_[i]];
    }
    return is;
}


Foam::List<Foam::vectorField> Foam::cyclicCopies::values
(
    const vectorField& known,
    const vector& unknown
) const
{
    List<vectorField> all(exchanged(known));
    forAll(points_, i)
    {
        const vectorField pairs(all[i]);
        all[i] = vectorField(copies_[i].size(), unknown);
        forAll(copies_[i], c)
        {
            // Some ranks that share a copy may not know: take the smallest
            vector value = unknown;
            for (label j = 0; j < pairs.size(); j += 2)
            {
                if
                (
                    pairs[j] == copies_[i][c].position
                 && magSqr(pairs[j + 1]) < magSqr(value)
                )
                {
                    value = pairs[j + 1];
                }
            }
            if (value != unknown)
            {
                all[i][c] = copies_[i][c].rotation & value;
            }
        }
    }
    return all;
}


Foam::scalar Foam::cyclicCopies::match(vectorField& values) const
{
    if (empty())
    {
        return 0;
    }
    const List<vectorField> copies
    (
        this->values(vectorField(values, points_), vector::uniform(GREAT))
    );
    scalar difference = 0;
    forAll(points_, i)
    {
        const vector mean = sum(copies[i])/copies[i].size();
        values[points_[i]] = mean;
        for (const vector& value : copies[i])
        {
            difference = max(difference, 2*mag(value - mean));
        }
    }
    return returnReduce(difference, maxOp<scalar>());
}


// ************************************************************************* //
