// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Evaluation of sums of kernels: accuracy, and that a point's value depends on
// nothing but the point.

#include "kernelSum.hpp"
#include "test_support.hpp"

using namespace test;

namespace
{

RbfInterpolant
randomInterpolant(Random& random, KernelType type, double radius, Index centres)
{
    Columns x(centres, 3), w(centres, 3);
    for (Index j = 0; j < centres; ++j)
    {
        x.row(j) = random.inBox().transpose();
        w.row(j) = random.inBox().transpose();
    }
    RbfInterpolant s{Kernel(type, radius)};
    s.set(x, w);
    return s;
}


Vectors randomPoints(Random& random, Index n)
{
    std::vector<Vector3> x;
    for (Index i = 0; i < n; ++i)
    {
        x.push_back(1.2 * random.inBox());
    }
    return rows(x);
}


// Bitwise, where -0 and 0 differ and NaN equals itself
bool sameBits(const Vectors& a, const Vectors& b)
{
    return a.rows() == b.rows()
        && std::equal(
               reinterpret_cast<const char*>(a.data()),
               reinterpret_cast<const char*>(a.data() + a.size()),
               reinterpret_cast<const char*>(b.data()));
}


// Each point by itself
Vectors oneByOne(const RbfInterpolant& s, const Vectors& x)
{
    Vectors v(x.rows(), 3);
    for (Index i = 0; i < x.rows(); ++i)
    {
        v.row(i) = s(Vectors(x.row(i))).row(0);
    }
    return v;
}

} // namespace


TEST(RbfInterpolant, agreesWithTheSumInLongDouble)
{
    for (const KernelType type : allKernels())
    {
        for (const double radius : {0.2, 0.7, 10.0})
        {
            Random random(11);
            const RbfInterpolant s =
                randomInterpolant(random, type, radius, 90);
            const Vectors x = randomPoints(random, 700);
            const Vectors expected = reference::plainSum(s)(x);
            EXPECT_TRUE(within(
                "sum of kernels",
                largestDifference(s(x), expected)
                    / expected.rowwise().norm().maxCoeff(),
                1e-11))
                << nameOf(type) << ", radius " << radius;
        }
    }
}


// Whatever its place among the centres, on which the way its distances are made
// may depend. With weights of other centres zero the sum is one term
TEST(RbfInterpolant, everyCentreCountsByTheFormulaAndOneAtItself)
{
    for (const KernelType type : allKernels())
    {
        const Kernel kernel(type, 1);
        if (!kernel.compact())
        {
            continue;
        }
        Random random(5);
        RbfInterpolant s = randomInterpolant(random, type, 1, 67);
        const Columns centres = s.centres();
        for (Index j = 0; j < centres.rows(); ++j)
        {
            Columns weights = Columns::Zero(centres.rows(), 3);
            weights.row(j) << 1, 2, 3;
            s.set(centres, weights);

            std::vector<Vector3> x{centres.row(j).transpose()};
            for (double d = 1e-160; d < 1; d *= 1.7)
            {
                x.push_back(x[0] + Vector3(0, d, 0));
            }
            const Vectors v = s(rows(x));
            ASSERT_EQ(v(0, 0), kernel(0));
            for (std::size_t i = 0; i < x.size(); ++i)
            {
                const double d = (x[i] - x[0]).norm();
                ASSERT_NEAR(v(i, 0), kernel(d), 2e-15) << j << ' ' << d;
            }
        }
    }
}


TEST(RbfInterpolant, addsThePolynomialToTheSum)
{
    Random random(12);
    RbfInterpolant s =
        randomInterpolant(random, KernelType::wendlandC2, 0.5, 20);
    const Vectors x = randomPoints(random, 600);
    const Vectors plain = s(x);

    Eigen::Matrix3d gradient;
    gradient << 1, 2, 3, 4, 5, 6, 7, 8, 10;
    const Vector3 origin(0.1, -0.4, 2), offset(-3, 4, 0.5);
    s.setPolynomial(origin, offset, gradient);
    const Vectors found = s(x);

    // Entry (a, b) of the gradient is d s_b / d x_a
    for (Index i = 0; i < x.rows(); ++i)
    {
        for (int b = 0; b < 3; ++b)
        {
            double expected = plain(i, b) + offset[b];
            for (int a = 0; a < 3; ++a)
            {
                expected += (x(i, a) - origin[a]) * gradient(a, b);
            }
            EXPECT_NEAR(found(i, b), expected, 1e-13);
        }
    }
}


