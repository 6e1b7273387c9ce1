// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Derivatives of functions of one number that are known by their values alone.

#ifndef morph_difference_hpp
#define morph_difference_hpp

#include "arrays.hpp"

#include <limits>
#include <vector>

namespace morph
{

struct Difference
{
    Eigen::VectorXd derivative;

    // Estimated, of the largest component
    double error = std::numeric_limits<double>::infinity();
};

// The derivative of f, which gives a VectorXd, at x: central differences of
// steps h, h/2, h/4, ..., extrapolated to the step zero (Ridders, C. J. F.
// (1982), Advances in Engineering Software 4, 75-76,
// doi:10.1016/S0141-1195(82)80057-0). About 1e-12 of f where it is smooth over
// a distance h; the error says where it jumps. At a kink it is the mean of both
// sides.
template <class Function>
Difference difference(const Function& f, double x, double h)
{
    constexpr int most = 10;
    Difference best;
    std::vector<Eigen::VectorXd> former;
    for (int i = 0; i < most; ++i, h /= 2)
    {
        // As far apart as the numbers are
        const double up = x + h, down = x - h;
        std::vector<Eigen::VectorXd> row{(f(up) - f(down)) / (up - down)};
        double factor = 1;
        for (int j = 0; j < i; ++j)
        {
            factor *= 4;
            row.push_back(row[j] + (row[j] - former[j]) / (factor - 1));
            const double error = std::max(
                (row[j + 1] - row[j]).template lpNorm<Eigen::Infinity>(),
                (row[j + 1] - former[j]).template lpNorm<Eigen::Infinity>());
            if (error <= best.error)
            {
                best = {row[j + 1], error};
            }
        }

        // Round-off: more steps make it worse
        const bool worse = i > 0
            && (row[i] - former[i - 1]).template lpNorm<Eigen::Infinity>()
                >= 2 * best.error;
        if (worse)
        {
            break;
        }
        former = row;
    }
    return best;
}

} // namespace morph

#endif
