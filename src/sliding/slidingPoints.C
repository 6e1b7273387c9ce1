/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slidingPoints.H"
#include "eigenFields.H"
#include "syncTools.H"

#include <Eigen/Dense>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Directions of conditions are kept while their cosine with the surface's
// normal is larger
static const scalar keptCosine = 0.9;

// Most steps of the final projection onto surfaces, which takes about three
static const label mostSteps = 30;


} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slidingPoints::slidingPoints
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const planarReduction& plane,
    const scalar featureAngle,
    const labelList& controlled,
    const boolList& onAxis
)
:
    mesh_(mesh),
    points0_(points0),
    plane_(plane),
    controlled_(controlled),
    onAxis_(onAxis),
    smoothPatches_(mesh, points0, groups, plane, featureAngle),
    presence_
    (
        mesh, dict, points0, plane, smoothPatches_, featureAngle, controlled_, onAxis_
    ),
    vertex_(findVertices()),
    edges_(smoothPatches_, groups.size(), featureAngle, vertex_)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::labelList Foam::slidingPoints::findVertices() const
{
    labelList vertex(mesh_.nPoints(), -1);
    forAllConstIters(smoothPatches_.faces().vertices(), iter)
    {
        vertex[iter.key()] = iter.val();
    }
    syncTools::syncPointList
    (
        mesh_, vertex, maxEqOp<label>(), label(-1)
    );
    return labelList(UIndirectList<label>(vertex, controlled_));
}


bool Foam::slidingPoints::adopt(const bool rebuild)
{
    bool changed = rebuild || normals_.size() != present_.size();
    for (label i = 0; i < present_.size() && !changed; ++i)
    {
        changed = normals_[i].size() != present_[i].size();
        for (label j = 0; j < present_[i].size() && !changed; ++j)
        {
            const scalar cosine =
                mag(normals_[i][j].normal & present_[i][j].normal);
            changed =
                cosine < keptCosine
             || normals_[i][j].surface != present_[i][j].surface;
        }
    }
    changed = returnReduce(changed, orOp<bool>());
    if (changed)
    {
        normals_ = present_;
    }
    return changed;
}


void Foam::slidingPoints::findWhoFollows()
{
    follows_.setSize(controlled_.size());
    follows_ = false;
    edges_.clear();
    forAll(present_, i)
    {
        if (presence_.fixed(present_[i]) || onAxis_[i])
        {
            continue;
        }
        const smoothPatch& first = smoothPatches_[present_[i][0].surface];
        bool planar = true;
        bool oneMotion = true;
        for (const surfaceNormals::taggedNormal& n : present_[i])
        {
            const smoothPatch& s = smoothPatches_[n.surface];
            planar = planar && s.planar;
            oneMotion =
                oneMotion && s.group == first.group && !smoothPatches_.isNamed(s);
            follows_[i] = follows_[i] || !s.planar || smoothPatches_.moves(s);
        }
        if (present_[i].size() == 2 && !planar && oneMotion)
        {
            edges_.slide(i, first);
        }
    }
}


void Foam::slidingPoints::findOffsets()
{
    // Distance that is kept from a surface that points are on: the round-off of
    // numbers in files
    offsets_.setSize(controlled_.size(), FixedList<scalar, 2>(Zero));
    forAll(present_, i)
    {
        if (presence_.fixed(present_[i]) || onAxis_[i])
        {
            continue;
        }
        forAll(present_[i], j)
        {
            const smoothPatch& s = smoothPatches_[present_[i][j].surface];
            if (smoothPatches_.isNamed(s) && !smoothPatches_.group(s).hasTarget())
            {
                const point& x = points0_[controlled_[i]];
                const slidingSurface::contact c =
                    smoothPatches_.named(s).nearest(x);
                offsets_[i][j] = c.normal & (x - c.position);
            }
        }
    }
}


void Foam::slidingPoints::findCorners()
{
    cornerMoves_.setSize(controlled_.size());
    cornerMoves_ = false;
    forAll(present_, i)
    {
        if (!presence_.fixed(present_[i]))
        {
            continue;
        }
        for (const surfaceNormals::taggedNormal& n : present_[i])
        {
            if (n.surface >= 0)
            {
                const smoothPatch& s = smoothPatches_[n.surface];
                cornerMoves_[i] =
                    cornerMoves_[i] || smoothPatches_.moves(s)
                 || (
                        smoothPatches_.isNamed(s)
                     && smoothPatches_.group(s).hasTarget()
                    );
            }
        }
    }
}


