/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cavityFaces.H"
#include "indexedOctree.H"
#include "polyMesh.H"
#include "treeDataFace.H"
#include "treeDataPoint.H"
#include "unitConversion.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Points of a triangle in the order of their numbers
typedef FixedList<label, 3> triple;

static triple sorted(const triFace& f)
{
    triple t({f[0], f[1], f[2]});
    std::sort(t.begin(), t.end());
    return t;
}


//- Is a triangle the same as another, or its reverse?
static bool sameOrientation(const triFace& a, const triFace& b)
{
    return triFace::compare(a, b) > 0;
}


//- A face of a tetrahedron, around the outward normal
static triFace outward(const remeshMap::corners& t, const label facei)
{
    switch (facei)
    {
        case 0:
            return triFace(t[1], t[2], t[3]);
        case 1:
            return triFace(t[0], t[3], t[2]);
        case 2:
            return triFace(t[0], t[1], t[3]);
        default:
            return triFace(t[0], t[2], t[1]);
    }
}


static scalar volume(const UList<point>& x, const remeshMap::corners& t)
{
    return
        (((x[t[1]] - x[t[0]])^(x[t[2]] - x[t[0]])) & (x[t[3]] - x[t[0]]))/6;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cavityFaces::cavityFaces
(
    const cavityTetrahedra& cavity,
    const tetrahedralMesh& made
)
:
    cavity_(cavity),
    made_(made)
{
    scalar before = 0;
    for (const remeshMap::corners& tet : cavity.given().tets)
    {
        before += volume(cavity.given().points, tet);
    }
    scalar after = 0;
    label nFlat = 0;
    for (const remeshMap::corners& tet : made.tets)
    {
        const scalar v = volume(made.points, tet);
        after += v;
        nFlat += !(v > 0);
    }
    OStringStream fault;
    if (nFlat > 0)
    {
        fault << nFlat << " tetrahedra have no positive volume";
    }
    else if (!(mag(after - before) <= 1e-9*before))
    {
        fault
            << "it fills a volume of " << after << " instead of " << before;
    }
    fault_ = fault.str();
    if (fault_.empty())
    {
        match();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::cavityFaces::match()
{
    const tetrahedralMesh& given = cavity_.given();

    // Old faces by their points in the new numbering
    labelList place(given.points.size(), -1);
    forAll(made_.origin, i)
    {
        if (made_.origin[i] >= 0)
        {
            place[made_.origin[i]] = i;
        }
    }
    HashTable<DynamicList<label>, triple, triple::Hash<>> fixedOf;
    forAll(given.fixedFaces, i)
    {
        const triFace& f = given.fixedFaces[i];
        const triFace now(place[f[0]], place[f[1]], place[f[2]]);
        fixedOf(sorted(now)).append(i);
    }
    HashTable<label, triple, triple::Hash<>> planeOf;
    forAll(made_.planeFaces, i)
    {
        planeOf.insert(sorted(made_.planeFaces[i]), made_.planes[i]);
    }

    // Both sides of each triangle
    HashTable<FixedList<label, 2>, triple, triple::Hash<>> first;
    label nFixed = 0;
    DynamicList<label> onPlanes;
    const auto addOuter = [&](const triFace& f, const label tet)
    {
        const auto fixed = fixedOf.cfind(sorted(f));
        if (fixed.found())
        {
            for (const label i : fixed())
            {
                const label facei = cavity_.oldFaces()[i];
                const triFace& then = given.fixedFaces[i];
                const triFace now
                (
                    place[then[0]], place[then[1]], place[then[2]]
                );
                const bool outwards = sameOrientation(now, f);
                const bool owner =
                    cavity_.inside(cavity_.mesh().faceOwner()[facei]);
                // Of a baffle the side on which the tetrahedron is
                if (outwards == owner)
                {
                    faces_.append
                    (
                        outwards
                      ? newFace{now, tet, -1, facei}
                      : newFace{now, -1, tet, facei}
                    );
                    ++nFixed;
                    return;
                }
            }
        }
        const auto plane = planeOf.cfind(sorted(f));
        if (plane.found())
        {
            onPlanes.append(faces_.size());
            faces_.append(newFace{f, tet, -1, -1 - plane()});
            return;
        }
        fault_ = "it has a face outside that was not given";
    };
    forAll(made_.tets, teti)
    {
        for (label i = 0; i < 4; ++i)
        {
            const triFace f(outward(made_.tets[teti], i));
            const auto other = first.cfind(sorted(f));
            if (!other.found())
            {
                first.insert(sorted(f), FixedList<label, 2>({teti, i}));
                continue;
            }
            const label otherTet = other()[0];
            first.erase(sorted(f));
            const auto fixed = fixedOf.cfind(sorted(f));
            if (!fixed.found())
            {
                faces_.append(newFace{f.reverseFace(), otherTet, teti, -1});
                continue;
            }
            const label facei = cavity_.oldFaces()[fixed()[0]];
            if (!cavity_.mesh().isInternalFace(facei))
            {
                addOuter(f, teti);
                addOuter(f.reverseFace(), otherTet);
                continue;
            }
            const triFace& then = given.fixedFaces[fixed()[0]];
            const triFace now(place[then[0]], place[then[1]], place[then[2]]);
            const bool out = sameOrientation(now, f);
            faces_.append
            (
                newFace{now, out ? teti : otherTet, out ? otherTet : teti, facei}
            );
            ++nFixed;
        }
    }
    // In the order of tetrahedra, not of a hash
    DynamicList<FixedList<label, 2>> outer;
    forAllConstIters(first, iter)
    {
        outer.append(iter.val());
    }
    std::sort(outer.begin(), outer.end());
    for (const FixedList<label, 2>& side : outer)
    {
        addOuter(outward(made_.tets[side[0]], side[1]), side[0]);
    }
    if (fault_.empty() && nFixed != given.fixedFaces.size())
    {
        OStringStream fault;
        fault
            << (given.fixedFaces.size() - nFixed) << " of "
            << given.fixedFaces.size() << " faces that had to stay are gone";
        fault_ = fault.str();
    }
    if (fault_.empty())
    {
        findOnPlanes(onPlanes);
    }
}


void Foam::cavityFaces::findOnPlanes(const labelUList& onPlanes)
{
    const polyMesh& mesh = cavity_.mesh();
    Map<labelHashSet> old;
    forAll(cavity_.oldPlaneFaces(), i)
    {
        old(cavity_.given().planes[i]).insert(cavity_.oldPlaneFaces()[i]);
    }
    Map<autoPtr<indexedOctree<treeDataFace>>> trees;
    treeBoundBox bounds(mesh.bounds());
    bounds.inflate(1e-3);
    forAllConstIters(old, iter)
    {
        trees.insert
        (
            iter.key(),
            autoPtr<indexedOctree<treeDataFace>>
            (
                new indexedOctree<treeDataFace>
                (
                    treeDataFace(false, mesh, iter.val().sortedToc()),
                    bounds, 10, 10, 3
                )
            )
        );
    }
    for (const label i : onPlanes)
    {
        newFace& f = faces_[i];
        const label plane = -1 - f.oldFace;
        const auto tree = trees.cfind(plane);
        if (!tree.found())
        {
            fault_ = "it has a face on a plane that was not given";
            return;
        }
        const pointIndexHit nearest
        (
            tree()->findNearest(f.points.centre(made_.points), GREAT)
        );
        f.oldFace = tree()->shapes().faceLabels()[nearest.index()];
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::cavityFaces::figures Foam::cavityFaces::quality() const
{
    const polyMesh& mesh = cavity_.mesh();
    const pointField& x = made_.points;
    pointField centres(made_.tets.size());
    forAll(centres, i)
    {
        const remeshMap::corners& t = made_.tets[i];
        centres[i] = 0.25*(x[t[0]] + x[t[1]] + x[t[2]] + x[t[3]]);
    }
    scalar cosine = 1;
    scalar skewness = 0;
    for (const newFace& f : faces_)
    {
        const vector area(f.points.areaNormal(x));
        const point centre(f.points.centre(x));
        const bool outer =
            f.oldFace >= 0 && (f.owner < 0 || f.neighbour < 0)
         && mesh.isInternalFace(f.oldFace);
        const bool boundary = !outer && (f.owner < 0 || f.neighbour < 0);
        const auto centreOf = [&](const label tet, const label celli)
        {
            return tet >= 0 ? centres[tet] : mesh.cellCentres()[celli];
        };
        point own
        (
            boundary && f.owner < 0
          ? centres[f.neighbour]
          : centreOf(f.owner, outer ? mesh.faceOwner()[f.oldFace] : -1)
        );
        vector d;
        scalar length;
        if (boundary)
        {
            const vector n(area/(mag(area) + VSMALL));
            d = n*(n & (centre - own));
            length = 0.4*mag(d);
        }
        else
        {
            d =
                centreOf
                (
                    f.neighbour, outer ? mesh.faceNeighbour()[f.oldFace] : -1
                )
              - own;
            length = 0.2*mag(d);
            cosine = min
            (
                cosine, (d & area)/(mag(d)*mag(area) + ROOTVSMALL)
            );
        }
        const vector toFace(centre - own);
        const vector off
        (
            toFace - ((area & toFace)/((area & d) + ROOTVSMALL))*d
        );
        const vector along(off/(mag(off) + ROOTVSMALL));
        for (const label pointi : f.points)
        {
            length = max(length, mag(along & (x[pointi] - centre)));
        }
        skewness = max(skewness, mag(off)/(length + ROOTVSMALL));
    }
    return {radToDeg(Foam::acos(max(-1, min(1, cosine)))), skewness};
}


// ************************************************************************* //
