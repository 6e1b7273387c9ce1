// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "surfaceMeasures.hpp"

#include <Eigen/Geometry>

#include <map>
#include <utility>

namespace morph
{

namespace
{

// A number and its derivative
struct Dual
{
    double value = 0;
    double slope = 0;

    void add(double v, double s)
    {
        value += v;
        slope += s;
    }
};

// Sums over triangles from which all measures follow
struct Sums
{
    Dual area;
    Dual volume;
    Dual areaMoment[3];
    Dual volumeMoment[3];
};

Sums sumsOf(
    const Vectors& points, const Triangles& triangles,
    const Vectors& velocities, const Vector3& origin)
{
    Sums sums;
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        Vector3 x[3], v[3];
        for (int i = 0; i < 3; ++i)
        {
            x[i] = points.row(triangles(t, i)).transpose() - origin;
            v[i] = velocities.row(triangles(t, i)).transpose();
        }
        const Vector3 n = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
        const Vector3 dn = 0.5
            * ((v[1] - v[0]).cross(x[2] - x[0])
               + (x[1] - x[0]).cross(v[2] - v[0]));
        const double a = n.norm();
        const double da = a > 0 ? n.dot(dn) / a : dn.norm();
        const double V = x[0].dot(n) / 3;
        const double dV = (v[0].dot(n) + x[0].dot(dn)) / 3;
        const Vector3 centre = (x[0] + x[1] + x[2]) / 3;
        const Vector3 dCentre = (v[0] + v[1] + v[2]) / 3;

        sums.area.add(a, da);
        sums.volume.add(V, dV);
        for (int c = 0; c < 3; ++c)
        {
            // The centroid of the tetrahedron to the origin is at 3/4
            sums.areaMoment[c].add(
                a * centre[c], da * centre[c] + a * dCentre[c]);
            sums.volumeMoment[c].add(
                0.75 * V * centre[c], 0.75 * (dV * centre[c] + V * dCentre[c]));
        }
    }
    return sums;
}

double slopeOfQuotient(const Dual& a, const Dual& b)
{
    return b.value != 0 ? (a.slope - a.value / b.value * b.slope) / b.value : 0;
}

// The middle of the points, about which round-off is smallest
Vector3 middle(const Vectors& points)
{
    return points.rows() > 0 ? Vector3(points.colwise().mean().transpose())
                             : Vector3(Vector3::Zero());
}

} // namespace


SurfaceMeasures
surfaceMeasures(const Vectors& points, const Triangles& triangles)
{
    const Vector3 origin = middle(points);
    const Sums sums =
        sumsOf(points, triangles, Vectors::Zero(points.rows(), 3), origin);
    SurfaceMeasures m;
    m.area = sums.area.value;
    m.volume = sums.volume.value;
    m.areaCentroid = origin;
    m.volumeCentroid = origin;
    for (int c = 0; c < 3; ++c)
    {
        if (m.area != 0)
        {
            m.areaCentroid[c] += sums.areaMoment[c].value / m.area;
        }
        if (m.volume != 0)
        {
            m.volumeCentroid[c] += sums.volumeMoment[c].value / m.volume;
        }
    }
    return m;
}


SurfaceMeasures surfaceMeasuresDerivative(
    const Vectors& points, const Triangles& triangles,
    const Vectors& velocities)
{
    const Sums sums = sumsOf(points, triangles, velocities, middle(points));
    SurfaceMeasures m;
    m.area = sums.area.slope;
    m.volume = sums.volume.slope;
    for (int c = 0; c < 3; ++c)
    {
        m.areaCentroid[c] = slopeOfQuotient(sums.areaMoment[c], sums.area);
        m.volumeCentroid[c] =
            slopeOfQuotient(sums.volumeMoment[c], sums.volume);
    }
    return m;
}


bool isClosed(const Triangles& triangles)
{
    std::map<std::pair<Index, Index>, int> uses;
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        for (int i = 0; i < 3; ++i)
        {
            ++uses[{triangles(t, i), triangles(t, (i + 1) % 3)}];
        }
    }
    for (const auto& use : uses)
    {
        const auto opposite = uses.find({use.first.second, use.first.first});
        if (use.second != 1 || opposite == uses.end())
        {
            return false;
        }
    }
    return !uses.empty();
}

} // namespace morph