Foam::vector Foam::slidingPoints::wayIntoCorner
(
    const label i,
    const vector& s,
    scalar& off
) const
{
    const point& x = points0_[controlled_[i]];
    const point y = x + plane_.expand(x, s);
    const List<surfaceNormals::taggedNormal>& present = present_[i];

    Eigen::Matrix<double, Eigen::Dynamic, 3> normals(present.size(), 3);
    Eigen::VectorXd distances(present.size());
    forAll(present, j)
    {
        vector n = present[j].normal;
        if (present[j].surface < 0)
        {
            // The axis of a wedge
            normals.row(j) = toEigen(n).transpose();
            distances[j] = n & s;
            continue;
        }

        const smoothPatch& sh = smoothPatches_[present[j].surface];
        label others = 0;
        for (const surfaceNormals::taggedNormal& other : present)
        {
            others += (other.surface == present[j].surface);
        }
        if (sh.planar || (others > 1 && !smoothPatches_.isNamed(sh)))
        {
            n = sh.planar ? sh.normal : n;
            const vector d =
                plane_.reduce(x, smoothPatches_.vertices(sh)[vertex_[i]] - x);
            distances[j] = n & (s - d);
        }
        else
        {
            const slidingSurface::contact c = smoothPatches_.nearest(sh, y);
            n = plane_.reduce(x, c.normal);
            const scalar size = max(mag(n), SMALL);
            distances[j] = (c.normal & (y - c.position))/size;
            n /= size;
            if
            (
                smoothPatches_.isNamed(sh)
             && !smoothPatches_.group(sh).hasTarget()
            )
            {
                const slidingSurface::contact c0 = smoothPatches_.nearest(sh, x);
                distances[j] -= (c0.normal & (x - c0.position))/size;
            }
        }
        normals.row(j) = toEigen(n).transpose();
    }
    off = distances.cwiseAbs().maxCoeff();
    const morph::Vector3 way =
        normals.completeOrthogonalDecomposition().solve(-distances);
    return toFoam(way);
}


bool Foam::slidingPoints::nearestOnEdge
(
    const label i,
    const point& y,
    slidingSurface::contact& c
) const
{
    if (edges_.slides(i))
    {
        c = edges_.nearest(i, y);
        return true;
    }
    const List<surfaceNormals::taggedNormal>& n = present_[i];
    if (n.size() == 2 && n[0].surface == n[1].surface)
    {
        const smoothPatch& s = smoothPatches_[n[0].surface];
        if (smoothPatches_.isNamed(s))
        {
            c = smoothPatches_.named(s).nearestOnEdge(y);
            return true;
        }
    }
    return false;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::slidingPoints::update(const bool rebuild)
{
    if (!smoothPatches_.update())
    {
        if (rebuild)
        {
            normals_ = present_;
        }
        return false;
    }
    present_ = presence_.present();
    findWhoFollows();
    findOffsets();
    findCorners();
    return adopt(rebuild);
}


Foam::vector Foam::slidingPoints::corner(const label i, scalar& off) const
{
    // As long as it gets nearer
    vector s(Zero);
    vector way = wayIntoCorner(i, s, off);
    for (label step = 0; step < mostSteps && off > 0; ++step)
    {
        scalar nearer;
        const vector next = wayIntoCorner(i, s + way, nearer);
        if (nearer >= off)
        {
            break;
        }
        s += way;
        way = next;
        off = nearer;
    }
    return s;
}


Foam::List<Foam::vector> Foam::slidingPoints::normals(const label i) const
{
    List<vector> n(normals_[i].size());
    forAll(n, j)
    {
        n[j] = normals_[i][j].normal;
    }
    return n;
}


morph::TangentPlanes Foam::slidingPoints::planes
(
    const label i,
    const vector& s
) const
{
    const point& x = points0_[controlled_[i]];
    const point y = x + plane_.expand(x, s);
    morph::TangentPlanes planes;

    slidingSurface::contact c;
    if (nearestOnEdge(i, y, c))
    {
        const vector& along = c.normal;
        vector n = present_[i][0].normal;
        n = normalised(n - (n & along)*along);
        const vector m = along ^ n;
        planes.add(toEigen(n), n & (y - c.position));
        planes.add(toEigen(m), m & (y - c.position));
        return planes;
    }

    const bool folded =
        present_[i].size() == 2
     && present_[i][0].surface == present_[i][1].surface;
    forAll(present_[i], j)
    {
        const smoothPatch& sh = smoothPatches_[present_[i][j].surface];
        if (sh.planar || folded)
        {
            // Through the point that the surface has moved the point to
            const vector& n = folded ? present_[i][j].normal : sh.normal;
            const vector d =
                plane_.reduce(x, smoothPatches_.vertices(sh)[vertex_[i]] - x);
            planes.add(toEigen(n), n & (s - d));
            continue;
        }
        c = smoothPatches_.nearest(sh, y);
        const vector m = plane_.reduce(x, c.normal);
        const scalar size = max(mag(m), SMALL);
        planes.add
        (
            toEigen(vector(m/size)),
            ((c.normal & (y - c.position)) - offsets_[i][j])/size
        );
    }
    return planes;
}


Foam::vector Foam::slidingPoints::onto(const label i, const vector& s) const
{
    const point& x = points0_[controlled_[i]];
    slidingSurface::contact c;
    if (!plane_.active())
    {
        const smoothPatch& sh = smoothPatches_[present_[i][0].surface];
        if (nearestOnEdge(i, x + s, c))
        {
            if (!c.beyond)
            {
                return c.position - x;
            }
        }
        else if (present_[i].size() == 1 && !sh.planar)
        {
            c = smoothPatches_.nearest(sh, x + s);
            if (!c.beyond)
            {
                return c.position + offsets_[i][0]*c.normal - x;
            }
        }
    }

    // While it gets nearer
    vector d = s;
    scalar former = GREAT;
    for (label step = 0; step < mostSteps; ++step)
    {
        const vector way = toFoam(morph::wayInto(planes(i, d)));
        if (mag(way) >= former)
        {
            break;
        }
        former = mag(way);
        d += way;
    }
    return d;
}


void Foam::slidingPoints::renewDirections(const label i, const vector& s)
{
    const morph::TangentPlanes p = planes(i, s);
    forAll(normals_[i], j)
    {
        const morph::Vector3 n = p.normals.col(j);
        normals_[i][j].normal = toFoam(n);
    }
}


// ************************************************************************* //
