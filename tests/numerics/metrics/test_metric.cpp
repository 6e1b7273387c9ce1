// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Metrics of cells' sizes.
//
// Sources of truth: the defining equations (what an intersection contains,
// what an optimal metric's error is), closed forms on the axes.

#include "metric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <random>

using namespace morph;

namespace
{

const Basis space = Basis::Identity(3, 3);
const Basis plane = Basis::Identity(3, 2);

Metric turned(double a, double b, double c, const Vector3& axis, double angle)
{
    const Eigen::Matrix3d r =
        Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    return r * Vector3(a, b, c).asDiagonal() * r.transpose();
}

double length(const Metric& m, const Vector3& e)
{
    return std::sqrt(e.dot(m * e));
}

} // namespace


TEST(Metric, SpectralFunctions)
{
    const Metric m = turned(1, 4, 900, Vector3(1, 2, 3), 0.7);
    const Metric root = spectral(m, [](double x) { return std::sqrt(x); });
    EXPECT_NEAR((root * root - m).norm(), 0, 1e-11);
    const Metric log = spectral(m, [](double x) { return std::log(x); });
    EXPECT_NEAR(log.trace(), std::log(1 * 4 * 900.0), 1e-12);
}


TEST(Metric, AbsoluteHessianHasNoFlatDirection)
{
    const Metric h = turned(-4, 1e-9, 9, Vector3(0, 1, 1), 1.1);
    EXPECT_NEAR(
        (absolute(h, space, 0.01) - turned(4, 0.01, 9, Vector3(0, 1, 1), 1.1))
            .norm(),
        0, 1e-13);
}


TEST(Metric, AcrossAPlaneNothingChanges)
{
    Metric h = Vector3(-4, 9, 7).asDiagonal();
    EXPECT_NEAR(
        (absolute(h, plane, 1) - Metric(Vector3(4, 9, 7).asDiagonal())).norm(),
        0, 1e-14);
    EXPECT_NEAR(determinant(h, plane), -36, 1e-13);
    h = Vector3(4, 9, 7).asDiagonal();
    EXPECT_NEAR(bounded(h, plane, 0.4, 10)(1, 1), 6.25, 1e-13);
    EXPECT_NEAR(bounded(h, plane, 0.4, 10)(2, 2), 7, 1e-13);
}


// The error of linear interpolation is (det|H|/det M)^(1/d) when cells have the
// shape that |H| wants: an optimal metric equidistributes its p-th power times
// the density of cells
TEST(Metric, OptimalEquidistributesTheError)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> next(0.1, 10);
    for (const Basis& basis : {space, plane})
    {
        const double d = double(basis.cols());
        for (const double p : {1.0, 2.0, 6.0})
        {
            double first = 0;
            for (int i = 0; i < 5; ++i)
            {
                const Metric h = turned(
                    next(random), next(random), 1,
                    d == 2 ? Vector3(0, 0, 1) : Vector3(1, 1, 0), next(random));
                const Metric m = optimal(h, basis, p);
                const double error = std::pow(
                    determinant(h, basis) / determinant(m, basis), 1 / d);
                // Error^p per cell of volume det(M)^(-1/2)
                const double share =
                    std::pow(error, p) / std::sqrt(determinant(m, basis));
                first = i == 0 ? share : first;
                EXPECT_NEAR(share / first, 1, 1e-12);
            }
        }
    }
}


TEST(Metric, IntersectionOnTheAxes)
{
    const Metric a = Vector3(1, 100, 4).asDiagonal();
    const Metric b = Vector3(9, 25, 4).asDiagonal();
    const Metric expected = Vector3(9, 100, 4).asDiagonal();
    EXPECT_NEAR((intersection(a, b) - expected).norm(), 0, 1e-12);
}


TEST(Metric, IntersectionIsInBothAndTouchesThem)
{
    const Metric a = turned(1, 50, 400, Vector3(1, 0, 1), 0.3);
    const Metric b = turned(300, 2, 9, Vector3(0, 2, 1), 1.9);
    const Metric both = intersection(a, b);
    EXPECT_NEAR((both - intersection(b, a)).norm() / both.norm(), 0, 1e-12);
    std::mt19937 random(1);
    std::normal_distribution<double> next;
    for (int i = 0; i < 1000; ++i)
    {
        const Vector3 e(next(random), next(random), next(random));
        const double wanted = std::max(length(a, e), length(b, e));
        EXPECT_GE(length(both, e), wanted * (1 - 1e-12));
    }
    // In the directions of the reduction it is one of them
    const Eigen::EigenSolver<Eigen::Matrix3d> reduction(a.inverse() * b);
    for (int i = 0; i < 3; ++i)
    {
        const Vector3 e = reduction.eigenvectors().col(i).real();
        const double wanted = std::max(length(a, e), length(b, e));
        EXPECT_NEAR(length(both, e) / wanted, 1, 1e-10);
    }
}


// Along a line of cells of these sizes each is the growth times the last
TEST(Metric, SizesAreThoseAlongAxes)
{
    const Metric m = turned(100, 4, 1, Vector3(1, 1, 1), 2);
    EXPECT_NEAR(sizes(m, space).least, 0.1, 1e-14);
    EXPECT_NEAR(sizes(m, space).most, 1, 1e-14);
    const Metric flat = Vector3(100, 4, 1e6).asDiagonal();
    EXPECT_NEAR(sizes(flat, plane).least, 0.1, 1e-14);
    EXPECT_NEAR(sizes(flat, plane).most, 0.5, 1e-14);
}


TEST(Metric, SizesGrowByTheFactor)
{
    const double growth = 1.2;
    const Metric m = Vector3(1e4, 1e4, 1e4).asDiagonal();
    const double far = 0.5;
    const double h = 1 / std::sqrt(grown(m, Vector3(far, 0, 0), growth)(0, 0));
    // h(x) = h0 + ln(growth) x
    EXPECT_NEAR(h, 0.01 + std::log(growth) * far, 1e-13);
}
