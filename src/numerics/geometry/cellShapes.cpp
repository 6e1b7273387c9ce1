// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cellShapes.hpp"

#include "multiVersion.hpp"

#include <algorithm>

#define MORPH_INLINE inline __attribute__((always_inline))

namespace morph
{

namespace
{

// Of so many cells at a time
constexpr int lanes = 8;
using Eight = double __attribute__((vector_size(8 * lanes)));

// Triangles end with -1

struct Tetrahedron
{
    static constexpr int points = 4;
    static constexpr int faces = 4;
    static constexpr int corners[faces][4] =
        {{0, 1, 2, -1}, {1, 0, 3, -1}, {2, 1, 3, -1}, {0, 2, 3, -1}};
};

struct Pyramid
{
    static constexpr int points = 5;
    static constexpr int faces = 5;
    static constexpr int corners[faces][4] = {
        {0, 1, 2, 3},
        {1, 0, 4, -1},
        {2, 1, 4, -1},
        {3, 2, 4, -1},
        {0, 3, 4, -1}};
};

struct Prism
{
    static constexpr int points = 6;
    static constexpr int faces = 5;
    static constexpr int corners[faces][4] = {
        {0, 1, 2, -1},
        {1, 0, 3, 4},
        {2, 1, 4, 5},
        {0, 2, 5, 3},
        {5, 4, 3, -1}};
};

struct Hexahedron
{
    static constexpr int points = 8;
    static constexpr int faces = 6;
    static constexpr int corners[faces][4] = {{0, 1, 2, 3}, {1, 0, 4, 5},
                                              {2, 1, 5, 6}, {3, 2, 6, 7},
                                              {0, 3, 7, 4}, {7, 6, 5, 4}};
};


// Of vectors: an argument would be passed differently by each instruction set
MORPH_INLINE void larger(Eight& a, const Eight& b)
{
    a = a > b ? a : b;
}


MORPH_INLINE void absolute(Eight& a)
{
    larger(a, -a);
}


// The mean of t at the points of a face, and the largest at the centroids of
// its triangles
MORPH_INLINE void
atFace(const int* corners, const Eight* t, Eight& mean, Eight& largest)
{
    const int a = corners[0], b = corners[1], c = corners[2], d = corners[3];
    if (d < 0)
    {
        mean = (t[a] + t[b] + t[c]) * (1.0 / 3);
        largest = mean;
        return;
    }
    const Eight ab = t[a] + t[b], cd = t[c] + t[d];
    mean = (ab + cd) * 0.25;
    largest = ab;
    larger(largest, cd);
    larger(largest, t[b] + t[c]);
    larger(largest, t[d] + t[a]);
    largest = (largest + mean) * (1.0 / 3);
}


// The area vector of a face
MORPH_INLINE void area(
    const int* corners, const Eight* x, const Eight* y, const Eight* z,
    Eight& ax, Eight& ay, Eight& az)
{
    const int a = corners[0], b = corners[1], c = corners[2];
    const int d = corners[3] < 0 ? a : corners[3];
    const Eight ux = x[c] - x[a], uy = y[c] - y[a], uz = z[c] - z[a];
    const Eight vx = x[d] - x[b], vy = y[d] - y[b], vz = z[d] - z[b];
    ax = 0.5 * (uy * vz - uz * vy);
    ay = 0.5 * (uz * vx - ux * vz);
    az = 0.5 * (ux * vy - uy * vx);
}


// Zero for those that are proven valid. By selections between numbers: of masks
// GCC makes eight comparisons. Each ends in the other one where a number is none
template <class Shape>
MORPH_INLINE void prove(
    const Eight* x, const Eight* y, const Eight* z, const Eight& roundOff,
    Eight& failed)
{
    failed = Eight{};
    const Eight one = Eight{} + 1;
#pragma GCC unroll 6
    for (int f = 0; f < Shape::faces; ++f)
    {
        const int* corners = Shape::corners[f];
        Eight ax, ay, az;
        area(corners, x, y, z, ax, ay, az);
        Eight t[Shape::points];
#pragma GCC unroll 8
        for (int j = 0; j < Shape::points; ++j)
        {
            t[j] = ax * x[j] + ay * y[j] + az * z[j];
        }
        Eight here, unused;
        atFace(corners, t, here, unused);
        Eight sum{}, least{};
#pragma GCC unroll 6
        for (int k = 0; k < Shape::faces; ++k)
        {
            if (k != f)
            {
                Eight mean, largest;
                atFace(Shape::corners[k], t, mean, largest);
                const Eight distance = here - largest;
                sum += distance;
                least = distance < least ? distance : least;
            }
        }
        const Eight bound = sum * (0.25 / Shape::faces) + 0.75 * least;
        failed = bound > roundOff ? failed : one;
    }
}


template <class Shape>
MORPH_INLINE void collect(
    const std::int32_t* labels, Index n, const double* points,
    std::vector<Index>& doubtful)
{
    constexpr int nPoints = Shape::points;
    for (Index start = 0; start < n; start += lanes)
    {
        Eight x[nPoints], y[nPoints], z[nPoints];
        for (int i = 0; i < lanes; ++i)
        {
            // Of what is missing at the end, the last cell again
            const std::int32_t* cell =
                labels + nPoints * std::min<Index>(start + i, n - 1);
            for (int j = 0; j < nPoints; ++j)
            {
                const double* p = points + 3 * std::size_t(cell[j]);
                x[j][i] = p[0];
                y[j][i] = p[1];
                z[j][i] = p[2];
            }
        }

        // The largest coordinate, and the square of the size
        Eight farthest{}, size{};
        const Eight x0 = x[0], y0 = y[0], z0 = z[0];
        for (int j = 0; j < nPoints; ++j)
        {
            Eight u = x[j], v = y[j], w = z[j];
            absolute(u);
            absolute(v);
            absolute(w);
            larger(farthest, u);
            larger(farthest, v);
            larger(farthest, w);
            x[j] -= x0;
            y[j] -= y0;
            z[j] -= z0;
            larger(size, x[j] * x[j] + y[j] * y[j] + z[j] * z[j]);
        }

        // A cell so small that OpenFOAM takes the area of its faces for zero
        // is not proven
        Eight failed;
        prove<Shape>(x, y, z, cellRoundOff * farthest * size + 1e-100, failed);
        for (int i = 0; i < lanes && start + i < n; ++i)
        {
            if (failed[i] != 0)
            {
                doubtful.push_back(start + i);
            }
        }
    }
}


MORPH_MULTIVERSION void tetrahedra(
    const std::int32_t* labels, Index n, const double* points,
    std::vector<Index>& doubtful)
{
    collect<Tetrahedron>(labels, n, points, doubtful);
}


MORPH_MULTIVERSION void pyramids(
    const std::int32_t* labels, Index n, const double* points,
    std::vector<Index>& doubtful)
{
    collect<Pyramid>(labels, n, points, doubtful);
}


MORPH_MULTIVERSION void prisms(
    const std::int32_t* labels, Index n, const double* points,
    std::vector<Index>& doubtful)
{
    collect<Prism>(labels, n, points, doubtful);
}


MORPH_MULTIVERSION void hexahedra(
    const std::int32_t* labels, Index n, const double* points,
    std::vector<Index>& doubtful)
{
    collect<Hexahedron>(labels, n, points, doubtful);
}


template <class Shape>
std::vector<std::vector<int>> facesOf()
{
    std::vector<std::vector<int>> faces;
    for (const auto& corners : Shape::corners)
    {
        faces.emplace_back(corners, corners + (corners[3] < 0 ? 3 : 4));
    }
    return faces;
}

} // namespace


int nPoints(const CellShape shape)
{
    constexpr int n[nCellShapes] = {
        Tetrahedron::points, Pyramid::points, Prism::points,
        Hexahedron::points};
    return n[int(shape)];
}


const std::vector<std::vector<int>>& faces(const CellShape shape)
{
    static const std::vector<std::vector<int>> all[nCellShapes] = {
        facesOf<Tetrahedron>(), facesOf<Pyramid>(), facesOf<Prism>(),
        facesOf<Hexahedron>()};
    return all[int(shape)];
}


std::vector<Index> notProven(
    const CellShape shape, const std::int32_t* labels, const Index n,
    const double* points)
{
    std::vector<Index> doubtful;
    switch (shape)
    {
    case CellShape::tetrahedron:
        tetrahedra(labels, n, points, doubtful);
        break;
    case CellShape::pyramid:
        pyramids(labels, n, points, doubtful);
        break;
    case CellShape::prism:
        prisms(labels, n, points, doubtful);
        break;
    case CellShape::hexahedron:
        hexahedra(labels, n, points, doubtful);
        break;
    }
    return doubtful;
}

} // namespace morph
