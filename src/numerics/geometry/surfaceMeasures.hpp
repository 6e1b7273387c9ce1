// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Area, volume and centroids of a triangulated surface, and their derivatives.

#ifndef morph_surfaceMeasures_hpp
#define morph_surfaceMeasures_hpp

#include "arrays.hpp"

namespace morph
{

using Triangles = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;

struct SurfaceMeasures
{
    double area = 0;                        // [m^2]
    Vector3 areaCentroid = Vector3::Zero(); // of the surface [m]

    // Of the body inside a closed surface with outward normals; for an open
    // surface they depend on the origin
    double volume = 0;                        // [m^3]
    Vector3 volumeCentroid = Vector3::Zero(); // [m]
};

// points: n x 3 [m]; triangles: m x 3 indices of points. Exact for the flat
// triangles: volume = 1/6 sum x_0.(x_1 x x_2), by the divergence theorem. The
// centroid of a surface without area, or a body without volume, is the mean of
// its points.
SurfaceMeasures
surfaceMeasures(const Vectors& points, const Triangles& triangles);

// Derivative of all measures where the points move at the given velocities
// (n x 3), for example dx/dmu
SurfaceMeasures surfaceMeasuresDerivative(
    const Vectors& points, const Triangles& triangles,
    const Vectors& velocities);

// Does every edge belong to two triangles with opposite directions?
bool isClosed(const Triangles& triangles);

} // namespace morph

#endif
