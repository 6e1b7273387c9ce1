// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Greedy selection on one rank: what is selected, and whether the errors
// reported are those there are.

#include "test_support.hpp"

#include <algorithm>
#include <cmath>

using namespace test;

namespace
{

// A smooth displacement
Vector3 wave(const Vector3& x)
{
    return {
        0.1 * std::sin(4 * x.x() + x.y()),
        0.05 * std::cos(3 * x.y() - 2 * x.x()),
        0.08 * std::sin(5 * x.x() * x.y() + 2 * x.z())};
}


// Another one, by which nothing changes further than 0.2 from its centre
Vector3 waveAndBump(const Vector3& x)
{
    const double d = (x - Vector3(0.7, 0.3, 0.3)).norm() / 0.2;
    const double bump = d < 1 ? std::pow(1 - d * d, 3) : 0;
    return wave(x) + bump * Vector3(0.02, -0.03, 0.01);
}


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


ControlPoints scaled(ControlPoints points, double factor)
{
    for (ControlPoint& p : points)
    {
        p.value *= factor;
    }
    return points;
}


// Prescribed points on the surface of the unit box
ControlPoints box(Random& random, Index n)
{
    ControlPoints points;
    for (Vector3 x : random.pointsApart(n, 3, 0))
    {
        const Index side = random.below(6);
        x[side / 2] = side % 2;
        points.push_back(ControlPoint::prescribed(x, wave(x)));
    }
    return points;
}


SelectionSettings settingsOf(double tolerance, Index pointsPerSweep = 0)
{
    SelectionSettings settings;
    settings.tolerance = tolerance;
    settings.pointsPerSweep = pointsPerSweep;
    return settings;
}


// A selection and its outcome on one rank
struct Selected
{
    GreedySelection selection;
    SelectionResult result;

    Selected(
        const Kernel& kernel, Polynomial polynomial,
        const SelectionSettings& settings, const ControlPoints& candidates)
    : selection(kernel, polynomial, settings)
    {
        again(candidates);
    }

    void again(const ControlPoints& candidates)
    {
        SerialCommunicator alone;
        result = selection.select(candidates, alone);
    }

    const RbfInterpolant& s() const { return selection.interpolant(); }
};


// The largest error of the candidates from a sum of our own (with a polynomial,
// which it has not, from the interpolant's)
double trueError(
    const Selected& selected, const ControlPoints& candidates,
    Polynomial polynomial = Polynomial::none)
{
    const Vectors x = positionRows(candidates);
    const Vectors s = polynomial == Polynomial::none
        ? reference::plainSum(selected.s())(x)
        : selected.s()(x);
    const std::vector<double> e = reference::errors(candidates, s);
    return e.empty() ? 0 : *std::max_element(e.begin(), e.end());
}


void expectHonest(
    const Selected& selected, const ControlPoints& candidates,
    Polynomial polynomial = Polynomial::none)
{
    // To within the round-off of the sum
    const SelectionResult& r = selected.result;
    const double difference =
        std::abs(r.largestError - trueError(selected, candidates, polynomial));
    EXPECT_TRUE(within(
        "reported against recomputed largest error, in round-off",
        difference / std::max(r.roundOff, 1e-300), 3));
    EXPECT_EQ(r.candidates, Index(candidates.size()));
    EXPECT_EQ(r.largestDisplacement, largestDisplacement(candidates));
    EXPECT_EQ(r.selected, Index(selected.selection.selected().size()));
    EXPECT_EQ(r.selected, selected.s().centres().rows());
    EXPECT_EQ(r.converged(), r.largestError <= r.keep * r.tolerance);
}


bool sameBits(const Columns& a, const Columns& b)
{
    return a.rows() == b.rows() && (a.array() == b.array()).all();
}


// (0, 1/n ... 1)^dimension
ControlPoints
grid(int n, int dimension, const std::function<Vector3(const Vector3&)>& s)
{
    ControlPoints points;
    for (int i = 0; i <= n; ++i)
    {
        for (int j = 0; j <= n; ++j)
        {
            for (int k = 0; k <= (dimension == 3 ? n : 0); ++k)
            {
                const Vector3 x = Vector3(i, j, k) / n;
                points.push_back(ControlPoint::prescribed(x, s(x)));
            }
        }
    }
    return points;
}

} // namespace


