// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The correction that makes the field exact at points that were not selected.

#include "exactSurface.hpp"
#include "surfaceCorrection.hpp"
#include "test_support.hpp"

#include <cmath>

using namespace test;

namespace
{

// Points on a sphere of radius 0.5, as close as they come by chance, and a
// smooth residual on them
struct Surface
{
    Columns x;
    Vectors residuals;

    Surface(Index n, unsigned seed)
    : x(n, 3),
      residuals(n, 3)
    {
        Random random(seed);
        for (Index i = 0; i < n; ++i)
        {
            const Vector3 p = 0.5 * random.direction();
            x.row(i) = p.transpose();
            residuals.row(i) << 1e-3 * std::sin(9 * p[0]),
                1e-3 * std::cos(7 * p[1]), 1e-3 * p[2];
        }
    }
};

} // namespace


TEST(SurfaceCorrection, meetsEveryResidual)
{
    const Surface surface(3000, 1);
    SurfaceCorrection correction(surface.x, 0.2);
    correction.set(surface.residuals);
    Vectors d = Vectors::Zero(3000, 3);
    correction.add(correction.reach(surface.x), d);
    EXPECT_TRUE(within(
        "surface correction at its points",
        (d - surface.residuals).cwiseAbs().maxCoeff() / 1e-3, 1e-13));
    EXPECT_GT(correction.levels(), 3);
}


TEST(SurfaceCorrection, isZeroBeyondItsRadius)
{
    const Surface surface(500, 2);
    SurfaceCorrection correction(surface.x, 0.1);
    correction.set(surface.residuals);
    Vectors x(3, 3), d = Vectors::Zero(3, 3);
    x << 0, 0, 0, 0.61, 0, 0, 0, 0.3, 0.2;
    correction.add(correction.reach(x), d);
    EXPECT_EQ(d, Vectors::Zero(3, 3));
}


TEST(SurfaceCorrection, changesNothingWhereNothingIsLeft)
{
    const Surface surface(500, 3);
    SurfaceCorrection correction(surface.x, 0.1);
    correction.set(Vectors::Zero(500, 3));
    Vectors d = surface.residuals;
    correction.add(correction.reach(surface.x), d);
    EXPECT_EQ(d, surface.residuals);
}


TEST(SurfaceCorrection, movesTheNeighbourhoodWithTheSurface)
{
    // A layer much thinner than the distance of the points keeps its thickness:
    // between two points 1e-6 apart the correction differs by the gradient
    const Surface surface(3000, 4);
    SurfaceCorrection correction(surface.x, 0.2);
    correction.set(surface.residuals);
    Vectors off = 1.000002 * surface.x;
    Vectors d = Vectors::Zero(3000, 3);
    correction.add(correction.reach(off), d);
    const double gradient =
        (d - surface.residuals).rowwise().norm().maxCoeff() / 1e-6;
    EXPECT_LT(gradient, 0.5);
}


TEST(SurfaceCorrection, followsNewResiduals)
{
    const Surface surface(400, 5);
    SurfaceCorrection correction(surface.x, 0.2);
    correction.set(surface.residuals);
    correction.set(-3 * surface.residuals);
    Vectors d = Vectors::Zero(400, 3);
    correction.add(correction.reach(surface.x), d);
    EXPECT_LT((d + 3 * surface.residuals).cwiseAbs().maxCoeff(), 1e-15);
}


