// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Kernels: formulas, smoothness, definiteness.

#include "kernelSum.hpp"
#include "test_support.hpp"

#include <Eigen/Dense>

#include <cmath>

using namespace test;

namespace
{

const KernelType wendland[4] = {
    KernelType::wendlandC0, KernelType::wendlandC2, KernelType::wendlandC4,
    KernelType::wendlandC6};


// The coefficients of the polynomial of degree n through n + 1 values of phi
// on [0,1], at Chebyshev's points
std::vector<double> fittedCoefficients(KernelType type, int n)
{
    using reference::Real;
    const Kernel kernel(type, 1.0);
    reference::RealMatrix V(n + 1, n + 1), values(n + 1, 1);
    for (int i = 0; i <= n; ++i)
    {
        const double d = 0.5 - 0.5 * std::cos(M_PI * (i + 0.5) / (n + 1));
        values(i) = kernel(d);
        for (int m = 0; m <= n; ++m)
        {
            V(i, m) = std::pow(Real(d), m);
        }
    }
    const reference::RealMatrix c = V.fullPivLu().solve(values);
    std::vector<double> coefficients;
    for (int m = 0; m <= n; ++m)
    {
        coefficients.push_back(double(c(m)));
    }
    return coefficients;
}


// The smallest eigenvalue of the Gram matrix on the weights that annihilate the
// polynomials given as columns
double smallestEigenvalue(const Matrix& gram, const Matrix& polynomials)
{
    const Index n = gram.rows();
    Matrix Z = Matrix::Identity(n, n);
    if (polynomials.cols() > 0)
    {
        Z = Eigen::FullPivLU<Matrix>(polynomials.transpose()).kernel();
        Z = Eigen::HouseholderQR<Matrix>(Z).householderQ()
            * Matrix::Identity(n, Z.cols());
    }
    const Matrix projected = Z.transpose() * gram * Z;
    return Eigen::SelfAdjointEigenSolver<Matrix>(projected)
        .eigenvalues()
        .minCoeff();
}


// 1 and, for order 2, the coordinates in which the points differ
Matrix polynomialsOfOrder(int order, const Columns& x, int dimension)
{
    Matrix p(x.rows(), order == 0 ? 0 : order == 1 ? 1 : 1 + dimension);
    if (order > 0)
    {
        p.col(0).setOnes();
    }
    if (order > 1)
    {
        p.rightCols(dimension) = x.leftCols(dimension);
    }
    return p;
}

} // namespace


TEST(Kernel, wendlandFunctionsFollowFromWendlandsConstruction)
{
    for (int k = 0; k < 4; ++k)
    {
        const std::vector<reference::Real> expected = reference::wendland(k);
        const std::vector<double> found =
            fittedCoefficients(wendland[k], expected.size() - 1);
        for (std::size_t m = 0; m < expected.size(); ++m)
        {
            EXPECT_TRUE(within(
                "Wendland coefficients",
                std::abs(found[m] - double(expected[m])), 1e-5))
                << nameOf(wendland[k]) << ", power " << m;
        }
    }
}


TEST(Kernel, valuesAgreeWithTheFormulasInLongDouble)
{
    const double r0 = 0.37;
    for (const KernelType type : allKernels())
    {
        const Kernel kernel(type, r0);
        for (int i = 0; i <= 3000; ++i)
        {
            const double r = 3 * r0 * i / 3000;
            const double expected =
                double(reference::phi(type, reference::Real(r) / r0));
            EXPECT_TRUE(within(
                "kernel value",
                std::abs(kernel(r) - expected)
                    / std::max(1.0, std::abs(expected)),
                1e-14))
                << nameOf(type) << " at " << r;
        }
    }
}


TEST(Kernel, valueAtTheCentreIsThatOfTheFormula)
{
    for (const KernelType type : allKernels())
    {
        const double expected = type == KernelType::thinPlate ? 0
            : type == KernelType::multiQuadric                ? -1
                                                              : 1;
        EXPECT_EQ(Kernel(type, 0.4)(0), expected) << nameOf(type);
    }
}


TEST(Kernel, compactKernelsAreZeroAtAndBeyondTheSupportRadiusAndOnlyThey)
{
    for (const KernelType type : allKernels())
    {
        for (const double r0 : {1e-6, 0.1, 1.0, 3.7e5})
        {
            const Kernel kernel(type, r0);
            EXPECT_EQ(kernel.compact(), kernel(1.5 * r0) == 0) << nameOf(type);
            if (kernel.compact())
            {
                EXPECT_EQ(kernel(r0), 0) << nameOf(type);
                EXPECT_EQ(kernel(r0 * (1 + 1e-15)), 0) << nameOf(type);
                EXPECT_EQ(kernel(1e12 * r0), 0) << nameOf(type);
                EXPECT_GT(kernel(0.99 * r0), 0) << nameOf(type);
            }
        }
    }
}


TEST(Kernel, theSmallestOddPowerTellsTheSmoothnessAtTheCentre)
{
    // phi(|x|) is k times differentiable at 0 if the powers 1, 3 ... k - 1 of
    // |x| are absent; k + 1 is the first there is
    for (const KernelType type : wendland)
    {
        const int k = Kernel(type, 1).smoothness();
        const std::vector<double> c =
            fittedCoefficients(type, reference::wendland(k / 2).size() - 1);
        for (int m = 1; m < k; m += 2)
        {
            EXPECT_NEAR(c[m], 0, 1e-5) << nameOf(type) << ", power " << m;
        }
        EXPECT_GT(std::abs(c[k + 1]), 1) << nameOf(type);
    }
}


