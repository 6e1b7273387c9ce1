/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slidingEdges.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slidingEdges::slidingEdges
(
    const smoothPatches& patches,
    const label nGroups,
    const scalar featureAngle,
    const labelList& vertex
)
:
    smoothPatches_(patches),
    nGroups_(nGroups),
    featureAngle_(featureAngle),
    featureEdge_(vertex.size()),
    curve_(vertex.size(), -1)
{
    // Chains that meet at a vertex end there: points at it slide along none
    const gatheredFaces& faces = smoothPatches_.faces();
    Map<label> featureEdgeAt(2*faces.edges().size());
    forAll(faces.edges(), i)
    {
        for (const label end : {0, 1})
        {
            const label v = faces.edges()[i][end];
            const label featureEdgei = faces.featureEdges()[i];
            if (!featureEdgeAt.insert(v, featureEdgei) && featureEdgeAt[v] != featureEdgei)
            {
                featureEdgeAt[v] = -1;
            }
        }
    }
    forAll(featureEdge_, i)
    {
        featureEdge_[i] = featureEdgeAt.lookup(vertex[i], -1);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::slidingEdges::makeCurve(const label curvei, const label featureEdgei, const smoothPatch& s)
{
    const gatheredFaces& faces = smoothPatches_.faces();
    DynamicList<edge> edges;
    forAll(faces.edges(), edgei)
    {
        if (faces.featureEdges()[edgei] == featureEdgei)
        {
            edges.append(faces.edges()[edgei]);
        }
    }
    curves_.set
    (
        curvei,
        new slidingCurve(smoothPatches_.vertices(s), edgeList(edges), featureAngle_)
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slidingEdges::clear()
{
    curve_ = -1;
    curves_.clear();
    curves_.setSize(smoothPatches_.faces().nFeatureEdges()*(nGroups_ + 1));
}


void Foam::slidingEdges::slide(const label i, const smoothPatch& s)
{
    if (featureEdge_[i] >= 0)
    {
        curve_[i] = featureEdge_[i]*(nGroups_ + 1) + s.group + 1;
        if (!curves_.set(curve_[i]))
        {
            makeCurve(curve_[i], featureEdge_[i], s);
        }
    }
}


// ************************************************************************* //
