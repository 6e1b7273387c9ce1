/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

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

    // Not shared by the ranks: each may hold another list
    treeBoundBox box(points_);
    span_ = box.mag();

    // A box without thickness cannot be divided, nor can one of a single
    // point; ROOTVSMALL alone is lost beside the position
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
