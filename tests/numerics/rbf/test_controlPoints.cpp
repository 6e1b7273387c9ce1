// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Control points: their directions, their duplicates, their order.

#include "controlPoints.hpp"
#include "test_support.hpp"

#include <Eigen/Geometry>

using namespace test;

namespace
{

const Vector3 x0(0.25, -1, 3);
const Vector3 ex = Vector3::UnitX();
const Vector3 ey = Vector3::UnitY();
const Vector3 ez = Vector3::UnitZ();


std::vector<Index>
withoutDuplicates(const ControlPoints& points, double tolerance)
{
    return morph::withoutDuplicates(points, coincident(points), tolerance);
}


std::string conflictOf(const ControlPoints& points, double tolerance)
{
    try
    {
        withoutDuplicates(points, tolerance);
    }
    catch (const ConflictingControlPoints& conflict)
    {
        EXPECT_EQ(conflict.position, points[0].position);
        return conflict.what();
    }
    return "";
}

} // namespace


TEST(ControlPoint, prescribedHasAllThreeComponentsOfTheDisplacement)
{
    const Vector3 s(1, 2, 3);
    const ControlPoint p = ControlPoint::prescribed(x0, s);
    EXPECT_FALSE(p.slides());
    EXPECT_EQ(p.position, x0);
    EXPECT_EQ(p.residual(Vector3::Zero()), s);
    EXPECT_EQ(p.residual(s), Vector3::Zero());
}


TEST(ControlPoint, slidingOnASurfacePrescribesTheComponentAlongTheUnitNormal)
{
    Random random(31);
    for (int i = 0; i < 50; ++i)
    {
        const Vector3 n = random.direction();
        const Vector3 s = random.inBox();
        const double length = random.uniform(1e-5, 1e5);
        const ControlPoint p = ControlPoint::sliding(x0, {length * n}, s);
        ASSERT_EQ(p.k, 1);
        EXPECT_TRUE(p.slides());
        EXPECT_NEAR(p.C().col(0).norm(), 1, 1e-15);
        EXPECT_LT((p.C().col(0) - n).norm(), 1e-15);
        EXPECT_NEAR(p.g()(0), n.dot(s), 1e-15);

        // Free in the tangent plane, bound along the normal
        const Vector3 tangent = n.cross(random.direction());
        EXPECT_LT(p.residual(s + 3 * tangent).norm(), 3e-15);
        EXPECT_NEAR(p.residual(s - 0.5 * n).norm(), 0.5, 1e-15);
    }
}


TEST(ControlPoint, slidingAlongAnEdgeIsFreeAlongTheEdgeAlone)
{
    Random random(32);
    for (int i = 0; i < 200; ++i)
    {
        const Vector3 s = random.inBox();
        const Vector3 a = random.direction();

        // Also nearly parallel normals, of any length
        const double angle = i % 2 ? 1 : 1e-4;
        const Vector3 b = (a + angle * random.direction()).normalized();
        const double sine = a.cross(b).norm();
        const ControlPoint p = ControlPoint::sliding(x0, {7 * a, -1e-3 * b}, s);

        ASSERT_EQ(p.k, 2);
        const Matrix C = p.C();
        EXPECT_LT((C.transpose() * C - Matrix::Identity(2, 2)).norm(), 1e-15);
        EXPECT_LT(
            std::abs(a.cross(b).normalized().dot(C.col(0))), 1e-14 / sine);
        EXPECT_LT(
            std::abs(a.cross(b).normalized().dot(C.col(1))), 1e-14 / sine);
        EXPECT_LT(p.residual(s + a.cross(b) / sine).norm(), 1e-14 / sine);
        EXPECT_NEAR(p.residual(s + C.col(1)).norm(), 1, 1e-14);
    }
}


TEST(ControlPoint, threeNormalsPrescribeTheDisplacement)
{
    const Vector3 s(1, 2, 3);
    const ControlPoint p =
        ControlPoint::sliding(x0, {ex + ey, ex - 2 * ey + ez, ey + ez}, s);
    EXPECT_FALSE(p.slides());
    EXPECT_LT((p.C() * p.g() - s).norm(), 1e-14);

    // What is prescribed is read as the displacement itself
    EXPECT_LT((p.value - s).norm(), 1e-14);
}


TEST(ControlPoint, refusesNormalsThatAreZeroDependentOrMissing)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<std::vector<Vector3>> bad = {
        {},
        {Vector3::Zero()},
        {Vector3(nan, 0, 0)},
        {ex, ex},
        {ex, -2 * ex},
        {ex, ex + 1e-9 * ey},
        {ex, Vector3::Zero()},
        {ex, ey, ex + ey},
        {ex, ey, ez, ex + ey + ez}};
    for (const std::vector<Vector3>& normals : bad)
    {
        EXPECT_THROW(ControlPoint::sliding(x0, normals), std::invalid_argument)
            << normals.size() << " normals";
    }
}


