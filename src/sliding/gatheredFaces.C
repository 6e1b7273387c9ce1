/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "gatheredFaces.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "ListOps.H"

#include <algorithm>
#include <map>
#include <vector>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The same face, starting at its smallest vertex
static face rotated(const labelUList& f)
{
    const label n = f.size();
    const label first = std::min_element(f.begin(), f.end()) - f.begin();
    face result(n);
    for (label i = 0; i < n; ++i)
    {
        result[i] = f[(first + i) % n];
    }
    return result;
}


//- Cosine of the angle by which the surface turns at an edge, from the unit
//  normals of two faces. Faces that traverse the edge in the same direction have
//  opposite orientations
static scalar cosineAcross
(
    const edge& e,
    const face& f,
    const face& g,
    const vector& n,
    const vector& m
)
{
    const scalar sign = f.edgeDirection(e) == g.edgeDirection(e) ? -1 : 1;
    // A face without area turns nowhere
    return n == vector(Zero) || m == vector(Zero) ? 1 : sign*(n & m);
}


// Numbers connected components in the order of their first members
class components
{
    labelList parent_;

    label root(label i)
    {
        while (parent_[i] != i)
        {
            i = parent_[i] = parent_[parent_[i]];
        }
        return i;
    }

public:

    explicit components(const label n)
    :
        parent_(identity(n))
    {}

    void join(const label a, const label b)
    {
        const label ra = root(a);
        const label rb = root(b);
        parent_[max(ra, rb)] = min(ra, rb);
    }