TEST(RbfInterpolant, aPointsValueDoesNotDependOnTheOthersEvaluatedWithIt)
{
    for (const KernelType type : allKernels())
    {
        Random random(13);
        RbfInterpolant s = randomInterpolant(random, type, 0.6, 70);
        s.setPolynomial(
            random.inBox(), random.inBox(), Eigen::Matrix3d::Constant(0.1));
        const Vectors x = randomPoints(random, 1700);
        const Vectors all = s(x);

        const std::vector<Index> order = random.permutation(x.rows());
        Vectors permuted(x.rows(), 3), expected(x.rows(), 3);
        for (Index i = 0; i < x.rows(); ++i)
        {
            permuted.row(i) = x.row(order[i]);
            expected.row(i) = all.row(order[i]);
        }
        EXPECT_TRUE(sameBits(s(permuted), expected)) << nameOf(type);

        for (const Index n : {2, 31, 32, 33, 511, 512, 513, 1100})
        {
            EXPECT_TRUE(
                sameBits(s(Vectors(permuted.topRows(n))), expected.topRows(n)))
                << nameOf(type) << ", " << n << " points";
        }
        EXPECT_TRUE(sameBits(oneByOne(s, x), all)) << nameOf(type);
    }
}


TEST(RbfInterpolant, leavingOutCentresOutOfReachChangesNoBit)
{
    for (const KernelType type : positiveDefiniteKernels())
    {
        // A cloud in one leaf around all centres needs all of them
        Random random(14);
        const RbfInterpolant s = randomInterpolant(random, type, 0.15, 300);
        const Vectors x = randomPoints(random, 16 * blockSize);
        ASSERT_EQ(PointCloud(x).leaves().size(), 1u);
        ASSERT_GT(s.centres().colwise().minCoeff().minCoeff(), x.minCoeff());

        EXPECT_TRUE(sameBits(oneByOne(s, x), s(x))) << nameOf(type);
    }
}


TEST(RbfInterpolant, pointsOnTheRimOfTheSupportGetTheSameBitsAloneAndTogether)
{
    for (const double offset : {0.0, 7.0, 1000.0})
    {
        Random random(15);
        const double radius = 0.3;
        RbfInterpolant s{Kernel(KernelType::wendlandC0, radius)};
        const Vector3 centre = offset * Vector3::Ones() + random.inBox();
        s.set(Columns(centre.transpose()), Columns::Constant(1, 3, 1e5));

        std::vector<Vector3> x;
        for (Index i = 0; i < 2000; ++i)
        {
            x.push_back(centre + radius * random.direction());
        }
        EXPECT_TRUE(sameBits(oneByOne(s, rows(x)), s(rows(x))))
            << "offset " << offset;
    }
}


TEST(RbfInterpolant, isExactlyZeroOutsideTheSupportOfAllCentres)
{
    for (const KernelType type : positiveDefiniteKernels())
    {
        if (!Kernel(type, 1).compact())
        {
            continue;
        }
        Random random(16);
        const RbfInterpolant s = randomInterpolant(random, type, 0.5, 50);
        std::vector<Vector3> x;
        for (Index i = 0; i < 1000; ++i)
        {
            // The centres are in [-1,1]^3
            Vector3 p = 4 * random.inBox();
            p[i % 3] = random.uniform(1.500001, 4);
            x.push_back(p);
        }
        EXPECT_TRUE(sameBits(s(rows(x)), Vectors::Zero(1000, 3)))
            << nameOf(type);
    }
}


TEST(RbfInterpolant, withoutCentresIsZeroAndWithoutPointsIsEmpty)
{
    Random random(17);
    const RbfInterpolant zero{Kernel(KernelType::gaussian, 1)};
    EXPECT_TRUE(sameBits(zero(randomPoints(random, 40)), Vectors::Zero(40, 3)));
    const RbfInterpolant s =
        randomInterpolant(random, KernelType::wendlandC2, 0.5, 5);
    EXPECT_EQ(s(Vectors(0, 3)).rows(), 0);
}


