// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Values of one mesh on another.
//
// Sources of truth: integrals stay; constant and linear values are known
// everywhere; a smooth function's means are known to higher order.

#include "conservativeMap.hpp"
#include "tetrahedra.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace morph;

namespace
{

CubeMesh cube(const int n, const int seed)
{
    return CubeMesh(
        n, [=](const Vector3& x) { return jitter(x, 0.15 / n, seed); });
}


CellSlopes slopesOf(const CubeMesh& mesh)
{
    std::vector<Index> start;
    std::vector<int> neighbour;
    mesh.neighbours(start, neighbour);
    return CellSlopes(mesh.centre, start, neighbour);
}


template <class Function>
Eigen::VectorXd atCentres(const CubeMesh& mesh, const Function& function)
{
    Eigen::VectorXd values(mesh.centre.rows());
    for (Index i = 0; i < values.size(); ++i)
    {
        values[i] = function(Vector3(mesh.centre.row(i)));
    }
    return values;
}

} // namespace


class ConservativeMapTest : public testing::Test
{
protected:
    CubeMesh from = cube(7, 1);
    CubeMesh to = cube(6, 2);
    CellSlopes slopes = slopesOf(from);
    ConservativeMap map{OverlapTable(from.tetrahedra, to.tetrahedra)};

    double
    lost(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const
    {
        return std::abs(from.volume.dot(before) - to.volume.dot(after))
            / from.volume.dot(before.cwiseAbs());
    }
};


TEST_F(ConservativeMapTest, constantsStay)
{
    const Eigen::VectorXd values =
        Eigen::VectorXd::Constant(from.volume.size(), 3.7);
    const Eigen::VectorXd mapped = map.map(slopes, values, {});
    EXPECT_LT((mapped.array() - 3.7).abs().maxCoeff(), 1e-14);
}


TEST_F(ConservativeMapTest, linearValuesStay)
{
    const auto linear = [](const Vector3& x)
    { return 0.3 + x.dot(Vector3(1, -2, 0.5)); };
    const Eigen::VectorXd mapped = map.map(slopes, atCentres(from, linear), {});
    EXPECT_LT((mapped - atCentres(to, linear)).cwiseAbs().maxCoeff(), 1e-13);
}


// Of a linear function that just reaches them
TEST_F(ConservativeMapTest, boundsDoNotDisturbLinearValuesWithinThem)
{
    const auto linear = [](const Vector3& x) { return x.sum() / 3; };
    const Eigen::VectorXd mapped =
        map.map(slopes, atCentres(from, linear), {0, 1});
    EXPECT_LT((mapped - atCentres(to, linear)).cwiseAbs().maxCoeff(), 1e-13);
}


TEST_F(ConservativeMapTest, integralsOfAnyValuesStay)
{
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int n = 0; n < 10; ++n)
    {
        Eigen::VectorXd values(from.volume.size());
        for (double& value : values)
        {
            value = uniform(generator);
        }
        EXPECT_LT(lost(values, map.map(slopes, values, {})), 1e-14);
    }
}


// A jump, a ramp that ends in both bounds, noise
TEST_F(ConservativeMapTest, boundedValuesStayInBoundsWithoutLoss)
{
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int n = 0; n < 3; ++n)
    {
        const Eigen::VectorXd values = atCentres(
            from,
            [&](const Vector3& x)
            {
                const double s = x[0] + 0.3 * x[1] - 0.6;
                return n == 0 ? double(s > 0)
                    : n == 1  ? std::clamp(3 * s + 0.5, 0.0, 1.0)
                              : uniform(generator);
            });
        const Eigen::VectorXd mapped = map.map(slopes, values, {0, 1});
        EXPECT_GE(mapped.minCoeff(), 0);
        EXPECT_LE(mapped.maxCoeff(), 1);
        EXPECT_LT(lost(values, mapped), 1e-14);

        // Nor a jump beyond what neighbours have, without bounds
        if (n == 0)
        {
            const Eigen::VectorXd free = map.map(slopes, values, {});
            EXPECT_GE(free.minCoeff(), -1e-14);
            EXPECT_LE(free.maxCoeff(), 1 + 1e-14);
        }
    }
}


TEST_F(ConservativeMapTest, jumpsWithoutLimitsOvershoot)
{
    const Eigen::VectorXd values =
        atCentres(from, [](const Vector3& x) { return double(x[0] > 0.4); });
    const Eigen::VectorXd mapped = map.map(values, slopes.slopes(values));
    EXPECT_GT(mapped.maxCoeff(), 1.001);
}


// Means over cells of sin(pi x) cos(2 y) e^z: their error by values at centres
// is of second order as well
TEST(ConservativeMap, isOfSecondOrder)
{
    const auto smooth = [](const Vector3& x)
    { return std::sin(M_PI * x[0]) * std::cos(2 * x[1]) * std::exp(x[2]); };
    double error[2], flat = 0;
    for (int n = 0; n < 2; ++n)
    {
        const CubeMesh from = cube(n == 0 ? 6 : 12, 1);
        const CubeMesh to = cube(n == 0 ? 7 : 14, 2);
        const ConservativeMap map(OverlapTable(from.tetrahedra, to.tetrahedra));
        const Eigen::VectorXd values = atCentres(from, smooth);
        const auto norm = [&](const Eigen::VectorXd& mapped)
        {
            return std::sqrt(
                to.volume.dot((mapped - atCentres(to, smooth)).cwiseAbs2()));
        };
        error[n] = norm(map.map(slopesOf(from), values, {}));
        flat = norm(map.map(values, Vectors::Zero(values.size(), 3)));
    }
    EXPECT_GT(error[0] / error[1], 3.5);
    EXPECT_GT(flat / error[1], 5);
}


// Neighbours in one plane: a mesh of one layer
TEST(CellSlopes, directionsWithoutNeighboursHaveNone)
{
    Vectors position(5, 3);
    position << 0, 0, 0.5, 1, 0, 0.5, -1, 0.1, 0.5, 0, 1, 0.5, 0.2, -1, 0.5;
    const CellSlopes slopes(position, {0, 4}, {1, 2, 3, 4});
    Eigen::VectorXd values(5);
    for (int i = 0; i < 5; ++i)
    {
        values[i] = 2 * position(i, 0) - position(i, 1) + 7;
    }
    const Vectors result = slopes.slopes(values);
    ASSERT_EQ(result.rows(), 1);
    EXPECT_LT((result.row(0).transpose() - Vector3(2, -1, 0)).norm(), 1e-14);
}


// Cells of a boundary layer, 1e-5 of their length thick
TEST(CellSlopes, areExactInThinCells)
{
    std::vector<Index> start;
    std::vector<int> neighbour;
    const CubeMesh mesh(
        3,
        [](const Vector3& x)
        {
            Vector3 y = jitter(x, 0.03, 3);
            y[2] *= 1e-5;
            return y;
        });
    mesh.neighbours(start, neighbour);
    const CellSlopes slopes(mesh.centre, start, neighbour);
    const Vector3 exact(1, 2, 3e5);
    const Vectors result = slopes.slopes(
        atCentres(mesh, [&](const Vector3& x) { return exact.dot(x); }));
    for (Index c = 0; c < result.rows(); ++c)
    {
        EXPECT_LT((result.row(c).transpose() - exact).norm(), 1e-8 * 3e5);
    }
}
