/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellTetrahedra.H"
#include "bitSet.H"
#include "polyMesh.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Volume of a tetrahedron of this fraction of its cell's counts as none
static const scalar flat = 1e-9;


static bool before(const point& a, const point& b)
{
    for (direction d = 0; d < point::nComponents; ++d)
    {
        if (a[d] != b[d])
        {
            return a[d] < b[d];
        }
    }
    return false;
}


//- Indices in the order of positions
static labelList inOrder(const UList<point>& points)
{
    labelList order(identity(points.size()));
    std::stable_sort
    (
        order.begin(),
        order.end(),
        [&](const label a, const label b)
        {
            return before(points[a], points[b]);
        }
    );
    return order;
}


//- Points of a face from the first in position, towards the first of its
//  neighbours
static pointField canonical(const face& f, const UList<point>& points)
{
    pointField x(UIndirectList<point>(points, f));
    const label n = x.size();
    label first = 0;
    forAll(x, i)
    {
        first = before(x[i], x[first]) ? i : first;
    }
    const bool forward =
        before(x[(first + 1)%n], x[(first + n - 1)%n]);
    pointField sorted(n);
    forAll(sorted, i)
    {
        sorted[i] = x[(first + (forward ? i : n - i))%n];
    }
    return sorted;
}


//- OpenFOAM's face centre, and the area in the order of these points
static point centreOf(const pointField& x, vector& area)
{
    const label n = x.size();
    const point mean(sum(x)/n);
    vector sumN(Zero);
    scalar sumA = 0;
    vector sumAc(Zero);
    forAll(x, i)
    {
        const point& next = x[(i + 1)%n];
        const vector a((next - x[i])^(mean - x[i]));
        sumN += a;
        sumA += mag(a);
        sumAc += mag(a)*(x[i] + next + mean);
    }
    area = 0.5*sumN;
    if (n == 3)
    {
        return mean;
    }
    return sumA > ROOTVSMALL ? point(sumAc/(3*sumA)) : mean;
}


