// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Extrapolated differences against closed forms.

#include "difference.hpp"
#include "test_support.hpp"

#include <cmath>

using namespace test;

TEST(Difference, isTheDerivativeToTwelveDigits)
{
    const auto f = [](double x)
    {
        Eigen::VectorXd v(3);
        v << std::sin(3 * x), std::exp(-x * x), 1 / (1 + x * x);
        return v;
    };
    for (const double x : {-1.3, 0.0, 0.2, 2.0})
    {
        Eigen::Vector3d expected;
        expected << 3 * std::cos(3 * x), -2 * x * std::exp(-x * x),
            -2 * x / ((1 + x * x) * (1 + x * x));
        const Difference d = difference(f, x, 0.1);
        EXPECT_TRUE(within(
            "extrapolated difference",
            (d.derivative - expected).cwiseAbs().maxCoeff(), 1e-12));
        EXPECT_LT(d.error, 1e-10);
    }
}


TEST(Difference, saysWhereThereIsNone)
{
    const auto jump = [](double x)
    { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, x > 0.3 ? 1 : 0)); };
    const auto steep = [](double x)
    { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, std::cbrt(x))); };
    EXPECT_GT(difference(jump, 0.3, 0.1).error, 1e-3);
    EXPECT_GT(difference(steep, 0.0, 0.1).error, 1e-3);
}
