// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A selection that is made again from the positions of its points.

#include "test_support.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

using namespace test;

namespace
{

bool sameBits(const Columns& a, const Columns& b)
{
    return a.rows() == b.rows() && (a.array() == b.array()).all();
}


ControlPoints displaced(ControlPoints points, double frequency)
{
    for (ControlPoint& p : points)
    {
        const Vector3& x = p.position;
        const Vector3 s(
            std::sin(frequency * x.x() + x.y()),
            std::cos(3 * x.z() - 2 * x.x()),
            std::sin(frequency * x.x() * x.y()));
        p.value.head(p.k) = p.directions.leftCols(p.k).transpose() * s;
    }
    return points;
}


// Of all kinds, enough for several blocks
ControlPoints mixedPoints()
{
    Random random(91);
    return randomControlPoints(random, {3, 420, 160, 40});
}


SelectionSettings settingsOf(double tolerance)
{
    SelectionSettings settings;
    settings.tolerance = tolerance;
    return settings;
}


const Kernel kernel(KernelType::wendlandC2, 0.8);


// Of the same points, which may be in another order
double largestWeightDifference(const RbfInterpolant& a, const RbfInterpolant& b)
{
    double largest = 0;
    for (Index i = 0; i < a.centres().rows(); ++i)
    {
        double difference = std::numeric_limits<double>::infinity();
        for (Index j = 0; j < b.centres().rows(); ++j)
        {
            if (a.centres().row(i) == b.centres().row(j))
            {
                difference = (a.weights().row(i) - b.weights().row(j)).norm();
            }
        }
        largest = std::max(largest, difference);
    }
    return largest;
}

} // namespace


TEST(Restore, givesTheSameSystemToTheLastBitAsANewOneGets)
{
    const ControlPoints points = mixedPoints();
    SerialCommunicator alone;
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        // Grown by several displacements, as in a run
        GreedySelection running(kernel, polynomial, settingsOf(6e-3));
        for (const double frequency : {2.0, 5.0, 3.0})
        {
            running.select(displaced(points, frequency), alone);
        }
        const std::vector<Vector3> positions = running.selectedPositions();
        ASSERT_GT(positions.size(), 256u);
        const Columns grown = running.interpolant().weights();

        GreedySelection restarted(kernel, polynomial, settingsOf(6e-3));
        for (GreedySelection* selection : {&running, &restarted})
        {
            selection->restore(positions, displaced(points, 3), alone);
        }
        EXPECT_TRUE(sameBits(
            running.interpolant().weights(),
            restarted.interpolant().weights()));

        // What is the same stays so, also where points are added
        for (const double frequency : {3.0, 9.0, 5.0})
        {
            const ControlPoints next = displaced(points, frequency);
            const Index added = running.select(next, alone).added;
            EXPECT_EQ(restarted.select(next, alone).added, added);
            EXPECT_EQ(added > 0, frequency == 9) << added;
            EXPECT_EQ(
                running.selectedPositions(), restarted.selectedPositions());
            EXPECT_TRUE(sameBits(
                running.interpolant().centres(),
                restarted.interpolant().centres()));
            EXPECT_TRUE(sameBits(
                running.interpolant().weights(),
                restarted.interpolant().weights()));
        }
    }
}


TEST(Restore, changesTheSolutionByRoundOffAlone)
{
    const ControlPoints candidates = displaced(mixedPoints(), 4);
    SerialCommunicator alone;
    for (const auto& algorithm : algorithmNames())
    {
        SelectionSettings settings = settingsOf(5e-2);
        settings.algorithm = algorithm.first;
        settings.maxPoints = 60;
        GreedySelection selection(kernel, Polynomial::none, settings);
        selection.select(candidates, alone);
        const RbfInterpolant former = selection.interpolant();
        std::vector<Vector3> positions = selection.selectedPositions();
        ASSERT_EQ(positions.size(), 60u) << algorithm.second;

        selection.restore(positions, candidates, alone);
        EXPECT_TRUE(within(
            "weights after restore",
            largestWeightDifference(former, selection.interpolant())
                / former.weights().rowwise().norm().maxCoeff(),
            1e-12))
            << algorithm.second;

        // Prescribed points first; then nothing changes any more
        positions = selection.selectedPositions();
        const Columns weights = selection.interpolant().weights();
        selection.restore(positions, candidates, alone);
        EXPECT_EQ(selection.selectedPositions(), positions);
        EXPECT_TRUE(sameBits(selection.interpolant().weights(), weights));
    }
}


TEST(Restore, leavesOutOnlyThePointsThatMakeTheSystemSingular)
{
    // Two in a hundred nearly coincide
    Random random(92);
    ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 60, 40, 0}), 4);
    for (const Index i : {10, 80})
    {
        ControlPoint p = candidates[i];
        p.position += 1e-12 * Vector3(1, 1, 1);
        candidates.push_back(p);
    }
    std::vector<Vector3> positions;
    for (const ControlPoint& p : candidates)
    {
        positions.push_back(p.position);
    }

    SerialCommunicator alone;
    GreedySelection selection(kernel, Polynomial::none, settingsOf(1e-2));
    selection.restore(positions, candidates, alone);
    const Index n = selection.selectedPositions().size();
    EXPECT_GE(n, 100);
    EXPECT_LE(n, 102);
    EXPECT_EQ(Index(selection.selected().size()), n);
    EXPECT_TRUE(selection.interpolant().weights().allFinite());
}


TEST(Restore, everyRankRefusesAPositionWithoutCandidate)
{
    const ControlPoints candidates = displaced(mixedPoints(), 4);
    std::vector<Vector3> positions{candidates[3].position};
    positions.push_back(candidates[5].position);
    positions.back().x() = std::nextafter(positions.back().x(), 2.0);
    std::atomic<int> refused(0);
    onRanks(
        3,
        [&](Communicator& communicator)
        {
            GreedySelection selection(
                kernel, Polynomial::none, settingsOf(1e-2));
            const ControlPoints mine =
                communicator.rank() == 1 ? candidates : ControlPoints();
            try
            {
                selection.restore(positions, mine, communicator);
            }
            catch (const std::invalid_argument& wrong)
            {
                const std::string message = wrong.what();
                EXPECT_NE(message.find("no control point at"), message.npos);
                ++refused;
            }
        });
    EXPECT_EQ(refused, 3);
}
