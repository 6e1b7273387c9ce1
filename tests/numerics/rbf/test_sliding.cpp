// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Points that slide on curved surfaces: the values that Newton's method on the
// chord prescribes, and greedy selection with them. Sources of truth: the
// closed forms of planes, cylinder and sphere.

#include "slidingCondition.hpp"
#include "test_support.hpp"

#include <Eigen/Geometry>

using namespace test;

namespace
{

// In the midst of a duct of radius 1 along z a body moves; points on the duct
// slide on it, on its rims they slide along them (z = -1), or are fixed (z = 1)
struct Duct
{
    ControlPoints points;

    explicit Duct(const Vector3& motion, double turn = 0)
    {
        const int around = 40;
        const int along = 21;
        for (int k = 0; k < along; ++k)
        {
            for (int j = 0; j < around; ++j)
            {
                const double a = 2 * M_PI * (j + 0.5 * (k % 2)) / around;
                const Vector3 n(std::cos(a), std::sin(a), 0);
                const Vector3 x =
                    n + (2.0 * k / (along - 1) - 1) * Vector3::UnitZ();
                points.push_back(
                    k == along - 1
                        ? ControlPoint::prescribed(x, Vector3::Zero())
                        : k == 0
                        ? ControlPoint::sliding(x, {n, Vector3::UnitZ()})
                        : ControlPoint::sliding(x, {n}));
            }
        }
        Random random(7);
        for (int i = 0; i < 150; ++i)
        {
            const Vector3 x = 0.5 * random.direction();
            const Vector3 turned =
                Eigen::AngleAxisd(turn, Vector3::UnitZ()) * x;
            points.push_back(ControlPoint::prescribed(x, motion + turned - x));
        }
    }

    static void slide(const Vectors& s, ControlPoints& points)
    {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            ControlPoint& p = points[i];
            if (!p.slides())
            {
                continue;
            }
            const Vector3 y = p.position + s.row(i).transpose();
            Vector3 n(y[0], y[1], 0);
            n.normalize();
            TangentPlanes planes;
            planes.add(n, y.head<2>().norm() - 1);
            if (p.k == 2)
            {
                planes.add(Vector3::UnitZ(), y[2] + 1);
            }
            slideOnto(p, s.row(i).transpose(), planes);
        }
    }

    // Of points on the duct, how far they end from it, and those of the rim
    // from its plane
    double distance(const Vectors& s) const
    {
        double largest = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Vector3 y = points[i].position + s.row(i).transpose();
            if (points[i].slides())
            {
                largest = std::max(largest, std::abs(y.head<2>().norm() - 1));
            }
            if (points[i].k == 2)
            {
                largest = std::max(largest, std::abs(y[2] + 1));
            }
        }
        return largest;
    }
};


GreedySelection selection(double tolerance, Index maxPoints = 100000)
{
    SelectionSettings settings;
    settings.tolerance = tolerance;
    settings.maxPoints = maxPoints;
    return {Kernel(KernelType::wendlandC2, 2), Polynomial::none, settings};
}

} // namespace


TEST(SlidingCondition, bringsThePointOntoThePlaneAlongItsOwnDirection)
{
    Random random(3);
    for (int i = 0; i < 100; ++i)
    {
        const Vector3 s = random.inBox();
        const Vector3 n = random.direction();
        Vector3 m = random.direction();
        m = (n + (n.dot(m) < 0 ? -0.5 : 0.5) * m).normalized();
        ControlPoint p = ControlPoint::sliding(random.inBox(), {n});
        TangentPlanes planes;
        const double h = random.uniform(-1, 1);
        planes.add(m, h);
        EXPECT_NEAR(slideOnto(p, s, planes), std::abs(n.dot(m)), 1e-15);
        const Vector3 moved = p.C() * (p.g() - p.C().transpose() * s);
        EXPECT_TRUE(within(
            "sliding point and its plane", std::abs(m.dot(moved) + h), 1e-14));
    }
}


