// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Interpolation with a linear polynomial and its side conditions.

#include "gramFactor.hpp"
#include "test_support.hpp"

#include <Eigen/Dense>

using namespace test;

namespace
{

const std::vector<Vector3> axes3D = {
    Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};

const std::vector<Vector3> axes2D = {Vector3::UnitX(), Vector3::UnitY()};

const Mixture mixtures[] = {{3, 40, 0, 0}, {3, 20, 15, 10}, {3, 5, 20, 10},
                            {2, 35, 0, 0}, {2, 15, 15, 0},  {2, 4, 15, 5}};


const std::vector<Vector3>& axesOf(const Mixture& mixture)
{
    return mixture.dimension == 3 ? axes3D : axes2D;
}


std::string nameOf(KernelType type, const Mixture& m)
{
    return test::nameOf(type) + ", " + std::to_string(m.dimension) + "D, "
        + std::to_string(m.moving) + " moving points";
}


// An affine displacement, in 2D within the plane
struct Affine
{
    Eigen::Matrix3d A;
    Vector3 b;

    Affine(Random& random, int dimension)
    {
        for (int i = 0; i < 3; ++i)
        {
            A.col(i) = 0.1 * random.inBox();
        }
        b = random.inBox();
        if (dimension == 2)
        {
            A.row(2).setZero();
            b.z() = 0;
        }
    }

    Vector3 operator()(const Vector3& x) const { return A * x + b; }

    Vectors operator()(const Vectors& x) const
    {
        return (x * A.transpose()).rowwise() + b.transpose();
    }
};


template <class Displacement>
ControlPoints displaced(ControlPoints points, const Displacement& s)
{
    for (ControlPoint& p : points)
    {
        p.value.head(p.k) =
            p.directions.leftCols(p.k).transpose() * s(p.position);
    }
    return points;
}


SelectionSettings takeAll()
{
    SelectionSettings settings;
    settings.all = true;
    return settings;
}

} // namespace


TEST(Polynomial, affineDisplacementsAreReproducedEverywhere)
{
    for (const KernelType type : allKernels())
    {
        for (const Mixture& mixture : mixtures)
        {
            Random random(51);
            const Affine affine(random, mixture.dimension);
            const ControlPoints points =
                displaced(randomControlPoints(random, mixture), affine);
            const RbfInterpolant s = throughAll(
                Kernel(type, moderateRadius(type)), Polynomial::linear, points);
            Vectors probes =
                rows(random.pointsApart(100, mixture.dimension, 0));
            probes.leftCols(mixture.dimension) *= 3;
            EXPECT_TRUE(within(
                "affine displacement",
                largestDifference(s(probes), affine(probes))
                    / largestDisplacement(points),
                1e-11))
                << nameOf(type, mixture);
        }
    }
}


TEST(Polynomial, affineDisplacementsNeedNoPointsButTheNodes)
{
    for (const KernelType type : allKernels())
    {
        for (const Mixture& mixture : mixtures)
        {
            Random random(52);
            const Affine affine(random, mixture.dimension);
            const ControlPoints points =
                displaced(randomControlPoints(random, mixture), affine);
            SelectionSettings settings;
            settings.tolerance = 1e-10;
            GreedySelection selection(
                Kernel(type, moderateRadius(type)), Polynomial::linear,
                settings);
            SerialCommunicator alone;
            const SelectionResult result = selection.select(points, alone);
            EXPECT_EQ(result.selected, mixture.dimension + 1)
                << nameOf(type, mixture);
            EXPECT_TRUE(result.converged()) << nameOf(type, mixture);
        }
    }
}


TEST(Polynomial, rigidRotationsAndTranslationsAreReproducedEverywhere)
{
    Random random(53);
    const Eigen::AngleAxisd turn(0.8, random.direction());
    const Vector3 shift(5, 6, 7);
    const auto rigid = [&](const Vector3& x)
    { return Vector3(turn * x - x + shift); };
    const ControlPoints points =
        displaced(randomControlPoints(random, {3, 20, 15, 5}), rigid);
    const RbfInterpolant s = throughAll(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::linear, points);
    for (const Vector3& x : random.pointsApart(50, 3, 0))
    {
        EXPECT_LT((s(rows({x})).row(0).transpose() - rigid(x)).norm(), 1e-12);
    }
}


TEST(Polynomial, weightsMeetTheSideConditions)
{
    for (const KernelType type : allKernels())
    {
        for (const Mixture& mixture : mixtures)
        {
            Random random(54);
            const ControlPoints points = randomControlPoints(random, mixture);
            const RbfInterpolant s = throughAll(
                Kernel(type, moderateRadius(type)), Polynomial::linear, points);

            // sum_j gamma_j q(x_j) = 0 for q = 1 and the coordinates
            using reference::RealMatrix;
            const RealMatrix w = s.weights().cast<reference::Real>();
            RealMatrix sums(1 + axesOf(mixture).size(), 3);
            sums.row(0) = w.colwise().sum();
            for (std::size_t a = 0; a < axesOf(mixture).size(); ++a)
            {
                sums.row(a + 1) = (s.centres().cast<reference::Real>()
                                   * axesOf(mixture)[a].cast<reference::Real>())
                                      .transpose()
                    * w;
            }
            EXPECT_TRUE(within(
                "side conditions, of the sum of |weights|",
                double(sums.cwiseAbs().maxCoeff())
                    / s.weights().rowwise().norm().sum(),
                1e-13))
                << nameOf(type, mixture);
        }
    }
}


