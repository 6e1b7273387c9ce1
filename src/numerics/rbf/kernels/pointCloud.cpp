// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pointCloud.hpp"

#include "kernelSum.hpp"

#include <algorithm>

namespace morph
{

namespace
{

// Small enough to be culled well, large enough for the list of the centres in
// reach to cost little beside the sum
constexpr Index leafSize = 16 * blockSize;

} // namespace


double PointCloud::Leaf::distance2(const Vector3& x) const
{
    return (low - x).cwiseMax(x - high).cwiseMax(Vector3::Zero()).squaredNorm();
}


PointCloud::PointCloud(const Vectors& positions)
: size_(positions.rows())
{
    std::vector<Place> places(size_);
    for (Index i = 0; i < size_; ++i)
    {
        places[i] = {{positions(i, 0), positions(i, 1), positions(i, 2)}, i};
    }
    if (size_ > 0)
    {
        split(places.data(), places.data() + size_);
    }

    sorted_.resize(index_.size(), 3);
    for (std::size_t i = 0; i < index_.size(); ++i)
    {
        sorted_.row(i) = positions.row(index_[i]);
    }
}


void PointCloud::split(Place* begin, Place* end)
{
    if (end - begin <= leafSize)
    {
        addLeaf(begin, end);
        return;
    }

    Vector3 low = Eigen::Map<const Vector3>(begin->x);
    Vector3 high = low;
    for (const Place* p = begin; p != end; ++p)
    {
        low = low.cwiseMin(Eigen::Map<const Vector3>(p->x));
        high = high.cwiseMax(Eigen::Map<const Vector3>(p->x));
    }
    int axis;
    (high - low).maxCoeff(&axis);

    // Cut at a multiple of the leaf size, so that only one leaf is not full
    const Index leaves = (end - begin + leafSize - 1) / leafSize;
    Place* const middle = begin + (leaves / 2) * leafSize;
    std::nth_element(
        begin, middle, end,
        [axis](const Place& a, const Place& b)
        { return a.x[axis] < b.x[axis]; });
    split(begin, middle);
    split(middle, end);
}


void PointCloud::addLeaf(const Place* begin, const Place* end)
{
    Leaf leaf;
    leaf.begin = index_.size();
    leaf.count = end - begin;
    leaf.low = Eigen::Map<const Vector3>(begin->x);
    leaf.high = leaf.low;
    for (const Place* p = begin; p != end; ++p)
    {
        leaf.low = leaf.low.cwiseMin(Eigen::Map<const Vector3>(p->x));
        leaf.high = leaf.high.cwiseMax(Eigen::Map<const Vector3>(p->x));
        index_.push_back(p->index);
    }
    while ((index_.size() - leaf.begin) % blockSize != 0)
    {
        index_.push_back(index_.back());
    }
    leaf.end = index_.size();
    leaves_.push_back(leaf);
}

} // namespace morph
