// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "slidingCondition.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace morph
{

namespace
{

double bounded(double cosine)
{
    return std::copysign(
        std::max(std::abs(cosine), leastSlidingCosine), cosine);
}

} // namespace


double slideOnto(ControlPoint& p, const Vector3& s, const TangentPlanes& planes)
{
    if (p.k == 1)
    {
        const Vector3 n = p.directions.col(0);
        const double cosine = n.dot(planes.normals.col(0));
        p.value[0] = n.dot(s) - planes.distances[0] / bounded(cosine);
        return std::abs(cosine);
    }

    // The singular values are the cosines if the planes are orthogonal; made so
    // by a basis of their normals, the distances along it follow
    Eigen::Matrix<double, 3, 2> basis = planes.normals;
    Eigen::Vector2d distances = planes.distances;
    const double c = basis.col(0).dot(basis.col(1));
    const double sine = std::sqrt(std::max(1 - c * c, 1e-12));
    basis.col(1) = (basis.col(1) - c * basis.col(0)) / sine;
    distances[1] = (distances[1] - c * distances[0]) / sine;

    const Eigen::Matrix2d turn = basis.transpose() * p.directions.leftCols<2>();
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(
        turn, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Vector2d along = svd.matrixU().transpose() * distances;
    const Eigen::Vector2d way(
        along[0] / bounded(svd.singularValues()[0]),
        along[1] / bounded(svd.singularValues()[1]));
    p.value.head<2>() =
        p.directions.leftCols<2>().transpose() * s - svd.matrixV() * way;
    return svd.singularValues()[1];
}


Vector3 wayInto(const TangentPlanes& planes)
{
    if (planes.k == 1)
    {
        return -planes.distances[0] * planes.normals.col(0);
    }
    return -planes.normals
        * (planes.normals.transpose() * planes.normals)
              .ldlt()
              .solve(planes.distances);
}

} // namespace morph
