// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "growingMatrix.hpp"

namespace morph
{

namespace
{

// Panels with fewer rows grow: products with a few rows are slow
constexpr Index leastRows = 64;

} // namespace


void GrowingMatrix::appendRows(const Matrix& x)
{
    const Index m = x.rows();
    if (m == 0)
    {
        return;
    }
    if (panels_.empty() || panels_.back().rows() >= leastRows)
    {
        panels_.push_back(x);
    }
    else
    {
        Matrix& last = panels_.back();
        last.conservativeResize(last.rows() + m, cols_);
        last.bottomRows(m) = x;
    }
    rows_ += m;
}


void GrowingMatrix::appendColumns(const Matrix& x)
{
    const Index m = x.cols();
    Index begin = 0;
    for (Matrix& panel : panels_)
    {
        panel.conservativeResize(panel.rows(), cols_ + m);
        panel.rightCols(m) = x.middleRows(begin, panel.rows());
        begin += panel.rows();
    }
    cols_ += m;
}


void GrowingMatrix::subtractTransposedTimes(const Matrix& b, Matrix& from) const
{
    Index begin = 0;
    for (const Matrix& panel : panels_)
    {
        from.noalias() -= panel.transpose() * b.middleRows(begin, panel.rows());
        begin += panel.rows();
    }
}


Matrix GrowingMatrix::times(const Matrix& b) const
{
    Matrix x(rows_, b.cols());
    Index begin = 0;
    for (const Matrix& panel : panels_)
    {
        x.middleRows(begin, panel.rows()).noalias() = panel * b;
        begin += panel.rows();
    }
    return x;
}

} // namespace morph
