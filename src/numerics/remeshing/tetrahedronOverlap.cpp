// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tetrahedronOverlap.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace morph
{

namespace
{

constexpr double eps = std::numeric_limits<double>::epsilon();

bool lexicographicallyLess(const Vector3& a, const Vector3& b)
{
    return std::lexicographical_compare(
        a.data(), a.data() + 3, b.data(), b.data() + 3);
}


// Barycentric coordinates in the tetrahedron that is cut
using Barycentric = Eigen::Vector4d;

struct Piece
{
    std::array<Barycentric, 4> corner;
};


// Four planes cut a tetrahedron into no more than 3^4
struct Pieces
{
    std::array<Piece, 81> piece;
    int size = 0;

    void
    add(const Barycentric& a, const Barycentric& b, const Barycentric& c,
        const Barycentric& d)
    {
        piece[size++].corner = {a, b, c, d};
    }

    void addPrism(
        const Barycentric& a0, const Barycentric& a1, const Barycentric& a2,
        const Barycentric& b0, const Barycentric& b1, const Barycentric& b2)
    {
        add(a0, a1, a2, b0);
        add(a1, a2, b0, b1);
        add(a2, b0, b1, b2);
    }
};


// Keeps what is on the positive side of a plane, whose values at the corners of
// the tetrahedron that is cut are given
void cutByPlane(const Barycentric& distance, const Pieces& pieces, Pieces& kept)
{
    kept.size = 0;
    for (int n = 0; n < pieces.size; ++n)
    {
        const auto& x = pieces.piece[n].corner;

        // Corners that are inside come first
        double d[4];
        int order[4];
        int nInside = 0, nOutside = 0, nPositive = 0;
        for (int i = 0; i < 4; ++i)
        {
            d[i] = distance.dot(x[i]);
            nPositive += d[i] > 0;
            if (d[i] >= 0)
            {
                order[nInside++] = i;
            }
            else
            {
                order[3 - nOutside++] = i;
            }
        }
        if (nPositive == 0)
        {
            continue;
        }
        if (nOutside == 0)
        {
            kept.piece[kept.size++] = pieces.piece[n];
            continue;
        }

        const auto corner = [&](const int i) -> const Barycentric&
        { return x[order[i]]; };
        const auto between = [&](const int in, const int out) -> Barycentric
        {
            const double a = d[order[in]], b = d[order[out]];
            return (corner(in) * -b + corner(out) * a) / (a - b);
        };

        if (nInside == 1)
        {
            kept.add(corner(0), between(0, 1), between(0, 2), between(0, 3));
        }
        else if (nInside == 2)
        {
            kept.addPrism(
                corner(0), between(0, 2), between(0, 3), corner(1),
                between(1, 2), between(1, 3));
        }
        else
        {
            kept.addPrism(
                corner(0), corner(1), corner(2), between(0, 3), between(1, 3),
                between(2, 3));
        }
    }
}

} // namespace


Tetrahedron::Tetrahedron(const std::array<Vector3, 4>& corners)
: corner_(corners)
{
    for (int face = 0; face < 4; ++face)
    {
        std::array<Vector3, 3> p;
        for (int i = 0, n = 0; i < 4; ++i)
        {
            if (i != face)
            {
                p[n++] = corner_[i];
            }
        }
        std::sort(p.begin(), p.end(), lexicographicallyLess);

        const Vector3 a = p[1] - p[0], b = p[2] - p[0];
        Plane& plane = plane_[face];
        plane.origin = p[0];
        plane.normal = a.cross(b);
        plane.roundOff2 = 64 * eps * eps * a.squaredNorm() * b.squaredNorm();
    }

    const Vector3 a = corner_[1] - corner_[0], b = corner_[2] - corner_[0],
                  c = corner_[3] - corner_[0];
    const double determinant = a.cross(b).dot(c);
    volume_ = std::abs(determinant) / 6;
    sign_ = determinant > 0 ? 1 : -1;

    for (int face = 0; face < 4; ++face)
    {
        const double d = inside(face, corner_[face]);
        if (d == 0)
        {
            sign_ = 0;
        }
        if (d < 0)
        {
            plane_[face].normal *= -1;
        }
    }
}


Vector3 Tetrahedron::centroid() const
{
    return 0.25 * (corner_[0] + corner_[1] + corner_[2] + corner_[3]);
}


Overlap overlap(const Tetrahedron& cut, const Tetrahedron& other)
{
    Overlap result;
    if (cut.sign() == 0 || other.sign() == 0)
    {
        return result;
    }

    // Corners of each by the planes of the other: most pairs end here
    std::array<Barycentric, 4> distance;
    bool within = true;
    for (int face = 0; face < 4; ++face)
    {
        for (int i = 0; i < 4; ++i)
        {
            distance[face][i] = other.inside(face, cut.corner(i));
        }
        if (distance[face].maxCoeff() <= 0)
        {
            return result;
        }
        within = within && distance[face].minCoeff() >= 0;
    }
    if (within)
    {
        result.volume = cut.volume();
        result.moment = cut.volume() * cut.centroid();
        return result;
    }

    within = true;
    for (int face = 0; face < 4; ++face)
    {
        Barycentric d;
        for (int i = 0; i < 4; ++i)
        {
            d[i] = cut.inside(face, other.corner(i));
        }
        if (d.maxCoeff() <= 0)
        {
            return result;
        }
        within = within && d.minCoeff() >= 0;
    }
    if (within)
    {
        result.volume = other.volume();
        result.moment = other.volume() * other.centroid();
        return result;
    }

    Pieces now, next;
    now.add(
        Barycentric::Unit(0), Barycentric::Unit(1), Barycentric::Unit(2),
        Barycentric::Unit(3));
    for (int face = 0; face < 4; ++face)
    {
        if (distance[face].minCoeff() >= 0)
        {
            continue;
        }
        cutByPlane(distance[face], now, next);
        std::swap(now, next);
    }

    double part = 0;
    Barycentric mean = Barycentric::Zero();
    for (int n = 0; n < now.size; ++n)
    {
        const auto& x = now.piece[n].corner;
        const Vector3 a = (x[1] - x[0]).head<3>(), b = (x[2] - x[0]).head<3>(),
                      c = (x[3] - x[0]).head<3>();
        const double volume = std::abs(a.cross(b).dot(c));
        part += volume;
        mean += 0.25 * volume * (x[0] + x[1] + x[2] + x[3]);
    }

    // Round-off of a touch
    if (part <= 4 * eps)
    {
        return result;
    }

    result.volume = part * cut.volume();
    for (int i = 0; i < 4; ++i)
    {
        result.moment += cut.volume() * mean[i] * cut.corner(i);
    }
    return result;
}

} // namespace morph
