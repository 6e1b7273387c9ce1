// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "boxTree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace morph
{

namespace
{

constexpr int leafSize = 8;

} // namespace


Box Box::empty()
{
    const double most = std::numeric_limits<double>::max();
    return {Vector3::Constant(most), Vector3::Constant(-most)};
}


void Box::extend(const Vector3& x)
{
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
}


void Box::extend(const Box& box)
{
    low = low.cwiseMin(box.low);
    high = high.cwiseMax(box.high);
}


BoxTree::BoxTree(std::vector<Box> boxes)
: boxes_(std::move(boxes)),
  order_(boxes_.size())
{
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty())
    {
        build(0, int(order_.size()));
    }
}


void BoxTree::build(const int first, const int last)
{
    const std::size_t here = nodes_.size();
    Box box = Box::empty();
    for (int i = first; i < last; ++i)
    {
        box.extend(boxes_[order_[i]]);
    }
    nodes_.push_back({box, first, last, -1});
    if (last - first <= leafSize)
    {
        return;
    }

    int axis;
    (box.high - box.low).maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    const auto twiceCentre = [&](const int i)
    { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
    std::nth_element(
        order_.begin() + first, order_.begin() + middle, order_.begin() + last,
        [&](const int a, const int b)
        {
            const double p = twiceCentre(a), q = twiceCentre(b);
            return p < q || (p == q && a < b);
        });

    build(first, middle);
    nodes_[here].second = int(nodes_.size());
    build(middle, last);
}

} // namespace morph
