// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "reproducibleSum.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace morph
{

namespace
{

__extension__ typedef __int128 Wide;

const int bits = 61;

// Four parts of a wide integer that doubles hold, and add, exactly
std::vector<double> parts(Wide total)
{
    std::vector<double> limbs(4);
    for (int i = 0; i < 4; ++i)
    {
        const bool top = i == 3;
        limbs[i] = top ? double(std::int64_t(total))
                       : double(std::uint32_t(total & 0xffffffff));
        total >>= 32;
    }
    return limbs;
}


template <class Term>
double sumOf(const Term& term, Index n, Communicator& communicator)
{
    double largest = 0;
    for (Index i = 0; i < n; ++i)
    {
        const double size = std::abs(term(i));

        // Unlike a maximum this keeps what is not a number
        largest = size <= largest ? largest : size;
        if (!(size <= std::numeric_limits<double>::max()))
        {
            largest = std::numeric_limits<double>::infinity();
            break;
        }
    }
    largest = communicator.max(largest);
    if (largest == 0 || !std::isfinite(largest))
    {
        return largest == 0 ? 0 : std::numeric_limits<double>::quiet_NaN();
    }

    int exponent;
    std::frexp(largest, &exponent);
    exponent = std::max(exponent, -900);
    const double scale = std::ldexp(1.0, bits - exponent);
    Wide total = 0;
    for (Index i = 0; i < n; ++i)
    {
        total += std::int64_t(term(i) * scale);
    }

    const std::vector<double> sums = communicator.sum(parts(total));
    Wide all = 0;
    for (int i = 3; i >= 0; --i)
    {
        all = all * (Wide(1) << 32) + Wide(sums[i]);
    }
    return std::ldexp(double(all), exponent - bits);
}

} // namespace


double reproducibleSum(const double* x, Index n, Communicator& communicator)
{
    return sumOf([x](Index i) { return x[i]; }, n, communicator);
}


double reproducibleDot(
    const double* x, const double* y, Index n, Communicator& communicator)
{
    return sumOf([x, y](Index i) { return x[i] * y[i]; }, n, communicator);
}

} // namespace morph
