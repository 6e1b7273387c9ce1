// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The conditions of points that slide on curved surfaces.

#ifndef morph_slidingCondition_hpp
#define morph_slidingCondition_hpp

#include "controlPoints.hpp"

namespace morph
{

// Nearest tangent planes of the surfaces that a point must be on: one for a
// surface, two for an edge
struct TangentPlanes
{
    int k = 0;

    // Unit normals, in columns
    Eigen::Matrix<double, 3, 2> normals = Eigen::Matrix<double, 3, 2>::Zero();

    // Distance of the point above each plane [m]
    Eigen::Vector2d distances = Eigen::Vector2d::Zero();

    void add(const Vector3& normal, double distance)
    {
        normals.col(k) = normal;
        distances[k++] = distance;
    }
};

// Newton's method for a point that slides on curved surfaces. With the
// displacement s it is by distances above the tangent planes N: what its
// condition C^T s = g has to prescribe to bring it into them is
//
//     g = C^T s - (N^T C)^-1 distances,
//
// for one surface g = n . s - distance/(n . n*). Only the value is new, the
// directions C are kept. Returns the cosine of the angle between the directions
// and those of the planes, |n . n*|; if it is less than leastSlidingCosine the
// point has gone too far around the surface for its directions, and the step is
// that of this cosine.
double
slideOnto(ControlPoint& p, const Vector3& s, const TangentPlanes& planes);

constexpr double leastSlidingCosine = 0.3;

// The shortest displacement into all of the planes
Vector3 wayInto(const TangentPlanes& planes);

} // namespace morph

#endif