    label number(labelList& component)
    {
        label n = 0;
        component.setSize(parent_.size());
        forAll(component, i)
        {
            const label r = root(i);
            component[i] = r == i ? n++ : component[r];
        }
        return n;
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::gatheredFaces::gatheredFaces
(
    const polyMesh& mesh,
    const pointField& points,
    const labelList& faces,
    const boolList& flips,
    const labelList& tags,
    const labelList& families,
    const scalar featureAngle
)
{
    gather(mesh, points, faces, flips, tags);
    const facesAtEdges at(points_.size(), faces_);
    alignDirections(at);
    vectorField normals(faces_.size());
    forAll(normals, i)
    {
        normals[i] = normalised(faces_[i].areaNormal(points_));
    }
    findSmoothPatches(at, normals, featureAngle, families);
    findFeatureEdges(at, normals, featureAngle);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::gatheredFaces::gather
(
    const polyMesh& mesh,
    const pointField& points,
    const labelList& faces,
    const boolList& flips,
    const labelList& tags
)
{
    // From every rank: positions, faces as indices into these, and tags
    const label rank = Pstream::myProcNo();
    List<pointField> allPoints(Pstream::nProcs());
    List<faceList> allFaces(Pstream::nProcs());
    List<labelList> allTags(Pstream::nProcs());
    DynamicList<point> positions;
    faceList& own = allFaces[rank];
    own.setSize(faces.size());
    forAll(faces, i)
    {
        const face& f = mesh.faces()[faces[i]];
        own[i] = flips[i] ? f.reverseFace() : f;
        for (label& pointi : own[i])
        {
            const label meshPoint = pointi;
            if (vertices_.insert(meshPoint, positions.size()))
            {
                positions.append(points[meshPoint]);
            }
            pointi = vertices_[meshPoint];
        }
    }
    allPoints[rank] = positions;
    allTags[rank] = tags;
    foamCompat::allGatherList(allPoints);
    foamCompat::allGatherList(allFaces);
    foamCompat::allGatherList(allTags);

    labelList vertex;
    mergePoints(allPoints, vertex);

    // Faces as vertex indices, each starting at the smallest, and sorted
    DynamicList<face> gathered;
    DynamicList<label> gatheredTags;
    label start = 0;
    label myStart = 0;
    forAll(allFaces, ranki)
    {
        if (ranki == rank)
        {
            myStart = gathered.size();
            forAllIters(vertices_, iter)
            {
                iter.val() = vertex[start + iter.val()];
            }
        }
        for (const face& f : allFaces[ranki])
        {
            labelList labels(f);
            for (label& pointi : labels)
            {
                pointi = vertex[start + pointi];
            }
            gathered.append(rotated(labels));
        }
        gatheredTags.append(allTags[ranki]);
        start += allPoints[ranki].size();
    }
    labelList order(identity(gathered.size()));
    std::sort
    (
        order.begin(),
        order.end(),
        [&](const label a, const label b)
        {
            const face& f = gathered[a];
            const face& g = gathered[b];
            const bool before = std::lexicographical_compare
            (
                f.begin(), f.end(), g.begin(), g.end()
            );
            const bool after = std::lexicographical_compare
            (
                g.begin(), g.end(), f.begin(), f.end()
            );
            return before || (!after && gatheredTags[a] < gatheredTags[b]);
        }
    );

    // Count only one of the two sides of a baffle
    std::map<std::vector<label>, label> known;
    DynamicList<face> distinct;
    DynamicList<label> distinctTags;
    labelList place(order.size());
    for (const label i : order)
    {
        std::vector<label> key(gathered[i].begin(), gathered[i].end());
        std::sort(key.begin(), key.end());
        const auto found = known.emplace(key, distinct.size());
        if (found.second)
        {
            distinct.append(gathered[i]);
            distinctTags.append(gatheredTags[i]);
        }
        place[i] = found.first->second;
    }
    faces_.transfer(distinct);
    tags_.transfer(distinctTags);
    mine_ = SubList<label>(place, faces.size(), myStart);
}


void Foam::gatheredFaces::mergePoints
(
    const List<pointField>& points,
    labelList& vertex
)
{
    DynamicList<point> all;
    for (const pointField& x : points)
    {
        all.append(x);
    }
    labelList order(identity(all.size()));
    std::sort
    (
        order.begin(),
        order.end(),
        [&](const label a, const label b)
        {
            return before(all[a], all[b]);
        }
    );

    vertex.setSize(all.size());
    DynamicList<point> merged;
    for (const label i : order)
    {
        if (merged.empty() || merged.last() != all[i])
        {
            merged.append(all[i]);
        }
        vertex[i] = merged.size() - 1;
    }
    points_.transfer(merged);
}


void Foam::gatheredFaces::alignDirections(const facesAtEdges& at)
{
    // Faces of a zone may be oriented at random: orient them like the first one
    boolList visited(faces_.size(), false);
    forAll(faces_, start)
    {
        if (visited[start])
        {
            continue;
        }
        visited[start] = true;
        DynamicList<label> front(1, start);
        while (front.size())
        {
            const face f(faces_[front.remove()]);
            forAll(f, k)
            {
                const edge e(f.faceEdge(k));
                const SubList<label> these(at.faces(at.find(e)));
                for (const label other : these)
                {
                    if (these.size() == 2 && !visited[other])
                    {
                        visited[other] = true;
                        face& g = faces_[other];
                        if (g.edgeDirection(e) == f.edgeDirection(e))
                        {
                            g = g.reverseFace();
                        }
                        front.append(other);
                    }
                }
            }
        }
    }
}


void Foam::gatheredFaces::findSmoothPatches
(
    const facesAtEdges& at,
    const vectorField& normals,
    const scalar featureAngle,
    const labelList& families
)
{
    components joined(faces_.size());
    const scalar least = Foam::cos(featureAngle);
    forAll(at.edges(), edgei)
    {
        const SubList<label> these(at.faces(edgei));
        if
        (
            these.size() == 2
         && families[tags_[these[0]]] == families[tags_[these[1]]]
         && cosineAcross
            (
                at.edges()[edgei],
                faces_[these[0]],
                faces_[these[1]],
                normals[these[0]],
                normals[these[1]]
            ) > least
        )
        {
            joined.join(these[0], these[1]);
        }
    }
    nSmoothPatches_ = joined.number(smoothPatches_);
}


void Foam::gatheredFaces::findFeatureEdges
(
    const facesAtEdges& at,
    const vectorField& normals,
    const scalar featureAngle
)
{
    DynamicList<edge> sharp;
    const scalar least = Foam::cos(featureAngle);
    forAll(at.edges(), edgei)
    {
        const edge& e = at.edges()[edgei];
        const SubList<label> these(at.faces(edgei));
        for (label i = 1; i < these.size(); ++i)
        {
            const scalar cosine = cosineAcross
            (
                e,
                faces_[these[0]],
                faces_[these[i]],
                normals[these[0]],
                normals[these[i]]
            );
            if (cosine < least)
            {
                sharp.append(e);
                break;
            }
        }
    }
    edges_ = sharp;

    Map<DynamicList<label>> edgesAt(2*edges_.size());
    forAll(edges_, i)
    {
        edgesAt(edges_[i].start()).append(i);
        edgesAt(edges_[i].end()).append(i);
    }
    components joined(edges_.size());
    forAllConstIters(edgesAt, iter)
    {
        if (iter.val().size() == 2)
        {
            const label pointi = iter.key();
            const edge& a = edges_[iter.val()[0]];
            const edge& b = edges_[iter.val()[1]];
            const vector from
            (
                normalised(points_[pointi] - points_[a.otherVertex(pointi)])
            );
            const vector to
            (
                normalised(points_[b.otherVertex(pointi)] - points_[pointi])
            );
            if ((from & to) > Foam::cos(featureAngle))
            {
                joined.join(iter.val()[0], iter.val()[1]);
            }
        }
    }
    nFeatureEdges_ = joined.number(featureEdges_);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::triSurface Foam::gatheredFaces::smoothPatch
(
    const label smoothPatchi,
    const pointField& points
) const
{
    // Split polygons into triangles around their centres, which do not depend
    // on where a polygon starts
    DynamicList<point> x;
    DynamicList<labelledTri> triangles;
    Map<label> place;
    forAll(faces_, i)
    {
        if (smoothPatches_[i] != smoothPatchi)
        {
            continue;
        }
        const face& f = faces_[i];
        labelList corners(f.size());
        point centre(Zero);
        forAll(f, k)
        {
            if (place.insert(f[k], x.size()))
            {
                x.append(points[f[k]]);
            }
            corners[k] = place[f[k]];
            centre += points[f[k]]/f.size();
        }
        if (f.size() == 3)
        {
            triangles.append(labelledTri(corners[0], corners[1], corners[2], 0));
            continue;
        }
        x.append(centre);
        forAll(f, k)
        {
            triangles.append
            (
                labelledTri
                (
                    corners[k], corners[f.fcIndex(k)], x.size() - 1, 0
                )
            );
        }
    }
    return triSurface(List<labelledTri>(triangles), pointField(x));
}


// ************************************************************************* //