TEST(SlidingCondition, bringsThePointOntoBothPlanesOfAnEdge)
{
    Random random(4);
    for (int i = 0; i < 100; ++i)
    {
        const Vector3 s = random.inBox();
        const Vector3 n1 = random.direction();
        const Vector3 n2 =
            (n1.cross(random.direction()).normalized() + 0.3 * n1).normalized();
        const Vector3 turn = 0.3 * random.inBox();
        const Eigen::AngleAxisd rotation(
            0.2 + 0.5 * turn.norm(), turn.normalized());
        ControlPoint p = ControlPoint::sliding(random.inBox(), {n1, n2});
        TangentPlanes planes;
        const Vector3 m1 = rotation * n1, m2 = rotation * n2;
        const double h1 = random.uniform(-1, 1), h2 = random.uniform(-1, 1);
        planes.add(m1, h1);
        planes.add(m2, h2);
        EXPECT_GT(slideOnto(p, s, planes), 0.7);
        const Vector3 moved = p.C() * (p.g() - p.C().transpose() * s);
        EXPECT_TRUE(within(
            "point on an edge and its planes",
            std::max(
                std::abs(m1.dot(moved) + h1), std::abs(m2.dot(moved) + h2)),
            1e-13));
        EXPECT_EQ(p.k, 2);
    }
}


TEST(SlidingCondition, aPlaneThatIsNearlyPerpendicularMovesThePointNoFurther)
{
    ControlPoint p = ControlPoint::sliding(Vector3::Zero(), {Vector3::UnitZ()});
    TangentPlanes planes;
    planes.add(Vector3(1, 0, 1e-9).normalized(), 0.1);
    EXPECT_NEAR(slideOnto(p, Vector3::Zero(), planes), 1e-9, 1e-12);
    EXPECT_NEAR(p.g()(0), -0.1 / leastSlidingCosine, 1e-12);
}


TEST(SlidingCondition, theWayIntoThePlanesIsTheShortest)
{
    Random random(5);
    const Vector3 n = random.direction();
    const Vector3 m = (n + random.direction()).normalized();
    TangentPlanes one;
    one.add(n, 0.3);
    EXPECT_LT((wayInto(one) + 0.3 * n).norm(), 1e-15);

    TangentPlanes two;
    two.add(n, 0.3);
    two.add(m, -0.2);
    const Vector3 way = wayInto(two);
    EXPECT_NEAR(n.dot(way), -0.3, 1e-14);
    EXPECT_NEAR(m.dot(way), 0.2, 1e-14);
    // Nothing of it is along the edge
    EXPECT_NEAR(way.dot(n.cross(m)), 0, 1e-14);
}


TEST(Sliding, pointsEndOnACylinderAndOnItsRim)
{
    for (const double tolerance : {1e-3, 1e-5})
    {
        SCOPED_TRACE(tolerance);
        const Vector3 motion(0.1, 0.05, -0.3);
        SerialCommunicator serial;

        // As planes: the points leave the surface
        Duct planes(motion, 0.5);
        GreedySelection tangential = selection(tolerance);
        const SelectionResult asPlanes =
            tangential.select(planes.points, serial);
        const Vectors x = positionRows(planes.points);
        EXPECT_TRUE(asPlanes.converged());
        EXPECT_GT(planes.distance(tangential.interpolant()(x)), 0.01);

        Duct duct(motion, 0.5);
        GreedySelection curved = selection(tolerance);
        const SelectionResult result =
            curved.select(duct.points, serial, Duct::slide);
        EXPECT_TRUE(result.converged());
        EXPECT_LE(
            duct.distance(curved.interpolant()(x)), 1.01 * result.tolerance);
        EXPECT_EQ(result.tolerance, asPlanes.tolerance);
        std::printf(
            "duct, tolerance %g: %ld points in %ld sweeps, %ld renewals; as "
            "planes %ld in %ld, then %.2g off\n",
            tolerance, result.selected, result.sweeps, result.renewals,
            asPlanes.selected, asPlanes.sweeps,
            planes.distance(tangential.interpolant()(x)));
        EXPECT_LE(result.selected, 1.2 * asPlanes.selected);
        EXPECT_LE(result.renewals, 12);
    }
}