TEST(ControlPoint, orderByPositionIsTotal)
{
    const std::vector<Vector3> ascending = {
        Vector3(-1, 5, 5), Vector3(0, -1, 7), Vector3(0, 0, -1),
        Vector3::Zero()};
    for (std::size_t i = 0; i < ascending.size(); ++i)
    {
        for (std::size_t j = 0; j < ascending.size(); ++j)
        {
            EXPECT_EQ(before(ascending[i], ascending[j]), i < j);
        }
    }
}


TEST(Duplicates, ofOnePositionThatWithMostConditionsStays)
{
    const ControlPoint surface = ControlPoint::sliding(x0, {ex});
    const ControlPoint edge = ControlPoint::sliding(x0, {ex, ey});
    const ControlPoint fixed = ControlPoint::prescribed(x0, Vector3::Zero());
    const ControlPoint other = ControlPoint::sliding(x0 + 1e-12 * ex, {ez});
    using Indices = std::vector<Index>;

    EXPECT_EQ(withoutDuplicates({surface, edge, fixed}, 0), (Indices{2}));
    EXPECT_EQ(withoutDuplicates({fixed, edge, surface}, 0), (Indices{0}));
    EXPECT_EQ(withoutDuplicates({surface, edge}, 0), (Indices{1}));
    EXPECT_EQ(withoutDuplicates({edge, surface}, 0), (Indices{0}));
    EXPECT_EQ(withoutDuplicates({surface, surface, surface}, 0), (Indices{0}));
    EXPECT_EQ(
        withoutDuplicates({other, surface, edge, other}, 0), (Indices{0, 2}));
    EXPECT_EQ(withoutDuplicates({}, 0), Indices());
}


// Of positions alone: values and directions may change, and the sets remain
TEST(Duplicates, setsFollowFromPositions)
{
    const ControlPoint low = ControlPoint::prescribed(x0 - ex, ez);
    const ControlPoint high = ControlPoint::prescribed(x0 + ex, ez);
    const ControlPoint here = ControlPoint::sliding(x0, {ex});
    ControlPoints points{high, here, low, here, high, low, here};
    const Coincident sets = coincident(points);
    EXPECT_EQ(sets, (Coincident{{2, 5}, {1, 3, 6}, {0, 4}}));

    points[3] = ControlPoint::prescribed(x0, Vector3::Zero());
    EXPECT_EQ(coincident(points), sets);
    EXPECT_EQ(
        morph::withoutDuplicates(points, sets, 0),
        (std::vector<Index>{0, 2, 3}));
    EXPECT_TRUE(coincident({low, high, here}).empty());
}


TEST(Duplicates, pointsAtDifferentPlacesAllStayInTheirOrder)
{
    Random random(33);
    const ControlPoints points = randomControlPoints(random, {3, 30, 20, 10});
    const std::vector<Index> kept = withoutDuplicates(points, 0);
    ASSERT_EQ(kept.size(), points.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
        EXPECT_EQ(kept[i], Index(i));
    }
}


TEST(Duplicates, conditionsThatTheKeptPointMeetsAreNoConflict)
{
    const Vector3 s(0.1, 0.2, 0.3);
    EXPECT_EQ(
        conflictOf(
            {ControlPoint::prescribed(x0, s),
             ControlPoint::prescribed(x0, s + 1e-7 * ey),
             ControlPoint::sliding(x0, {ex + ey}, s),
             ControlPoint::sliding(x0, {ex + ez, ey}, s)},
            1e-6),
        "");
}


TEST(Duplicates, twoDisplacementsOfOnePointAreAConflictThatNamesThePlace)
{
    const std::string message = conflictOf(
        {ControlPoint::prescribed(x0, Vector3::Zero()),
         ControlPoint::prescribed(x0, 0.5 * ey)},
        0.49);
    EXPECT_NE(message.find("0.25"), std::string::npos) << message;
    EXPECT_NE(message.find("-1"), std::string::npos) << message;
    EXPECT_NE(message.find("3"), std::string::npos) << message;
    EXPECT_NE(message.find("0.5"), std::string::npos) << message;
}


TEST(Duplicates, aPrescribedDisplacementOffTheSurfaceIsAConflict)
{
    EXPECT_NE(
        conflictOf(
            {ControlPoint::sliding(x0, {ey}),
             ControlPoint::prescribed(x0, 0.1 * ey)},
            1e-3),
        "");
}


TEST(Duplicates, slidingPointsConflictInTheDirectionsTheyShare)
{
    // One surface in two places
    EXPECT_NE(
        conflictOf(
            {ControlPoint::sliding(x0, {ex}),
             ControlPoint::sliding(x0, {-ex}, 0.1 * ex)},
            1e-3),
        "");

    // An edge off its surface
    EXPECT_NE(
        conflictOf(
            {ControlPoint::sliding(x0, {ex, ey}),
             ControlPoint::sliding(x0, {ex + ey}, 0.1 * ex)},
            1e-3),
        "");

    // Two surfaces that meet: each can be met
    EXPECT_EQ(
        conflictOf(
            {ControlPoint::sliding(x0, {ex}),
             ControlPoint::sliding(x0, {ex + ey}, 0.1 * ex)},
            1e-3),
        "");
}
