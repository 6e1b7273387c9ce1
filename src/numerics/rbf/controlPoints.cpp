// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "controlPoints.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace morph
{

namespace
{

// Sine of the angle below which directions are the same
constexpr double sameDirection = 1e-6;


// How far what p prescribes is from what q prescribes, along the directions of
// p that are among those of q
double contradiction(const ControlPoint& p, const ControlPoint& q)
{
    const Vector3 residual = p.residual(q.C() * q.g());
    double sum = 0;
    for (int a = 0; a < p.k; ++a)
    {
        const Vector3 n = p.directions.col(a);
        if ((n - q.C() * (q.C().transpose() * n)).norm() < sameDirection)
        {
            sum += residual[a] * residual[a];
        }
    }
    return std::sqrt(sum);
}

} // namespace


ControlPoint ControlPoint::prescribed(const Vector3& x, const Vector3& s)
{
    ControlPoint p;
    p.position = x;
    p.value = s;
    return p;
}


ControlPoint ControlPoint::sliding(
    const Vector3& x, const std::vector<Vector3>& normals, const Vector3& s)
{
    ControlPoint p;
    p.position = x;
    p.k = 0;
    p.directions.setZero();

    for (const Vector3& normal : normals)
    {
        // Twice, so that nearly parallel normals end orthogonal to round-off
        Vector3 n = normal.normalized();
        for (int pass = 0; pass < 2; ++pass)
        {
            n -= p.C() * (p.C().transpose() * n);
        }
        if (p.k == 3 || !(n.norm() > sameDirection))
        {
            throw std::invalid_argument(
                "the normals of a sliding control point are zero or dependent");
        }
        p.directions.col(p.k++) = n.normalized();
    }

    if (p.k == 0)
    {
        throw std::invalid_argument("a sliding control point needs a normal");
    }
    if (p.k == 3)
    {
        return prescribed(x, s);
    }
    p.setDisplacement(s);
    return p;
}


Columns positions(const ControlPoints& points)
{
    Columns x(points.size(), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        x.row(i) = points[i].position.transpose();
    }
    return x;
}


ConflictingControlPoints::ConflictingControlPoints(
    const Vector3& x, double difference)
: std::invalid_argument(
    [&]
    {
        std::ostringstream s;
        s << "two control points at (" << x.transpose()
          << ") are told to go to places " << difference << " apart";
        return s.str();
    }()),
  position(x),
  difference(difference)
{
}


Coincident coincident(const ControlPoints& points)
{
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index(0));
    std::sort(
        order.begin(), order.end(),
        [&](Index a, Index b)
        {
            const Vector3& x = points[a].position;
            const Vector3& y = points[b].position;
            return x != y ? before(x, y) : a < b;
        });
    const auto together = [&](Index a, Index b)
    { return points[a].position == points[b].position; };

    Coincident sets;
    auto start = order.begin();
    while (start != order.end())
    {
        auto end = start + 1;
        while (end != order.end() && together(*start, *end))
        {
            ++end;
        }
        if (end - start > 1)
        {
            sets.emplace_back(start, end);
        }
        start = end;
    }
    return sets;
}


std::vector<Index> withoutDuplicates(
    const ControlPoints& points, const Coincident& sets, double tolerance)
{
    std::vector<char> kept(points.size(), 1);
    for (std::vector<Index> set : sets)
    {
        std::stable_sort(
            set.begin(), set.end(),
            [&](Index a, Index b) { return points[a].k > points[b].k; });
        for (std::size_t i = 1; i < set.size(); ++i)
        {
            const ControlPoint& p = points[set[i]];
            kept[set[i]] = 0;
            const double difference = contradiction(p, points[set[0]]);
            if (difference > tolerance)
            {
                throw ConflictingControlPoints(p.position, difference);
            }
        }
    }

    std::vector<Index> indices;
    indices.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (kept[i])
        {
            indices.push_back(Index(i));
        }
    }
    return indices;
}

} // namespace morph