TEST(Greedy, stopsWhereNoCandidatesErrorExceedsTheTolerance)
{
    for (const KernelType type : allKernels())
    {
        for (const int dimension : {2, 3})
        {
            for (const Index pointsPerSweep : {0, 1, 7})
            {
                for (const Polynomial polynomial :
                     {Polynomial::none, Polynomial::linear})
                {
                    const Kernel kernel(type, moderateRadius(type));
                    if (kernel.order() > 0 && polynomial == Polynomial::none)
                    {
                        continue;
                    }
                    Random random(61);
                    const ControlPoints candidates = displaced(
                        randomControlPoints(random, {dimension, 120, 60, 20}),
                        wave);
                    const Selected selected(
                        kernel, polynomial, settingsOf(2e-2, pointsPerSweep),
                        candidates);
                    SCOPED_TRACE(
                        nameOf(type) + ' ' + std::to_string(dimension) + "D");
                    EXPECT_TRUE(selected.result.converged());
                    EXPECT_LE(
                        trueError(selected, candidates, polynomial),
                        2e-2 * largestDisplacement(candidates) * (1 + 1e-9));
                    EXPECT_GT(selected.result.selected, 0);
                    EXPECT_LT(
                        selected.result.selected, Index(candidates.size()));
                    expectHonest(selected, candidates, polynomial);
                }
            }
        }
    }
}


TEST(Greedy, weightsAreThoseOfTheDenseSystemOfTheSelectedPoints)
{
    for (const KernelType type : positiveDefiniteKernels())
    {
        Random random(62);
        const double radius = moderateRadius(type);
        const ControlPoints candidates =
            displaced(randomControlPoints(random, {3, 80, 40, 20}), wave);
        const Selected found(
            Kernel(type, radius), Polynomial::none, settingsOf(3e-2),
            candidates);
        ControlPoints chosen;
        for (const Index i : found.selection.selected())
        {
            chosen.push_back(candidates[i]);
        }
        const Vectors probes = rows(random.pointsApart(50, 3, 0));
        EXPECT_TRUE(within(
            "greedy against dense system of its points",
            largestDifference(
                found.s()(probes),
                reference::gram(type, radius, chosen)(probes))
                / largestDisplacement(candidates),
            1e-10))
            << nameOf(type);
    }
}


TEST(Greedy, onePointASweepSelectsWhatTheStandardAlgorithmSelects)
{
    const Mixture mixtures[] = {
        {3, 150, 0, 0}, {3, 90, 50, 20}, {2, 100, 60, 0}};
    for (const KernelType type : positiveDefiniteKernels())
    {
        for (const Mixture& mixture : mixtures)
        {
            Random random(63);
            const double radius = moderateRadius(type);
            const ControlPoints candidates =
                displaced(randomControlPoints(random, mixture), wave);
            const double tolerance = 8e-2;
            const Selected found(
                Kernel(type, radius), Polynomial::none,
                settingsOf(tolerance, 1), candidates);
            std::vector<Index> expected = reference::greedy(
                type, radius, candidates,
                tolerance * largestDisplacement(candidates));
            std::sort(expected.begin(), expected.end());
            EXPECT_GT(expected.size(), 15u);
            EXPECT_EQ(found.selection.selected(), expected)
                << nameOf(type) << ' ' << mixture.dimension << "D";
            EXPECT_EQ(found.result.sweeps, found.result.selected + 1);
        }
    }
}


