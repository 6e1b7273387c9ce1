// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The formulas of kernel.hpp as functions of the *squared* scaled distance,
// inlined into the loops of kernelSum.cpp. Branch-free, so that the loops
// vectorise; the square root is the only costly operation of the Wendland ones.

#ifndef morph_radialFunctions_hpp
#define morph_radialFunctions_hpp

#include "kernel.hpp"
#include "vectorMath.hpp"

#include <cmath>
#include <limits>

namespace morph
{
namespace radial
{

// The value 1. If the compiler knew it, it would turn the clamping into a
// branch with a constant result, and the loops would vectorise only with masks
// (AVX-512)
extern const double endOfSupport;

inline double clampedRoot(double d2)
{
    const double d = std::sqrt(d2);
    return d < endOfSupport ? d : endOfSupport;
}

struct WendlandC0
{
    static double value(double d2)
    {
        const double m = 1 - clampedRoot(d2);
        return m * m;
    }
};

struct WendlandC2
{
    static double value(double d2)
    {
        const double d = clampedRoot(d2);
        const double m2 = (1 - d) * (1 - d);
        return m2 * m2 * (4 * d + 1);
    }
};

struct WendlandC4
{
    static double value(double d2)
    {
        const double d = clampedRoot(d2);
        const double m2 = (1 - d) * (1 - d);
        return m2 * m2 * m2 * ((35 * d + 18) * d + 3) * (1.0 / 3.0);
    }
};

struct WendlandC6
{
    static double value(double d2)
    {
        const double d = clampedRoot(d2);
        const double m2 = (1 - d) * (1 - d);
        const double m4 = m2 * m2;
        return m4 * m4 * (((32 * d + 25) * d + 8) * d + 1);
    }
};

struct Gaussian
{
    static double value(double d2) { return vectorMath::exponential(-d2); }
};

struct InverseMultiQuadric
{
    static double value(double d2) { return 1 / std::sqrt(1 + d2); }
};

struct MultiQuadric
{
    static double value(double d2) { return -std::sqrt(1 + d2); }
};

struct ThinPlate
{
    static double value(double d2)
    {
        // d^2 log(d) = d^2 log(d^2)/2, and zero at the centre
        const double least = std::numeric_limits<double>::min();
        return 0.5 * d2 * vectorMath::logarithm(d2 > least ? d2 : least);
    }
};

// Calls action(formula) with the formula of the given type, so that loops are
// compiled once for each formula and the choice is made outside of them.
template <class Action>
inline __attribute__((always_inline)) void
dispatch(KernelType type, const Action& action)
{
    switch (type)
    {
    case KernelType::wendlandC0:
        action(WendlandC0());
        break;
    case KernelType::wendlandC2:
        action(WendlandC2());
        break;
    case KernelType::wendlandC4:
        action(WendlandC4());
        break;
    case KernelType::wendlandC6:
        action(WendlandC6());
        break;
    case KernelType::gaussian:
        action(Gaussian());
        break;
    case KernelType::inverseMultiQuadric:
        action(InverseMultiQuadric());
        break;
    case KernelType::multiQuadric:
        action(MultiQuadric());
        break;
    case KernelType::thinPlate:
        action(ThinPlate());
        break;
    }
}

} // namespace radial
} // namespace morph

#endif
