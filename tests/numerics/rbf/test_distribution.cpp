// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The same selection, to the last bit, however the candidates are distributed.

#include "test_support.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

using namespace test;

namespace
{

// For each candidate the rank that has it
using Deal = std::vector<int>;


struct NamedDeal
{
    std::string name;
    int ranks;
    Deal deal;
};


std::vector<NamedDeal> deals(const ControlPoints& candidates)
{
    const Index n = candidates.size();
    std::vector<NamedDeal> all;
    for (const int ranks : {1, 2, 3, 5})
    {
        Random random(81);
        Deal inTurn, atRandom, byPlace, firstIsEmpty, oneHasAll;
        for (Index i = 0; i < n; ++i)
        {
            const double x = candidates[i].position.x();
            inTurn.push_back(i % ranks);
            atRandom.push_back(random.below(ranks));
            byPlace.push_back(std::min(ranks - 1, std::max(0, int(x * ranks))));
            firstIsEmpty.push_back(ranks > 1 ? 1 + i % (ranks - 1) : 0);
            oneHasAll.push_back(ranks - 1);
        }
        const std::string name = std::to_string(ranks) + " ranks, ";
        all.push_back({name + "in turn", ranks, inTurn});
        all.push_back({name + "at random", ranks, atRandom});
        all.push_back({name + "by place", ranks, byPlace});
        all.push_back({name + "the first empty", ranks, firstIsEmpty});
        all.push_back({name + "the last has all", ranks, oneHasAll});
    }
    return all;
}


// What a rank knows in the end
struct Outcome
{
    Columns centres;
    Columns weights;
    SelectionResult result;
    std::vector<Vector3> selected;
};


// The outcomes of all ranks after selections for each of the displacements,
// which are those of the same candidates
std::vector<Outcome> outcomes(
    const Kernel& kernel, Polynomial polynomial,
    const SelectionSettings& settings,
    const std::vector<ControlPoints>& displacements, const NamedDeal& deal)
{
    std::vector<Outcome> all(deal.ranks);
    onRanks(
        deal.ranks,
        [&](Communicator& communicator)
        {
            // Each rank has its candidates in an order of its own
            std::vector<Index> mine;
            for (const Index i :
                 Random(82 + communicator.rank()).permutation(deal.deal.size()))
            {
                if (deal.deal[i] == communicator.rank())
                {
                    mine.push_back(i);
                }
            }

            GreedySelection selection(kernel, polynomial, settings);
            Outcome& outcome = all[communicator.rank()];
            ControlPoints points;
            for (const ControlPoints& candidates : displacements)
            {
                points.clear();
                for (const Index i : mine)
                {
                    points.push_back(candidates[i]);
                }
                outcome.result = selection.select(points, communicator);
            }
            outcome.centres = selection.interpolant().centres();
            outcome.weights = selection.interpolant().weights();
            for (const Index i : selection.selected())
            {
                outcome.selected.push_back(points.at(i).position);
            }
        });
    return all;
}


bool sameBits(const Columns& a, const Columns& b)
{
    return a.rows() == b.rows() && (a.array() == b.array()).all();
}


void expectTheSameOnAnyRanks(
    const Kernel& kernel, Polynomial polynomial,
    const SelectionSettings& settings,
    const std::vector<ControlPoints>& displacements)
{
    const std::vector<NamedDeal> all = deals(displacements[0]);
    const Outcome serial =
        outcomes(kernel, polynomial, settings, displacements, all[0])[0];
    EXPECT_GT(serial.centres.rows(), 4);

    for (const NamedDeal& deal : all)
    {
        SCOPED_TRACE(nameOf(kernel.type()) + ", " + deal.name);
        std::vector<Vector3> selected;
        for (const Outcome& outcome :
             outcomes(kernel, polynomial, settings, displacements, deal))
        {
            EXPECT_TRUE(sameBits(outcome.centres, serial.centres));
            EXPECT_TRUE(sameBits(outcome.weights, serial.weights));
            const SelectionResult& r = outcome.result;
            const SelectionResult& s = serial.result;
            EXPECT_EQ(r.candidates, s.candidates);
            EXPECT_EQ(r.selected, s.selected);
            EXPECT_EQ(r.rejected, s.rejected);
            EXPECT_EQ(r.added, s.added);
            EXPECT_EQ(r.sweeps, s.sweeps);
            EXPECT_EQ(r.largestError, s.largestError);
            EXPECT_EQ(r.largestDisplacement, s.largestDisplacement);
            EXPECT_EQ(r.tolerance, s.tolerance);
            EXPECT_EQ(r.roundOff, s.roundOff);
            selected.insert(
                selected.end(), outcome.selected.begin(),
                outcome.selected.end());
        }

        // Each selected point is one rank's
        std::vector<Vector3> centres;
        for (Index j = 0; j < serial.centres.rows(); ++j)
        {
            centres.push_back(serial.centres.row(j).transpose());
        }
        std::sort(selected.begin(), selected.end(), before);
        std::sort(centres.begin(), centres.end(), before);
        EXPECT_EQ(selected, centres);
    }
}


SelectionSettings settingsOf(double tolerance, Index pointsPerSweep = 0)
{
    SelectionSettings settings;
    settings.tolerance = tolerance;
    settings.pointsPerSweep = pointsPerSweep;
    return settings;
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

} // namespace


TEST(Distribution, ofMovingPointsDoesNotMatter)
{
    Random random(83);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 400, 0, 0}), 4);
    for (const KernelType type : {KernelType::wendlandC2, KernelType::gaussian})
    {
        expectTheSameOnAnyRanks(
            Kernel(type, moderateRadius(type)), Polynomial::none,
            settingsOf(5e-2), {candidates});
    }
}