TEST(Greedy, blocksSelectHardlyMorePointsInFarFewerSweeps)
{
    for (const double tolerance : {1e-2, 1e-3, 1e-4})
    {
        for (const bool sliding : {false, true})
        {
            Random random(64);
            ControlPoints candidates = box(random, 1200);
            for (ControlPoint& p : candidates)
            {
                if (sliding && p.position.z() == 0)
                {
                    p = ControlPoint::sliding(
                        p.position, {Vector3::UnitZ()}, wave(p.position));
                }
            }
            const Kernel kernel(KernelType::wendlandC2, 1.5);
            const Selected blocks(
                kernel, Polynomial::none, settingsOf(tolerance), candidates);
            const Selected ones(
                kernel, Polynomial::none, settingsOf(tolerance, 1), candidates);
            EXPECT_TRUE(blocks.result.converged());
            EXPECT_TRUE(within(
                "points in blocks, of those one by one",
                double(blocks.result.selected) / ones.result.selected, 1.15))
                << tolerance;
            EXPECT_LT(2 * blocks.result.sweeps, ones.result.sweeps)
                << tolerance;
        }
    }
}


TEST(Greedy, oneBlockOnAListOfAllCandidatesIsTheStandardAlgorithm)
{
    // One candidate in each cell of the first list (0.4 radii wide), which so
    // holds all of them: all that is selected is selected in one sweep
    for (const bool sliding : {false, true})
    {
        Random random(76);
        const double radius = 0.5;
        ControlPoints candidates;
        for (int i = 0; i < 150; ++i)
        {
            const Vector3 middle(i % 6 + 0.5, i / 6 % 5 + 0.5, i / 30 + 0.5);
            const Vector3 x = 0.4 * radius * (middle + 0.3 * random.inBox());
            candidates.push_back(
                sliding && i % 3 == 0
                    ? ControlPoint::sliding(x, {random.direction()}, wave(x))
                    : ControlPoint::prescribed(x, wave(x)));
        }
        const double tolerance = 0.15;
        const Selected found(
            Kernel(KernelType::wendlandC2, radius), Polynomial::none,
            settingsOf(tolerance, 150), candidates);
        std::vector<Index> expected = reference::greedy(
            KernelType::wendlandC2, radius, candidates,
            tolerance * largestDisplacement(candidates));
        std::sort(expected.begin(), expected.end());
        EXPECT_GT(expected.size(), 30u);
        EXPECT_LT(expected.size(), 120u);
        EXPECT_EQ(found.selection.selected(), expected);
        EXPECT_EQ(found.result.sweeps, 2);
    }
}


TEST(Greedy, neverSelectsMoreThanMaxPoints)
{
    Random random(65);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 100, 50, 20}), wave);
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        for (const Index most : {1, 2, 7, 50})
        {
            for (const bool all : {false, true})
            {
                SelectionSettings settings = settingsOf(1e-6);
                settings.maxPoints = most;
                settings.all = all;
                const Selected found(
                    Kernel(KernelType::wendlandC2, 0.8), polynomial, settings,
                    candidates);
                EXPECT_EQ(found.result.selected, most);
                EXPECT_FALSE(found.result.converged());
                expectHonest(found, candidates, polynomial);
            }
        }
    }
}


TEST(Greedy, rejectsPointsThatNearlyCoincideAndCountsTheirErrors)
{
    for (const KernelType type : {KernelType::wendlandC2, KernelType::gaussian})
    {
        for (const Polynomial polynomial :
             {Polynomial::none, Polynomial::linear})
        {
            for (const bool all : {false, true})
            {
                Random random(66);
                const double radius = moderateRadius(type);
                ControlPoints candidates = displaced(
                    randomControlPoints(random, {3, 30, 10, 0}), wave);
                const Index single = candidates.size();
                for (Index i = 0; i < single; ++i)
                {
                    ControlPoint p = candidates[i];
                    p.position += 1e-9 * radius * random.direction();
                    p.value.head(p.k) *= 0.7;
                    candidates.push_back(p);
                }
                SelectionSettings settings = settingsOf(1e-5);
                settings.all = all;
                const Selected found(
                    Kernel(type, radius), polynomial, settings, candidates);
                SCOPED_TRACE(
                    nameOf(type)
                    + (polynomial == Polynomial::linear ? " with polynomial"
                                                        : "")
                    + (all ? ", all" : ""));
                EXPECT_EQ(found.result.selected, single);
                EXPECT_EQ(found.result.rejected, single);
                EXPECT_FALSE(found.result.converged());
                EXPECT_NEAR(
                    found.result.largestError,
                    0.3 * found.result.largestDisplacement,
                    0.15 * found.result.largestDisplacement);
                EXPECT_LT(
                    found.result.roundOff,
                    1e-9 * found.result.largestDisplacement);
                expectHonest(found, candidates, polynomial);
            }
        }
    }
}


