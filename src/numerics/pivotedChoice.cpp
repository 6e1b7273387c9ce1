#include "pivotedChoice.hpp"

#include <Eigen/Dense>

#include <algorithm>

namespace morph
{

namespace
{

// Columns of a symmetric matrix of which the lower triangle is there
Matrix symmetricColumns(const Matrix& W, Index first, Index count)
{
    const Index n = W.rows();
    Matrix v(n, count);
    v.topRows(first) = W.block(first, 0, count, first).transpose();
    v.bottomRows(n - first) = W.block(first, first, n - first, count);
    for (Index j = 1; j < count; ++j)
    {
        for (Index i = 0; i < j; ++i)
        {
            v(first + i, j) = v(first + j, i);
        }
    }
    return v;
}


// The usable point with the largest error above the least, or -1
Index worstOf
(
    const Matrix& r,
    const std::vector<Index>& first,
    const std::vector<char>& usable,
    double least
)
{
    Index worst = -1;
    double largest = least;
    for (std::size_t i = 0; i < usable.size(); ++i)
    {
        if (usable[i])
        {
            const double error =
                r.middleRows(first[i], first[i + 1] - first[i]).norm();
            if (error > largest)
            {
                largest = error;
                worst = i;
            }
        }
    }
    return worst;
}

} // namespace


ControlSystem::Choice pivotedChoice
(
    const Matrix& W,
    const std::vector<Index>& first,
    Matrix r,
    const std::vector<double>& scale,
    Index most,
    double least,
    double outside
)
{
    const Index n = first.size() - 1;
    const bool scalar = r.cols() == 3;
    Matrix V(first.back(), std::min(most, n)*(scalar ? 1 : 3));
    Index columns = 0;
    std::vector<char> usable(n, 1);
    ControlSystem::Choice choice;
    while (Index(choice.taken.size()) < std::min(most, n))
    {
        // Round-off may differ from that of the sweep: without an exception for
        // the first, there might be no progress and no end
        const double bound =
            !choice.taken.empty() ? std::max(least, outside)
          : choice.singular.empty() ? -1
          : least;
        const Index p = worstOf(r, first, usable, bound);
        if (p < 0)
        {
            break;
        }
        usable[p] = 0;

        const Index k = first[p + 1] - first[p];
        Matrix v = symmetricColumns(W, first[p], k);
        v.noalias() -=
            V.leftCols(columns)*V.block(first[p], 0, k, columns).transpose();
        const Eigen::LLT<Matrix> pivot(v.middleRows(first[p], k));
        const Matrix l = pivot.matrixL();
        if
        (
            pivot.info() != Eigen::Success
         || !(l.diagonal().cwiseAbs2().minCoeff() > leastPivot*scale[p])
        )
        {
            // Nor can it be later: pivots only shrink as points are added
            choice.singular.push_back(p);
            continue;
        }

        l.transpose().triangularView<Eigen::Upper>()
            .solveInPlace<Eigen::OnTheRight>(v);
        const Matrix c =
            l.triangularView<Eigen::Lower>().solve(r.middleRows(first[p], k));
        r.noalias() -= v*c;
        V.middleCols(columns, k) = v;
        columns += k;
        choice.taken.push_back(p);
    }
    return choice;
}

} // namespace morph
