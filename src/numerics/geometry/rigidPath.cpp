// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The rotation of a rigid motion by its covariance

#include "rigidPath.hpp"
#include "reproducibleSum.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace morph
{

// Of the largest displacement
static const double rigid = 1e-6;

// Of the largest extent: points on a straight line do not tell a rotation
static const double flat = 1e-6;

// An arc of this angle [rad] and its chord are the same to round-off
static const double straight = 1e-8;

RigidPath
RigidPath::fit(const Vectors& x, const Vectors& d, Communicator& communicator)
{
    const Index n = x.rows();
    const auto sum = [&](const Eigen::VectorXd& terms)
    { return reproducibleSum(terms.data(), n, communicator); };

    const double count = sum(Eigen::VectorXd::Ones(n));
    const double largest =
        communicator.max(n > 0 ? d.rowwise().norm().maxCoeff() : 0.0);
    if (count < 3 || !(largest > 0))
    {
        return RigidPath();
    }
    RigidPath path;
    Vector3 mean;
    for (int i = 0; i < 3; ++i)
    {
        path.centre_[i] = sum(x.col(i)) / count;
        mean[i] = sum(d.col(i)) / count;
    }
    const Vectors from = x.rowwise() - path.centre_.transpose();
    const Vectors to = from + (d.rowwise() - mean.transpose());
    Eigen::Matrix3d covariance;
    Eigen::Matrix3d inertia;
    for (int i = 0; i < 3; ++i)
    {
        for (int j = 0; j < 3; ++j)
        {
            covariance(i, j) = sum(from.col(i).cwiseProduct(to.col(j)));
            inertia(i, j) = sum(from.col(i).cwiseProduct(from.col(j)));
        }
    }
    const Vector3 sizes =
        Eigen::JacobiSVD<Eigen::Matrix3d>(inertia).singularValues();
    if (!(sizes[1] > flat * flat * sizes[0]))
    {
        return RigidPath();
    }

    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
        covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d mirrored = svd.matrixV() * svd.matrixU().transpose();
    Vector3 signs = Vector3::Ones();
    signs[2] = mirrored.determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d rotation =
        svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();

    const double off = communicator.max(
        n > 0 ? (to - from * rotation.transpose()).rowwise().norm().maxCoeff()
              : 0.0);
    if (!(off <= rigid * largest))
    {
        return RigidPath();
    }
    const Eigen::AngleAxisd turn(rotation);
    if (turn.angle() < straight)
    {
        return RigidPath();
    }
    path.rotation_ = turn.angle() * turn.axis();
    return path;
}


Vector3 RigidPath::turned(const Vector3& x, const double f) const
{
    const double angle = rotation_.norm();
    return angle > 0 ? Vector3(
               Eigen::AngleAxisd(f * angle, rotation_ / angle)
                   * Vector3(x - centre_)
               - (x - centre_))
                     : Vector3(Vector3::Zero());
}


Vector3 RigidPath::displacement(
    const Vector3& x, const Vector3& d, const double f) const
{
    if (f >= 1)
    {
        return d;
    }
    return turned(x, f) + f * (d - turned(x, 1));
}

} // namespace morph
