// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imageSystem.hpp"

#include "kernelSum.hpp"
#include "pivotedCholesky.hpp"

#include <Eigen/Dense>

namespace morph
{

namespace
{

// The first row of each point among the conditions, and the end
std::vector<Index> firstRows(const ControlPoints& points)
{
    std::vector<Index> first(1, 0);
    for (const ControlPoint& p : points)
    {
        first.push_back(first.back() + p.k);
    }
    return first;
}


// The directions of all conditions: n x 3
Columns directions(const ControlPoints& points)
{
    Columns d(firstRows(points).back(), 3);
    Index row = 0;
    for (const ControlPoint& p : points)
    {
        d.middleRows(row, p.k) = p.C().transpose();
        row += p.k;
    }
    return d;
}


// The rows among the conditions of some of the points
std::vector<Index>
rowsOf(const std::vector<Index>& points, const std::vector<Index>& first)
{
    std::vector<Index> rows;
    for (const Index i : points)
    {
        for (Index row = first[i]; row < first[i + 1]; ++row)
        {
            rows.push_back(row);
        }
    }
    return rows;
}


// g of all conditions
Eigen::VectorXd values(const ControlPoints& points)
{
    Eigen::VectorXd g(firstRows(points).back());
    Index row = 0;
    for (const ControlPoint& p : points)
    {
        g.segment(row, p.k) = p.g();
        row += p.k;
    }
    return g;
}

} // namespace


ImageSystem::ImageSystem(const Kernel& kernel, const ImageGroup& images)
: kernel_(kernel),
  images_(images)
{
}


Matrix ImageSystem::block(const ControlPoints& a, const ControlPoints& b) const
{
    const std::vector<Index> rows = firstRows(a);
    const std::vector<Index> columns = firstRows(b);
    const Columns xa = positions(a), xb = positions(b);
    const Columns da = directions(a), db = directions(b);

    Matrix G = Matrix::Zero(rows.back(), columns.back());
    Eigen::VectorXd factor(rows.back());
    for (const RigidMap& map : images_.maps())
    {
        const Matrix phi = kernelMatrix(kernel_, xa, map(xb));
        const Matrix cosines = da * (db * map.R.transpose()).transpose();
        for (std::size_t j = 0; j < b.size(); ++j)
        {
            if (phi.col(j).isZero(0))
            {
                continue;
            }
            for (std::size_t i = 0; i < a.size(); ++i)
            {
                factor.segment(rows[i], a[i].k).setConstant(phi(i, j));
            }
            for (Index q = columns[j]; q < columns[j + 1]; ++q)
            {
                G.col(q).array() += factor.array() * cosines.col(q).array();
            }
        }
    }
    return G;
}


std::vector<double> ImageSystem::eliminateFrom(const ControlPoints& points)
{
    first_ = firstRows(points);
    W_ = block(points, points);
    std::vector<double> scale;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        scale.push_back(
            W_.diagonal().segment(first_[i], points[i].k).maxCoeff());
    }
    Y_ = L_.solved(block(points_, points));
    W_.noalias() -= Y_.transpose() * Y_;
    return scale;
}


ControlSystem::Choice ImageSystem::choose(
    const std::vector<Candidate>& list, Index most, double least,
    double outside)
{
    ControlPoints points;
    for (const Candidate& entry : list)
    {
        points.push_back(entry.point);
    }
    const std::vector<double> scale = eliminateFrom(points);

    Matrix r(first_.back(), 1);
    for (std::size_t i = 0; i < list.size(); ++i)
    {
        r.middleRows(first_[i], points[i].k) =
            list[i].residual.head(points[i].k);
    }
    return pivotedCholesky(
        [this](const std::vector<Index>& which)
        {
            const std::vector<Index> columns = rowsOf(which, first_);
            Matrix w(W_.rows(), columns.size());
            for (std::size_t j = 0; j < columns.size(); ++j)
            {
                w.col(j) = W_.col(columns[j]);
            }
            return w;
        },
        first_, r, scale, most, least, outside);
}


std::vector<bool> ImageSystem::append(
    const std::vector<Candidate>& list, const std::vector<Index>& chosen)
{
    std::vector<Index> which = chosen;
    if (W_.size() == 0)
    {
        // Not chosen from the list
        ControlPoints points;
        for (std::size_t i = 0; i < chosen.size(); ++i)
        {
            points.push_back(list[chosen[i]].point);
            which[i] = i;
        }
        eliminateFrom(points);
    }
    const std::vector<Index> rows = rowsOf(which, first_);
    const Index n = rows.size();
    Matrix corner(n, n), above(L_.size(), n);
    for (Index p = 0; p < n; ++p)
    {
        above.col(p) = Y_.col(rows[p]);
        for (Index q = 0; q < n; ++q)
        {
            corner(p, q) = W_(rows[p], rows[q]);
        }
    }
    Y_.resize(0, 0);
    W_.resize(0, 0);
    const Eigen::LLT<Matrix> factor(corner);
    if (factor.info() != Eigen::Success)
    {
        return std::vector<bool>(chosen.size(), false);
    }
    L_.append(above, factor.matrixL());
    for (const Index i : chosen)
    {
        points_.push_back(list[i].point);
    }
    return std::vector<bool>(chosen.size(), true);
}


void ImageSystem::setValues(const std::vector<Vector3>& values)
{
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        points_[i].value = values[i];
    }
}


void ImageSystem::solve(RbfInterpolant& interpolant)
{
    const Eigen::VectorXd alpha =
        L_.solvedTransposed(L_.solved(values(points_)));
    Columns centres = positions(points_);
    Columns weights(centres.rows(), 3);
    Index row = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ControlPoint& p = points_[i];
        weights.row(i) = (p.C() * alpha.segment(row, p.k)).transpose();
        row += p.k;
    }
    images_.replicate(centres, weights);
    interpolant.set(centres, weights);
}

} // namespace morph