TEST(Distribution, ofMovingAndSlidingPointsDoesNotMatter)
{
    Random random(84);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 200, 120, 40}), 4);
    for (const Index pointsPerSweep : {0, 1, 10})
    {
        expectTheSameOnAnyRanks(
            Kernel(KernelType::wendlandC2, 0.8), Polynomial::none,
            settingsOf(5e-2, pointsPerSweep), {candidates});
    }
}


TEST(Distribution, withAPolynomialDoesNotMatter)
{
    Random random(85);
    for (const int dimension : {2, 3})
    {
        const ControlPoints candidates =
            displaced(randomControlPoints(random, {dimension, 150, 80, 20}), 4);
        for (const KernelType type :
             {KernelType::wendlandC4, KernelType::multiQuadric,
              KernelType::thinPlate})
        {
            expectTheSameOnAnyRanks(
                Kernel(type, moderateRadius(type)), Polynomial::linear,
                settingsOf(5e-2), {candidates});
        }
    }
}


TEST(Distribution, ofAllPointsDoesNotMatter)
{
    Random random(86);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 200, 120, 40}), 4);
    SelectionSettings settings;
    settings.all = true;
    expectTheSameOnAnyRanks(
        Kernel(KernelType::wendlandC2, 0.5), Polynomial::none, settings,
        {candidates});
}


TEST(Distribution, doesNotMatterWhenOtherDisplacementsFollow)
{
    Random random(87);
    const ControlPoints points = randomControlPoints(random, {3, 150, 80, 30});
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        expectTheSameOnAnyRanks(
            Kernel(KernelType::wendlandC2, 0.8), polynomial, settingsOf(5e-2),
            {displaced(points, 2), displaced(points, 5), displaced(points, 1)});
    }
}


TEST(Distribution, ofManyPointsOfWhichASampleIsSweptDoesNotMatter)
{
    const ControlPoints points = manyControlPoints();
    expectTheSameOnAnyRanks(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settingsOf(2e-2),
        {displaced(points, 2), displaced(points, 5)});
}


TEST(Distribution, doesNotMatterWhereErrorsTieExactly)
{
    ControlPoints candidates;
    for (int i = 0; i <= 12; ++i)
    {
        for (int j = 0; j <= 12; ++j)
        {
            candidates.push_back(ControlPoint::prescribed(
                Vector3(i, j, 0) / 12, Vector3(i % 2, j % 2, (i + j) % 2)));
        }
    }
    for (const Index pointsPerSweep : {0, 1})
    {
        expectTheSameOnAnyRanks(
            Kernel(KernelType::wendlandC2, 0.5), Polynomial::none,
            settingsOf(1e-2, pointsPerSweep), {candidates});
    }
}


TEST(Distribution, doesNotMatterWherePointsAreRejected)
{
    Random random(88);
    ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 60, 30, 0}), 4);
    for (Index i = 0; i < 90; ++i)
    {
        ControlPoint p = candidates[i];
        p.position += 1e-10 * random.direction();
        p.value *= 0.9;
        candidates.push_back(p);
    }
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        expectTheSameOnAnyRanks(
            Kernel(KernelType::wendlandC2, 0.8), polynomial, settingsOf(1e-3),
            {candidates});
    }
}