TEST(ExactSurface, isTheSameOnAnyRanksAndWithNewResiduals)
{
    // One place twice, as where ranks share a point
    const Surface surface(300, 6);
    const auto pointAt = [&](Index i)
    {
        return ControlPoint::prescribed(
            surface.x.row(i % 300).transpose(), Vector3::Zero());
    };
    Vectors near(600, 3);
    near << surface.x, 1.001 * surface.x;
    Vectors expected;
    for (const int ranks : {1, 3})
    {
        std::vector<Vectors> moved(ranks);
        onRanks(
            ranks,
            [&](Communicator& communicator)
            {
                const int rank = communicator.rank();
                ControlPoints mine;
                std::vector<Vector3> residuals;
                for (Index i = rank; i < 301; i += ranks)
                {
                    mine.push_back(pointAt(i));
                    residuals.push_back(surface.residuals.row(i % 300));
                }
                ExactSurface exact(0.2);
                for (const double factor : {1.0, -3.0})
                {
                    moved[rank] = Vectors::Zero(600, 3);
                    exact.add(
                        mine, factor * rows(residuals), communicator, near,
                        moved[rank]);
                }
            });
        if (ranks == 1)
        {
            const Vectors open = -3 * surface.residuals;
            EXPECT_LT(
                (moved[0].topRows(300) - open).cwiseAbs().maxCoeff(), 1e-15);
            expected = moved[0];
        }
        for (const Vectors& d : moved)
        {
            EXPECT_EQ(d, expected);
        }
    }
}


TEST(ExactSurface, hasTheSymmetryAndThePeriodOfItsImages)
{
    // A mirror at x = 0 and a period of 1 in y: residuals are those of points
    // in [0, 1]^3, in the mirror's plane along it
    const Surface surface(200, 7);
    Box box;
    box.low = Vector3::Zero();
    box.high = Vector3::Ones();
    const ImageGroup images(
        {RigidMap::reflection(Vector3::Zero(), Vector3::UnitX()),
         RigidMap::translation(Vector3::UnitY())},
        box, 0.7, 100);
    ControlPoints points;
    Vectors residuals(202, 3);
    Columns x(202, 3);
    for (Index i = 0; i < 202; ++i)
    {
        Vector3 at = surface.x.row(i % 200).transpose();
        for (int a = 0; a < 3; ++a)
        {
            at[a] -= std::floor(at[a]);
        }
        Vector3 r = surface.residuals.row(i % 200).transpose();
        if (i >= 200)
        {
            // In the plane of the mirror, and very near to it
            at = Vector3(i == 200 ? 0 : 1e-4, 0.3, 0.4 + 0.2 * (i - 200));
            r[0] = i == 200 ? 0 : r[0];
        }
        points.push_back(ControlPoint::prescribed(at, Vector3::Zero()));
        residuals.row(i) = r.transpose();
        x.row(i) = at.transpose();
    }

    // At the points themselves, in the plane of the mirror, and on both
    // periodic sides
    const Index n = 100;
    Vectors where(202 + 3 * n, 3);
    where.topRows(202) = x;
    for (Index i = 0; i < n; ++i)
    {
        const double a = 0.01 * i;
        const double b = std::fmod(0.37 * i, 1.0);
        where.row(202 + i) << 0, a, b;
        where.row(202 + n + i) << a, 0, b;
        where.row(202 + 2 * n + i) << a, 1, b;
    }
    SerialCommunicator communicator;
    Vectors moved = Vectors::Zero(where.rows(), 3);
    ExactSurface(0.2, images)
        .add(points, residuals, communicator, where, moved);

    EXPECT_LT((moved.topRows(202) - residuals).cwiseAbs().maxCoeff(), 1e-14);
    const Vectors inPlane = moved.middleRows(202, n);
    EXPECT_LT(inPlane.col(0).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_GT(inPlane.cwiseAbs().maxCoeff(), 1e-4);
    const Vectors here = moved.middleRows(202 + n, n);
    const Vectors there = moved.bottomRows(n);
    EXPECT_GT(here.cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((there - here).cwiseAbs().maxCoeff(), 1e-14);
}


TEST(SurfaceCorrection, copesWithNoPoints)
{
    SurfaceCorrection correction(Columns(0, 3), 1);
    Vectors d = Vectors::Zero(1, 3);
    correction.add(correction.reach(Vectors::Zero(1, 3)), d);
    EXPECT_EQ(d, Vectors::Zero(1, 3));
}


TEST(SurfaceCorrection, refusesCoincidentPointsAndBadRadii)
{
    EXPECT_THROW(
        SurfaceCorrection(Columns::Zero(2, 3), 1), std::invalid_argument);
    for (const double radius : {0.0, -1.0, std::nan("")})
    {
        EXPECT_THROW(
            SurfaceCorrection(Columns::Zero(1, 3), radius),
            std::invalid_argument);
    }
}