TEST(Greedy, doesNotTakeRoundOffForAPivotBesideANodeOfThePolynomial)
{
    // Each point twice, so also the nodes, where the reduced kernel vanishes:
    // a pivot that is round-off would give weights of any size
    for (const KernelType type : allKernels())
    {
        for (const double distance : {1e-7, 1e-8, 1e-9, 1e-10, 1e-12})
        {
            for (const bool all : {false, true})
            {
                Random random(67);
                const double radius = moderateRadius(type);
                ControlPoints candidates =
                    displaced(randomControlPoints(random, {3, 25, 0, 0}), wave);
                for (Index i = 0; i < 25; ++i)
                {
                    ControlPoint p = candidates[i];
                    p.position += distance * radius * random.direction();
                    p.value *= 0.7;
                    candidates.push_back(p);
                }
                SelectionSettings settings = settingsOf(1e-5);
                settings.all = all;
                const Selected found(
                    Kernel(type, radius), Polynomial::linear, settings,
                    candidates);
                EXPECT_TRUE(within(
                    "round-off beside polynomial nodes",
                    found.result.roundOff / found.result.largestDisplacement,
                    0.01))
                    << nameOf(type) << " at " << distance;
                expectHonest(found, candidates, Polynomial::linear);
            }
        }
    }
}


TEST(Greedy, selectsEnoughPointsWhereTheSystemIsIllConditioned)
{
    // Of a radius so large that the kernel hardly varies many points may be
    // rejected: not so many that what is left does not fit, unless the kernel
    // is smooth
    for (const KernelType type : allKernels())
    {
        for (const bool all : {false, true})
        {
            Random random(68);
            const ControlPoints candidates = box(random, 400);
            SelectionSettings settings = settingsOf(1e-4);
            settings.all = all;
            const Kernel kernel(type, 20 * moderateRadius(type));
            const Polynomial polynomial =
                kernel.order() > 0 ? Polynomial::linear : Polynomial::none;
            const Selected found(kernel, polynomial, settings, candidates);
            SCOPED_TRACE(nameOf(type) + (all ? ", all" : ""));
            if (all)
            {
                EXPECT_EQ(found.result.selected + found.result.rejected, 400);
            }
            if (kernel.smoothness() >= 0)
            {
                EXPECT_TRUE(within(
                    "largest error, ill-conditioned",
                    found.result.largestError / largestDisplacement(candidates),
                    1e-2))
                    << found.result.selected << " selected";
            }
            expectHonest(found, candidates, polynomial);
        }
    }
}


TEST(Greedy, scaledDisplacementsScaleTheWeightsAndAddNoPoint)
{
    Random random(68);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 100, 50, 20}), wave);
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        Selected found(
            Kernel(KernelType::wendlandC2, 0.8), polynomial, settingsOf(1e-2),
            candidates);
        const Columns x = found.s().centres();
        const Columns w = found.s().weights();
        for (const double factor : {-0.5, 3.0, 1e-3, 0.0, 1.0})
        {
            found.again(scaled(candidates, factor));
            EXPECT_EQ(found.result.added, 0) << factor;
            EXPECT_EQ(found.result.sweeps, 1) << factor;
            EXPECT_TRUE(sameBits(found.s().centres(), x)) << factor;
            EXPECT_TRUE(within(
                "scaled weights",
                (found.s().weights() - factor * w).norm() / w.norm(), 1e-12));
            if (factor == -0.5 || factor == 1)
            {
                EXPECT_TRUE(sameBits(found.s().weights(), factor * w));
            }
        }
    }
}


