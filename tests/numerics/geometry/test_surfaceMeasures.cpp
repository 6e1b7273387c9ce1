// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Source of truth: closed forms (box, tetrahedron, rigid motion) and central
// differences.

#include "surfaceMeasures.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace morph;

namespace
{

// A box with a corner at x, its normals outwards
void box(const Vector3& x, const Vector3& size, Vectors& points, Triangles& t)
{
    points.resize(8, 3);
    for (int i = 0; i < 8; ++i)
    {
        points.row(i) << x[0] + (i & 1 ? size[0] : 0),
            x[1] + (i & 2 ? size[1] : 0), x[2] + (i & 4 ? size[2] : 0);
    }
    t.resize(12, 3);
    t << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
        0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
}

Vectors randomVectors(Index n, unsigned seed)
{
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vectors v(n, 3);
    for (Index i = 0; i < n; ++i)
    {
        v.row(i) << uniform(generator), uniform(generator), uniform(generator);
    }
    return v;
}

} // namespace


TEST(SurfaceMeasures, ofABoxFarFromTheOrigin)
{
    const Vector3 corner(1000, -2000, 500);
    const Vector3 size(1, 2, 3);
    Vectors points;
    Triangles t;
    box(corner, size, points, t);
    const SurfaceMeasures m = surfaceMeasures(points, t);
    EXPECT_NEAR(m.volume, 6, 1e-12);
    EXPECT_NEAR(m.area, 22, 1e-12);
    EXPECT_LT((m.volumeCentroid - corner - 0.5 * size).norm(), 1e-12);
    EXPECT_LT((m.areaCentroid - corner - 0.5 * size).norm(), 1e-12);
    EXPECT_TRUE(isClosed(t));
    EXPECT_FALSE(isClosed(t.topRows(11)));
}


TEST(SurfaceMeasures, ofATetrahedron)
{
    Vectors points(4, 3);
    points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    Triangles t(4, 3);
    t << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    const SurfaceMeasures m = surfaceMeasures(points, t);
    EXPECT_NEAR(m.volume, 1.0 / 6, 1e-16);
    EXPECT_LT((m.volumeCentroid - Vector3::Constant(0.25)).norm(), 1e-15);
    EXPECT_NEAR(m.area, 1.5 + std::sqrt(3) / 2, 1e-15);
}


TEST(SurfaceMeasures, derivativesAreThoseOfDifferences)
{
    Vectors points;
    Triangles t;
    box(Vector3(0.3, 0.1, -2), Vector3(1, 2, 3), points, t);
    points += 0.1 * randomVectors(8, 1);
    const Vectors v = randomVectors(8, 2);
    const SurfaceMeasures d = surfaceMeasuresDerivative(points, t, v);

    const double h = 1e-4;
    const SurfaceMeasures a = surfaceMeasures(points + h * v, t);
    const SurfaceMeasures b = surfaceMeasures(points - h * v, t);
    EXPECT_NEAR(d.volume, (a.volume - b.volume) / (2 * h), 1e-7);
    EXPECT_NEAR(d.area, (a.area - b.area) / (2 * h), 1e-7);
    EXPECT_LT(
        (d.volumeCentroid - (a.volumeCentroid - b.volumeCentroid) / (2 * h))
            .norm(),
        1e-7);
    EXPECT_LT(
        (d.areaCentroid - (a.areaCentroid - b.areaCentroid) / (2 * h)).norm(),
        1e-7);
}


TEST(SurfaceMeasures, aRigidMotionChangesPositionsOnly)
{
    Vectors points;
    Triangles t;
    box(Vector3(0.3, 0.1, -2), Vector3(1, 2, 3), points, t);
    const Vector3 speed(1, 2, 3), spin(0.4, -0.2, 0.1);
    Vectors v(8, 3);
    for (int i = 0; i < 8; ++i)
    {
        const Vector3 x = points.row(i).transpose();
        v.row(i) = (speed + spin.cross(x)).transpose();
    }
    const SurfaceMeasures m = surfaceMeasures(points, t);
    const SurfaceMeasures d = surfaceMeasuresDerivative(points, t, v);
    EXPECT_NEAR(d.volume, 0, 1e-13);
    EXPECT_NEAR(d.area, 0, 1e-13);
    EXPECT_LT(
        (d.volumeCentroid - speed - spin.cross(m.volumeCentroid)).norm(),
        1e-13);
}
