// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Times a selection on a set of control points from a file.
//
//     benchmarkSelection POINTS [-algorithm incremental|schur|standard]
//         [-tolerance T] [-maxPoints N] [-pointsPerSweep N]
//         [-restartFraction F] [-repeats N] [-trajectory FILE] [-selected FILE]
//
// Prints one JSON object in one line per repetition. A trajectory is a table
// of what had been reached after each sweep: where points are added one by one,
// one run gives the cost of all smaller selections as well.
//
// POINTS: first line `# name=... dim=... r0=... smax=... n=...`, then a line
// `x y z  k  c1 c2  s` per point: k = dim prescribes the displacement s, k = 1
// slides on a surface of normal c1, k = 2 in 3D along an edge of normals c1, c2.

#include "greedySelection.hpp"

#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace morph;

namespace
{

struct PointSet
{
    std::string name;
    double supportRadius = 0;
    ControlPoints points;
};


// The value of a key in the first line of a point set
std::string header(const std::string& line, const std::string& key)
{
    const std::size_t at = line.find(" " + key + "=");
    if (at == std::string::npos)
    {
        throw std::runtime_error("no " + key + "= in the line: " + line);
    }
    const std::size_t from = at + key.size() + 2;
    return line.substr(from, line.find(' ', from) - from);
}


PointSet read(const std::string& file)
{
    std::ifstream in(file);
    std::string line;
    if (!std::getline(in, line))
    {
        throw std::runtime_error("cannot read " + file);
    }
    PointSet set;
    set.name = header(line, "name");
    set.supportRadius = std::stod(header(line, "r0"));
    const int dimensions = std::stoi(header(line, "dim"));

    Vector3 x, n1, n2, s;
    int k;
    while
    (
        in >> x[0] >> x[1] >> x[2] >> k
           >> n1[0] >> n1[1] >> n1[2] >> n2[0] >> n2[1] >> n2[2]
           >> s[0] >> s[1] >> s[2]
    )
    {
        set.points.push_back
        (
            k == dimensions ? ControlPoint::prescribed(x, s)
          : k == 1 ? ControlPoint::sliding(x, {n1}, s)
          : ControlPoint::sliding(x, {n1, n2}, s)
        );
    }
    if (set.points.size() != std::stoul(header(line, "n")))
    {
        throw std::runtime_error(file + " has not as many points as it says");
    }
    return set;
}


struct Options
{
    std::string file;
    SelectionSettings settings;
    int repeats = 1;
    std::string trajectory;
    std::string selected;
};


Options parse(int argc, char** argv)
{
    Options options;
    std::map<std::string, std::string> given;
    for (int i = 1; i < argc; ++i)
    {
        const std::string word = argv[i];
        if (word[0] != '-')
        {
            options.file = word;
        }
        else if (++i < argc)
        {
            given[word.substr(1)] = argv[i];
        }
    }

    SelectionSettings& settings = options.settings;
    for (const auto& option : given)
    {
        const std::string& name = option.first;
        const std::string& value = option.second;
        if (name == "algorithm")
        {
            bool known = false;
            for (const auto& algorithm : algorithmNames())
            {
                if (algorithm.second == value)
                {
                    settings.algorithm = algorithm.first;
                    known = true;
                }
            }
            if (!known)
            {
                throw std::runtime_error("no algorithm " + value);
            }
        }
        else if (name == "tolerance") settings.tolerance = std::stod(value);
        else if (name == "maxPoints") settings.maxPoints = std::stol(value);
        else if (name == "pointsPerSweep")
        {
            settings.pointsPerSweep = std::stol(value);
        }
        else if (name == "restartFraction")
        {
            settings.restartFraction = std::stod(value);
        }
        else if (name == "repeats") options.repeats = std::stoi(value);
        else if (name == "trajectory") options.trajectory = value;
        else if (name == "selected") options.selected = value;
        else throw std::runtime_error("no option -" + name);
    }
    return options;
}


// A figure in kB from /proc/self/status, in bytes
double statusBytes(const std::string& key)
{
    std::ifstream status("/proc/self/status");
    std::string line;
    while (std::getline(status, line))
    {
        if (line.compare(0, key.size() + 1, key + ":") == 0)
        {
            return 1024*std::stod(line.substr(key.size() + 1));
        }
    }
    return 0;
}


// From here on the peak of this process's memory is that of what follows; where
// the kernel does not know how to, it remains that of all before
void forgetPeak()
{
    std::ofstream("/proc/self/clear_refs") << "5\n";
}


double cpuSeconds()
{
    return double(std::clock())/CLOCKS_PER_SEC;
}


double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>
        (std::chrono::steady_clock::now() - start).count();
}