//- The point that is farthest inside of planes, found from a start: steps
//  along the normal of the nearest, which get shorter
static point deepest
(
    const List<point>& onPlane,
    const List<vector>& inward,
    const point& start,
    const scalar length,
    scalar& depth
)
{
    static const label nSteps = 500;
    point x(start);
    point best(start);
    depth = -GREAT;
    for (label step = 0; step < nSteps; ++step)
    {
        label nearest = 0;
        scalar distance = GREAT;
        forAll(onPlane, i)
        {
            const scalar d = inward[i] & (x - onPlane[i]);
            if (d < distance)
            {
                distance = d;
                nearest = i;
            }
        }
        if (distance > depth)
        {
            depth = distance;
            best = x;
        }
        x += inward[nearest]*(0.3*length/(1 + 0.1*step));
    }
    return best;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::cellTetrahedra::addPoints(const labelUList& cells)
{
    bitSet used(mesh_.nPoints());
    for (const label celli : cells)
    {
        for (const label facei : mesh_.cells()[celli])
        {
            used.set(mesh_.faces()[facei]);
        }
    }
    const labelList labels(used.sortedToc());
    const pointField x(mesh_.points(), labels);
    const labelList order(inOrder(x));
    meshPoints_ = UIndirectList<label>(labels, order);
    points_ = UIndirectList<point>(mesh_.points(), meshPoints_);
    forAll(meshPoints_, i)
    {
        places_.insert(meshPoints_[i], i);
    }
}


bool Foam::cellTetrahedra::cutPlane(const label facei, const point& centre)
{
    const face& f = mesh_.faces()[facei];
    const pointField& x = mesh_.points();
    if (f.size() == 3)
    {
        triangles_.insert
        (
            facei,
            triFaceList
            (
                1, triFace(places_[f[0]], places_[f[1]], places_[f[2]])
            )
        );
        return true;
    }
    if (f.size() > 4)
    {
        return false;
    }
    const scalar d02 = magSqr(x[f[2]] - x[f[0]]);
    const scalar d13 = magSqr(x[f[3]] - x[f[1]]);
    const label a =
        d02 < d13 ? 0
      : d13 < d02 ? 1
      : min(places_[f[0]], places_[f[2]]) < min(places_[f[1]], places_[f[3]])
      ? 0 : 1;
    const label b = (a + 2)%4;
    const vector n1(triFace(f[a], f[a + 1], f[b]).areaNormal(x));
    const vector n2(triFace(f[a], f[b], f[(b + 1)%4]).areaNormal(x));
    const vector n(n1 + n2);
    const scalar size = Foam::sqrt(mag(n));
    const scalar roundOff = max(mag(centre), size)*1e-15;
    // The diagonal lies in the surface, and so does the centre
    const bool exact =
        mag(n & (centre - x[f[a]])) <= mag(n)*max(1e-13*size, roundOff);
    const bool convex =
        (n1 & n) > 1e-3*magSqr(n) && (n2 & n) > 1e-3*magSqr(n);
    if (!exact || !convex)
    {
        return false;
    }
    triFaceList triangles(2);
    triangles[0] = triFace(places_[f[a]], places_[f[a + 1]], places_[f[b]]);
    triangles[1] =
        triFace(places_[f[a]], places_[f[b]], places_[f[(b + 1)%4]]);
    triangles_.insert(facei, triangles);
    return true;
}


void Foam::cellTetrahedra::cutFaces(const labelUList& cells)
{
    labelHashSet used;
    for (const label celli : cells)
    {
        used.insert(mesh_.cells()[celli]);
    }
    DynamicList<label> faces;
    DynamicList<point> centres;
    for (const label facei : used.sortedToc())
    {
        vector area;
        const point centre
        (
            centreOf(canonical(mesh_.faces()[facei], mesh_.points()), area)
        );
        if (!cutPlane(facei, centre))
        {
            faces.append(facei);
            centres.append(centre);
        }
    }
    for (const label i : inOrder(centres))
    {
        const label centrei = points_.size();
        points_.append(centres[i]);
        meshPoints_.append(-1);
        const face& f = mesh_.faces()[faces[i]];
        triFaceList triangles(f.size());
        forAll(f, fp)
        {
            triangles[fp] =
                triFace(places_[f[fp]], places_[f.nextLabel(fp)], centrei);
        }
        triangles_.insert(faces[i], triangles);
    }
}


void Foam::cellTetrahedra::cutCells(const labelUList& cells)
{
    List<point> apices(cells.size());
    DynamicList<label> blind;
    forAll(cells, i)
    {
        const label celli = cells[i];
        const cell& faces = mesh_.cells()[celli];

        // OpenFOAM's cell centre, its faces in the order of their centres
        List<point> centres(faces.size());
        List<vector> areas(faces.size());
        forAll(faces, j)
        {
            const pointField x
            (
                canonical(mesh_.faces()[faces[j]], mesh_.points())
            );
            centres[j] = centreOf(x, areas[j]);
        }
        const labelList order(inOrder(centres));
        point mean(Zero);
        for (const label j : order)
        {
            mean += centres[j]/faces.size();
        }
        scalar sumV = 0;
        vector sumVc(Zero);
        for (const label j : order)
        {
            const scalar v = mag(areas[j] & (centres[j] - mean));
            sumV += v;
            sumVc += v*(0.75*centres[j] + 0.25*mean);
        }
        apices[i] = sumV > VSMALL ? point(sumVc/sumV) : mean;

        // Does it see all triangles?
        List<point> onPlane;
        List<vector> inward;
        scalar least = GREAT;
        scalar total = 0;
        for (const label j : order)
        {
            const bool owner = mesh_.faceOwner()[faces[j]] == celli;
            for (const triFace& t : triangles_[faces[j]])
            {
                const vector n
                (
                    (owner ? -1 : 1)*t.areaNormal(points_)
                );
                const point& x = points_[t[0]];
                const scalar v = (n & (apices[i] - x))/3;
                least = min(least, v);
                total += v;
                onPlane.append(x);
                inward.append(n/max(mag(n), VSMALL));
            }
        }
        if (least <= flat*total)
        {
            scalar depth;
            const scalar length = Foam::cbrt(max(total, VSMALL));
            apices[i] = deepest(onPlane, inward, apices[i], length, depth);
            if (depth <= flat*length)
            {
                blind.append(celli);
            }
        }
    }
    blind_.transfer(blind);

    for (const label i : inOrder(apices))
    {
        apices_.insert(cells[i], points_.size());
        points_.append(apices[i]);
        meshPoints_.append(-1);
        addTetrahedra(cells[i]);
    }
}


void Foam::cellTetrahedra::addTetrahedra(const label celli)
{
    const label apex = apices_[celli];
    DynamicList<remeshMap::corners> tets;
    for (const label facei : mesh_.cells()[celli])
    {
        const bool owner = mesh_.faceOwner()[facei] == celli;
        for (const triFace& t : triangles_[facei])
        {
            // In the order of numbers, turned so that the volume is positive
            FixedList<label, 3> base({t[0], t[1], t[2]});
            const label start = base.find(min(t[0], min(t[1], t[2])));
            remeshMap::corners tet;
            tet[0] = t[start];
            tet[1] = t[(start + (owner ? 2 : 1))%3];
            tet[2] = t[(start + (owner ? 1 : 2))%3];
            tet[3] = apex;
            tets.append(tet);
        }
    }
    std::sort(tets.begin(), tets.end());
    tets_.append(tets);
    cells_.append(labelList(tets.size(), celli));
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellTetrahedra::cellTetrahedra
(
    const polyMesh& mesh,
    const labelUList& cells
)
:
    mesh_(mesh)
{
    addPoints(cells);
    cutFaces(cells);
    cutCells(cells);
}


// ************************************************************************* //
