// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapeFunctions.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace morph
{

namespace
{

Vector3 at(const Vectors& points, Index i)
{
    return points.row(i).transpose();
}


// Gradients of many triangles, summed up per point
class Gradient
{
public:
    explicit Gradient(Index n)
    : sums_(Vectors::Zero(n, 3))
    {
    }

    void add(Index point, const Vector3& g)
    {
        sums_.row(point) += g.transpose();
    }

    std::vector<std::pair<Index, Vector3>> terms() const
    {
        std::vector<std::pair<Index, Vector3>> result;
        for (Index i = 0; i < sums_.rows(); ++i)
        {
            if (!sums_.row(i).isZero(0))
            {
                result.emplace_back(i, sums_.row(i).transpose());
            }
        }
        return result;
    }

    const Vectors& sums() const { return sums_; }

private:
    Vectors sums_;
};


// The nearest point of a triangle (Ericson 2005, Real-time collision
// detection, 5.1.5), as barycentric coordinates
std::array<double, 3> nearestOfTriangle(
    const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& x)
{
    const Vector3 ab = b - a, ac = c - a, ax = x - a;
    const double d1 = ab.dot(ax), d2 = ac.dot(ax);
    if (d1 <= 0 && d2 <= 0)
    {
        return {{1, 0, 0}};
    }
    const Vector3 bx = x - b;
    const double d3 = ab.dot(bx), d4 = ac.dot(bx);
    if (d3 >= 0 && d4 <= d3)
    {
        return {{0, 1, 0}};
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
    {
        const double v = d1 > d3 ? d1 / (d1 - d3) : 0;
        return {{1 - v, v, 0}};
    }
    const Vector3 cx = x - c;
    const double d5 = ab.dot(cx), d6 = ac.dot(cx);
    if (d6 >= 0 && d5 <= d6)
    {
        return {{0, 0, 1}};
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
    {
        const double w = d2 > d6 ? d2 / (d2 - d6) : 0;
        return {{1 - w, 0, w}};
    }
    const double va = d3 * d6 - d5 * d4;
    const double e = d4 - d3, f = d5 - d6;
    if (va <= 0 && e >= 0 && f >= 0)
    {
        const double w = e + f > 0 ? e / (e + f) : 0;
        return {{0, 1 - w, w}};
    }
    const double sum = va + vb + vc;
    return {{va / sum, vb / sum, vc / sum}};
}


// A corner of a triangle that a plane cuts off: its position, and how it moves
// with the two points it lies between
struct Corner
{
    Index from, to;
    double t;
    Vector3 x;
};


void addCorner(
    const Corner& corner, const Vector3& g, const Vectors& points,
    const Vector3& origin, const Vector3& normal, Gradient& gradient)
{
    if (corner.from == corner.to)
    {
        gradient.add(corner.from, g);
        return;
    }
    // x = a + t (b - a) with t = h_a/(h_a - h_b)
    const Vector3 a = at(points, corner.from), b = at(points, corner.to);
    const double ha = normal.dot(a - origin), hb = normal.dot(b - origin);
    const double along = g.dot(b - a) / ((ha - hb) * (ha - hb));
    gradient.add(corner.from, (1 - corner.t) * g - along * hb * normal);
    gradient.add(corner.to, corner.t * g + along * ha * normal);
}

} // namespace


double ShapeValue::derivative(const Vectors& velocities) const
{
    double sum = 0;
    for (const auto& term : gradient)
    {
        sum += term.second.dot(velocities.row(term.first).transpose());
    }
    return sum;
}


Vector3 SurfacePlace::position(const Vectors& x) const
{
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
    {
        sum += weights[i] * at(x, points[i]);
    }
    return sum;
}


SurfacePlace nearestPlace(
    const Vectors& points, const Triangles& triangles, const Vector3& x)
{
    SurfacePlace nearest{{{0, 0, 0}}, {{1, 0, 0}}};
    double least = std::numeric_limits<double>::infinity();
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        SurfacePlace place;
        for (std::size_t i = 0; i < 3; ++i)
        {
            place.points[i] = triangles(t, Index(i));
        }
        place.weights = nearestOfTriangle(
            at(points, place.points[0]), at(points, place.points[1]),
            at(points, place.points[2]), x);
        const double distance = (place.position(points) - x).squaredNorm();
        if (distance < least)
        {
            least = distance;
            nearest = place;
        }
    }
    return nearest;
}


bool placesOnLine(
    const Vectors& points, const Triangles& triangles, const Vector3& x,
    const Vector3& direction, SurfacePlace& below, SurfacePlace& above)
{
    const double infinite = std::numeric_limits<double>::infinity();
    double up = infinite, down = -infinite;
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        // Moeller and Trumbore 1997, with edges that belong to both sides
        const Vector3 a = at(points, triangles(t, 0));
        const Vector3 e1 = at(points, triangles(t, 1)) - a;
        const Vector3 e2 = at(points, triangles(t, 2)) - a;
        const Vector3 p = direction.cross(e2);
        const double det = e1.dot(p);
        if (std::abs(det) <= 1e-14 * e1.norm() * e2.norm() * direction.norm())
        {
            continue;
        }
        const Vector3 s = x - a;
        const double u = s.dot(p) / det;
        const Vector3 q = s.cross(e1);
        const double v = direction.dot(q) / det;
        const double slack = 1e-10;
        if (u < -slack || v < -slack || u + v > 1 + slack)
        {
            continue;
        }
        const double along = e2.dot(q) / det;
        const SurfacePlace place{
            {{triangles(t, 0), triangles(t, 1), triangles(t, 2)}},
            {{1 - u - v, u, v}}};
        if (along >= 0 && along < up)
        {
            up = along;
            above = place;
        }
        if (along <= 0 && along > down)
        {
            down = along;
            below = place;
        }
    }
    return up < infinite && down > -infinite;
}


ShapeValue
distance(const Vectors& points, const SurfacePlace& a, const SurfacePlace& b)
{
    const Vector3 line = a.position(points) - b.position(points);
    ShapeValue result;
    result.value = line.norm();
    const Vector3 unit = result.value > 0 ? Vector3(line / result.value)
                                          : Vector3::Zero().eval();
    for (std::size_t i = 0; i < 3; ++i)
    {
        result.gradient.emplace_back(a.points[i], a.weights[i] * unit);
        result.gradient.emplace_back(b.points[i], -b.weights[i] * unit);
    }
    return result;
}


ShapeValue component(
    const Vectors& points, const SurfacePlace& place, const Vector3& direction)
{
    ShapeValue result;
    result.value = direction.dot(place.position(points));
    for (std::size_t i = 0; i < 3; ++i)
    {
        result.gradient.emplace_back(
            place.points[i], place.weights[i] * direction);
    }
    return result;
}


ShapeValue projectedArea(
    const Vectors& points, const Triangles& triangles, const Vector3& direction)
{
    ShapeValue result;
    Gradient gradient(points.rows());
    const Vector3 d = direction.normalized();
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        Vector3 x[3];
        for (int i = 0; i < 3; ++i)
        {
            x[i] = at(points, triangles(t, i));
        }
        const double facing = 0.5 * d.dot((x[1] - x[0]).cross(x[2] - x[0]));
        if (facing > 0)
        {
            result.value += facing;
            for (int i = 0; i < 3; ++i)
            {
                gradient.add(
                    triangles(t, i),
                    0.5 * (x[(i + 1) % 3] - x[(i + 2) % 3]).cross(d));
            }
        }
    }
    result.gradient = gradient.terms();
    return result;
}


