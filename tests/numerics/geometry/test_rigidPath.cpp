// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The way of points that move as a rigid body.
//
// Source of truth: Rodrigues' formula about an axis through a given point.

#include "rigidPath.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

using namespace morph;

namespace
{

const Vector3 axis = Vector3(1, -2, 0.5).normalized();
const Vector3 through(3, 1, -2);
const Vector3 along(0.3, 0.1, -0.7);

// About an axis through a point, by an angle, and on
Vector3 moved(const Vector3& x, const double angle)
{
    const Vector3 r = x - through;
    return through + std::cos(angle) * r + std::sin(angle) * axis.cross(r)
        + (1 - std::cos(angle)) * axis.dot(r) * axis;
}

Vectors body(const int n)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> next(-1, 1);
    Vectors x(n, 3);
    for (int i = 0; i < n; ++i)
    {
        x.row(i) << next(random), next(random), 5 * next(random);
    }
    return x;
}

RigidPath pathOf(const Vectors& x, const Vectors& d)
{
    SerialCommunicator communicator;
    return RigidPath::fit(x, d, communicator);
}

Vectors turn(const Vectors& x, const double angle)
{
    Vectors d(x.rows(), 3);
    for (Index i = 0; i < x.rows(); ++i)
    {
        const Vector3 at = x.row(i).transpose();
        d.row(i) = (moved(at, angle) - at).transpose();
    }
    return d;
}

} // namespace


TEST(RigidPath, TurnsByEqualAngles)
{
    const Vectors x = body(50);
    for (const double angle : {1e-3, 0.7, 2.9})
    {
        const Vectors d = turn(x, angle);
        const RigidPath path = pathOf(x, d);
        EXPECT_NEAR((path.rotation() - angle * axis).norm(), 0, 1e-11);
        // The mean goes in a straight line, all else turns about it
        const Vector3 mean = x.colwise().mean().transpose();
        const Vector3 meanMoved = d.colwise().mean().transpose();
        for (const double f : {0.25, 0.5, 0.875})
        {
            for (Index i = 0; i < x.rows(); ++i)
            {
                const Vector3 at = x.row(i).transpose();
                const Vector3 r = moved(at, f * angle) - moved(mean, f * angle);
                const Vector3 s =
                    path.displacement(at, d.row(i).transpose(), f);
                EXPECT_NEAR(
                    (at + s - mean - f * meanMoved - r).norm(), 0, 1e-11);
            }
        }
    }
}


TEST(RigidPath, EndsWhereItIsTold)
{
    const Vectors x = body(20);
    const Vectors d = turn(x, 2);
    const RigidPath path = pathOf(x, d);
    for (Index i = 0; i < x.rows(); ++i)
    {
        const Vector3 at = x.row(i).transpose();
        const Vector3 to = d.row(i).transpose();
        EXPECT_EQ(path.displacement(at, to, 1), to);
        EXPECT_EQ(path.displacement(at, to, 0).norm(), 0);
    }
}


TEST(RigidPath, PointsInAPlaneTurn)
{
    Vectors x(4, 3);
    x << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 2, 0;
    Vectors d(4, 3);
    for (Index i = 0; i < 4; ++i)
    {
        d.row(i) << -x(i, 1) - x(i, 0), x(i, 0) - x(i, 1), 0;
    }
    const Vector3 rotation = pathOf(x, d).rotation();
    EXPECT_NEAR((rotation - Vector3(0, 0, M_PI / 2)).norm(), 0, 1e-14);
}


TEST(RigidPath, WhatIsNotRigidGoesStraight)
{
    const Vectors x = body(20);
    const Vectors shift = along.transpose().replicate(20, 1);
    Vectors bent = turn(x, 1);
    bent.row(3) *= 1.001;
    Vectors line(5, 3);
    for (Index i = 0; i < 5; ++i)
    {
        line.row(i) = double(i) * axis.transpose() + through.transpose();
    }
    Vectors rod(5, 3);
    for (Index i = 0; i < 5; ++i)
    {
        rod.row(i) = double(i) * (Vector3::UnitX() - axis).transpose();
    }
    for (const auto& [from, by] : std::vector<std::pair<Vectors, Vectors>>{
             {x, shift},
             {x, bent},
             {line, rod},
             {x, Vectors::Zero(20, 3)},
             {Vectors(0, 3), Vectors(0, 3)}})
    {
        const RigidPath path = pathOf(from, by);
        EXPECT_EQ(path.rotation().norm(), 0);
        EXPECT_EQ(path.displacement(through, along, 0.3), 0.3 * along);
    }
}
