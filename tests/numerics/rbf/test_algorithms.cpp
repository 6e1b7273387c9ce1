// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The reference algorithms of greedy selection, beside the independent one of
// test_support and beside each other.

#include "memory.hpp"
#include "test_support.hpp"
#include "vectorMath.hpp"

#include <algorithm>
#include <cmath>

using namespace test;

namespace
{

struct Outcome
{
    SelectionResult result;
    std::vector<Index> selected;
    RbfInterpolant s;
};


Outcome outcomeOf(
    Algorithm algorithm, const ControlPoints& candidates,
    double restartFraction = 0.1)
{
    SelectionSettings settings;
    settings.algorithm = algorithm;
    settings.tolerance = 5e-2;
    settings.pointsPerSweep = 1;
    settings.restartFraction = restartFraction;
    GreedySelection selection(
        Kernel(KernelType::wendlandC2, 1.0), Polynomial::none, settings);
    SerialCommunicator communicator;
    const SelectionResult result = selection.select(candidates, communicator);
    return {result, selection.selected(), selection.interpolant()};
}


ControlPoints mixture(unsigned seed)
{
    Random random(seed);
    return randomControlPoints(random, {3, 80, 40, 20});
}

} // namespace


TEST(Algorithms, selectTheSamePointsOneByOne)
{
    // Source of truth: the standard algorithm written independently
    for (const unsigned seed : {1u, 2u, 3u})
    {
        const ControlPoints candidates = mixture(seed);
        std::vector<Index> expected = reference::greedy(
            KernelType::wendlandC2, 1.0, candidates,
            5e-2 * largestDisplacement(candidates));
        std::sort(expected.begin(), expected.end());
        EXPECT_GT(expected.size(), 30u);
        for (const Algorithm a :
             {Algorithm::standard, Algorithm::schur, Algorithm::incremental})
        {
            EXPECT_EQ(outcomeOf(a, candidates).selected, expected);
        }
    }
}


TEST(Algorithms, giveTheSameField)
{
    const ControlPoints candidates = mixture(4);
    const Vectors x = positionRows(mixture(5));
    const Vectors expected = outcomeOf(Algorithm::incremental, candidates).s(x);
    for (const Algorithm a : {Algorithm::standard, Algorithm::schur})
    {
        const Vectors found = outcomeOf(a, candidates).s(x);
        EXPECT_TRUE(within(
            "field of the reference algorithms",
            largestDifference(found, expected)
                / largestDisplacement(candidates),
            1e-10));
    }
}


TEST(Algorithms, schurIsIndependentOfItsRestarts)
{
    const ControlPoints candidates = mixture(6);
    const std::vector<Index> expected =
        outcomeOf(Algorithm::schur, candidates, 0.01).selected;
    for (const double fraction : {0.1, 0.3, 0.6, 100.0})
    {
        EXPECT_EQ(
            outcomeOf(Algorithm::schur, candidates, fraction).selected,
            expected);
    }
}


TEST(Algorithms, referencesFollowANewDisplacement)
{
    ControlPoints candidates = mixture(7);
    for (const Algorithm a : {Algorithm::standard, Algorithm::schur})
    {
        SelectionSettings settings;
        settings.algorithm = a;
        settings.tolerance = 5e-2;
        GreedySelection selection(
            Kernel(KernelType::wendlandC2, 1.0), Polynomial::none, settings);
        SerialCommunicator communicator;
        selection.select(candidates, communicator);
        const Vectors before =
            selection.interpolant()(positionRows(candidates));
        for (ControlPoint& p : candidates)
        {
            p.value *= -2;
        }
        const SelectionResult again =
            selection.select(candidates, communicator);
        const Vectors after = selection.interpolant()(positionRows(candidates));
        EXPECT_EQ(again.added, 0);
        EXPECT_LT((after + 2 * before).cwiseAbs().maxCoeff(), 1e-11);
    }
}


TEST(Algorithms, referencesLeaveOutCoincidentPoints)
{
    ControlPoints candidates = mixture(8);
    ControlPoint twin = candidates[0];
    twin.value += Vector3(0.5, 0, 0);
    candidates.push_back(twin);
    for (const Algorithm a : {Algorithm::standard, Algorithm::schur})
    {
        const Outcome outcome = outcomeOf(a, candidates);
        EXPECT_EQ(outcome.result.rejected, 1);
        EXPECT_GT(outcome.result.largestError, 0.4);
        EXPECT_FALSE(outcome.result.converged());
    }
}


TEST(Algorithms, referencesRefuseWhatTheyDoNotKnow)
{
    SelectionSettings settings;
    settings.algorithm = Algorithm::schur;
    const Kernel kernel(KernelType::wendlandC2, 1);
    EXPECT_THROW(
        GreedySelection(kernel, Polynomial::linear, settings),
        std::invalid_argument);
    settings.all = true;
    EXPECT_THROW(
        GreedySelection(kernel, Polynomial::none, settings),
        std::invalid_argument);
}


TEST(Algorithms, schurIsRefusedWhereItsMatrixDoesNotFit)
{
    // 8 N^2 bytes: so many points that they need twice what there is
    const Index n = Index(std::sqrt(2 * availableMemory() / 8));
    ControlPoints candidates(
        n, ControlPoint::prescribed(Vector3(0, 0, 0), Vector3(1, 0, 0)));
    SelectionSettings settings;
    settings.algorithm = Algorithm::schur;
    GreedySelection selection(
        Kernel(KernelType::wendlandC2, 1), Polynomial::none, settings);
    SerialCommunicator communicator;
    try
    {
        selection.select(candidates, communicator);
        FAIL() << "not refused";
    }
    catch (const std::runtime_error& refused)
    {
        const std::string message = refused.what();
        EXPECT_NE(message.find("GB"), std::string::npos) << message;
        EXPECT_NE(message.find("schur"), std::string::npos) << message;
    }
}


TEST(Algorithms, refuseDisplacementsThatAreNotFinite)
{
    for (const double bad :
         {std::nan(""), std::numeric_limits<double>::infinity()})
    {
        ControlPoints candidates = mixture(9);
        candidates[17].value[0] = bad;
        EXPECT_THROW(
            outcomeOf(Algorithm::incremental, candidates),
            std::invalid_argument);
    }
}


TEST(VectorMath, agreesWithTheCLibrary)
{
    // Source of truth: expl and logl in long double
    Random random(90);
    double worstExponential = 0;
    double worstLogarithm = 0;
    for (int i = 0; i < 200000; ++i)
    {
        const double x = -std::exp(random.uniform(-30, 6.5));
        const long double e = expl(x);
        worstExponential = std::max(
            worstExponential,
            double(fabsl((vectorMath::exponential(x) - e) / e)));
        const double y = std::exp(random.uniform(-700, 700));
        const long double l = logl(y);
        worstLogarithm = std::max(
            worstLogarithm,
            double(
                fabsl(vectorMath::logarithm(y) - l)
                / std::max(1.0L, fabsl(l))));
    }
    EXPECT_TRUE(within("exponential", worstExponential, 5e-16));
    EXPECT_TRUE(within("logarithm", worstLogarithm, 5e-16));
    EXPECT_EQ(vectorMath::exponential(0), 1);
    EXPECT_EQ(vectorMath::exponential(-1e300), 0);
    EXPECT_EQ(vectorMath::logarithm(1), 0);
}
