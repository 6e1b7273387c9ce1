// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A motion in several steps.
//
// Sources of truth: where the conditions of the whole motion say that points
// end; order on a line, which one step loses and many do not.

#include "subStep.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace morph;

namespace
{

SubStepSettings settings(const double radius)
{
    SelectionSettings selection;
    selection.all = true;
    return {
        Kernel(KernelType::wendlandC2, radius), Polynomial::none, selection, 0,
        0};
}


// Displacements of control points and of other points after n steps
struct Motion
{
    ControlPoints conditions;
    Vectors positions;
    Vectors reached;
    Vectors moved;

    Motion(const ControlPoints& c, const Vectors& x)
    : conditions(c),
      positions(x),
      reached(Vectors::Zero(Index(c.size()), 3)),
      moved(Vectors::Zero(x.rows(), 3))
    {
    }

    void
    run(const SubStepSettings& how, const int n,
        const GreedySelection::Renewal& renewal = GreedySelection::Renewal())
    {
        SerialCommunicator communicator;
        const Index nc = Index(conditions.size());
        for (int step = 0; step < n; ++step)
        {
            Vectors x(nc + positions.rows(), 3);
            for (Index i = 0; i < nc; ++i)
            {
                x.row(i) = conditions[i].position.transpose() + reached.row(i);
            }
            x.bottomRows(positions.rows()) = positions + moved;
            SelectionResult result;
            const SubStep made = subStep(
                how, conditions, reached, n - step, renewal, x, communicator);
            result = made.result;
            const Vectors& s = made.displacements;
            reached += s.topRows(nc);
            moved += s.bottomRows(positions.rows());
        }
    }
};


// A body at 0.5, between walls at 0 and 1 of a line
Motion squeeze(const double distance)
{
    ControlPoints c;
    c.push_back(ControlPoint::prescribed({0, 0, 0}, {0, 0, 0}));
    c.push_back(ControlPoint::prescribed({1, 0, 0}, {0, 0, 0}));
    c.push_back(ControlPoint::prescribed({0.5, 0, 0}, {distance, 0, 0}));
    Vectors x = Vectors::Zero(99, 3);
    for (Index i = 0; i < 99; ++i)
    {
        x(i, 0) = 0.01 * double(i + 1);
    }
    return Motion(c, x);
}


bool inOrder(const Motion& motion)
{
    for (Index i = 1; i < motion.positions.rows(); ++i)
    {
        if (motion.positions(i, 0) + motion.moved(i, 0)
            <= motion.positions(i - 1, 0) + motion.moved(i - 1, 0))
        {
            return false;
        }
    }
    return true;
}

} // namespace


TEST(SubStep, anyNumberOfStepsEndsAtWhatIsPrescribed)
{
    for (const int n : {1, 2, 3, 7, 32})
    {
        Motion motion = squeeze(0.3);
        motion.run(settings(1), n);
        EXPECT_NEAR(motion.reached(0, 0), 0, 1e-14);
        EXPECT_NEAR(motion.reached(1, 0), 0, 1e-14);
        EXPECT_NEAR(motion.reached(2, 0), 0.3, 1e-14);
    }
}


TEST(SubStep, oneStepIsTheMotionAsAWhole)
{
    Motion motion = squeeze(0.2);
    motion.run(settings(1), 1);

    SerialCommunicator communicator;
    GreedySelection selection(
        settings(1).kernel, Polynomial::none, settings(1).selection);
    selection.select(motion.conditions, communicator);
    const Vectors s = selection.interpolant()(motion.positions);
    EXPECT_LT((s - motion.moved).cwiseAbs().maxCoeff(), 1e-15);
}


TEST(SubStep, manyStepsKeepTheOrderThatOneLoses)
{
    Motion one = squeeze(0.4);
    one.run(settings(1), 1);
    EXPECT_FALSE(inOrder(one));

    Motion many = squeeze(0.4);
    many.run(settings(1), 16);
    EXPECT_TRUE(inOrder(many));
}


TEST(SubStep, slidingPointsStayOnTheirPlaneAndFollowAMovingOne)
{
    for (const double rise : {0.0, 0.25})
    {
        ControlPoints c;
        c.push_back(ControlPoint::prescribed({0, 1, 0}, {0.5, 0, 0}));
        c.push_back(
            ControlPoint::sliding({0.1, 0, 0}, {{0, 1, 0}}, {0, rise, 0}));
        Motion motion(c, Vectors::Zero(1, 3));
        motion.run(settings(2), 5);
        EXPECT_NEAR(motion.reached(1, 1), rise, 1e-14);
        EXPECT_GT(motion.reached(1, 0), 0.05);
    }
}


// On a circle: the condition follows from where the point has got to
TEST(SubStep, conditionsThatFollowThePointAreMetAtTheEnd)
{
    ControlPoints c;
    c.push_back(ControlPoint::prescribed({0, 0.5, 0}, {0.4, 0, 0}));
    c.push_back(ControlPoint::sliding({0, 1, 0}, {{0, 1, 0}}));
    const auto ontoCircle = [](const Vectors& s, ControlPoints& points)
    {
        const double x = s(1, 0), y = 1 + s(1, 1);
        points[1].value[0] = s(1, 1) - (std::hypot(x, y) - 1);
    };
    SubStepSettings how = settings(3);
    how.selection.tolerance = 1e-10;
    Motion motion(c, Vectors::Zero(1, 3));
    motion.run(how, 6, ontoCircle);
    EXPECT_GT(motion.reached(1, 0), 0.01);
    EXPECT_NEAR(
        std::hypot(motion.reached(1, 0), 1 + motion.reached(1, 1)), 1, 1e-9);
}
