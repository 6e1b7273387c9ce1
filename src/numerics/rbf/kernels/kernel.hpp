// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Radial basis functions phi(r/r0).

#ifndef morph_kernel_hpp
#define morph_kernel_hpp

#include <string>
#include <vector>

namespace morph
{

// With d = r/r0:
//   wendlandC0           (1 - d)^2                              d < 1, else 0
//   wendlandC2           (1 - d)^4 (4 d + 1)                    d < 1, else 0
//   wendlandC4           (1 - d)^6 (35 d^2 + 18 d + 3)/3        d < 1, else 0
//   wendlandC6           (1 - d)^8 (32 d^3 + 25 d^2 + 8 d + 1)  d < 1, else 0
//   gaussian             exp(-d^2)
//   inverseMultiQuadric  1/sqrt(1 + d^2)
//   multiQuadric         -sqrt(1 + d^2)
//   thinPlate            d^2 log(d)
//
// Wendland (1995), doi:10.1007/BF02123482, and Wendland, Scattered Data
// Approximation (2005), tables 8.1 and 9.1. The sign of multiQuadric makes it
// conditionally *positive* definite; it changes the weights, not the sum.
enum class KernelType
{
    wendlandC0,
    wendlandC2,
    wendlandC4,
    wendlandC6,
    gaussian,
    inverseMultiQuadric,
    multiQuadric,
    thinPlate
};

class Kernel
{
public:
    // Support radius r0 in metres; throws std::invalid_argument unless it is
    // finite and positive.
    Kernel(KernelType type, double supportRadius);

    KernelType type() const { return type_; }

    double supportRadius() const { return supportRadius_; }

    // phi of a distance in metres
    double operator()(double distance) const;

    // Is phi zero beyond the support radius?
    bool compact() const;

    // Order m of conditional positive definiteness: 0 for a positive definite
    // function; otherwise polynomials of degree m - 1 have to be added.
    int order() const;

    // k if phi is k times continuously differentiable, -1 if it is smooth
    int smoothness() const;

private:
    KernelType type_;
    double supportRadius_;
};

// All types, in the order of the enumeration, with the names users type
const std::vector<std::pair<KernelType, std::string>>& kernelNames();

} // namespace morph

#endif