TEST(RbfInterpolant, isAsAccurateFarFromTheOrigin)
{
    // The shift is a power of two and the positions are multiples of 2^-20, so
    // that the shifted positions are exact
    Random random(18);
    const double shift = 1024;
    const auto rounded = [](double v)
    { return std::round(v * 1048576) / 1048576; };
    RbfInterpolant near =
        randomInterpolant(random, KernelType::wendlandC2, 0.07, 200);
    Columns c = near.centres().unaryExpr(rounded);
    near.set(c, near.weights());
    const Vectors x = randomPoints(random, 500).unaryExpr(rounded);

    RbfInterpolant far(near.kernel());
    far.set(c.array() + shift, near.weights());
    const Vectors expected = near(x);
    EXPECT_TRUE(within(
        "sum of kernels far from the origin",
        largestDifference(far(Vectors(x.array() + shift)), expected)
            / expected.rowwise().norm().maxCoeff(),
        1e-13));
}


TEST(PointCloud, leavesHoldEveryPointOnceAndTheirBoxesEnclosePoints)
{
    Random random(19);
    const Vectors x = randomPoints(random, 1300);
    const PointCloud cloud(x);
    std::vector<int> seen(x.rows(), 0);
    ASSERT_EQ(cloud.size(), x.rows());
    for (const PointCloud::Leaf& leaf : cloud.leaves())
    {
        EXPECT_EQ((leaf.end - leaf.begin) % blockSize, 0);
        EXPECT_LE(leaf.begin + leaf.count, leaf.end);
        for (Index i = leaf.begin; i < leaf.end; ++i)
        {
            const Vector3 p = x.row(cloud.index()[i]).transpose();
            EXPECT_EQ(p, Vector3(cloud.sorted().row(i).transpose()));
            EXPECT_EQ(leaf.distance2(p), 0);
            seen[cloud.index()[i]] += i < leaf.begin + leaf.count;
        }

        // Distance to the box by way of its nearest point
        const Vector3 q = 3 * random.inBox();
        Vector3 nearest = q;
        for (int a = 0; a < 3; ++a)
        {
            nearest[a] = std::min(std::max(q[a], leaf.low[a]), leaf.high[a]);
        }
        EXPECT_NEAR(leaf.distance2(q), (q - nearest).squaredNorm(), 1e-14);
    }
    EXPECT_EQ(seen, std::vector<int>(x.rows(), 1));
}


TEST(RbfInterpolant, severalTogetherAreEachByItself)
{
    // To round-off as each alone, and to the bit whatever other points there
    // are
    for (const auto& [type, name] : kernelNames())
    {
        Random random(29);
        const RbfInterpolant first = randomInterpolant(random, type, 0.9, 150);
        std::vector<RbfInterpolant> fields(1, first);
        for (int k = 1; k < 4; ++k)
        {
            RbfInterpolant other = first;
            const RbfInterpolant some =
                randomInterpolant(random, type, 0.9, 150);
            other.set(first.centres(), some.weights());
            fields.push_back(other);
        }
        fields[2].setPolynomial(
            Vector3(1, 2, 3), Vector3(0.1, 0.2, 0.3),
            Eigen::Matrix3d::Constant(0.4));
        const Vectors x = randomPoints(random, 700);
        const std::vector<Vectors> s =
            RbfInterpolant::together(fields, PointCloud(x));
        const std::vector<Vectors> few = RbfInterpolant::together(
            fields, PointCloud(Vectors(x.middleRows(100, 37))));
        ASSERT_EQ(s.size(), fields.size());
        for (std::size_t k = 0; k < fields.size(); ++k)
        {
            const double scale = fields[k].weights().cwiseAbs().sum();
            EXPECT_TRUE(within(
                "several fields together, " + name,
                (s[k] - fields[k](x)).cwiseAbs().maxCoeff() / scale, 1e-15));
            EXPECT_TRUE(sameBits(few[k], Vectors(s[k].middleRows(100, 37))));
        }
    }
}
