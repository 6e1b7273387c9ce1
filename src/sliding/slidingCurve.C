/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slidingCurve.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slidingCurve::slidingCurve
(
    const pointField& points,
    const edgeList& edges,
    const scalar featureAngle
)
:
    points_(points),
    edges_(edges),
    tangents_(edges.size()),
    ends_(edges.size()),
    tree_(nullptr)
{
    Map<DynamicList<label>> edgesAt(2*edges_.size());
    forAll(edges_, i)
    {
        edgesAt(edges_[i].start()).append(i);
        edgesAt(edges_[i].end()).append(i);
    }

    forAll(edges_, i)
    {
        const vector own = edges_[i].unitVec(points_);
        for (const label side : {0, 1})
        {
            const label pointi = edges_[i][side];
            const labelList around(edgesAt[pointi]);
            vector& tangent = tangents_[i][side];
            tangent = own;
            ends_[i][side] = around.size() == 1;
            if (around.size() == 2)
            {
                const edge& other =
                    edges_[around[0] == i ? around[1] : around[0]];
                const vector along = other.unitVec(points_);
                const bool follows =
                    (other.start() == pointi) == (side == 1);
                const vector next = follows ? along : -along;
                if ((next & own) > Foam::cos(featureAngle))
                {
                    tangent = normalised(own + next);
                }
            }
        }
    }

    boundBox box;
    for (const edge& e : edges_)
    {
        box.add(points_[e.start()]);
        box.add(points_[e.end()]);
    }
    box.inflate(0.01);
    tree_.reset
    (
        new indexedOctree<treeDataEdge>
        (
            treeDataEdge(true, edges_, points_, identity(edges_.size())),
            treeBoundBox(box),
            8,
            10,
            3
        )
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::slidingSurface::contact Foam::slidingCurve::nearest(const point& x) const
{
    const pointIndexHit hit = tree_->findNearest(x, sqr(GREAT));
    const label i = hit.index();
    const point& a = points_[edges_[i].start()];
    const point& b = points_[edges_[i].end()];
    const scalar t = min
    (
        max(((x - a) & (b - a))/max(magSqr(b - a), VSMALL), scalar(0)),
        scalar(1)
    );
    return
    {
        a + t*(b - a),
        normalised((1 - t)*tangents_[i].first() + t*tangents_[i].second()),
        (t <= 0 && ends_[i].first()) || (t >= 1 && ends_[i].second())
    };
}


// ************************************************************************* //