TEST(Distribution, doesNotMatterWhereASelectionIsRestored)
{
    Random random(93);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 200, 120, 40}), 4);
    std::vector<Vector3> positions;
    for (std::size_t i = 0; i < candidates.size(); i += 2)
    {
        positions.push_back(candidates[i].position);
    }
    const Kernel kernel(KernelType::wendlandC2, 0.5);
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        Columns serial(0, 3);
        std::vector<Vector3> order;
        for (const NamedDeal& deal : deals(candidates))
        {
            std::vector<Columns> weights(deal.ranks);
            std::vector<std::vector<Vector3>> orders(deal.ranks);
            onRanks(
                deal.ranks,
                [&](Communicator& communicator)
                {
                    const int rank = communicator.rank();
                    ControlPoints mine;
                    for (std::size_t i = 0; i < candidates.size(); ++i)
                    {
                        if (deal.deal[i] == rank)
                        {
                            mine.push_back(candidates[i]);
                        }
                    }
                    GreedySelection selection(
                        kernel, polynomial, settingsOf(1e-2));
                    selection.restore(positions, mine, communicator);
                    weights[rank] = selection.interpolant().weights();
                    orders[rank] = selection.selectedPositions();
                });
            if (serial.rows() == 0)
            {
                serial = weights[0];
                order = orders[0];
                EXPECT_GE(order.size(), positions.size());
            }
            for (int rank = 0; rank < deal.ranks; ++rank)
            {
                SCOPED_TRACE(deal.name);
                EXPECT_TRUE(sameBits(weights[rank], serial));
                EXPECT_EQ(orders[rank], order);
            }
        }
    }
}


TEST(Distribution, everyRankRefusesWhatOneWouldRefuse)
{
    // Moving points on one rank, sliding ones on the other
    Random random(89);
    const ControlPoints sliding = randomControlPoints(random, {3, 0, 20, 0});
    for (const bool coplanar : {true, false})
    {
        const ControlPoints moving =
            randomControlPoints(random, {2, coplanar ? 15 : 0, 0, 0});
        std::atomic<int> refused(0);
        onRanks(
            3,
            [&](Communicator& communicator)
            {
                GreedySelection selection(
                    Kernel(KernelType::thinPlate, 1), Polynomial::linear,
                    settingsOf(1e-3));
                const ControlPoints mine = communicator.rank() == 0 ? moving
                    : communicator.rank() == 1                      ? sliding
                                               : ControlPoints();
                try
                {
                    selection.select(mine, communicator);
                }
                catch (const std::invalid_argument&)
                {
                    ++refused;
                }
            });
        EXPECT_EQ(refused, 3);
    }
}


TEST(Distribution, everyRankDoesTheSameCollectiveOperations)
{
    Random random(90);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 300, 100, 0}), 4);
    std::vector<long> operations(4, 0);
    Index sweeps = 0;
    onRanks(
        4,
        [&](Communicator& communicator)
        {
            ControlPoints mine;
            for (std::size_t i = 0; i < candidates.size(); ++i)
            {
                // The last rank has none
                if (int(i % 3) == communicator.rank())
                {
                    mine.push_back(candidates[i]);
                }
            }
            GreedySelection selection(
                Kernel(KernelType::wendlandC2, 0.8), Polynomial::linear,
                settingsOf(1e-2));
            const SelectionResult r = selection.select(mine, communicator);
            operations[communicator.rank()] = communicator.operations();
            if (communicator.rank() == 0)
            {
                sweeps = r.sweeps;
            }
        });
    for (const long n : operations)
    {
        EXPECT_EQ(n, operations[0]);
    }

    // The worst, a histogram and the list of each sweep, some lists in two
    // parts, and a few at the beginning and the end
    EXPECT_LE(operations[0], 3.5 * sweeps + 10);
}


TEST(Distribution, allRanksTogetherSendHardlyMoreThanTheList)
{
    Random random(94);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 1500, 500, 0}), 4);
    std::vector<double> total;
    Index sweeps = 0;
    for (const int ranks : {1, 5})
    {
        std::vector<double> bytes(ranks);
        onRanks(
            ranks,
            [&](Communicator& communicator)
            {
                const int rank = communicator.rank();
                ControlPoints mine;
                for (std::size_t i = rank; i < candidates.size(); i += ranks)
                {
                    mine.push_back(candidates[i]);
                }
                GreedySelection selection(
                    Kernel(KernelType::wendlandC2, 0.8), Polynomial::none,
                    settingsOf(2e-3));
                const SelectionResult r = selection.select(mine, communicator);
                bytes[rank] = communicator.bytes();
                if (rank == 0)
                {
                    sweeps = r.sweeps;
                }
            });
        total.push_back(std::accumulate(bytes.begin(), bytes.end(), 0.0));
    }

    // Beside the lists each rank sends a histogram of 64 numbers and the worst
    // candidate it has, 22 numbers, in each sweep. Dealt in turn, ranks share
    // the cells from which the list takes one candidate each: hence more than
    // one list. Were all to send a whole one, it would be five
    EXPECT_TRUE(within(
        "what five ranks send of lists, of what one does",
        (total[1] - 8 * 5 * 86 * (sweeps + 1)) / (total[0] - 8 * 86 * sweeps),
        2));
}
