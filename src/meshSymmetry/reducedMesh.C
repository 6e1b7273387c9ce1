/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "reducedMesh.H"
#include "DynamicList.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "labelPairHashes.H"
#include "meshImages.H"
#include "processorPolyPatch.H"
#include "regionSplit.H"
#include "syncTools.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

struct firstEqOp
{
    void operator()(point& a, const point& b) const
    {
        a = before(b, a) ? b : a;
    }
};


struct lastEqOp
{
    void operator()(point& a, const point& b) const
    {
        a = before(a, b) ? b : a;
    }
};


//- Joins pairs into sets, the same on every rank
static labelList joined(const label n, const UList<labelPair>& pairs)
{
    List<labelList> all(Pstream::nProcs());
    labelList& mine = all[Pstream::myProcNo()];
    for (const labelPair& p : pairs)
    {
        mine.append(p.first());
        mine.append(p.second());
    }
    foamCompat::allGatherList(all);

    // The smallest label of each set is found in as many passes as its longest
    // chain of pairs has links
    labelList least(identity(n));
    for (bool changed = true; changed;)
    {
        changed = false;
        for (const labelList& those : all)
        {
            for (label i = 0; i < those.size(); i += 2)
            {
                label& a = least[those[i]];
                label& b = least[those[i + 1]];
                changed = changed || a != b;
                a = b = min(a, b);
            }
        }
    }
    return least;
}


//- Is the mesh known to be connected? Cheaper than finding regions, and all
//  that most meshes need. Periodic sides, which connect as well, are not looked
//  at. Collective
static bool connected(const polyMesh& mesh)
{
    labelList parent(identity(mesh.nCells()));
    const auto root = [&](label i)
    {
        while (parent[i] != i)
        {
            i = parent[i] = parent[parent[i]];
        }
        return i;
    };
    const labelList& own = mesh.faceOwner();
    const labelList& nei = mesh.faceNeighbour();
    label parts = mesh.nCells();
    for (label facei = 0; facei < nei.size() && parts > 1; ++facei)
    {
        const label a = root(own[facei]);
        const label b = root(nei[facei]);
        parts -= a != b;
        parent[max(a, b)] = min(a, b);
    }

    // The parts of the ranks, by the ranks they touch
    List<labelPair> touching;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        const auto* processor = isA<processorPolyPatch>(patch);
        if (processor && patch.size())
        {
            touching.append
            (
                labelPair(processor->myProcNo(), processor->neighbProcNo())
            );
        }
    }
    const labelList least(joined(Pstream::nProcs(), touching));
    return
        returnReduce(parts == 1, andOp<bool>())
     && least == labelList(least.size(), Zero);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::reducedMesh::reducedMesh