TEST(Greedy, interpolantsOfDerivativesAreDifferencesOfInterpolants)
{
    // The interpolant is linear in the values of the points that are there, and
    // the selection itself is left as it was
    Random random(70);
    const ControlPoints candidates =
        displaced(randomControlPoints(random, {3, 100, 50, 20}), wave);
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        Selected found(
            Kernel(KernelType::wendlandC2, 0.8), polynomial, settingsOf(1e-2),
            candidates);
        const Columns w = found.s().weights();
        SerialCommunicator alone;
        const ControlPoints other = displaced(candidates, waveAndBump);
        const std::vector<RbfInterpolant> both =
            found.selection.interpolants({candidates, other}, alone);
        EXPECT_TRUE(sameBits(both[0].weights(), w));
        found.again(candidates);
        EXPECT_TRUE(sameBits(found.s().weights(), w));

        ControlPoints difference = other;
        for (std::size_t i = 0; i < other.size(); ++i)
        {
            difference[i].value -= candidates[i].value;
        }
        const RbfInterpolant d =
            found.selection.interpolants({difference}, alone)[0];
        const Columns expected = both[1].weights() - both[0].weights();
        EXPECT_TRUE(within(
            "weights of a derivative",
            (d.weights() - expected).norm() / both[1].weights().norm(), 1e-11));
    }
}


TEST(Greedy, aNewDisplacementKeepsThePointsAndAddsWhereItDiffers)
{
    for (const Polynomial polynomial : {Polynomial::none, Polynomial::linear})
    {
        Random random(69);
        ControlPoints candidates;
        for (const Vector3& x : random.pointsApart(1500, 2, 0.008))
        {
            candidates.push_back(ControlPoint::prescribed(x, wave(x)));
        }
        const Kernel kernel(KernelType::wendlandC2, 0.8);
        Selected found(kernel, polynomial, settingsOf(1e-3), candidates);
        const std::vector<Index> before = found.selection.selected();

        const ControlPoints changed = displaced(candidates, waveAndBump);
        found.again(changed);
        const std::vector<Index> after = found.selection.selected();
        EXPECT_TRUE(found.result.converged());
        expectHonest(found, changed, polynomial);
        EXPECT_GT(found.result.added, 0);
        EXPECT_EQ(
            found.result.added, Index(after.size()) - Index(before.size()));
        EXPECT_TRUE(std::includes(
            after.begin(), after.end(), before.begin(), before.end()));
        const Selected afresh(kernel, polynomial, settingsOf(1e-3), changed);
        EXPECT_LT(found.result.added, afresh.result.selected);

        // Nine in ten of the points that were added are at the bump
        Index near = 0;
        for (const Index i : after)
        {
            const bool added =
                !std::binary_search(before.begin(), before.end(), i);
            const Vector3 x = candidates[i].position;
            near += added && (x - Vector3(0.7, 0.3, 0.3)).norm() < 0.3;
        }
        EXPECT_GE(10 * near, 9 * found.result.added);

        // And back
        found.again(candidates);
        EXPECT_TRUE(found.result.converged());
        expectHonest(found, candidates, polynomial);
    }
}


// By definition of SelectionSettings: nothing is added while no error exceeds
// so many tolerances, and then until none exceeds one
TEST(Greedy, aSelectionIsKeptUntilAnErrorExceedsSoManyTolerances)
{
    Random random(12);
    const Kernel kernel(KernelType::wendlandC2, 1);
    const ControlPoints candidates = box(random, 400);
    const SelectionSettings settings = settingsOf(1e-2);
    Selected found(kernel, Polynomial::none, settings, candidates);
    const auto bumpOnASide = [](const Vector3& x) -> Vector3
    {
        const double d = (x - Vector3(0.7, 0.3, 0)).norm() / 0.3;
        return wave(x) + (d < 1 ? 0.03 * (1 - d * d) : 0) * Vector3::UnitZ();
    };
    const ControlPoints changed = displaced(candidates, bumpOnASide);

    // The error in tolerances that the new values leave
    SelectionSettings loose = settings;
    loose.keep = 1e9;
    found.selection.setTolerances(loose);
    found.again(changed);
    EXPECT_EQ(found.result.added, 0);
    EXPECT_TRUE(found.result.converged());
    const double ratio = found.result.largestError / found.result.tolerance;
    ASSERT_GT(ratio, 2);

    for (const double keep : {1.01 * ratio, 0.99 * ratio})
    {
        SelectionSettings some = settings;
        some.keep = keep;
        found.selection.setTolerances(some);
        found.again(changed);
        expectHonest(found, changed);
        EXPECT_TRUE(found.result.converged());
        EXPECT_EQ(found.result.added > 0, keep < ratio);
        EXPECT_EQ(
            found.result.largestError <= found.result.tolerance, keep < ratio);
    }

    // A new selection is made to the tolerance
    const Selected afresh(kernel, Polynomial::none, loose, changed);
    EXPECT_LE(afresh.result.largestError, afresh.result.tolerance);
}


