// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The volume of a tetrahedron in motion, and how far it stays positive.
//
// Sources of truth: the determinant of the edges themselves, and a search in
// long double that walks along the motion and knows nothing of polynomials.

#include "movingTetrahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <random>

using namespace morph;

namespace
{

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Motion
{
    Vector3 before[3];
    Vector3 after[3];

    Cubic cubic() const
    {
        return movingVolume(
            before[0], before[1], before[2], after[0], after[1], after[2]);
    }

    long double volume(const long double t) const
    {
        long double e[3][3];
        for (int i = 0; i < 3; ++i)
        {
            for (int k = 0; k < 3; ++k)
            {
                e[i][k] = (1 - t) * before[i][k] + t * after[i][k];
            }
        }
        return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1])
            - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0])
            + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }

    // Size of the terms that cancel in a volume
    double scale() const
    {
        double product = 1;
        for (int i = 0; i < 3; ++i)
        {
            product *= std::max(before[i].norm(), after[i].norm());
        }
        return product;
    }
};


// The first root in (0, 1] that a walk of many steps finds, or noRoot
long double walked(const Motion& motion, const int steps)
{
    for (int i = 1; i <= steps; ++i)
    {
        long double low = (i - 1) / (long double)(steps);
        long double high = i / (long double)(steps);
        if (motion.volume(high) > 0)
        {
            continue;
        }
        for (int k = 0; k < 100; ++k)
        {
            const long double middle = 0.5L * (low + high);
            (motion.volume(middle) > 0 ? low : high) = middle;
        }
        return low;
    }
    return noRoot;
}


Motion random(std::mt19937& generator, const double amplitude)
{
    std::normal_distribution<double> normal;
    Motion motion;
    do
    {
        for (int i = 0; i < 3; ++i)
        {
            for (int k = 0; k < 3; ++k)
            {
                motion.before[i][k] = normal(generator);
                motion.after[i][k] =
                    motion.before[i][k] + amplitude * normal(generator);
            }
        }
    } while (motion.volume(0) < 0.05);
    return motion;
}

} // namespace


TEST(MovingTetrahedron, coefficientsGiveTheDeterminant)
{
    std::mt19937 generator(1);
    for (int n = 0; n < 1000; ++n)
    {
        const Motion motion = random(generator, 1);
        const Cubic p = motion.cubic();
        for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0})
        {
            EXPECT_NEAR(
                value(p, t), double(motion.volume(t)),
                20 * eps * motion.scale());
        }
    }
}


TEST(MovingTetrahedron, swappedEdgesChangeTheSignAndNothingElse)
{
    std::mt19937 generator(2);
    for (int n = 0; n < 1000; ++n)
    {
        const Motion m = random(generator, 1);
        const Cubic p = m.cubic();
        const Cubic q = movingVolume(
            m.before[1], m.before[0], m.before[2], m.after[1], m.after[0],
            m.after[2]);
        for (int i = 0; i < 4; ++i)
        {
            EXPECT_EQ(p[i], -q[i]);
        }
    }
}


TEST(MovingTetrahedron, rootIsTheFirstThatAWalkFinds)
{
    std::mt19937 generator(3);
    int broken = 0, whole = 0, differs = 0;
    for (int n = 0; n < 3000; ++n)
    {
        const Motion motion = random(generator, n % 3 == 0 ? 0.3 : 1.5);
        const double root = positiveUpTo(motion.cubic());
        const long double walk = walked(motion, 2000);
        (walk == noRoot ? whole : broken) += 1;

        // A walk may step over a dip below zero: then the volume tells
        if (std::abs(root - double(walk)) > 1e-9)
        {
            ++differs;
            EXPECT_LT(root, walk);
            EXPECT_LT(
                std::abs(double(motion.volume(root))),
                100 * eps * motion.scale());
        }
        else if (walk != noRoot)
        {
            // As sharp as the slope of the volume allows
            const double h = 1e-6;
            const double slope = std::abs(
                double(motion.volume(root + h) - motion.volume(root - h))
                / (2 * h));
            EXPECT_NEAR(
                root, double(walk),
                4 * eps + 100 * eps * motion.scale() / slope);
        }
    }
    EXPECT_GT(broken, 500);
    EXPECT_GT(whole, 500);
    EXPECT_LT(differs, 10);
}


TEST(MovingTetrahedron, allIsPositiveUpToTheRoot)
{
    std::mt19937 generator(4);
    for (int n = 0; n < 3000; ++n)
    {
        const Motion motion = random(generator, 1.5);
        const Cubic p = motion.cubic();
        const double root = std::min(1.0, positiveUpTo(p));
        EXPECT_GT(value(p, root), 0);
        for (int i = 0; i < 50; ++i)
        {
            EXPECT_GT(value(p, root * i / 50), 0);
        }
    }
}


