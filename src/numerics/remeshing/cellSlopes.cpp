// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cellSlopes.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <utility>

namespace morph
{

namespace
{

// Directions of less than this part of the largest eigenvalue hold nothing but
// round-off: neighbours in one plane, as in a mesh of one layer
constexpr double flat = 1e-10;


Eigen::Matrix3d pseudoInverse(const Eigen::Matrix3d& matrix)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    const Vector3 lambda = solver.eigenvalues();
    Vector3 inverse = Vector3::Zero();
    for (int i = 0; i < 3; ++i)
    {
        if (lambda[i] > flat * lambda[2])
        {
            inverse[i] = 1 / lambda[i];
        }
    }
    return solver.eigenvectors() * inverse.asDiagonal()
        * solver.eigenvectors().transpose();
}

} // namespace


CellSlopes::CellSlopes(
    Vectors position, std::vector<Index> start, std::vector<int> neighbour)
: position_(std::move(position)),
  start_(std::move(start)),
  neighbour_(std::move(neighbour))
{
    inverse_.reserve(nCells());
    for (Index c = 0; c < nCells(); ++c)
    {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (Index n = start_[c]; n < start_[c + 1]; ++n)
        {
            const Vector3 d = position_.row(neighbour_[n]) - position_.row(c);
            sum += d * d.transpose() / d.squaredNorm();
        }
        inverse_.push_back(pseudoInverse(sum));
    }
}


Vectors CellSlopes::slopes(const Eigen::VectorXd& values) const
{
    Vectors result(nCells(), 3);
    for (Index c = 0; c < nCells(); ++c)
    {
        Vector3 sum = Vector3::Zero();
        for (Index n = start_[c]; n < start_[c + 1]; ++n)
        {
            const Vector3 d = position_.row(neighbour_[n]) - position_.row(c);
            sum += d * (values[neighbour_[n]] - values[c]) / d.squaredNorm();
        }
        result.row(c) = inverse_[c] * sum;
    }
    return result;
}


CellSlopes::Range
CellSlopes::range(const Index cell, const Eigen::VectorXd& values) const
{
    Range range{values[cell], values[cell]};
    for (Index n = start_[cell]; n < start_[cell + 1]; ++n)
    {
        range.least = std::min(range.least, values[neighbour_[n]]);
        range.most = std::max(range.most, values[neighbour_[n]]);
    }
    return range;
}


double CellSlopes::roughness(
    const Index cell, const Eigen::VectorXd& values, const Vector3& slope) const
{
    double off = 0, all = 0;
    for (Index n = start_[cell]; n < start_[cell + 1]; ++n)
    {
        const Vector3 d = position_.row(neighbour_[n]) - position_.row(cell);
        const double difference = values[neighbour_[n]] - values[cell];
        off += std::abs(difference - slope.dot(d));
        all += std::abs(difference);
    }
    return all > 0 ? off / all : 0;
}

} // namespace morph
