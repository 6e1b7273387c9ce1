// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pivotedCholesky.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <utility>

namespace morph
{

namespace
{

// A Cholesky factorisation of the system of a list, point by point and as far
// as needed, which updates the right-hand side, the errors, as it goes. Columns
// of the system are computed for several points at a time, those with the
// largest errors: about a third of all columns, by matrix products, without
// ever storing the whole system.
class ListFactor
{
public:
    ListFactor(
        const ColumnsOfPoints& system, const std::vector<Index>& first,
        const Matrix& errors, Index most)
    : system_(system),
      first_(first),
      r_(errors),
      V_(errors.rows(), most * (errors.cols() == 3 ? 1 : 3)),
      usable_(first.size() - 1, 1),
      open_(first.size() - 1),
      upTo_(first.size() - 1, 0)
    {
    }

    // The usable point with the largest error above the least, or -1
    Index worst(double least) const
    {
        Index worst = -1;
        double largest = least;
        for (std::size_t i = 0; i < usable_.size(); ++i)
        {
            if (usable_[i] && error(i) > largest)
            {
                largest = error(i);
                worst = i;
            }
        }
        return worst;
    }

    // Takes the point in, unless its pivot is round-off at its scale; in both
    // cases it is not usable any more. Up to `most` points may follow it
    bool take(Index p, double scale, Index most)
    {
        const Index k = first_[p + 1] - first_[p];
        if (open_[p].size() == 0)
        {
            open(batchFrom(p, most));
        }
        usable_[p] = 0;
        Matrix v;
        v.swap(open_[p]);
        subtractTaken(v, {p}, upTo_[p]);

        const Eigen::LLT<Matrix> pivot(v.middleRows(first_[p], k));
        const Matrix l = pivot.matrixL();
        if (pivot.info() != Eigen::Success
            || !(l.diagonal().cwiseAbs2().minCoeff() > leastPivot * scale))
        {
            return false;
        }

        l.transpose()
            .triangularView<Eigen::Upper>()
            .solveInPlace<Eigen::OnTheRight>(v);
        const Matrix c =
            l.triangularView<Eigen::Lower>().solve(r_.middleRows(first_[p], k));
        r_.noalias() -= v * c;
        V_.middleCols(taken_, k) = v;
        taken_ += k;
        return true;
    }

private:
    // Points whose columns are computed together
    static constexpr Index batch = 16;

    double error(Index i) const
    {
        return r_.middleRows(first_[i], first_[i + 1] - first_[i]).norm();
    }

    // p, and of those whose columns are not there the worst
    std::vector<Index> batchFrom(Index p, Index most) const
    {
        std::vector<std::pair<double, Index>> others;
        for (std::size_t i = 0; i < usable_.size(); ++i)
        {
            if (usable_[i] && Index(i) != p && open_[i].size() == 0)
            {
                others.emplace_back(-error(i), i);
            }
        }
        std::sort(others.begin(), others.end());
        std::vector<Index> points(1, p);
        for (const auto& other : others)
        {
            if (Index(points.size()) >= std::min(batch, most))
            {
                break;
            }
            points.push_back(other.second);
        }
        return points;
    }

    void open(const std::vector<Index>& points)
    {
        Matrix W = system_(points);
        subtractTaken(W, points, 0);
        Index column = 0;
        for (const Index i : points)
        {
            const Index k = first_[i + 1] - first_[i];
            open_[i] = W.middleCols(column, k);
            upTo_[i] = taken_;
            column += k;
        }
    }

    // From columns of some points what those taken, beginning with a certain
    // column of V, explain of them
    void subtractTaken(Matrix& W, const std::vector<Index>& points, Index from)
    {
        const Index n = taken_ - from;
        Matrix rows(W.cols(), n);
        Index row = 0;
        for (const Index i : points)
        {
            const Index k = first_[i + 1] - first_[i];
            rows.middleRows(row, k) = V_.block(first_[i], from, k, n);
            row += k;
        }
        if (n > 0)
        {
            W.noalias() -= V_.middleCols(from, n) * rows.transpose();
        }
    }

    const ColumnsOfPoints& system_;
    const std::vector<Index>& first_;

    Matrix r_;
    Matrix V_;
    Index taken_ = 0;
    std::vector<char> usable_;

    // Columns of the system that wait to be taken, and what columns of V have
    // been subtracted from them
    std::vector<Matrix> open_;
    std::vector<Index> upTo_;
};

} // namespace


ControlSystem::Choice pivotedCholesky(
    const ColumnsOfPoints& system, const std::vector<Index>& first,
    const Matrix& r, const std::vector<double>& scale, Index most, double least,
    double outside)
{
    most = std::min<Index>(most, first.size() - 1);
    ListFactor factor(system, first, r, most);
    ControlSystem::Choice choice;
    while (Index(choice.taken.size()) < most)
    {
        // Round-off may differ from that of the sweep: without an exception for
        // the first, there might be no progress and no end
        const double bound = !choice.taken.empty() ? std::max(least, outside)
            : choice.singular.empty()              ? -1
                                                   : least;
        const Index p = factor.worst(bound);
        if (p < 0)
        {
            break;
        }
        // A singular one cannot be taken later either: pivots only shrink as
        // points are added
        const bool in = factor.take(p, scale[p], most - choice.taken.size());
        (in ? choice.taken : choice.singular).push_back(p);
    }
    return choice;
}

} // namespace morph
