/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "positionTable.H"
#include "treeBoundBox.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::positionTable::positionTable(const pointField& points)
:
    points_(points),
    span_(0),
    tree_(nullptr)
{
    if (points_.empty())
    {
        return;
    }

    // Not shared between ranks: each may hold a different list
    treeBoundBox box(points_);
    span_ = box.mag();

    // An octree cannot divide a box without thickness, nor that of a single
    // point; ROOTVSMALL alone vanishes beside the position
    const scalar magnitude = mag(box.min()) + mag(box.max());
    const vector room =
        vector::uniform(1e-3*span_ + 1e-6*magnitude + ROOTVSMALL);
    box.min() -= room;
    box.max() += room;

    tree_.reset
    (
        new indexedOctree<treeDataPoint>
        (
            treeDataPoint(points_), box, 8, 10, 3.0
        )
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::positionTable::find
(
    const point& x,
    const scalar tolerance
) const
{
    if (!tree_.valid())
    {
        return -1;
    }
    const pointIndexHit nearest = tree_->findNearest(x, sqr(tolerance));
    return nearest.hit() ? nearest.index() : -1;
}


// ************************************************************************* //
