/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "planarReduction.H"
#include "emptyPolyPatch.H"
#include "wedgePolyPatch.H"
#include "foamCompat.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Points closer to the axis of a wedge than this, in units of the mesh's size,
// are on it
static const scalar samePlace = 1e-8;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::planarReduction::planarReduction
(
    const polyMesh& mesh,
    const pointField& points
)
:
    kind_(kind::none),
    origin_(Zero),
    normal_(Zero),
    axis_(Zero),
    radial_(Zero),
    axisTolerance_(samePlace*boundBox(points, true).mag()),
    representative_(identity(points.size()))
{
    bool wedge = false;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        // One without faces is left over in a three-dimensional mesh
        wedge = wedge || (isA<wedgePolyPatch>(patch) && patch.size());
    }

    if (returnReduce(wedge, orOp<bool>()))
    {
        kind_ = kind::wedge;
        findWedge(mesh, points);
    }
    else if (mesh.nGeometricD() == 2)
    {
        kind_ = kind::empty;
        findEmpty(mesh, points);
    }
    if (active())
    {
        pair(mesh, points);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::planarReduction::findEmpty
(
    const polyMesh& mesh,
    const pointField& points
)
{
    for (direction d = 0; d < vector::nComponents; ++d)
    {
        if (mesh.geometricD()[d] == -1)
        {
            normal_[d] = 1;
        }
    }
    scalar lowest = GREAT;
    for (const point& x : points)
    {
        lowest = min(lowest, x & normal_);
    }
    Foam::reduce(lowest, minOp<scalar>());
    origin_ = lowest*normal_;
}


void Foam::planarReduction::findWedge
(
    const polyMesh& mesh,
    const pointField& points
)
{
    // A normal and a point of each wedge patch, from ranks with faces
    List<vectorField> planes(Pstream::nProcs());
    vectorField& mine = planes[Pstream::myProcNo()];
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (isA<wedgePolyPatch>(patch) && patch.size())
        {
            const vector n = patch[0].areaNormal(points);
            mine.append(n/mag(n));
            mine.append(patch[0].centre(points));
        }
    }
    foamCompat::allGatherList(planes);
    const vectorField all
    (
        ListListOps::combine<vectorField>(planes, accessOp<vectorField>())
    );

    // The two patches are those whose normals differ most
    const vector n1 = all[0];
    label other = 0;
    for (label i = 0; i < all.size(); i += 2)
    {
        if (mag(all[i] - n1) > mag(all[other] - n1))
        {
            other = i;
        }
    }
    const vector n2 = all[other];

    // Both normals point outwards: the normal of the plane between them, and
    // the axis where they meet: x = p1 + a n1 + b n2 with x on both planes
    normal_ = (n1 - n2)/mag(n1 - n2);
    axis_ = (n1 ^ n2)/mag(n1 ^ n2);
    const scalar c = n1 & n2;
    const scalar h = (all[other + 1] - all[1]) & n2;
    origin_ = all[1] + h/(1 - sqr(c))*(n2 - c*n1);
    radial_ = axis_ ^ normal_;
    if (((all[1] - origin_) & radial_) < 0)
    {
        radial_ = -radial_;
    }
}


void Foam::planarReduction::pair
(
    const polyMesh& mesh,
    const pointField& points
)
{
    // Partners are joined by an edge that has no length in the plane
    for (const edge& e : mesh.edges())
    {
        const point& a = points[e.start()];
        const point& b = points[e.end()];
        if (mag(position(a) - position(b)) < 1e-2*mag(a - b))
        {
            const bool startIsLower = (a & normal_) < (b & normal_);
            const label lower = startIsLower ? e.start() : e.end();
            const label upper = startIsLower ? e.end() : e.start();
            representative_[upper] = lower;
        }
    }
}


Foam::vector Foam::planarReduction::outwards(const point& x) const
{
    vector r = x - origin_;
    r -= (r & axis_)*axis_;
    const scalar length = mag(r);
    return length > ROOTVSMALL ? r/length : radial_;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::point Foam::planarReduction::position(const point& x) const
{
    switch (kind_)
    {
        case kind::empty:
            return x - ((x - origin_) & normal_)*normal_;

        case kind::wedge:
        {
            const vector r = x - origin_;
            const scalar a = r & axis_;
            return origin_ + a*axis_ + mag(r - a*axis_)*radial_;
        }

        default:
            return x;
    }
}


Foam::vector Foam::planarReduction::reduce
(
    const point& x,
    const vector& d
) const
{
    switch (kind_)
    {
        case kind::empty:
            return d - (d & normal_)*normal_;

        case kind::wedge:
            return (d & axis_)*axis_ + (d & outwards(x))*radial_;

        default:
            return d;
    }
}


Foam::vector Foam::planarReduction::reduceMotion
(
    const point& x,
    const vector& d
) const
{
    const vector inPlane = reduce(x, d);
    return onAxis(x) ? inPlane - (inPlane & radial_)*radial_ : inPlane;
}


Foam::vector Foam::planarReduction::expand
(
    const point& x,
    const vector& d
) const
{
    return
        kind_ == kind::wedge
      ? (d & axis_)*axis_ + (d & radial_)*outwards(x)
      : d;
}


bool Foam::planarReduction::onAxis(const point& x) const
{
    return
        kind_ == kind::wedge
     && ((position(x) - origin_) & radial_) < axisTolerance_;
}


// ************************************************************************* //