// By definition of SelectionSettings
TEST(Greedy, aRoughFieldGetsARoughTolerance)
{
    Random random(13);
    const Kernel kernel(KernelType::wendlandC2, 1);
    ControlPoints candidates = box(random, 400);
    for (ControlPoint& p : candidates)
    {
        p.value = Vector3(
            random.uniform(-1, 1), random.uniform(-1, 1),
            random.uniform(-1, 1));
    }
    SelectionSettings settings = settingsOf(1e-3);
    settings.roughTolerance = 0.8;
    settings.roughPoints = 50;
    settings.roughShare = 0.2;
    const Selected some(kernel, Polynomial::none, settings, candidates);
    EXPECT_TRUE(some.result.rough);
    EXPECT_TRUE(some.result.converged());
    EXPECT_DOUBLE_EQ(
        some.result.tolerance, 0.8 * some.result.largestDisplacement);
    EXPECT_GT(some.result.selected, 80);
    EXPECT_LT(some.result.selected, 390);
    expectHonest(some, candidates);

    // Neither of the two bounds is enough
    settings.roughPoints = 400;
    const Selected all(kernel, Polynomial::none, settings, candidates);
    EXPECT_FALSE(all.result.rough);
    EXPECT_GT(all.result.selected, some.result.selected);
    settings.roughPoints = 50;
    settings.roughShare = 1;
    const Selected too(kernel, Polynomial::none, settings, candidates);
    EXPECT_FALSE(too.result.rough);
}


TEST(Greedy, kindsThatFollowEachOtherInAnyOrderGiveTheRightWeights)
{
    // First only the sliding points move, then only the others, so that the
    // factor of sliding points grows before and after that of moving ones
    for (const bool slidingFirst : {true, false})
    {
        Random random(70);
        const ControlPoints points =
            displaced(randomControlPoints(random, {3, 60, 40, 20}), wave);
        ControlPoints first = points;
        for (ControlPoint& p : first)
        {
            if (p.slides() != slidingFirst)
            {
                p.value.setZero();
            }
        }
        Selected found(
            Kernel(KernelType::wendlandC2, 0.8), Polynomial::none,
            settingsOf(5e-2), first);
        expectHonest(found, first);
        found.again(points);
        EXPECT_TRUE(found.result.converged());
        EXPECT_GT(found.result.added, 0);
        expectHonest(found, points);
    }
}


TEST(Greedy, copesWithErrorsThatTieExactly)
{
    const auto constant = [](const Vector3&) { return Vector3(1, 0, 0); };
    const auto symmetric = [](const Vector3& x)
    {
        const Vector3 d = 2 * x - Vector3(1, 1, 1);
        return Vector3(d.cwiseProduct(d) * 0.25);
    };
    struct Grid
    {
        int n;
        int dimension;
    };
    for (const Grid g : {Grid{16, 2}, Grid{6, 3}})
    {
        for (const Index pointsPerSweep : {0, 1})
        {
            for (const bool isConstant : {true, false})
            {
                const ControlPoints candidates = isConstant
                    ? grid(g.n, g.dimension, constant)
                    : grid(g.n, g.dimension, symmetric);
                const Kernel kernel(KernelType::wendlandC2, 0.8);
                const SelectionSettings settings =
                    settingsOf(1e-2, pointsPerSweep);
                const Selected found(
                    kernel, Polynomial::none, settings, candidates);
                EXPECT_TRUE(found.result.converged());
                EXPECT_EQ(found.result.rejected, 0);
                expectHonest(found, candidates);

                // In any order the same
                ControlPoints shuffled;
                for (const Index i : Random(71).permutation(candidates.size()))
                {
                    shuffled.push_back(candidates[i]);
                }
                const Selected other(
                    kernel, Polynomial::none, settings, shuffled);
                EXPECT_TRUE(sameBits(found.s().centres(), other.s().centres()));
                EXPECT_TRUE(sameBits(found.s().weights(), other.s().weights()));
            }
        }
    }
}