ShapeValue wettedArea(
    const Vectors& points, const Triangles& triangles, const Vector3& origin,
    const Vector3& normal)
{
    ShapeValue result;
    Gradient gradient(points.rows());
    const auto height = [&](Index i)
    { return normal.dot(at(points, i) - origin); };
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        // What is below the plane (Sutherland and Hodgman 1974)
        std::vector<Corner> corners;
        for (int i = 0; i < 3; ++i)
        {
            const Index a = triangles(t, i), b = triangles(t, (i + 1) % 3);
            const double ha = height(a), hb = height(b);
            if (ha <= 0)
            {
                corners.push_back({a, a, 0, at(points, a)});
            }
            if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0))
            {
                const double s = ha / (ha - hb);
                corners.push_back(
                    {a, b, s, (1 - s) * at(points, a) + s * at(points, b)});
            }
        }
        const std::size_t n = corners.size();
        if (n < 3)
        {
            continue;
        }
        Vector3 area = Vector3::Zero();
        for (std::size_t i = 1; i + 1 < n; ++i)
        {
            area += 0.5
                * (corners[i].x - corners[0].x)
                      .cross(corners[i + 1].x - corners[0].x);
        }
        const double size = area.norm();
        if (!(size > 0))
        {
            continue;
        }
        result.value += size;
        const Vector3 unit = area / size;
        for (std::size_t i = 0; i < n; ++i)
        {
            const Vector3 g = 0.5
                * (corners[(i + 1) % n].x - corners[(i + n - 1) % n].x)
                      .cross(unit);
            addCorner(corners[i], g, points, origin, normal, gradient);
        }
    }
    result.gradient = gradient.terms();
    return result;
}


std::vector<Hinge> hinges(const Triangles& triangles)
{
    std::map<std::pair<Index, Index>, std::array<Index, 2>> edges;
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        for (int i = 0; i < 3; ++i)
        {
            const Index a = triangles(t, i), b = triangles(t, (i + 1) % 3);
            auto& sides =
                edges.insert({{std::min(a, b), std::max(a, b)}, {{-1, -1}}})
                    .first->second;
            sides[a < b ? 0 : 1] = triangles(t, (i + 2) % 3);
        }
    }

    std::vector<Hinge> result;
    for (const auto& edge : edges)
    {
        if (edge.second[0] >= 0 && edge.second[1] >= 0)
        {
            result.push_back(
                {{edge.first.first, edge.first.second, edge.second[0],
                  edge.second[1]}});
        }
    }
    return result;
}


