// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Control points: their positions, the directions along which their
// displacement is prescribed, and its values.

#ifndef morph_controlPoints_hpp
#define morph_controlPoints_hpp

#include "arrays.hpp"
#include "pointOrder.hpp"

#include <Eigen/StdVector>

#include <stdexcept>
#include <vector>

namespace morph
{

// Condition on the displacement s at the control point: C^T s(x) = g.
//   k = 3  moving or fixed: s is prescribed (C = I, g = s, always)
//   k = 1  sliding on a surface of unit normal C: g = n . s
//   k = 2  sliding along an edge; the columns of C are orthonormal and span
//          the plane normal to the edge
// The weight of the control point lies in the span of C, which makes the system
// symmetric (Mastrippolito et al. 2019, eqs 2-5, doi:10.1108/EC-06-2018-0265,
// with C in place of n, t, b).
struct ControlPoint
{
    Vector3 position = Vector3::Zero();
    int k = 3;
    Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
    Vector3 value = Vector3::Zero();

    // The first k columns of directions, and entries of value, count
    auto C() const { return directions.leftCols(k); }
    auto g() const { return value.head(k); }

    // s is prescribed
    static ControlPoint prescribed(const Vector3& x, const Vector3& s);

    // The component of s along the normals is prescribed to be that of the
    // given displacement. One normal: a surface. Two: an edge. Normals need not
    // have unit length nor be orthogonal. Three: s is prescribed. Throws
    // std::invalid_argument if there is none or they are dependent.
    static ControlPoint sliding(
        const Vector3& x, const std::vector<Vector3>& normals,
        const Vector3& s = Vector3::Zero());

    // Prescribes another displacement, of which sliding points take what is
    // along their normals
    void setDisplacement(const Vector3& s)
    {
        if (k == 3)
        {
            value = s;
        }
        else
        {
            value.head(k) = C().transpose() * s;
        }
    }

    // Is s free along some direction?
    bool slides() const { return k < 3; }

    // The residual g - C^T s; the first k components count
    Vector3 residual(const Vector3& s) const
    {
        // Of fixed sizes, which cost a fraction of a product of variable size
        if (k == 3)
        {
            return value - s;
        }
        Vector3 r = Vector3::Zero();
        for (int i = 0; i < k; ++i)
        {
            r[i] = value[i] - directions.col(i).dot(s);
        }
        return r;
    }
};

using ControlPoints = std::vector<ControlPoint>;

// The positions as columns
Columns positions(const ControlPoints& points);

// Thrown if two control points at one position contradict each other
struct ConflictingControlPoints : std::invalid_argument
{
    ConflictingControlPoints(const Vector3& x, double difference);

    Vector3 position;
    double difference;
};

// Control points at exactly the same position, two or more: their indices in
// ascending order, the sets in the order of their positions
using Coincident = std::vector<std::vector<Index>>;
Coincident coincident(const ControlPoints& points);

// Of control points at exactly the same position keeps the one with most
// conditions (fixed and moving before edge before surface; of equals the first)
// and returns their indices in ascending order. Throws ConflictingControlPoints
// where one that is dropped and the one that is kept prescribe, along a
// direction they share, displacements further apart than the tolerance [m].
// \param sets  coincident(points), which positions alone determine
std::vector<Index> withoutDuplicates(
    const ControlPoints& points, const Coincident& sets, double tolerance);

} // namespace morph

#endif