TEST(Sliding, pointsEndOnTheCylinderWithEveryAlgorithmAndWithAllPoints)
{
    const Vector3 motion(0.1, 0, 0.1);
    for (int which = 0; which < 4; ++which)
    {
        SCOPED_TRACE(which);
        SelectionSettings settings;
        settings.tolerance = 1e-2;
        settings.algorithm = which < 3 ? Algorithm(which) : Algorithm(0);
        settings.all = which == 3;
        Duct duct(motion);
        SerialCommunicator serial;
        GreedySelection greedy(
            Kernel(KernelType::wendlandC2, 1), Polynomial::none, settings);
        const SelectionResult result =
            greedy.select(duct.points, serial, Duct::slide);
        EXPECT_TRUE(result.converged());
        EXPECT_LE(
            duct.distance(greedy.interpolant()(positionRows(duct.points))),
            1.01 * result.tolerance);
    }
}


TEST(Sliding, aMotionThatReturnsLeavesNothing)
{
    SerialCommunicator serial;
    GreedySelection curved = selection(1e-5);
    const Duct still(Vector3::Zero());
    const Vectors x = positionRows(still.points);
    Vectors there;
    Index added = 0;
    for (int i = 0; i < 4; ++i)
    {
        // The values are what they are at rest, whatever the motion before
        Duct duct(Vector3(0.1, 0.05, 0.2), 0.3);
        const SelectionResult result =
            curved.select(duct.points, serial, Duct::slide);
        added = result.added;
        const Vectors s = curved.interpolant()(x);
        if (i > 0)
        {
            EXPECT_LT(
                largestDifference(s, there), i > 2 ? 1e-15 : result.tolerance);
        }
        there = s;

        Duct back(Vector3::Zero());
        curved.select(back.points, serial, Duct::slide);
        EXPECT_LT(
            largestDifference(
                curved.interpolant()(x), Vectors::Zero(x.rows(), 3)),
            1e-15);
    }
    EXPECT_EQ(added, 0);
}


TEST(Sliding, isTheSameOnEveryNumberOfRanks)
{
    const Duct whole(Vector3(0.1, 0.05, 0.2), 0.3);
    const Vectors x = positionRows(whole.points);
    Vectors expected;
    for (const int ranks : {1, 2, 3})
    {
        Vectors found;
        onRanks(
            ranks,
            [&](Communicator& communicator)
            {
                ControlPoints mine;
                for (std::size_t i = 0; i < whole.points.size(); ++i)
                {
                    if (int(i * i % ranks) == communicator.rank())
                    {
                        mine.push_back(whole.points[i]);
                    }
                }
                GreedySelection curved = selection(1e-4);
                curved.select(mine, communicator, Duct::slide);
                if (communicator.rank() == 0)
                {
                    found = curved.interpolant()(x);
                }
            });
        if (ranks == 1)
        {
            expected = found;
        }
        EXPECT_TRUE(found == expected);
    }
}


TEST(Sliding, valuesThatNeverSettleEndAndAreReported)
{
    // Every time it has got there, the surface is elsewhere
    Duct duct(Vector3(0.1, 0, 0));
    int sweep = 0;
    const auto run = [&](const Vectors&, ControlPoints& points)
    {
        ++sweep;
        for (ControlPoint& p : points)
        {
            if (p.slides())
            {
                p.value[0] = sweep % 2 ? 0.05 : -0.05;
            }
        }
    };
    SerialCommunicator serial;
    GreedySelection curved = selection(1e-3);
    const SelectionResult result = curved.select(duct.points, serial, run);
    EXPECT_FALSE(result.converged());
    EXPECT_GT(result.largestError, 0.05);
    EXPECT_GT(result.renewals, 1);
    EXPECT_LT(result.renewals, 100);
}