TEST(Greedy, ofEqualErrorsTheFirstByPositionIsSelected)
{
    const ControlPoints candidates =
        grid(8, 2, [](const Vector3&) { return Vector3(0, 1, 0); });
    SelectionSettings settings = settingsOf(1e-3);
    settings.maxPoints = 1;
    const Selected found(
        Kernel(KernelType::wendlandC2, 0.4), Polynomial::none, settings,
        candidates);
    EXPECT_EQ(found.s().centres().row(0), Eigen::RowVector3d(0, 0, 0));
}


TEST(Greedy, noDisplacementSelectsNothing)
{
    Random random(72);
    const ControlPoints candidates =
        scaled(randomControlPoints(random, {3, 30, 20, 10}), 0);
    const Selected found(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settingsOf(1e-5),
        candidates);
    EXPECT_EQ(found.result.selected, 0);
    EXPECT_EQ(found.result.sweeps, 1);
    EXPECT_TRUE(found.result.converged());
    expectHonest(found, ControlPoints(candidates));
}


TEST(Greedy, oneMovingPointAmongFixedOnesIsFound)
{
    Random random(73);
    ControlPoints candidates =
        scaled(randomControlPoints(random, {3, 500, 0, 0}), 0);
    candidates[321].value = Vector3(0, 0, 1e-7);
    const Selected found(
        Kernel(KernelType::wendlandC2, 0.5), Polynomial::none, settingsOf(1e-3),
        candidates);
    EXPECT_TRUE(found.result.converged());
    const std::vector<Index> selected = found.selection.selected();
    EXPECT_EQ(std::count(selected.begin(), selected.end(), 321), 1);
    expectHonest(found, candidates);
}


TEST(Greedy, endsWhereTheLargestErrorEqualsTheTolerance)
{
    // To the last bit, which the compiler may round differently in different
    // places (-march=native)
    for (unsigned seed = 0; seed < 200; ++seed)
    {
        Random random(seed);
        const ControlPoints candidates =
            randomControlPoints(random, {3, 4, 2, 2});
        const Selected found(
            Kernel(KernelType::wendlandC2, 0.8), Polynomial::none,
            settingsOf(1), candidates);
        EXPECT_LE(
            found.result.largestError, found.result.tolerance * (1 + 1e-15));
    }
}


TEST(Greedy, toleranceZeroEndsWithEveryPointSelected)
{
    Random random(74);
    const ControlPoints candidates =
        randomControlPoints(random, {3, 40, 20, 10});
    const Selected found(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settingsOf(0),
        candidates);
    EXPECT_EQ(found.result.selected + found.result.rejected, 70);
    EXPECT_LT(found.result.largestError, 1e-12);
    expectHonest(found, candidates);
}


TEST(Greedy, roundOffIsMachineEpsilonTimesTheSumOfTheWeights)
{
    Random random(75);
    const ControlPoints candidates =
        randomControlPoints(random, {3, 40, 20, 10});
    const Selected found(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settingsOf(1e-3),
        candidates);
    double sum = 0;
    for (Index j = 0; j < found.s().weights().rows(); ++j)
    {
        sum += found.s().weights().row(j).norm();
    }
    EXPECT_NEAR(
        found.result.roundOff / (2.220446049250313e-16 * sum), 1, 1e-12);
}


TEST(Greedy, refusesSettingsWithoutMeaning)
{
    const Kernel kernel(KernelType::wendlandC2, 1);
    SelectionSettings none;
    none.maxPoints = 0;
    for (const SelectionSettings& settings :
         {settingsOf(-1e-5), settingsOf(std::nan("")), none})
    {
        EXPECT_THROW(
            GreedySelection(kernel, Polynomial::none, settings),
            std::invalid_argument);
    }
}