TEST(Kernel, derivativesUpToTheSmoothnessVanishAtTheSupportRadius)
{
    // phi(1 - h) ~ h^p: p - 1 derivatives vanish at d = 1
    for (const KernelType type : wendland)
    {
        const Kernel kernel(type, 1);
        const double h = 1.0 / 1024;
        const double p = std::log2(kernel(1 - 2 * h) / kernel(1 - h));
        EXPECT_GT(p, kernel.smoothness() + 0.9) << nameOf(type);
    }
}


TEST(Kernel, secondDerivativeOfThinPlateIsUnboundedAtTheCentre)
{
    // d^2 log d: slope d (2 log d + 1), curvature 2 log d + 3
    const Kernel kernel(KernelType::thinPlate, 1);
    EXPECT_EQ(kernel.smoothness(), 1);
    EXPECT_NEAR(kernel(1e-8) / 1e-8, 0, 1e-6);
    EXPECT_NEAR(2 * kernel(1e-8) / 1e-16, 2 * std::log(1e-8), 1e-6);
}


TEST(Kernel, theOtherKernelsAreSmooth)
{
    EXPECT_EQ(Kernel(KernelType::gaussian, 1).smoothness(), -1);
    EXPECT_EQ(Kernel(KernelType::inverseMultiQuadric, 1).smoothness(), -1);
    EXPECT_EQ(Kernel(KernelType::multiQuadric, 1).smoothness(), -1);
}


TEST(Kernel, gramMatrixIsPositiveDefiniteWherePolynomialsOfItsOrderVanish)
{
    for (const int dimension : {2, 3})
    {
        for (const KernelType type : allKernels())
        {
            for (const double factor : {0.5, 1.0, 2.0})
            {
                const Kernel kernel(type, factor * moderateRadius(type));
                const Columns x =
                    rows(Random(7).pointsApart(30, dimension, 0.06));
                EXPECT_GT(
                    smallestEigenvalue(
                        kernelMatrix(kernel, x, x),
                        polynomialsOfOrder(kernel.order(), x, dimension)),
                    1e-13)
                    << nameOf(type) << ' ' << dimension << "D";
            }
        }
    }
}


TEST(Kernel, onlyMultiQuadricAndThinPlateNeedAPolynomial)
{
    for (const KernelType type : allKernels())
    {
        EXPECT_EQ(
            Kernel(type, 1).order(),
            type == KernelType::multiQuadric    ? 1
                : type == KernelType::thinPlate ? 2
                                                : 0);
    }
}


TEST(Kernel, noLowerOrderMakesTheConditionalOnesPositiveDefinite)
{
    const Columns x = 3 * rows(Random(8).pointsApart(30, 3, 0.1));
    for (const KernelType type : allKernels())
    {
        const Kernel kernel(type, 1);
        if (kernel.order() == 0)
        {
            continue;
        }
        EXPECT_LT(
            smallestEigenvalue(
                kernelMatrix(kernel, x, x),
                polynomialsOfOrder(kernel.order() - 1, x, 3)),
            -0.1)
            << nameOf(type);
    }
}


TEST(Kernel, kernelMatrixHoldsTheValuesOfAllPairs)
{
    Random random(9);
    const Columns a = rows(random.pointsApart(37, 3, 0));
    const Columns b = rows(random.pointsApart(5, 3, 0));
    for (const KernelType type : allKernels())
    {
        const Kernel kernel(type, moderateRadius(type));
        const Matrix phi = kernelMatrix(kernel, a, b);
        ASSERT_EQ(phi.rows(), 37);
        ASSERT_EQ(phi.cols(), 5);
        for (Index i = 0; i < a.rows(); ++i)
        {
            for (Index j = 0; j < b.rows(); ++j)
            {
                const double d =
                    (a.row(i) - b.row(j)).norm() / kernel.supportRadius();
                const double expected = double(reference::phi(type, d));
                EXPECT_TRUE(within(
                    "kernel matrix",
                    std::abs(phi(i, j) - expected)
                        / std::max(1.0, std::abs(expected)),
                    1e-14))
                    << nameOf(type);
            }
        }
    }
    EXPECT_EQ(kernelMatrix(Kernel(wendland[1], 1), a, Columns(0, 3)).size(), 0);
}


TEST(Kernel, refusesARadiusThatIsNoPositiveLength)
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double r0 : {0.0, -1.0, infinity, -infinity, std::nan("")})
    {
        EXPECT_THROW(Kernel(KernelType::wendlandC2, r0), std::invalid_argument)
            << r0;
    }
}


TEST(Kernel, namesAreInTheOrderOfTheEnumeration)
{
    const auto& names = kernelNames();
    ASSERT_EQ(names.size(), allKernels().size());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        EXPECT_EQ(int(names[i].first), int(i));
    }
    EXPECT_EQ(nameOf(KernelType::wendlandC2), "wendlandC2");
    EXPECT_EQ(nameOf(KernelType::inverseMultiQuadric), "inverseMultiQuadric");
    EXPECT_EQ(nameOf(KernelType::thinPlate), "thinPlate");
}
