// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Times of one pair of point and centre in the sums and matrices of kernels,
// beside what the machine could do: a square root and the multiply-adds of a
// pair at its full rate. Google Benchmark; the counter `pair` is seconds.

#include "kernelSum.hpp"
#include "pointCloud.hpp"
#include "rbfInterpolant.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

// As the loops measured (kernelSum.cpp)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
    #if __GNUC__ >= 12
        #define MULTIVERSION __attribute__((target_clones \
            ("arch=x86-64-v4", "arch=x86-64-v3", "default")))
    #else
        #define MULTIVERSION __attribute__((target_clones \
            ("avx512f", "avx2", "default")))
    #endif
#else
    #define MULTIVERSION
#endif

using namespace morph;

namespace
{

// Arithmetic of a pair with Wendland C2 beside the square root, a multiply-add
// counting once: 3 differences, 3 for the square, clamping, 5 for the formula,
// 3 for the sums
constexpr int operationsOfPair = 15;

constexpr Index nPoints = 100000;
constexpr Index nCentres = 1000;


Columns randomPoints(Index n, unsigned seed)
{
    std::mt19937_64 engine(seed);
    Columns x(n, 3);
    for (Index i = 0; i < x.size(); ++i)
    {
        x.data()[i] = std::ldexp(double(engine() >> 11), -53);
    }
    return x;
}


void countPairs(benchmark::State& state, double pairs)
{
    state.counters["pair"] = benchmark::Counter
    (
        pairs,
        benchmark::Counter::kIsIterationInvariantRate
      | benchmark::Counter::kInvert
    );
}


// 64 sums, so that no operation waits for the one before
constexpr int lanes = 64;


MULTIVERSION
void roots(const double* __restrict__ x, int repetitions, double* __restrict__ s)
{
    for (int k = 0; k < repetitions; ++k)
    {
        for (int i = 0; i < lanes; ++i)
        {
            s[i] += std::sqrt(x[i] + k);
        }
    }
}


MULTIVERSION
void multiplyAdds(const double* __restrict__ x, int repetitions,
    double* __restrict__ sums)
{
    // Small enough to stay in registers
    double s[lanes];
    for (int i = 0; i < lanes; ++i)
    {
        s[i] = sums[i];
    }
    const double a = x[0], b = x[1];
    for (int k = 0; k < repetitions; ++k)
    {
        for (int i = 0; i < lanes; ++i)
        {
            s[i] = s[i]*a + b;
        }
    }
    for (int i = 0; i < lanes; ++i)
    {
        sums[i] = s[i];
    }
}


void limitOfRoots(benchmark::State& state)
{
    double x[lanes], s[lanes] = {};
    for (int i = 0; i < lanes; ++i)
    {
        x[i] = 0.5 + i;
    }
    constexpr int repetitions = 1000;
    for (auto _ : state)
    {
        roots(x, repetitions, s);
        benchmark::DoNotOptimize(s);
    }
    countPairs(state, double(lanes)*repetitions);
}


void limitOfMultiplyAdds(benchmark::State& state)
{
    double x[2] = {0.999, 0.001}, s[lanes] = {};
    constexpr int repetitions = 10000;
    for (auto _ : state)
    {
        benchmark::DoNotOptimize(x);
        multiplyAdds(x, repetitions, s);
        benchmark::DoNotOptimize(s);
    }
    countPairs(state, double(lanes)*repetitions/operationsOfPair);
}


void kernelSum(benchmark::State& state, KernelType type)
{
    const Index n = 512;
    const Columns x = randomPoints(n, 1), c = randomPoints(nCentres, 2);
    const Columns w = randomPoints(nCentres, 3);
    Columns s = Columns::Zero(n, 3);
    const double* const xs[3] = {&x(0, 0), &x(0, 1), &x(0, 2)};
    const double* const cs[3] = {&c(0, 0), &c(0, 1), &c(0, 2)};
    const double* const ws[3] = {&w(0, 0), &w(0, 1), &w(0, 2)};
    double* const ss[3] = {&s(0, 0), &s(0, 1), &s(0, 2)};
    std::vector<CentreGroup> groups;
    const Index nRooted = nCentres*rootsOfGroup/groupSize;
    CentreGroup group = {0, 0, nRooted, nRooted};
    while (group.end < nRooted)
    {
        group.begin = group.end;
        group.end = std::min(group.end + rootsOfGroup, nRooted);
        group.rootlessBegin = group.rootlessEnd;
        group.rootlessEnd = std::min
        (
            group.rootlessEnd + groupSize - rootsOfGroup, nCentres
        );
        groups.push_back(group);
    }
    for (auto _ : state)
    {
        addKernelSum(type, xs, n, cs, ws, groups, ss);
        benchmark::DoNotOptimize(s.data());
    }
    countPairs(state, double(n)*nCentres);
}


void matrix(benchmark::State& state)
{
    const Kernel kernel(KernelType::wendlandC2, 1);
    const Columns a = randomPoints(2000, 1), b = randomPoints(500, 2);
    for (auto _ : state)
    {
        const Matrix phi = kernelMatrix(kernel, a, b);
        benchmark::DoNotOptimize(phi.data());
    }
    countPairs(state, 2000.0*500.0);
}


// The points once sorted into a cloud, as a mesh is
void interpolant(benchmark::State& state, KernelType type, double radius)
{
    const PointCloud cloud(randomPoints(nPoints, 1));
    RbfInterpolant s{Kernel(type, radius)};
    s.set(randomPoints(nCentres, 2), randomPoints(nCentres, 3));

    const Columns& c = s.centres();
    double reached = 0;
    for (const PointCloud::Leaf& leaf : cloud.leaves())
    {
        for (Index j = 0; j < nCentres; ++j)
        {
            const Vector3 centre = c.row(j).transpose();
            reached += leaf.count*
                (!s.kernel().compact()
              || leaf.distance2(centre) < radius*radius);
        }
    }

    for (auto _ : state)
    {
        const Vectors values = s(cloud);
        benchmark::DoNotOptimize(values.data());
    }
    countPairs(state, double(nPoints)*nCentres);
    state.counters["reached"] = reached/(double(nPoints)*nCentres);
}


// What one would write without a thought: points one after the other, a pair
// at a time
template<class Formula>
void naive(benchmark::State& state, const Formula& phi)
{
    const Index n = 2000;
    const Vectors x = randomPoints(n, 1), c = randomPoints(nCentres, 2);
    const Vectors w = randomPoints(nCentres, 3);
    Vectors s = Vectors::Zero(n, 3);
    for (auto _ : state)
    {
        for (Index i = 0; i < n; ++i)
        {
            Vector3 sum = Vector3::Zero();
            for (Index j = 0; j < nCentres; ++j)
            {
                const Eigen::RowVector3d d = x.row(i) - c.row(j);
                sum += phi(d.norm())*w.row(j).transpose();
            }
            s.row(i) = sum.transpose();
        }
        benchmark::DoNotOptimize(s.data());
    }
    countPairs(state, double(n)*nCentres);
}


void naivePowers(benchmark::State& state)
{
    // As numbers the compiler does not know, like those of a dictionary
    volatile double exponent = 4;
    const double power = exponent;
    naive(state, [=](double d)
    {
        return d < 1 ? std::pow(1 - d, power)*(4*d + 1) : 0;
    });
}


void naiveProducts(benchmark::State& state)
{
    naive(state, [](double d)
    {
        const double m = 1 - d;
        return d < 1 ? m*m*m*m*(4*d + 1) : 0;
    });
}

} // namespace


int main(int argc, char** argv)
{
    const auto add = [](const std::string& name, auto&&... arguments)
    {
        benchmark::RegisterBenchmark(name.c_str(), arguments...)
            ->Unit(benchmark::kMillisecond);
    };

    add("limit/squareRoot", limitOfRoots);
    add("limit/multiplyAdds", limitOfMultiplyAdds);
    for (const auto& kernel : kernelNames())
    {
        add("sum/" + kernel.second, kernelSum, kernel.first);
    }
    for (const auto& kernel : kernelNames())
    {
        // No centre out of reach
        add("interpolant/" + kernel.second, interpolant, kernel.first, 2.0);
    }
    for (const char* radius : {"0.6", "0.3", "0.15"})
    {
        add
        (
            std::string("culled/") + radius, interpolant,
            KernelType::wendlandC2, std::stod(radius)
        );
    }
    add("matrix/wendlandC2", matrix);
    add("naive/powers", naivePowers);
    add("naive/products", naiveProducts);

    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
