/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "facesAtEdges.H"
#include "DynamicList.H"
#include "labelPair.H"

#include <algorithm>

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::facesAtEdges::facesAtEdges(const label nPoints, const UList<face>& faces)
:
    ofVertex_(nPoints + 1, Zero)
{
    // For each smaller vertex the larger one and the face of all its edges
    labelList first(nPoints + 1, Zero);
    for (const face& f : faces)
    {
        forAll(f, k)
        {
            ++first[min(f[k], f.nextLabel(k)) + 1];
        }
    }
    for (label i = 0; i < nPoints; ++i)
    {
        first[i + 1] += first[i];
    }
    List<labelPair> others(first[nPoints]);
    labelList next(first);
    forAll(faces, i)
    {
        const face& f = faces[i];
        forAll(f, k)
        {
            const label a = f[k];
            const label b = f.nextLabel(k);
            others[next[min(a, b)]++] = labelPair(max(a, b), i);
        }
    }

    faces_.setSize(others.size());
    DynamicList<edge> edges(others.size()/2 + 1);
    DynamicList<label> start(others.size()/2 + 2);
    for (label a = 0; a < nPoints; ++a)
    {
        ofVertex_[a] = edges.size();
        std::stable_sort
        (
            others.begin() + first[a],
            others.begin() + first[a + 1],
            [](const labelPair& p, const labelPair& q)
            {
                return p.first() < q.first();
            }
        );
        for (label i = first[a]; i < first[a + 1]; ++i)
        {
            if (i == first[a] || others[i].first() != others[i - 1].first())
            {
                edges.append(edge(a, others[i].first()));
                start.append(i);
            }
            faces_[i] = others[i].second();
        }
    }
    ofVertex_[nPoints] = edges.size();
    start.append(others.size());
    edges_.transfer(edges);
    start_.transfer(start);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::facesAtEdges::find(const edge& e) const
{
    const label a = min(e.start(), e.end());
    const label b = max(e.start(), e.end());
    for (label i = ofVertex_[a]; i < ofVertex_[a + 1]; ++i)
    {
        if (edges_[i].end() == b)
        {
            return i;
        }
    }
    return -1;
}


// ************************************************************************* //
