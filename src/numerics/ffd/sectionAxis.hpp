// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A reference axis: sections along it are shifted, turned and scaled.

#ifndef morph_sectionAxis_hpp
#define morph_sectionAxis_hpp

#include "arrays.hpp"

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace morph
{

// A function of u in [0,1] through given values; beyond them it keeps the
// first and the last
class AxisFunction
{
public:
    enum class Kind
    {
        linear,

        // Natural cubic spline: continuous curvature, none at the ends
        spline
    };

    // at: ascending, at least two. Throws std::invalid_argument otherwise
    AxisFunction(
        const std::vector<double>& at, const std::vector<double>& values,
        Kind kind);

    double value(double u) const;

    double slope(double u) const;

private:
    // The interval u is in, -1 before the first, size() - 1 after the last
    Index interval(double u) const;

    std::vector<double> at_;

    std::vector<double> values_;

    // Second derivatives; zero where linear
    std::vector<double> bending_;
};


// A section is what a plane with the given normal n cuts; u, from 0 at the
// first point of the axis to 1 at its last, counts them along n. With A(u) on
// the axis, the unit vectors c (along the chord), n and m = n x c,
//
//     x* = A + shift + R S (x - A),    shift = sweep c + dihedral m + span n
//
// where R turns by the twist about n, and S scales by 1 + chord along c and m
// and by 1 + thickness along m: a section stays plane, and with chord and
// thickness zero it keeps its shape. Beyond the ends of the axis, points go with
// the section there.
class SectionAxis
{
public:
    enum class Kind
    {
        twist,
        chord,
        thickness,
        sweep,
        dihedral,
        span
    };

    struct Variable
    {
        Kind kind;
        AxisFunction along;
    };

    // What a section changes by: x* - x = shift + change (x - A)
    struct Section
    {
        Vector3 shift;
        Eigen::Matrix3d change;
    };

    // points: those of the axis, n x 3. Throws std::invalid_argument unless
    // they advance along the normal, and the chord is across it
    SectionAxis(
        const Vectors& points, AxisFunction::Kind line, const Vector3& normal,
        const Vector3& chord, const std::vector<Variable>& variables);

    const Vectors& points() const { return points_; }

    // Of the section a point is in, not taken into [0,1]
    double fraction(const Vector3& x) const;

    // What it changes by where the point moves
    double rate(const Vector3& velocity) const;

    // A(u), and its derivative by u
    Vector3 at(double u) const;

    Vector3 slope(double u) const;

    // The same for an axis whose points have been moved, at several u
    Vectors along(const std::vector<double>& u, const Vectors& points) const;

    // values: one for each variable; twists in radians
    Section section(double u, const std::vector<double>& values) const;

    // Its derivative by the value of a variable
    Section byVariable(
        double u, const std::vector<double>& values,
        std::size_t variable) const;

    // Its derivative by u
    Section byFraction(double u, const std::vector<double>& values) const;

private:
    // Sums of the variables of each kind
    using Sums = std::array<double, 6>;

    Sums sums(double u, const std::vector<double>& values, bool slopes) const;

    Section of(const Sums& sums) const;

    // In the direction of the rates
    Section derivative(const Sums& sums, const Sums& rates) const;

    Vectors points_;

    AxisFunction::Kind line_;

    Vector3 normal_;
    Vector3 chord_;
    Vector3 across_;

    double start_;
    double length_;

    std::vector<double> fractions_;

    std::vector<AxisFunction> position_;

    std::vector<Variable> variables_;
};

} // namespace morph

#endif
