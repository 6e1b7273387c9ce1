// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Bernstein coefficients and first root of the volume of a moving tetrahedron

#include "movingTetrahedron.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace morph
{

Cubic movingVolume(
    const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& a1,
    const Vector3& b1, const Vector3& c1)
{
    // The polar form of the determinant, with each edge at t = 0 or 1
    const Vector3 start = a.cross(b);
    const Vector3 mixed = a1.cross(b) + a.cross(b1);
    const Vector3 end = a1.cross(b1);
    return Cubic{
        {start.dot(c), (mixed.dot(c) + start.dot(c1)) / 3,
         (end.dot(c) + mixed.dot(c1)) / 3, end.dot(c1)}};
}


double value(const Cubic& p, const double t)
{
    const double s = 1 - t;
    const double p01 = s * p[0] + t * p[1];
    const double p12 = s * p[1] + t * p[2];
    const double p23 = s * p[2] + t * p[3];
    return s * (s * p01 + t * p12) + t * (s * p12 + t * p23);
}


bool surelyPositive(const Cubic& p, const double end)
{
    const double start = 1 - end;
    const double p01 = start * p[0] + end * p[1];
    const double p12 = start * p[1] + end * p[2];
    const double p012 = start * p01 + end * p12;
    return p[0] > 0 && p01 > 0 && p012 > 0 && value(p, end) > 0;
}


// The quotient, or 1 if it is not in (0, 1); never divides by zero, which
// OpenFOAM traps
static double inside(const double numerator, const double denominator)
{
    const bool sameSign = (numerator > 0) == (denominator > 0);
    return numerator != 0 && sameSign
            && std::abs(numerator) < std::abs(denominator)
        ? numerator / denominator
        : 1;
}


// Where in (0, 1) the derivative vanishes, in ascending order; 1 if nowhere
static std::pair<double, double> extrema(const Cubic& p)
{
    // The derivative, over 3, by Bernstein coefficients, then as
    // a t^2 + 2 b t + c
    const double q0 = p[1] - p[0], q1 = p[2] - p[1], q2 = p[3] - p[2];
    const double a = (q0 - q1) + (q2 - q1), b = q1 - q0, c = q0;
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0))
    {
        return {1, 1};
    }

    // Both roots without cancellation; a straight line has one at infinity
    const double w = -(b + std::copysign(std::sqrt(discriminant), b));
    const double first = inside(w, a), second = inside(c, w);
    return {std::min(first, second), std::max(first, second)};
}


// The root between low, where the cubic is positive, and high, where it is
// not, and between which it is monotone
static double bracketed(const Cubic& p, double low, double high)
{
    double atLow = value(p, low), atHigh = value(p, high);
    for (int i = 0; i < 200; ++i)
    {
        // False position, every third step bisection: it cannot get stuck
        double t = low + (high - low) * (atLow / (atLow - atHigh));
        if (i % 3 == 2 || !(t > low && t < high))
        {
            t = low + 0.5 * (high - low);
        }
        if (!(t > low && t < high))
        {
            break;
        }
        const double at = value(p, t);
        if (at > 0)
        {
            low = t;
            atLow = at;
        }
        else
        {
            high = t;
            atHigh = at;
        }
    }
    return low;
}


double positiveUpTo(const Cubic& p)
{
    if (p[0] > 0 && p[1] > 0 && p[2] > 0 && p[3] > 0)
    {
        return noRoot;
    }
    if (!std::isfinite(p[0] + p[1] + p[2] + p[3]))
    {
        return 0;
    }
    if (!(p[0] > 0))
    {
        return noRoot;
    }

    const std::pair<double, double> turns = extrema(p);
    double low = 0;
    for (const double high : {turns.first, turns.second, 1.0})
    {
        if (!(value(p, high) > 0))
        {
            return bracketed(p, low, high);
        }
        low = high;
    }
    return noRoot;
}

} // End namespace morph
