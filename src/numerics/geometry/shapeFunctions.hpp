// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Functions of the points of a surface, with their gradients: what an optimiser
// constrains.

#ifndef morph_shapeFunctions_hpp
#define morph_shapeFunctions_hpp

#include "surfaceMeasures.hpp"

#include <array>
#include <utility>
#include <vector>

namespace morph
{

// A number, and its derivative by the position of each point that matters
struct ShapeValue
{
    double value = 0;

    std::vector<std::pair<Index, Vector3>> gradient;

    // Derivative where the points move at these velocities (n x 3)
    double derivative(const Vectors& velocities) const;
};


// A place on a triangle, which goes with it
struct SurfacePlace
{
    std::array<Index, 3> points;

    // Barycentric coordinates, their sum is one
    std::array<double, 3> weights;

    Vector3 position(const Vectors& x) const;
};

// The place of the triangles that is nearest to a point. points: n x 3
SurfacePlace nearestPlace(
    const Vectors& points, const Triangles& triangles, const Vector3& x);

// Where the line through x along a direction meets the triangles nearest to x,
// once with negative and once with positive parameter. False if it does not on
// both sides
bool placesOnLine(
    const Vectors& points, const Triangles& triangles, const Vector3& x,
    const Vector3& direction, SurfacePlace& below, SurfacePlace& above);

// |a - b|; at zero the gradient is zero
ShapeValue
distance(const Vectors& points, const SurfacePlace& a, const SurfacePlace& b);

// d.x of a place
ShapeValue component(
    const Vectors& points, const SurfacePlace& place, const Vector3& direction);

// Sum of the areas of triangles as seen against a direction: those that face it
ShapeValue projectedArea(
    const Vectors& points, const Triangles& triangles,
    const Vector3& direction);

// Area of the part of the surface where normal.(x - origin) <= 0; all of it
// where the normal is zero
ShapeValue wettedArea(
    const Vectors& points, const Triangles& triangles, const Vector3& origin,
    const Vector3& normal);

// Edges with a triangle on either side: their two points, and the points
// opposite to them
using Hinge = std::array<Index, 4>;

std::vector<Hinge> hinges(const Triangles& triangles);

// Integral of the squared curvature across edges, sum of angle^2 length^2 /
// (A_1 + A_2) over edges with two triangles (Grinspun et al. 2003, Discrete
// shells, up to its factor): exact for cylinders in facets, without dimension
ShapeValue bending(const Vectors& points, const std::vector<Hinge>& hinges);

// 1/6 sum x_0.(x_1 x x_2) of a closed surface with normals outwards
ShapeValue volume(const Vectors& points, const Triangles& triangles);

// A component of the centroid of what a closed surface encloses
ShapeValue barycentre(
    const Vectors& points, const Triangles& triangles,
    const Vector3& direction);

} // namespace morph

#endif
