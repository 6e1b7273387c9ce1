// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Interpolation through all control points without a polynomial, against two
// dense systems.

#include "test_support.hpp"

using namespace test;

namespace
{

const Mixture mixtures[] = {
    // dimension, moving, on a surface, on an edge
    {3, 40, 0, 0},  {3, 25, 12, 6}, {3, 6, 20, 15},
    {3, 0, 25, 10}, {3, 1, 0, 20},  {2, 35, 0, 0},
    {2, 20, 15, 0}, {2, 10, 15, 5}, {2, 0, 20, 0}};


std::string nameOf(const Mixture& m)
{
    return std::to_string(m.dimension) + "D with " + std::to_string(m.moving)
        + " moving, " + std::to_string(m.onSurface) + " on surfaces, "
        + std::to_string(m.onEdge) + " on edges";
}


struct Case
{
    KernelType type;
    double radius;
    ControlPoints points;
    RbfInterpolant found;
    Vectors probes;
    std::string name;
};


void forAllCases(const std::function<void(const Case&)>& check)
{
    for (const KernelType type : positiveDefiniteKernels())
    {
        for (const Mixture& mixture : mixtures)
        {
            Random random(21);
            const double radius = moderateRadius(type);
            const ControlPoints points = randomControlPoints(random, mixture);
            const Vectors probes =
                rows(random.pointsApart(100, mixture.dimension, 0));
            check(
                {type, radius, points,
                 throughAll(Kernel(type, radius), Polynomial::none, points),
                 probes, test::nameOf(type) + ", " + nameOf(mixture)});
        }
    }
}


// The index of the control point at each centre
std::vector<Index>
pointsOfCentres(const RbfInterpolant& interpolant, const ControlPoints& points)
{
    std::vector<Index> indices;
    for (Index j = 0; j < interpolant.centres().rows(); ++j)
    {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            if (interpolant.centres().row(j).transpose() == points[i].position)
            {
                indices.push_back(i);
            }
        }
    }
    return indices;
}

// Every case against an independent solution of the same problem
template <class Solve>
void agreesWith(const std::string& name, const Solve& solve)
{
    forAllCases(
        [&](const Case& c)
        {
            const reference::Field expected = solve(c.type, c.radius, c.points);
            EXPECT_TRUE(within(
                "whole solve against " + name,
                largestDifference(c.found(c.probes), expected(c.probes))
                    / largestDisplacement(c.points),
                1e-10))
                << c.name;
        });
}

} // namespace


TEST(WholeSolve, agreesWithTheDenseGramSystem)
{
    agreesWith("dense Gram system", reference::gram);
}


TEST(WholeSolve, agreesWithTheSystemOfThePaper)
{
    agreesWith("system (6) of the paper", reference::paper);
}


TEST(WholeSolve, meetsEveryConditionOfMovingAndSlidingPoints)
{
    forAllCases(
        [](const Case& c)
        {
            const Vectors s =
                reference::plainSum(c.found)(positionRows(c.points));
            for (const double error : reference::errors(c.points, s))
            {
                EXPECT_TRUE(within(
                    "conditions at control points",
                    error / largestDisplacement(c.points), 1e-10))
                    << c.name;
            }
        });
}


TEST(WholeSolve, weightsOfSlidingPointsLieAlongTheirNormals)
{
    forAllCases(
        [](const Case& c)
        {
            const std::vector<Index> index = pointsOfCentres(c.found, c.points);
            ASSERT_EQ(index.size(), c.points.size()) << c.name;
            for (std::size_t j = 0; j < index.size(); ++j)
            {
                const ControlPoint& p = c.points[index[j]];
                Vector3 tangential = c.found.weights().row(j).transpose();
                const double size = tangential.norm();
                for (int a = 0; a < p.k; ++a)
                {
                    const Vector3 n = p.directions.col(a);
                    tangential -= n.dot(tangential) * n;
                }
                EXPECT_TRUE(within(
                    "tangential part of sliding weights",
                    tangential.norm() / size, 1e-14))
                    << c.name;
            }
        });
}


