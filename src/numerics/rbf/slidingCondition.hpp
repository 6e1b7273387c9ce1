// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Points that slide on curved surfaces: what their condition prescribes.

#ifndef morph_slidingCondition_hpp
#define morph_slidingCondition_hpp

#include "controlPoints.hpp"

namespace morph
{

// Tangent planes of the surfaces on which a point has to be, nearest to where
// it is: one for a point on a surface, two for one on an edge
struct TangentPlanes
{
    int k = 0;

    // Unit normals, in columns
    Eigen::Matrix<double, 3, 2> normals = Eigen::Matrix<double, 3, 2>::Zero();

    // How far the point is above each plane [m]
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
// and those of the planes, |n . n*|; where it is less than leastSlidingCosine
// the point has gone too far around the surface for its directions, and its
// value moves it as far as it would with that cosine.
double slideOnto(ControlPoint& p, const Vector3& s, const TangentPlanes& planes);

constexpr double leastSlidingCosine = 0.3;

// The shortest way into all of the planes
Vector3 wayInto(const TangentPlanes& planes);

} // namespace morph

#endif