(
    const polyMesh& mesh,
    const pointField& points0
)
:
    mesh_(mesh),
    points0_(points0),
    plane_(mesh, points0),
    coupled_
    (
        cyclicCopies::New
        (
            mesh,
            points0,
            meshImages
            (
                mesh, points0, plane_, labelHashSet(), labelHashSet(),
                pointField()
            )
        )
    ),
    nRegions_(1)
{
    findRegions();

    List<DynamicList<label>> independent(nRegions_);
    forAll(points0_, pointi)
    {
        if (plane_.representative()[pointi] == pointi)
        {
            independent[regionOf(pointi)].append(pointi);
        }
    }
    independent_.setSize(nRegions_);
    forAll(independent_, regioni)
    {
        independent_[regioni].transfer(independent[regioni]);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::reducedMesh::findRegions()
{
    if (connected(mesh_))
    {
        return;
    }
    const regionSplit split(mesh_);
    if (split.nRegions() <= 1)
    {
        return;
    }

    // The smallest region of each point's cells; cells that share a point
    // belong to one region
    const label none = labelMax;
    region_.setSize(mesh_.nPoints());
    region_ = none;
    forAll(mesh_.cells(), celli)
    {
        for (const label facei : mesh_.cells()[celli])
        {
            for (const label pointi : mesh_.faces()[facei])
            {
                region_[pointi] = min(region_[pointi], split[celli]);
            }
        }
    }
    syncTools::syncPointList(mesh_, region_, minEqOp<label>(), none);

    labelPairHashSet pairs;
    forAll(mesh_.cells(), celli)
    {
        for (const label facei : mesh_.cells()[celli])
        {
            for (const label pointi : mesh_.faces()[facei])
            {
                if (region_[pointi] != split[celli])
                {
                    pairs.insert(labelPair(region_[pointi], split[celli]));
                }
            }
        }
    }
    const labelList least(joined(split.nRegions(), pairs.sortedToc()));

    // Numbered by position, independent of the ranks
    pointField first(least.size(), point::uniform(GREAT));
    pointField last(least.size(), point::uniform(-GREAT));
    forAll(region_, pointi)
    {
        if (region_[pointi] != none)
        {
            region_[pointi] = least[region_[pointi]];
            const point& x = points0_[pointi];
            point& f = first[region_[pointi]];
            point& l = last[region_[pointi]];
            f = before(x, f) ? x : f;
            l = before(l, x) ? x : l;
        }
    }
    foamCompat::allCombineList(first, firstEqOp());
    foamCompat::allCombineList(last, lastEqOp());

    labelList order;
    forAll(least, i)
    {
        if (least[i] == i)
        {
            order.append(i);
        }
    }
    std::stable_sort
    (
        order.begin(),
        order.end(),
        [&](const label a, const label b)
        {
            return
                first[a] != first[b]
              ? before(first[a], first[b])
              : before(last[a], last[b]);
        }
    );
    nRegions_ = order.size();
    labelList number(least.size(), Zero);
    forAll(order, i)
    {
        number[order[i]] = i;
    }
    for (label& region : region_)
    {
        region = region == none ? 0 : number[region];
    }
    if (nRegions_ == 1)
    {
        region_.clear();
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::labelList Foam::reducedMesh::regionsAt(const pointField& x) const
{
    labelList regions(x.size(), Zero);
    if (nRegions_ == 1)
    {
        return regions;
    }

    List<pointField> asked(Pstream::nProcs());
    asked[Pstream::myProcNo()] = x;
    foamCompat::allGatherList(asked);
    forAll(asked, ranki)
    {
        scalarField nearest(asked[ranki].size(), GREAT);
        labelList region(asked[ranki].size(), labelMax);
        forAll(asked[ranki], i)
        {
            forAll(points0_, pointi)
            {
                const scalar distance =
                    magSqr(points0_[pointi] - asked[ranki][i]);
                if
                (
                    distance < nearest[i]
                 || (distance == nearest[i] && region_[pointi] < region[i])
                )
                {
                    nearest[i] = distance;
                    region[i] = region_[pointi];
                }
            }
        }
        const scalarField mine(nearest);
        foamCompat::allCombineList(nearest, minEqOp<scalar>());
        forAll(region, i)
        {
            region[i] = mine[i] == nearest[i] ? region[i] : labelMax;
        }
        foamCompat::allCombineList(region, minEqOp<label>());
        if (ranki == Pstream::myProcNo())
        {
            regions = region;
        }
    }
    return regions;
}


Foam::pointField Foam::reducedMesh::positions(const label regioni) const
{
    pointField positions(points0_, independent_[regioni]);
    for (point& x : positions)
    {
        x = plane_.position(x);
    }
    return positions;
}


Foam::tmp<Foam::vectorField> Foam::reducedMesh::expand
(
    const vectorField& inPlane
) const
{
    auto displacement = tmp<vectorField>::New(points0_.size());
    forAll(inPlane, pointi)
    {
        displacement.ref()[pointi] = plane_.expand
        (
            points0_[pointi],
            inPlane[plane_.representative()[pointi]]
        );
    }
    return displacement;
}


// ************************************************************************* //