TEST(Sliding, pointsOnASphereFollowALargeTurn)
{
    // The cap of a sphere turns by 40 degrees, the opposite one is fixed
    ControlPoints points;
    Random random(11);
    const Eigen::AngleAxisd turn(0.7, Vector3::UnitX());
    for (int i = 0; i < 1500; ++i)
    {
        const Vector3 x = random.direction();
        points.push_back(
            x[2] > 0.9        ? ControlPoint::prescribed(x, turn * x - x)
                : x[2] < -0.9 ? ControlPoint::prescribed(x, Vector3::Zero())
                              : ControlPoint::sliding(x, {x}));
    }
    SerialCommunicator serial;
    GreedySelection curved = selection(1e-4);
    const SelectionResult result = curved.select(
        points, serial,
        [](const Vectors& s, ControlPoints& p)
        {
            for (std::size_t i = 0; i < p.size(); ++i)
            {
                if (p[i].slides())
                {
                    const Vector3 y = p[i].position + s.row(i).transpose();
                    TangentPlanes planes;
                    planes.add(y.normalized(), y.norm() - 1);
                    slideOnto(p[i], s.row(i).transpose(), planes);
                }
            }
        });
    EXPECT_TRUE(result.converged());
    const Vectors x = positionRows(points);
    const Vectors y = x + curved.interpolant()(x);
    EXPECT_LE(
        (y.rowwise().norm().array() - 1).abs().maxCoeff(),
        1.01 * result.tolerance);
}


namespace
{

// The rib of Mastrippolito et al. (2019), section 5, in a channel, and a line
// around it: corners are displaced, points between them slide on the flanks
struct Rib
{
    ControlPoints target;  // along the normals of the displaced flanks
    ControlPoints initial; // along those at rest, as if nothing moved

    void line(const std::vector<Vector3>& x, const std::vector<Vector3>& d)
    {
        const double distance = 0.0024;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            target.push_back(ControlPoint::prescribed(x[i], d[i]));
            if (i + 1 == x.size())
            {
                break;
            }
            const Vector3 before = x[i + 1] - x[i];
            const Vector3 after = before + d[i + 1] - d[i];
            const int n = int(before.norm() / distance);
            for (int k = 1; k < n; ++k)
            {
                const double t = double(k) / n;
                target.push_back(ControlPoint::sliding(
                    x[i] + t * before, {Vector3(-after[1], after[0], 0)},
                    (1 - t) * d[i] + t * d[i + 1]));
                initial.push_back(ControlPoint::sliding(
                    x[i] + t * before, {Vector3(-before[1], before[0], 0)}));
            }
        }
    }

    Rib()
    {
        const Vector3 o = Vector3::Zero();
        line(
            {{-0.9, 0, 0},
             {-0.435, 0, 0},
             {-0.305, 0.15, 0},
             {0.305, 0.15, 0},
             {0.435, 0, 0},
             {0.9, 0, 0},
             {0.9, 1, 0},
             {-0.9, 1, 0}},
            {o,
             {0.035, 0, 0},
             {0.07, 0.1, 0},
             {-0.07, 0.1, 0},
             {-0.035, 0, 0},
             o,
             o,
             o});
        line(
            {{-0.45326516, 0.04, 0},
             {-0.32326516, 0.19, 0},
             {0.32326516, 0.19, 0},
             {0.45326516, 0.04, 0}},
            {{0.03173854, 0, 0},
             {0.06673854, 0.1, 0},
             {-0.06673854, 0.1, 0},
             {-0.03173854, 0, 0}});
        for (const ControlPoint& p : target)
        {
            if (!p.slides())
            {
                initial.push_back(p);
            }
        }
    }
};

} // namespace


TEST(Sliding, normalsOfTheDisplacedFlanksOfARibTakeFewerPoints)
{
    SelectionSettings settings;
    settings.tolerance = 1e-5;
    const Kernel kernel(KernelType::wendlandC2, 0.488262);
    const Rib rib;
    SerialCommunicator serial;
    GreedySelection target(kernel, Polynomial::none, settings);
    GreedySelection initial(kernel, Polynomial::none, settings);
    const SelectionResult few = target.select(rib.target, serial);
    const SelectionResult many = initial.select(rib.initial, serial);
    std::printf(
        "rib, %ld points: %ld along the normals of the displaced flanks, %ld "
        "along those at rest\n",
        few.candidates, few.selected, many.selected);
    EXPECT_TRUE(few.converged());
    EXPECT_LT(2 * few.selected, many.selected);
}
