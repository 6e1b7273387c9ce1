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
    :
        x(n, 3),
        residuals(n, 3)
    {
        Random random(seed);
        for (Index i = 0; i < n; ++i)
        {
            const Vector3 p = 0.5*random.direction();
            x.row(i) = p.transpose();
            residuals.row(i) << 1e-3*std::sin(9*p[0]), 1e-3*std::cos(7*p[1]),
                1e-3*p[2];
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
    EXPECT_TRUE(within
    (
        "surface correction at its points",
        (d - surface.residuals).cwiseAbs().maxCoeff()/1e-3,
        1e-13
    ));
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
    Vectors off = 1.000002*surface.x;
    Vectors d = Vectors::Zero(3000, 3);
    correction.add(correction.reach(off), d);
    const double gradient =
        (d - surface.residuals).rowwise().norm().maxCoeff()/1e-6;
    EXPECT_LT(gradient, 0.5);
}


TEST(SurfaceCorrection, followsNewResiduals)
{
    const Surface surface(400, 5);
    SurfaceCorrection correction(surface.x, 0.2);
    correction.set(surface.residuals);
    correction.set(-3*surface.residuals);
    Vectors d = Vectors::Zero(400, 3);
    correction.add(correction.reach(surface.x), d);
    EXPECT_LT((d + 3*surface.residuals).cwiseAbs().maxCoeff(), 1e-15);
}


TEST(ExactSurface, isTheSameOnAnyRanksAndWithNewResiduals)
{
    // One place twice, as where ranks share a point
    const Surface surface(300, 6);
    const auto pointAt = [&](Index i)
    {
        return ControlPoint::prescribed
        (
            surface.x.row(i%300).transpose(), Vector3::Zero()
        );
    };
    Vectors near(600, 3);
    near << surface.x, 1.001*surface.x;
    Vectors expected;
    for (const int ranks : {1, 3})
    {
        std::vector<Vectors> moved(ranks);
        onRanks
        (
            ranks,
            [&](Communicator& communicator)
            {
                const int rank = communicator.rank();
                ControlPoints mine;
                std::vector<Vector3> residuals;
                for (Index i = rank; i < 301; i += ranks)
                {
                    mine.push_back(pointAt(i));
                    residuals.push_back(surface.residuals.row(i%300));
                }
                ExactSurface exact(0.2);
                for (const double factor : {1.0, -3.0})
                {
                    moved[rank] = Vectors::Zero(600, 3);
                    exact.add
                    (
                        mine, factor*rows(residuals), communicator, near,
                        moved[rank]
                    );
                }
            }
        );
        if (ranks == 1)
        {
            const Vectors open = -3*surface.residuals;
            EXPECT_LT
            (
                (moved[0].topRows(300) - open).cwiseAbs().maxCoeff(), 1e-15
            );
            expected = moved[0];
        }
        for (const Vectors& d : moved)
        {
            EXPECT_EQ(d, expected);
        }
    }
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
    EXPECT_THROW
    (
        SurfaceCorrection(Columns::Zero(2, 3), 1), std::invalid_argument
    );
    for (const double radius : {0.0, -1.0, std::nan("")})
    {
        EXPECT_THROW
        (
            SurfaceCorrection(Columns::Zero(1, 3), radius),
            std::invalid_argument
        );
    }
}