TEST(WholeSolve, everyControlPointIsACentreOnce)
{
    forAllCases(
        [](const Case& c)
        {
            std::vector<Index> index = pointsOfCentres(c.found, c.points);
            std::sort(index.begin(), index.end());
            ASSERT_EQ(index.size(), c.points.size()) << c.name;
            for (std::size_t i = 0; i < index.size(); ++i)
            {
                EXPECT_EQ(index[i], Index(i)) << c.name;
            }
        });
}


TEST(WholeSolve, takesMoreThanOneBlockOfPoints)
{
    // Points are appended in blocks of 256, moving ones also after sliding ones
    Random random(22);
    const ControlPoints points = randomControlPoints(random, {3, 400, 200, 60});
    const RbfInterpolant found = throughAll(
        Kernel(KernelType::wendlandC2, 0.4), Polynomial::none, points);
    const Vectors s = reference::plainSum(found)(positionRows(points));
    for (const double error : reference::errors(points, s))
    {
        EXPECT_TRUE(within(
            "conditions at 660 control points",
            error / largestDisplacement(points), 1e-10));
    }
}


TEST(WholeSolve, noDisplacementGivesNone)
{
    Random random(23);
    ControlPoints points = randomControlPoints(random, {3, 15, 10, 5});
    for (ControlPoint& p : points)
    {
        p.value.setZero();
    }
    const RbfInterpolant s = throughAll(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, points);
    EXPECT_EQ(s(rows(random.pointsApart(50, 3, 0))), Vectors::Zero(50, 3));
}


TEST(WholeSolve, onePointSpreadsItsDisplacementByTheKernel)
{
    // s(x) = phi(|x - x_1|/r0) d
    Random random(24);
    const Vector3 x(0.3, 0.2, 0.5), d(0.1, -0.2, 0.05);
    const Vectors probes = rows(random.pointsApart(50, 3, 0));
    const auto phi = [&](Index i)
    {
        return double(reference::phi(
            KernelType::wendlandC4,
            (probes.row(i).transpose() - x).norm() / 0.8));
    };
    const Kernel kernel(KernelType::wendlandC4, 0.8);

    const Vectors s = throughAll(
        kernel, Polynomial::none, {ControlPoint::prescribed(x, d)})(probes);
    const Vector3 n = Vector3(1, 2, -2) / 3;
    const Vectors t = throughAll(
        kernel, Polynomial::none, {ControlPoint::sliding(x, {n}, d)})(probes);
    for (Index i = 0; i < probes.rows(); ++i)
    {
        EXPECT_LT((s.row(i).transpose() - phi(i) * d).norm(), 1e-15);
        EXPECT_LT((t.row(i).transpose() - phi(i) * n.dot(d) * n).norm(), 1e-15);
    }
}


TEST(WholeSolve, noPointsAtAllGiveZeroEverywhere)
{
    for (const bool all : {true, false})
    {
        SelectionSettings settings;
        settings.all = all;
        GreedySelection selection(
            Kernel(KernelType::wendlandC2, 1), Polynomial::none, settings);
        SerialCommunicator alone;
        const SelectionResult result = selection.select({}, alone);
        EXPECT_EQ(result.candidates, 0);
        EXPECT_EQ(result.selected, 0);
        EXPECT_EQ(result.largestError, 0);
        EXPECT_TRUE(result.converged());
        EXPECT_TRUE(selection.selected().empty());
        EXPECT_EQ(
            selection.interpolant()(Vectors(Vectors::Ones(3, 3))),
            Vectors::Zero(3, 3));
    }
}


TEST(WholeSolve, aPointHeldInThreeDirectionsGoesWhereItIsTold)
{
    // The corner of three planes: no direction is left to slide along
    Random random(25);
    ControlPoints points = randomControlPoints(random, {3, 10, 5, 0});
    const Vector3 x(1.3, 1.1, 0.9), s(0.05, 0.02, -0.04);
    points.push_back(ControlPoint::sliding(
        x, {Vector3(1, 1, 0), Vector3(1, -2, 1), Vector3(0, 1, 1)}, s));
    const RbfInterpolant found = throughAll(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, points);
    EXPECT_LT((found(rows({x})).row(0).transpose() - s).norm(), 1e-12);
}
