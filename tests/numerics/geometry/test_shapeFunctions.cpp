// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Functions of a surface. Sources of truth: closed forms of cylinders, spheres
// and cubes; central differences for every gradient.

#include "shapeFunctions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace morph;

namespace
{

const double pi = 3.14159265358979323846;

struct Surface
{
    Vectors points;
    Triangles triangles;
};


// Rings of points on a sphere, or with flat ends on a cylinder about z
Surface
rings(Index n, Index around, const std::function<Vector3(double, double)>& at)
{
    Surface s;
    s.points.resize((n + 1) * around, 3);
    for (Index i = 0; i <= n; ++i)
    {
        for (Index j = 0; j < around; ++j)
        {
            s.points.row(i * around + j) =
                at(double(i) / double(n), 2 * pi * double(j) / double(around))
                    .transpose();
        }
    }
    s.triangles.resize(2 * n * around, 3);
    Index t = 0;
    for (Index i = 0; i < n; ++i)
    {
        for (Index j = 0; j < around; ++j)
        {
            const Index a = i * around + j, b = i * around + (j + 1) % around;
            s.triangles.row(t++) << a, b, b + around;
            s.triangles.row(t++) << a, b + around, a + around;
        }
    }
    return s;
}


Surface cylinder(double radius, double length, Index n, Index around)
{
    return rings(
        n, around,
        [=](double u, double angle)
        {
            return Vector3(
                radius * std::cos(angle), radius * std::sin(angle), length * u);
        });
}


Surface blob()
{
    return rings(
        6, 9,
        [](double u, double angle)
        {
            const double r =
                (0.4 + std::sin(pi * u)) * (1 + 0.3 * std::cos(2 * angle));
            return Vector3(
                1 + r * std::cos(angle), r * std::sin(angle),
                -std::cos(pi * u) + 0.1 * r);
        });
}


Surface cube()
{
    Surface s;
    s.points.resize(8, 3);
    for (Index i = 0; i < 8; ++i)
    {
        s.points.row(i) << double(i & 1), double(i >> 1 & 1),
            double(i >> 2 & 1);
    }
    s.triangles.resize(12, 3);
    s.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6,
        3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
    return s;
}


void expectGradient(
    const std::function<ShapeValue(const Vectors&)>& f, const Vectors& points)
{
    Vectors velocities(points.rows(), 3);
    for (Index i = 0; i < velocities.size(); ++i)
    {
        velocities.data()[i] = std::sin(double(7 * i + 1));
    }
    const double h = 1e-6;
    const double difference =
        (f(points + h * velocities).value - f(points - h * velocities).value)
        / (2 * h);
    const double exact = f(points).derivative(velocities);
    EXPECT_GT(std::abs(exact), 1e-3);
    EXPECT_NEAR(exact, difference, 1e-8 * std::max(1.0, std::abs(exact)));
}

} // namespace


TEST(ShapeFunctions, BendingOfACylinderIsItsClosedForm)
{
    const double radius = 0.7, length = 2;
    const Index n = 400;
    const Surface s = cylinder(radius, length, 3, n);
    // N facets of width 2 R sin(pi/N) between edges with the angle 2 pi/N
    const double facets = double(n) * std::pow(2 * pi / double(n), 2) * length
        / (2 * radius * std::sin(pi / double(n)));
    EXPECT_NEAR(
        bending(s.points, hinges(s.triangles)).value, facets, 1e-9 * facets);
    EXPECT_NEAR(facets, 2 * pi * length / radius, 1e-4 * facets);
}


TEST(ShapeFunctions, AreasAndVolumeOfACube)
{
    const Surface s = cube();
    const Vector3 zero = Vector3::Zero();
    EXPECT_NEAR(
        projectedArea(s.points, s.triangles, {0, 0, 2}).value, 1, 1e-15);
    EXPECT_NEAR(
        projectedArea(s.points, s.triangles, {1, 1, 0}).value, std::sqrt(2.0),
        1e-15);
    EXPECT_NEAR(wettedArea(s.points, s.triangles, zero, zero).value, 6, 1e-14);
    EXPECT_NEAR(
        wettedArea(s.points, s.triangles, {0, 0, 0.3}, {0, 0, 1}).value,
        1 + 4 * 0.3, 1e-14);
    EXPECT_NEAR(volume(s.points, s.triangles).value, 1, 1e-15);
    EXPECT_NEAR(barycentre(s.points, s.triangles, {0, 1, 0}).value, 0.5, 1e-15);
}


TEST(ShapeFunctions, ThicknessAlongALine)
{
    const Surface s = cube();
    SurfacePlace below, above;
    ASSERT_TRUE(placesOnLine(
        s.points, s.triangles, {0.3, 0.4, 0.2}, {0, 0, 1}, below, above));
    EXPECT_NEAR(distance(s.points, below, above).value, 1, 1e-15);
    EXPECT_NEAR(
        (above.position(s.points) - Vector3(0.3, 0.4, 1)).norm(), 0, 1e-15);
    EXPECT_FALSE(placesOnLine(
        s.points, s.triangles, {0.3, 0.4, 2}, {0, 0, 1}, below, above));
}


TEST(ShapeFunctions, TheNearestPlaceIsOnFaceEdgeOrCorner)
{
    const Surface s = cube();
    const auto near = [&](const Vector3& x)
    { return nearestPlace(s.points, s.triangles, x).position(s.points); };
    EXPECT_NEAR((near({0.3, 0.4, 5}) - Vector3(0.3, 0.4, 1)).norm(), 0, 1e-15);
    EXPECT_NEAR((near({0.3, -1, 5}) - Vector3(0.3, 0, 1)).norm(), 0, 1e-15);
    EXPECT_NEAR((near({-2, -1, 5}) - Vector3(0, 0, 1)).norm(), 0, 1e-15);
    EXPECT_NEAR(
        (near({0.6, 0.4, 0.9}) - Vector3(0.6, 0.4, 1)).norm(), 0, 1e-15);
}


TEST(ShapeFunctions, GradientsAreThoseOfCentralDifferences)
{
    const Surface s = blob();
    const Triangles& t = s.triangles;
    const std::vector<Hinge> h = hinges(t);
    const Vector3 d(0.3, 0.8, 0.5), origin(1, 0, 0.123), up(0, 0.1, 1);
    expectGradient(
        [&](const Vectors& x) { return projectedArea(x, t, d); }, s.points);
    expectGradient(
        [&](const Vectors& x) { return wettedArea(x, t, origin, up); },
        s.points);
    expectGradient([&](const Vectors& x) { return bending(x, h); }, s.points);

    SurfacePlace a, b;
    ASSERT_TRUE(placesOnLine(s.points, t, {1.1, 0.1, 0.1}, {0, 1, 0}, a, b));
    expectGradient(
        [&](const Vectors& x) { return distance(x, a, b); }, s.points);
    expectGradient(
        [&](const Vectors& x) { return component(x, a, d); }, s.points);

    const Surface c = cube();
    expectGradient(
        [&](const Vectors& x) { return volume(x, c.triangles); }, c.points);
    expectGradient(
        [&](const Vectors& x) { return barycentre(x, c.triangles, d); },
        c.points);
}
