// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Exponential and logarithm in plain arithmetic, so that loops over them
// vectorise with any instruction set; those of the C library are function
// calls.

#ifndef morph_vectorMath_hpp
#define morph_vectorMath_hpp

#include <cstdint>
#include <cstring>

namespace morph
{
namespace vectorMath
{

inline std::uint64_t bitsOf(double x)
{
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}


inline double fromBits(std::uint64_t bits)
{
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}


// exp(x) for x <= 0, to two units in the last place; zero below -708.
// x = k ln 2 + r with |r| <= ln(2)/2, and Taylor's series of exp(r), whose
// first term left out is 4e-18.
inline double exponential(double x)
{
    const double inside = x > -708 ? x : -708;

    // Adding 1.5 2^52 leaves the nearest integer in the last bits
    const double magic = 6755399441055744.0;
    const double shifted = inside * 1.4426950408889634 + magic;
    const double k = shifted - magic;
    const double r = (inside - k * 6.93147180369123816490e-01)
        - k * 1.90821492927058770002e-10;

    double s = 1.0 / 6227020800.0;
    s = s * r + 1.0 / 479001600.0;
    s = s * r + 1.0 / 39916800.0;
    s = s * r + 1.0 / 3628800.0;
    s = s * r + 1.0 / 362880.0;
    s = s * r + 1.0 / 40320.0;
    s = s * r + 1.0 / 5040.0;
    s = s * r + 1.0 / 720.0;
    s = s * r + 1.0 / 120.0;
    s = s * r + 1.0 / 24.0;
    s = s * r + 1.0 / 6.0;
    s = s * r + 0.5;
    s = s * r + 1.0;
    s = s * r + 1.0;

    const double power = fromBits((bitsOf(shifted) + 1023) << 52);
    return x > -708 ? s * power : 0.0;
}


// log(x) for positive normal numbers, to two units in the last place of the
// result or of 1, whichever is larger. x = 2^e m with m between sqrt(1/2) and
// sqrt(2), and log(m) = 2 artanh f with f = (m - 1)/(m + 1), |f| <= 0.172.
inline double logarithm(double x)
{
    const std::uint64_t half = 0x3FE6A09E667F3BCDULL; // sqrt(1/2)
    const std::uint64_t bits = bitsOf(x);
    const std::uint64_t biased = (bits - half + 0x3FF0000000000000ULL) >> 52;

    // A small integer in the last bits of 2^52 is a number
    const double e = fromBits(biased | 0x4330000000000000ULL)
        - (4503599627370496.0 + 1023.0);
    const double m = fromBits(bits - ((biased - 1023) << 52));

    const double f = (m - 1) / (m + 1);
    const double f2 = f * f;
    double s = 1.0 / 21.0;
    s = s * f2 + 1.0 / 19.0;
    s = s * f2 + 1.0 / 17.0;
    s = s * f2 + 1.0 / 15.0;
    s = s * f2 + 1.0 / 13.0;
    s = s * f2 + 1.0 / 11.0;
    s = s * f2 + 1.0 / 9.0;
    s = s * f2 + 1.0 / 7.0;
    s = s * f2 + 1.0 / 5.0;
    s = s * f2 + 1.0 / 3.0;
    s = s * f2 + 1.0;

    return e * 6.93147180369123816490e-01
        + (2 * f * s + e * 1.90821492927058770002e-10);
}

} // namespace vectorMath
} // namespace morph

#endif