TEST(Polynomial, agreesWithTheAugmentedSystem)
{
    for (const KernelType type : allKernels())
    {
        for (const Mixture& mixture : mixtures)
        {
            Random random(55);
            const double radius = moderateRadius(type);
            const ControlPoints points = randomControlPoints(random, mixture);
            const RbfInterpolant s =
                throughAll(Kernel(type, radius), Polynomial::linear, points);
            const reference::Field expected =
                reference::augmented(type, radius, points, axesOf(mixture));
            const Vectors probes =
                rows(random.pointsApart(100, mixture.dimension, 0));
            EXPECT_TRUE(within(
                "whole solve with polynomial against augmented system",
                largestDifference(s(probes), expected(probes))
                    / largestDisplacement(points),
                1e-10))
                << nameOf(type, mixture);
        }
    }
}


TEST(Polynomial, isConstantNormalToThePlaneWhereMovingPointsLieInOne)
{
    for (const KernelType type : allKernels())
    {
        if (type == KernelType::thinPlate)
        {
            continue;
        }
        Random random(56);
        ControlPoints points = randomControlPoints(random, {3, 20, 20, 0});
        for (ControlPoint& p : points)
        {
            if (!p.slides())
            {
                p.position.z() = 0.5;
            }
        }
        const double radius = moderateRadius(type);
        const RbfInterpolant s =
            throughAll(Kernel(type, radius), Polynomial::linear, points);
        const Vectors at = positionRows(points);
        for (const double error : reference::errors(points, s(at)))
        {
            EXPECT_TRUE(within(
                "conditions, moving points in a plane",
                error / largestDisplacement(points), 1e-10))
                << test::nameOf(type);
        }
        const reference::Field expected =
            reference::augmented(type, radius, points, axes2D);
        EXPECT_TRUE(within(
            "whole solve with polynomial against augmented system",
            largestDifference(s(at), expected(at))
                / largestDisplacement(points),
            1e-10))
            << test::nameOf(type);
    }
}


TEST(Polynomial, ofOnePointIsItsDisplacementEverywhere)
{
    const Vector3 d(1, 2, 3);
    for (const KernelType type : allKernels())
    {
        const RbfInterpolant s = throughAll(
            Kernel(type, 0.5), Polynomial::linear,
            {ControlPoint::prescribed(Vector3(4, 5, 6), d)});
        const Vectors found = s(Vectors(Vectors::Random(10, 3)));
        EXPECT_LT((found.rowwise() - d.transpose()).norm(), 1e-14)
            << test::nameOf(type);
    }
}


TEST(Polynomial, thinPlateRefusesMovingPointsInAPlaneWithSlidingOnesOffIt)
{
    Random random(57);
    for (int dimension : {2, 3})
    {
        ControlPoints points =
            randomControlPoints(random, {dimension, 10, 10, 0});
        for (ControlPoint& p : points)
        {
            if (!p.slides())
            {
                p.position[dimension - 1] = 0.5;
            }
        }
        GreedySelection selection(
            Kernel(KernelType::thinPlate, 1), Polynomial::linear, takeAll());
        SerialCommunicator alone;
        EXPECT_THROW(selection.select(points, alone), std::invalid_argument);

        // Not once only
        EXPECT_THROW(selection.select(points, alone), std::invalid_argument);
    }
}


TEST(Polynomial, isRefusedWhereEveryPointSlides)
{
    Random random(58);
    const ControlPoints points = randomControlPoints(random, {3, 0, 20, 5});
    for (const KernelType type : allKernels())
    {
        GreedySelection selection(
            Kernel(type, 1), Polynomial::linear, takeAll());
        SerialCommunicator alone;
        EXPECT_THROW(selection.select(points, alone), std::invalid_argument)
            << test::nameOf(type);
        EXPECT_THROW(selection.select(points, alone), std::invalid_argument)
            << test::nameOf(type);
    }
}


TEST(Polynomial, isNotOptionalForConditionallyDefiniteKernels)
{
    for (const KernelType type : allKernels())
    {
        const Kernel kernel(type, 1);
        if (kernel.order() > 0)
        {
            EXPECT_THROW(
                GreedySelection(kernel, Polynomial::none, takeAll()),
                std::invalid_argument);
            EXPECT_THROW((GramFactor(kernel)), std::invalid_argument);
        }
    }
}
