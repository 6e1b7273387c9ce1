// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Which of many boxes touch another: a tree of bounding boxes, halved at the
// middle of the longest side.

#ifndef morph_boxTree_hpp
#define morph_boxTree_hpp

#include "arrays.hpp"

#include <vector>

namespace morph
{

struct Box
{
    Vector3 low;
    Vector3 high;

    // One that holds nothing
    static Box empty();

    void extend(const Vector3& x);
    void extend(const Box& box);

    bool touches(const Box& box) const
    {
        return (low.array() <= box.high.array()).all()
            && (box.low.array() <= high.array()).all();
    }
};


class BoxTree
{
public:
    explicit BoxTree(std::vector<Box> boxes);

    // Calls visit(index) for each box that touches this one
    template <class Visit>
    void forAllTouching(const Box& box, const Visit& visit) const;

private:
    // Leaves have boxes order_[first, last), others have one child behind them
    // and the other at second
    struct Node
    {
        Box box;
        int first;
        int last;
        int second;
    };

    void build(int first, int last);

    std::vector<Box> boxes_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};


template <class Visit>
void BoxTree::forAllTouching(const Box& box, const Visit& visit) const
{
    // Halves: no deeper than the digits of an int
    int stack[64];
    int size = 0;
    if (!nodes_.empty())
    {
        stack[size++] = 0;
    }
    while (size > 0)
    {
        const int n = stack[--size];
        const Node& node = nodes_[n];
        if (!node.box.touches(box))
        {
            continue;
        }
        if (node.second < 0)
        {
            for (int i = node.first; i < node.last; ++i)
            {
                if (boxes_[order_[i]].touches(box))
                {
                    visit(order_[i]);
                }
            }
            continue;
        }
        stack[size++] = node.second;
        stack[size++] = n + 1;
    }
}

} // namespace morph

#endif
