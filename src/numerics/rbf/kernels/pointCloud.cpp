// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pointCloud.hpp"

#include "kernelSum.hpp"

#include <algorithm>
#include <numeric>

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
: size_(positions.rows()),
  order_(positions.rows())
{
    std::iota(order_.begin(), order_.end(), Index(0));
    if (size_ > 0)
    {
        split(positions, 0, size_);
    }

    sorted_.resize(index_.size(), 3);
    for (std::size_t i = 0; i < index_.size(); ++i)
    {
        sorted_.row(i) = positions.row(index_[i]);
    }
    order_ = std::vector<Index>();
}


void PointCloud::split(const Vectors& x, Index begin, Index end)
{
    if (end - begin <= leafSize)
    {
        addLeaf(x, begin, end);
        return;
    }

    Vector3 low = x.row(order_[begin]);
    Vector3 high = low;
    for (Index i = begin; i < end; ++i)
    {
        const Vector3 p = x.row(order_[i]);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    int axis;
    (high - low).maxCoeff(&axis);

    // Cut at a multiple of the leaf size, so that only one leaf is not full
    const Index leaves = (end - begin + leafSize - 1) / leafSize;
    const Index middle = begin + (leaves / 2) * leafSize;
    std::nth_element(
        order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
        [&](Index a, Index b) { return x(a, axis) < x(b, axis); });
    split(x, begin, middle);
    split(x, middle, end);
}


void PointCloud::addLeaf(const Vectors& x, Index begin, Index end)
{
    Leaf leaf;
    leaf.begin = index_.size();
    leaf.count = end - begin;
    leaf.low = x.row(order_[begin]);
    leaf.high = leaf.low;
    for (Index i = begin; i < end; ++i)
    {
        const Vector3 p = x.row(order_[i]);
        leaf.low = leaf.low.cwiseMin(p);
        leaf.high = leaf.high.cwiseMax(p);
        index_.push_back(order_[i]);
    }
    while ((index_.size() - leaf.begin) % blockSize != 0)
    {
        index_.push_back(index_.back());
    }
    leaf.end = index_.size();
    leaves_.push_back(leaf);
}

} // namespace morph
