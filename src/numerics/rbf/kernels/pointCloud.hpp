// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Points sorted into leaves of neighbours, so that sums over control points of
// compact support skip those that are out of reach.

#ifndef morph_pointCloud_hpp
#define morph_pointCloud_hpp

#include "arrays.hpp"

#include <vector>

namespace morph
{

class PointCloud
{
public:
    // A leaf owns the sorted points [begin, end), whole blocks of
    // kernelSum's blockSize of which the first `count` are real and the rest
    // copies of the last one
    struct Leaf
    {
        Index begin;
        Index end;
        Index count;
        Vector3 low;
        Vector3 high;

        // Square of the distance from a point to the leaf's box
        double distance2(const Vector3& x) const;
    };

    // positions: n x 3 [m]
    explicit PointCloud(const Vectors& positions);

    Index size() const { return size_; }

    const std::vector<Leaf>& leaves() const { return leaves_; }

    // The positions, leaf after leaf, padded: padded size x 3
    const Columns& sorted() const { return sorted_; }

    // For each sorted point its index in the given positions; padding has the
    // index of the point that it copies
    const std::vector<Index>& index() const { return index_; }

private:
    // Beside its index, so that sorting reads memory in order
    struct Place
    {
        double x[3];
        Index index;
    };

    void split(Place* begin, Place* end);
    void addLeaf(const Place* begin, const Place* end);

    Index size_;
    std::vector<Leaf> leaves_;
    std::vector<Index> index_;
    Columns sorted_;
};

} // namespace morph

#endif
