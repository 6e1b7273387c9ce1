// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The sum over pairs of points, whichever loop the machine takes for it. Source
// of truth: the sum in long double (test_support.hpp).

#include "test_support.hpp"
#include "wendlandSum.hpp"

#include <cmath>

using namespace test;

namespace
{

// Centres of a group, with and without a root; behind all groups' centres with
// a root are those without
struct GroupSizes
{
    Index rooted;
    Index rootless;
};


std::vector<CentreGroup> groupsOf(const std::vector<GroupSizes>& sizes)
{
    CentreGroup group = {0, 0, 0, 0};
    for (const GroupSizes& size : sizes)
    {
        group.rootlessBegin += size.rooted;
    }
    group.rootlessEnd = group.rootlessBegin;

    std::vector<CentreGroup> groups;
    for (const GroupSizes& size : sizes)
    {
        group.begin = group.end;
        group.end += size.rooted;
        group.rootlessBegin = group.rootlessEnd;
        group.rootlessEnd += size.rootless;
        groups.push_back(group);
    }
    return groups;
}


// The pointers to the columns
struct ColumnPointers
{
    const double* column[3];

    explicit ColumnPointers(const Columns& x)
    : column{x.col(0).data(), x.col(1).data(), x.col(2).data()}
    {
    }
};


Columns kernelSum(
    KernelType type, const Columns& points, const Columns& centres,
    const Columns& weights, const std::vector<CentreGroup>& groups)
{
    Columns sums = Columns::Constant(points.rows(), 3, 0.25);
    double* const s[3] = {
        sums.col(0).data(), sums.col(1).data(), sums.col(2).data()};
    addKernelSum(
        type, ColumnPointers(points).column, points.rows(),
        ColumnPointers(centres).column, ColumnPointers(weights).column, groups,
        s);
    return sums;
}


Columns randomColumns(Random& random, Index n, double scale)
{
    Columns x(n, 3);
    for (Index i = 0; i < n; ++i)
    {
        x.row(i) = scale * random.inBox().transpose();
    }
    return x;
}

} // namespace


TEST(KernelSum, theLoopIsTheOneThisProgramWasBuiltFor)
{
    for (const KernelType type : allKernels())
    {
#if defined(MORPH_NO_AVX512) || !defined(__x86_64__)
        EXPECT_FALSE(hasWendlandSum(type)) << nameOf(type);
#else
        // Wendland's functions are the compact ones
        EXPECT_EQ(
            hasWendlandSum(type),
            Kernel(type, 1).compact() && __builtin_cpu_supports("avx512f"))
            << nameOf(type);
#endif
    }
}


TEST(KernelSum, isThatOfLongDoubleForEveryKernelAndAllSizesOfGroups)
{
    const std::vector<std::vector<GroupSizes>> sizes = {
        {},
        {{1, 0}},
        {{0, 1}},
        {{3, 1}},
        {{2, 5}, {7, 0}, {1, 2}},
        {{rootsOfGroup, groupSize - rootsOfGroup}, {0, 3}, {13, 4}}};
    Random random(31);
    for (const KernelType type : allKernels())
    {
        for (const std::vector<GroupSizes>& sizesOfGroups : sizes)
        {
            const std::vector<CentreGroup> groups = groupsOf(sizesOfGroups);
            const Index n = groups.empty() ? 0 : groups.back().rootlessEnd;
            Columns points = randomColumns(random, 3 * blockSize, 0.6);
            const Columns centres = randomColumns(random, n, 0.6);
            const Columns weights = randomColumns(random, n, 1);
            // Some are at a centre
            for (Index j = 0; j < std::min<Index>(n, 2 * blockSize); ++j)
            {
                points.row(j) = centres.row(j);
            }

            const Columns sums =
                kernelSum(type, points, centres, weights, groups);

            reference::Field field;
            field.type = type;
            field.radius = 1;
            field.centres = centres;
            field.weights = weights.cast<reference::Real>();
            const Vectors expected = field(points);
            EXPECT_TRUE(within(
                "kernel sum",
                (sums.array() - 0.25 - expected.array()).abs().maxCoeff()
                    / (1 + n),
                1e-15))
                << nameOf(type) << ", " << n << " centres";
        }
    }
}


TEST(KernelSum, ofAPointDoesNotDependOnThePointsBesideIt)
{
    Random random(32);
    const std::vector<CentreGroup> groups = groupsOf({{48, 16}, {20, 7}});
    const Columns centres = randomColumns(random, 91, 0.6);
    const Columns weights = randomColumns(random, 91, 1);
    const Columns points = randomColumns(random, 2 * blockSize, 0.6);
    for (const KernelType type : allKernels())
    {
        const Columns forwards =
            kernelSum(type, points, centres, weights, groups);
        const Columns backwards =
            kernelSum(
                type, points.colwise().reverse(), centres, weights, groups)
                .colwise()
                .reverse();
        EXPECT_TRUE(forwards == backwards) << nameOf(type);
    }
}
