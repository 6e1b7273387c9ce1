#include "incrementalSystem.hpp"

#include <Eigen/Dense>

#include <algorithm>

namespace morph
{

namespace
{

// A pivot below this fraction of its scale is round-off
constexpr double leastPivot = 1e-12;


GramFactor factorOf
(
    const Kernel& kernel,
    const Columns& nodes,
    const Matrix& nodeValues
)
{
    return
        nodes.rows() > 0
      ? GramFactor(kernel, AffineBasis(nodes), nodeValues)
      : GramFactor(kernel);
}


// The residuals of the list as the right-hand side of its system
Matrix rightHandSide
(
    const std::vector<Listed>& list,
    const GramFactor::Residual& system
)
{
    Matrix r(system.offset.back(), system.scalar ? 3 : 1);
    for (std::size_t p = 0; p < list.size(); ++p)
    {
        if (system.scalar)
        {
            r.row(p) = list[p].residual.transpose();
        }
        else
        {
            const int k = list[p].point.k;
            r.middleRows(system.offset[p], k) = list[p].residual.head(k);
        }
    }
    return r;
}


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


IncrementalSystem::IncrementalSystem
(
    const Kernel& kernel,
    const Columns& nodes,
    const Matrix& nodeValues
)
:
    nNodes_(nodes.rows()),
    factor_(factorOf(kernel, nodes, nodeValues))
{}


ControlSystem::Choice IncrementalSystem::choose
(
    const std::vector<Listed>& list,
    Index most,
    double least,
    double outside
)
{
    points_.clear();
    for (const Listed& entry : list)
    {
        points_.push_back(entry.point);
    }
    residual_ = factor_.residual(points_);
    const std::vector<Index>& first = residual_.offset;
    const Index n = list.size();

    Matrix r = rightHandSide(list, residual_);
    Matrix V(first.back(), std::min(most, n)*(residual_.scalar ? 1 : 3));
    Index columns = 0;
    std::vector<char> usable(n, 1);
    Choice choice;
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
        Matrix v = symmetricColumns(residual_.W, first[p], k);
        v.noalias() -=
            V.leftCols(columns)*V.block(first[p], 0, k, columns).transpose();
        const Eigen::LLT<Matrix> pivot(v.middleRows(first[p], k));
        const Matrix l = pivot.matrixL();
        const double scale = factor_.pivotScale(points_[p].position);
        if
        (
            pivot.info() != Eigen::Success
         || !(l.diagonal().cwiseAbs2().minCoeff() > leastPivot*scale)
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


std::vector<bool> IncrementalSystem::append
(
    const std::vector<Listed>& list,
    const std::vector<Index>& chosen
)
{
    if (points_.empty())
    {
        ControlPoints points;
        for (const Index i : chosen)
        {
            points.push_back(list[i].point);
        }
        return factor_.append(points);
    }
    const std::vector<bool> in = factor_.append(points_, chosen, residual_);
    // As large as the factors themselves, and of no use any more
    residual_ = GramFactor::Residual();
    points_.clear();
    return in;
}


void IncrementalSystem::setValues(const std::vector<Vector3>& values)
{
    Matrix nodeValues(nNodes_, 3);
    for (Index i = 0; i < nNodes_; ++i)
    {
        nodeValues.row(i) = values[i].transpose();
    }
    factor_.setValues
    (
        std::vector<Vector3>(values.begin() + nNodes_, values.end()),
        nodeValues
    );
}


void IncrementalSystem::solve(RbfInterpolant& interpolant)
{
    factor_.solve(interpolant);
}

} // namespace morph
