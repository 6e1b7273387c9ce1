// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "blockTriangularFactor.hpp"

#include <Eigen/Dense>

#include <algorithm>

namespace morph
{

namespace
{

// Panels with fewer rows grow: products with a few rows are slow
constexpr Index leastRows = 64;

} // namespace


void BlockTriangularFactor::append(const Matrix& above, const Matrix& corner)
{
    const Index m = corner.rows();
    const Index n = size_ + m;
    if (panels_.empty() || panels_.back().rows() >= leastRows)
    {
        panels_.emplace_back(0, size_);
    }
    Matrix& last = panels_.back();
    const Index r = last.rows();
    Matrix grown(r + m, n);
    grown.topLeftCorner(r, size_) = last;
    grown.topRightCorner(r, m).setZero();
    grown.bottomLeftCorner(m, size_) = above.transpose();
    grown.bottomRightCorner(m, m) = corner;
    last.swap(grown);
    size_ = n;
}


void BlockTriangularFactor::set(const Matrix& lower)
{
    size_ = 0;
    panels_.clear();
    const Index n = lower.rows();
    while (size_ < n)
    {
        const Index m = std::min(leastRows, n - size_);
        panels_.push_back(lower.block(size_, 0, m, size_ + m));
        size_ += m;
    }
}


Matrix BlockTriangularFactor::solved(Matrix b) const
{
    Index end = 0;
    for (const Matrix& panel : panels_)
    {
        const Index m = panel.rows();
        auto x = b.middleRows(end, m);
        if (end > 0)
        {
            x.noalias() -= panel.leftCols(end) * b.topRows(end);
        }
        panel.rightCols(m).triangularView<Eigen::Lower>().solveInPlace(x);
        end += m;
    }
    return b;
}


Matrix BlockTriangularFactor::solvedTransposed(Matrix b) const
{
    Index begin = size_;
    for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel)
    {
        const Index m = panel->rows();
        begin -= m;
        auto x = b.middleRows(begin, m);
        panel->rightCols(m)
            .transpose()
            .triangularView<Eigen::Upper>()
            .solveInPlace(x);
        if (begin > 0)
        {
            b.topRows(begin).noalias() -=
                panel->leftCols(begin).transpose() * x;
        }
    }
    return b;
}

} // namespace morph
