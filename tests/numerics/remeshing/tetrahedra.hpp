// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Tetrahedra and meshes of them that the tests of re-meshing share.

#ifndef morph_test_tetrahedra_hpp
#define morph_test_tetrahedra_hpp

#include "overlapTable.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace morph
{

using Corners = std::array<Vector3, 4>;

inline double signedVolume(const Corners& c)
{
    return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) / 6;
}


inline Corners unitCorners()
{
    return {
        Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
}


inline Eigen::Affine3d randomMotion(std::mt19937& generator)
{
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond q(
        normal(generator), normal(generator), normal(generator),
        normal(generator));
    return Eigen::Translation3d(
               normal(generator), normal(generator), normal(generator))
        * q.normalized();
}


inline Corners moved(Corners corners, const Eigen::Affine3d& motion)
{
    for (Vector3& x : corners)
    {
        x = motion * x;
    }
    return corners;
}


inline Vector3 randomPoint(std::mt19937& generator, const double scale = 1)
{
    std::uniform_real_distribution<double> uniform(0, scale);
    const double x = uniform(generator), y = uniform(generator);
    return Vector3(x, y, uniform(generator));
}


// A point in a tetrahedron; some on its faces, edges and corners
inline Vector3 pointIn(const Corners& corners, std::mt19937& generator)
{
    std::exponential_distribution<double> exponential;
    std::bernoulli_distribution zero(0.1);
    Eigen::Vector4d weight;
    do
    {
        for (int i = 0; i < 4; ++i)
        {
            weight[i] = zero(generator) ? 0 : exponential(generator);
        }
    } while (weight.sum() == 0);
    weight /= weight.sum();
    Vector3 x = Vector3::Zero();
    for (int i = 0; i < 4; ++i)
    {
        x += weight[i] * corners[i];
    }
    return x;
}


// Splits one tetrahedron about a point in it, again and again: most that come
// of it are slivers
inline std::vector<Corners>
splitted(const Corners& whole, const int times, std::mt19937& generator)
{
    std::vector<Corners> all{whole};
    for (int n = 0; n < times; ++n)
    {
        std::uniform_int_distribution<std::size_t> any(0, all.size() - 1);
        const std::size_t chosen = any(generator);
        const Corners old = all[chosen];
        const Vector3 x = pointIn(old, generator);
        all.erase(all.begin() + chosen);
        for (int i = 0; i < 4; ++i)
        {
            Corners part = old;
            part[i] = x;
            all.push_back(part);
        }
    }
    return all;
}


// The unit cube as n^3 cells, each of six tetrahedra around its diagonal;
// points go where place puts them
struct CubeMesh
{
    CubeMesh(const int n, const std::function<Vector3(const Vector3&)>& place)
    : n(n)
    {
        static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                        {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        tetrahedra.nCells = n * n * n;
        for (int cell = 0; cell < n * n * n; ++cell)
        {
            const Eigen::Vector3i low(cell % n, cell / n % n, cell / (n * n));
            for (int t = 0; t < 6; ++t)
            {
                Eigen::Vector3i at = low;
                Corners corners;
                corners[0] = place(at.cast<double>() / n);
                for (int i = 0; i < 3; ++i)
                {
                    ++at[order[t][i]];
                    corners[i + 1] = place(at.cast<double>() / n);
                }
                if (t >= 3)
                {
                    std::swap(corners[2], corners[3]);
                }
                tetrahedra.corners.push_back(corners);
                tetrahedra.cell.push_back(cell);
            }
        }
        volume = Eigen::VectorXd::Zero(tetrahedra.nCells);
        centre = Vectors::Zero(tetrahedra.nCells, 3);
        for (std::size_t t = 0; t < tetrahedra.corners.size(); ++t)
        {
            const Corners& c = tetrahedra.corners[t];
            const int cell = tetrahedra.cell[t];
            const double v = signedVolume(c);
            volume[cell] += v;
            centre.row(cell) += 0.25 * v * (c[0] + c[1] + c[2] + c[3]);
        }
        for (Index cell = 0; cell < centre.rows(); ++cell)
        {
            centre.row(cell) /= volume[cell];
        }
    }

    // Cells that share a corner
    void neighbours(std::vector<Index>& start, std::vector<int>& all) const
    {
        start.assign(1, 0);
        all.clear();
        for (int cell = 0; cell < n * n * n; ++cell)
        {
            const int i = cell % n, j = cell / n % n, k = cell / (n * n);
            for (int c = std::max(0, k - 1); c <= std::min(n - 1, k + 1); ++c)
            {
                for (int b = std::max(0, j - 1); b <= std::min(n - 1, j + 1);
                     ++b)
                {
                    for (int a = std::max(0, i - 1);
                         a <= std::min(n - 1, i + 1); ++a)
                    {
                        if (a != i || b != j || c != k)
                        {
                            all.push_back(a + n * (b + n * c));
                        }
                    }
                }
            }
            start.push_back(Index(all.size()));
        }
    }

    int n;
    CellTetrahedra tetrahedra;
    Eigen::VectorXd volume;
    Vectors centre;
};


// Moves points inside the unit cube, never by the same amount; those of its
// boundary along it
inline Vector3 jitter(const Vector3& x, const double amplitude, const int seed)
{
    Vector3 y = x;
    for (int i = 0; i < 3; ++i)
    {
        if (x[i] > 1e-12 && x[i] < 1 - 1e-12)
        {
            y[i] += amplitude
                * std::sin(
                        (17.3 + 3 * seed) * x[0] + (29.1 + seed) * x[1]
                        + (41.7 - seed) * x[2] + 5 * i + seed);
        }
    }
    return y;
}

} // namespace morph

#endif
