// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "wendlandSum.hpp"

// For GCC only. MORPH_NO_AVX512 builds what other machines use
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) \
    && !defined(MORPH_NO_AVX512)

    // GCC's intrinsics contain a deliberately uninitialised variable
    #pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

    #include <algorithm>
    #include <immintrin.h>

    #define AVX512 __attribute__((target("avx512f")))
    #define AVX512_INLINE \
        inline __attribute__((target("avx512f"), always_inline))

namespace morph
{

namespace
{

using Eight = __m512d;

// Of a block of points, by eights
constexpr int eights = blockSize / 8;

using Distances = Eight[eights];

struct Columns3
{
    const double* x;
    const double* y;
    const double* z;
};

struct Sums
{
    Eight x[eights];
    Eight y[eights];
    Eight z[eights];
};


AVX512_INLINE Eight number(double value)
{
    return _mm512_set1_pd(value);
}


struct SquareRoot
{
    AVX512_INLINE static Eight of(Eight d2) { return _mm512_sqrt_pd(d2); }
};


// y = (1 + a)/sqrt(x), |a| < 2^-14, leaves e = 1 - x y^2; the root is
//     x y (1 - e)^(-1/2) = x y (1 + e/2 + 3/8 e^2 + 5/16 e^3 + ...)
// whose first term left out is below 2^-53. The addition that keeps y finite
// is lost in all numbers but those whose roots, like zero, give phi = 1.
struct ApproximateRoot
{
    AVX512_INLINE static Eight of(Eight d2)
    {
        const Eight x = d2 + number(1e-300);
        const Eight y = _mm512_rsqrt14_pd(x);
        const Eight root = x * y;
        const Eight e = _mm512_fnmadd_pd(root, y, number(1));
        Eight series = _mm512_fmadd_pd(e, number(5.0 / 16), number(3.0 / 8));
        series = _mm512_fmadd_pd(series, e, number(0.5));
        return _mm512_fmadd_pd(root * e, series, root);
    }
};


// The formulas of radialFunctions.hpp, m = 1 - d

struct C0
{
    AVX512_INLINE static Eight value(Eight, Eight m) { return m * m; }
};

struct C2
{
    AVX512_INLINE static Eight value(Eight d, Eight m)
    {
        const Eight m2 = m * m;
        return m2 * m2 * _mm512_fmadd_pd(d, number(4), number(1));
    }
};

struct C4
{
    AVX512_INLINE static Eight value(Eight d, Eight m)
    {
        const Eight m2 = m * m;
        Eight p = _mm512_fmadd_pd(d, number(35), number(18));
        p = _mm512_fmadd_pd(p, d, number(3));
        return m2 * m2 * m2 * p * number(1.0 / 3.0);
    }
};

struct C6
{
    AVX512_INLINE static Eight value(Eight d, Eight m)
    {
        const Eight m2 = m * m;
        const Eight m4 = m2 * m2;
        Eight p = _mm512_fmadd_pd(d, number(32), number(25));
        p = _mm512_fmadd_pd(p, d, number(8));
        p = _mm512_fmadd_pd(p, d, number(1));
        return m4 * m4 * p;
    }
};


// Of a block of points from centre j
template <class Root>
AVX512_INLINE void distances(
    const Columns3& points, const Columns3& centres, Index j, Distances& d)
{
    const Eight cx = number(centres.x[j]);
    const Eight cy = number(centres.y[j]);
    const Eight cz = number(centres.z[j]);
    for (int k = 0; k < eights; ++k)
    {
        const Eight dx = _mm512_loadu_pd(points.x + 8 * k) - cx;
        const Eight dy = _mm512_loadu_pd(points.y + 8 * k) - cy;
        const Eight dz = _mm512_loadu_pd(points.z + 8 * k) - cz;
        const Eight d2 =
            _mm512_fmadd_pd(dz, dz, _mm512_fmadd_pd(dy, dy, dx * dx));
        d[k] = Root::of(d2);
    }
}


template <class Formula>
AVX512_INLINE void addTerm(
    const Distances& distances, const Columns3& weights, Index j, Sums& sums)
{
    const Eight wx = number(weights.x[j]);
    const Eight wy = number(weights.y[j]);
    const Eight wz = number(weights.z[j]);
    for (int k = 0; k < eights; ++k)
    {
        const Eight d = _mm512_min_pd(distances[k], number(1));
        const Eight phi = Formula::value(d, number(1) - d);
        sums.x[k] = _mm512_fmadd_pd(phi, wx, sums.x[k]);
        sums.y[k] = _mm512_fmadd_pd(phi, wy, sums.y[k]);
        sums.z[k] = _mm512_fmadd_pd(phi, wz, sums.z[k]);
    }
}


AVX512_INLINE void
addTo(double* sum, const Eight (&a)[eights], const Eight (&b)[eights])
{
    for (int k = 0; k < eights; ++k)
    {
        const Eight former = _mm512_loadu_pd(sum + 8 * k);
        _mm512_storeu_pd(sum + 8 * k, former + (a[k] + b[k]));
    }
}


// Of one group, three centres with a root and one without in turn. The
// distances are a centre ahead of the terms: while a root is made, the terms of
// the centre before keep the other units busy. `now` are the distances of the
// group's first centre with a root, and become those of the next group's.
template <class Formula>
AVX512_INLINE void addGroup(
    const Columns3& points, const Columns3& centres, const Columns3& weights,
    const CentreGroup& group, Index last, Distances& now, Sums& withRoots,
    Sums& without)
{
    Distances next;
    Index i = group.begin;
    Index j = group.rootlessBegin;
    for (; i + 3 <= group.end && j < group.rootlessEnd; i += 3, ++j)
    {
        distances<ApproximateRoot>(points, centres, j, next);
        addTerm<Formula>(now, weights, i, withRoots);
        distances<SquareRoot>(points, centres, i + 1, now);
        addTerm<Formula>(next, weights, j, without);
        distances<SquareRoot>(points, centres, i + 2, next);
        addTerm<Formula>(now, weights, i + 1, withRoots);
        distances<SquareRoot>(points, centres, std::min(i + 3, last), now);
        addTerm<Formula>(next, weights, i + 2, withRoots);
    }
    Distances apart;
    for (; i < group.end && j < group.rootlessEnd; ++i, ++j)
    {
        distances<SquareRoot>(points, centres, std::min(i + 1, last), next);
        distances<ApproximateRoot>(points, centres, j, apart);
        addTerm<Formula>(now, weights, i, withRoots);
        addTerm<Formula>(apart, weights, j, without);
        std::copy(next, next + eights, now);
    }
    for (; i < group.end; ++i)
    {
        distances<SquareRoot>(points, centres, std::min(i + 1, last), next);
        addTerm<Formula>(now, weights, i, withRoots);
        std::copy(next, next + eights, now);
    }
    for (; j < group.rootlessEnd; ++j)
    {
        distances<ApproximateRoot>(points, centres, j, next);
        addTerm<Formula>(next, weights, j, without);
    }
}


template <class Formula>
AVX512 void addBlock(
    const Columns3& points, const Columns3& centres, const Columns3& weights,
    const std::vector<CentreGroup>& groups, double* const sums[3], Index begin)
{
    const Index first = groups.front().begin;
    const Index last = groups.back().end - 1;
    Distances now = {};
    if (first <= last)
    {
        distances<SquareRoot>(points, centres, first, now);
    }
    for (const CentreGroup& group : groups)
    {
        Sums withRoots = {};
        Sums without = {};
        addGroup<Formula>(
            points, centres, weights, group, last, now, withRoots, without);
        addTo(sums[0] + begin, withRoots.x, without.x);
        addTo(sums[1] + begin, withRoots.y, without.y);
        addTo(sums[2] + begin, withRoots.z, without.z);
    }
}


template <class Formula>
void addBlocks(
    const double* const points[3], Index nPoints, const Columns3& centres,
    const Columns3& weights, const std::vector<CentreGroup>& groups,
    double* const sums[3])
{
    for (Index i = 0; i < nPoints; i += blockSize)
    {
        addBlock<Formula>(
            {points[0] + i, points[1] + i, points[2] + i}, centres, weights,
            groups, sums, i);
    }
}

} // namespace


bool hasWendlandSum(KernelType type)
{
    static const bool hasInstructions = __builtin_cpu_supports("avx512f");
    return hasInstructions
        && (type == KernelType::wendlandC0 || type == KernelType::wendlandC2
            || type == KernelType::wendlandC4
            || type == KernelType::wendlandC6);
}


void addWendlandSum(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const double* const weights[3],
    const std::vector<CentreGroup>& groups, double* const sums[3])
{
    if (groups.empty())
    {
        return;
    }
    const Columns3 c{centres[0], centres[1], centres[2]};
    const Columns3 w{weights[0], weights[1], weights[2]};
    const auto add = type == KernelType::wendlandC0 ? addBlocks<C0>
        : type == KernelType::wendlandC2            ? addBlocks<C2>
        : type == KernelType::wendlandC4            ? addBlocks<C4>
                                                    : addBlocks<C6>;
    add(points, nPoints, c, w, groups, sums);
}

} // namespace morph

#else

namespace morph
{

bool hasWendlandSum(KernelType)
{
    return false;
}


void addWendlandSum(
    KernelType, const double* const[3], Index, const double* const[3],
    const double* const[3], const std::vector<CentreGroup>&, double* const[3])
{
}

} // namespace morph

#endif
