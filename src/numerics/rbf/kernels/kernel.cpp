// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "kernel.hpp"

#include "radialFunctions.hpp"

#include <stdexcept>

namespace morph
{

const double radial::endOfSupport = 1;


Kernel::Kernel(KernelType type, double supportRadius)
: type_(type),
  supportRadius_(supportRadius)
{
    if (!(supportRadius > 0) || !std::isfinite(supportRadius))
    {
        throw std::invalid_argument(
            "the support radius is " + std::to_string(supportRadius)
            + " but must be a positive length");
    }
}


double Kernel::operator()(double distance) const
{
    const double d = distance / supportRadius_;
    double phi = 0;
    radial::dispatch(
        type_, [&](auto formula) { phi = decltype(formula)::value(d * d); });
    return phi;
}


bool Kernel::compact() const
{
    return type_ == KernelType::wendlandC0 || type_ == KernelType::wendlandC2
        || type_ == KernelType::wendlandC4 || type_ == KernelType::wendlandC6;
}


int Kernel::order() const
{
    switch (type_)
    {
    case KernelType::multiQuadric:
        return 1;
    case KernelType::thinPlate:
        return 2;
    default:
        return 0;
    }
}


int Kernel::smoothness() const
{
    switch (type_)
    {
    case KernelType::wendlandC0:
        return 0;
    case KernelType::wendlandC2:
        return 2;
    case KernelType::wendlandC4:
        return 4;
    case KernelType::wendlandC6:
        return 6;
    case KernelType::thinPlate:
        return 1;
    default:
        return -1;
    }
}


const std::vector<std::pair<KernelType, std::string>>& kernelNames()
{
    static const std::vector<std::pair<KernelType, std::string>> names{
        {KernelType::wendlandC0, "wendlandC0"},
        {KernelType::wendlandC2, "wendlandC2"},
        {KernelType::wendlandC4, "wendlandC4"},
        {KernelType::wendlandC6, "wendlandC6"},
        {KernelType::gaussian, "gaussian"},
        {KernelType::inverseMultiQuadric, "inverseMultiQuadric"},
        {KernelType::multiQuadric, "multiQuadric"},
        {KernelType::thinPlate, "thinPlate"}};
    return names;
}

} // namespace morph