TEST(MovingTetrahedron, whatIsSurelyPositiveIsPositiveUpToThere)
{
    std::mt19937 generator(5);
    int sure = 0;
    for (int n = 0; n < 3000; ++n)
    {
        const Cubic p = random(generator, 1.5).cubic();
        const double root = std::min(1.0, positiveUpTo(p));
        EXPECT_FALSE(
            surelyPositive(p, std::min(1.0, 1.01 * root)) && root < 0.9);
        sure += surelyPositive(p, 0.5 * root);
        if (surelyPositive(p, 0.5 * root))
        {
            for (int i = 0; i <= 20; ++i)
            {
                EXPECT_GT(value(p, 0.5 * root * i / 20), 0);
            }
        }
    }
    // It is of use
    EXPECT_GT(sure, 2000);
}


// Heights that change alone: the volume is linear, the root known
TEST(MovingTetrahedron, linearVolumeHasItsExactRoot)
{
    for (const double target : {1e-9, 1e-3, 0.25, 0.5, 0.999, 1.0})
    {
        Motion motion;
        motion.before[0] = motion.after[0] = Vector3(1, 0, 0);
        motion.before[1] = motion.after[1] = Vector3(0, 1, 0);
        motion.before[2] = Vector3(0.3, 0.2, 1);
        motion.after[2] = Vector3(0.3, 0.2, 1 - 1 / target);
        EXPECT_NEAR(
            positiveUpTo(motion.cubic()), target,
            4 * eps * (1 + 1 / target) * target);
    }
}


// A face that shrinks to a point: (1 - t/target)^2, which touches zero
TEST(MovingTetrahedron, doubleRootIsFoundOrIsPositiveByRoundOff)
{
    for (const double target : {0.25, 0.3, 0.5, 0.7})
    {
        const double end = 1 - 1 / target;
        Motion motion;
        motion.before[0] = Vector3(1, 0, 0);
        motion.after[0] = Vector3(end, 0, 0);
        motion.before[1] = Vector3(0, 1, 0);
        motion.after[1] = Vector3(0, end, 0);
        motion.before[2] = motion.after[2] = Vector3(0, 0, 1);
        const double root = positiveUpTo(motion.cubic());
        EXPECT_TRUE(root == noRoot || std::abs(root - target) < 1e-7) << root;
    }
}


// Shrinking to nothing: (1 - t/target)^3
TEST(MovingTetrahedron, tripleRootIsFound)
{
    for (const double target : {0.25, 0.3, 0.5, 0.7})
    {
        Motion motion;
        for (int i = 0; i < 3; ++i)
        {
            motion.before[i] = Vector3::Unit(i);
            motion.after[i] = (1 - 1 / target) * Vector3::Unit(i);
        }
        EXPECT_NEAR(positiveUpTo(motion.cubic()), target, 2e-5);
    }
}


TEST(MovingTetrahedron, whatWasWrongBeforeHasNoRoot)
{
    EXPECT_EQ(positiveUpTo(Cubic{{0, -1, -1, -1}}), noRoot);
    EXPECT_EQ(positiveUpTo(Cubic{{-1, 1, -1, 1}}), noRoot);
}


TEST(MovingTetrahedron, rootAtTheEndCounts)
{
    EXPECT_NEAR(positiveUpTo(Cubic{{1, 1, 1, 0}}), 1, 1e-5);
    EXPECT_EQ(positiveUpTo(Cubic{{1, 1, 1, 1e-300}}), noRoot);
}


TEST(MovingTetrahedron, whatIsNoNumberGoesNowhere)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(positiveUpTo(Cubic{{1, 1, nan, 1}}), 0);
    EXPECT_EQ(positiveUpTo(Cubic{{nan, 1, 1, 1}}), 0);
}


// A thin cell of a boundary layer far from the origin of its motion
TEST(MovingTetrahedron, thinTetrahedraKeepTheirDigits)
{
    Motion motion;
    motion.before[0] = Vector3(1, 0, 0);
    motion.before[1] = Vector3(0, 1, 0);
    motion.before[2] = Vector3(0.3, 0.3, 1e-8);
    for (int i = 0; i < 3; ++i)
    {
        motion.after[i] = motion.before[i];
    }
    motion.after[2][2] = -3e-8;
    EXPECT_NEAR(positiveUpTo(motion.cubic()), 0.25, 1e-14);
}