// Largest difference, at some of the points, from the sum in long double; as a
// fraction of the largest displacement
double evaluationError
(
    const RbfInterpolant& interpolant,
    const ControlPoints& points,
    double largestDisplacement
)
{
    const Index stride = std::max<Index>(1, points.size()/500);
    const Index n = points.size()/stride;
    Vectors x(n, 3);
    for (Index i = 0; i < n; ++i)
    {
        x.row(i) = points[i*stride].position.transpose();
    }
    const Vectors s = interpolant(x);

    const Columns& centres = interpolant.centres();
    const Columns& weights = interpolant.weights();
    const long double r0 = interpolant.kernel().supportRadius();
    long double largest = 0;
    for (Index i = 0; i < n; ++i)
    {
        long double sum[3] = {0, 0, 0};
        for (Index j = 0; j < centres.rows(); ++j)
        {
            long double d2 = 0;
            for (int a = 0; a < 3; ++a)
            {
                const long double d = (long double)x(i, a) - centres(j, a);
                d2 += d*d;
            }
            const long double d = std::sqrt(d2)/r0;
            const long double m = d < 1 ? 1 - d : 0;
            for (int a = 0; a < 3; ++a)
            {
                sum[a] += m*m*m*m*(4*d + 1)*weights(j, a);
            }
        }
        for (int a = 0; a < 3; ++a)
        {
            largest = std::max(largest, std::abs(sum[a] - s(i, a)));
        }
    }
    return double(largest/largestDisplacement);
}


// The linear algebra's own pages, which the first products bring into memory,
// are no part of a selection
void warmUp
(
    const PointSet& set,
    const Kernel& kernel,
    SelectionSettings settings
)
{
    settings.maxPoints = 50;
    settings.tolerance = 0;
    const std::size_t few = std::min<std::size_t>(300, set.points.size());
    SerialCommunicator alone;
    GreedySelection(kernel, Polynomial::none, settings).select
    (
        ControlPoints(set.points.begin(), set.points.begin() + few), alone
    );
    malloc_trim(0);
}


void run(const Options& options)
{
    const PointSet set = read(options.file);
    const Kernel kernel(KernelType::wendlandC2, set.supportRadius);
    std::FILE* trajectory = nullptr;
    if (!options.trajectory.empty())
    {
        trajectory = std::fopen(options.trajectory.c_str(), "w");
        if (!trajectory)
        {
            throw std::runtime_error("cannot write " + options.trajectory);
        }
        std::fprintf(trajectory, "run,selected,error,seconds\n");
    }

    warmUp(set, kernel, options.settings);
    const double before = statusBytes("VmRSS");
    for (int i = 0; i < options.repeats; ++i)
    {
        SerialCommunicator alone;
        GreedySelection::Observer observer;
        forgetPeak();
        const double cpuStart = cpuSeconds();
        const auto start = std::chrono::steady_clock::now();
        if (trajectory)
        {
            observer = [&](const SelectionResult& result)
            {
                std::fprintf
                (
                    trajectory, "%d,%ld,%.6e,%.6e\n", i, long(result.selected),
                    result.largestError/result.largestDisplacement,
                    secondsSince(start)
                );
            };
        }
        GreedySelection selection(kernel, Polynomial::none, options.settings);
        const SelectionResult result =
            selection.select(set.points, alone, observer);
        const double total = secondsSince(start);
        const double cpu = cpuSeconds() - cpuStart;
        const double peak = statusBytes("VmHWM") - before;
        malloc_trim(0);
        const double kept = statusBytes("VmRSS") - before;

        std::printf
        (
            "{\"set\": \"%s\", \"candidates\": %ld, \"selected\": %ld, "
            "\"rejected\": %ld, \"error\": %.6e, \"sweeps\": %ld, \"whole\": %ld, "
            "\"sweep\": %.6f, \"list\": %.6f, \"solve\": %.6f, "
            "\"total\": %.6f, \"cpu\": %.6f, \"peakMB\": %.2f, "
            "\"keptMB\": %.2f, \"roundOff\": %.3e, "
            "\"evaluationError\": %.3e}\n",
            set.name.c_str(), long(result.candidates), long(result.selected),
            long(result.rejected),
            result.largestError/result.largestDisplacement,
            long(result.sweeps), long(result.wholeSweeps), result.sweepTime, result.listTime,
            result.solveTime, total, cpu, peak*1e-6, kept*1e-6,
            result.roundOff/result.largestDisplacement,
            evaluationError
            (
                selection.interpolant(), set.points, result.largestDisplacement
            )
        );
        std::fflush(stdout);

        if (!options.selected.empty() && i == 0)
        {
            std::ofstream out(options.selected);
            for (const Index index : selection.selected())
            {
                out << index << '\n';
            }
        }
    }
    if (trajectory)
    {
        std::fclose(trajectory);
    }
}

} // namespace


int main(int argc, char** argv)
{
    try
    {
        run(parse(argc, argv));
        return 0;
    }
    catch (const std::exception& wrong)
    {
        std::cerr << "benchmarkSelection: " << wrong.what() << '\n';
        return 1;
    }
}