ShapeValue bending(const Vectors& points, const std::vector<Hinge>& hinges)
{
    ShapeValue result;
    Gradient gradient(points.rows());
    for (const Hinge& hinge : hinges)
    {
        const Index i0 = hinge[0], i1 = hinge[1], i2 = hinge[2], i3 = hinge[3];
        const Vector3 x0 = at(points, i0), x1 = at(points, i1);
        const Vector3 e = x1 - x0;
        const Vector3 n1 = e.cross(at(points, i2) - x0);
        const Vector3 n2 = (at(points, i3) - x0).cross(e);
        const double length = e.norm(), l1 = n1.norm(), l2 = n2.norm();
        if (!(length > 0 && l1 > 0 && l2 > 0))
        {
            continue;
        }
        const double angle =
            std::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2));
        const double areas = 0.5 * (l1 + l2);
        const double square = length * length;
        result.value += angle * angle * square / areas;

        // d angle: the heights over the edge (Bridson et al. 2003)
        const Vector3 g2 = -length / (l1 * l1) * n1;
        const Vector3 g3 = -length / (l2 * l2) * n2;
        const double s2 = (at(points, i2) - x0).dot(e) / square;
        const double s3 = (at(points, i3) - x0).dot(e) / square;
        const double byAngle = 2 * angle * square / areas;
        gradient.add(i2, byAngle * g2);
        gradient.add(i3, byAngle * g3);
        gradient.add(i0, -byAngle * ((1 - s2) * g2 + (1 - s3) * g3));
        gradient.add(i1, -byAngle * (s2 * g2 + s3 * g3));

        const double byLength = 2 * angle * angle / areas;
        gradient.add(i0, -byLength * e);
        gradient.add(i1, byLength * e);

        const double byArea = -angle * angle * square / (areas * areas);
        const Vector3 u1 = n1 / l1, u2 = n2 / l2;
        const auto areaOf = [&](Index a, Index b, Index c, const Vector3& unit)
        {
            const Index corner[3] = {a, b, c};
            for (int i = 0; i < 3; ++i)
            {
                gradient.add(
                    corner[i],
                    0.5 * byArea
                        * (at(points, corner[(i + 1) % 3])
                           - at(points, corner[(i + 2) % 3]))
                              .cross(unit));
            }
        };
        areaOf(i0, i1, i2, u1);
        areaOf(i1, i0, i3, u2);
    }
    result.gradient = gradient.terms();
    return result;
}


ShapeValue volume(const Vectors& points, const Triangles& triangles)
{
    ShapeValue result;
    Gradient gradient(points.rows());
    const Vector3 middle = points.colwise().mean().transpose();
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        Vector3 x[3];
        for (int i = 0; i < 3; ++i)
        {
            x[i] = at(points, triangles(t, i)) - middle;
        }
        result.value += x[0].dot(x[1].cross(x[2])) / 6;
        for (int i = 0; i < 3; ++i)
        {
            gradient.add(
                triangles(t, i), x[(i + 1) % 3].cross(x[(i + 2) % 3]) / 6);
        }
    }
    result.gradient = gradient.terms();
    return result;
}


ShapeValue barycentre(
    const Vectors& points, const Triangles& triangles, const Vector3& direction)
{
    // Moments of the tetrahedra to the middle of the points
    const Vector3 middle = points.colwise().mean().transpose();
    double volume = 0, moment = 0;
    Gradient ofVolume(points.rows()), ofMoment(points.rows());
    for (Index t = 0; t < triangles.rows(); ++t)
    {
        Vector3 x[3];
        for (int i = 0; i < 3; ++i)
        {
            x[i] = at(points, triangles(t, i)) - middle;
        }
        const double V = x[0].dot(x[1].cross(x[2])) / 6;
        const double h = direction.dot(x[0] + x[1] + x[2]) / 4;
        volume += V;
        moment += V * h;
        for (int i = 0; i < 3; ++i)
        {
            const Vector3 g = x[(i + 1) % 3].cross(x[(i + 2) % 3]) / 6;
            ofVolume.add(triangles(t, i), g);
            ofMoment.add(triangles(t, i), h * g + 0.25 * V * direction);
        }
    }
    ShapeValue result;
    const double relative = volume != 0 ? moment / volume : 0;
    result.value = direction.dot(middle) + relative;
    if (volume != 0)
    {
        // The place that moments are taken about does not matter: it is held
        Gradient gradient(points.rows());
        for (Index i = 0; i < points.rows(); ++i)
        {
            gradient.add(
                i,
                (ofMoment.sums().row(i) - relative * ofVolume.sums().row(i))
                        .transpose()
                    / volume);
        }
        result.gradient = gradient.terms();
    }
    return result;
}

} // namespace morph
