// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "sectionAxis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace morph
{

namespace
{

std::vector<double> column(const Vectors& points, Index c)
{
    std::vector<double> values;
    for (Index i = 0; i < points.rows(); ++i)
    {
        values.push_back(points(i, c));
    }
    return values;
}


Eigen::Matrix3d crossMatrix(const Vector3& n)
{
    Eigen::Matrix3d K;
    K << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0;
    return K;
}

} // namespace

// * * * A function along an axis

AxisFunction::AxisFunction(
    const std::vector<double>& at, const std::vector<double>& values, Kind kind)
: at_(at),
  values_(values),
  bending_(at.size(), 0.0)
{
    if (at.size() < 2 || values.size() != at.size())
    {
        throw std::invalid_argument("at least two places are needed");
    }
    for (std::size_t i = 1; i < at.size(); ++i)
    {
        if (!(at[i] > at[i - 1]))
        {
            throw std::invalid_argument("the places have to ascend");
        }
    }
    const Index n = Index(at.size()) - 2;
    if (kind == Kind::linear || n == 0)
    {
        return;
    }

    // Continuous slopes at the inner places
    Matrix A = Matrix::Zero(n, n);
    Eigen::VectorXd b(n);
    for (Index i = 0; i < n; ++i)
    {
        const std::size_t k = std::size_t(i);
        const double before = at[k + 1] - at[k];
        const double after = at[k + 2] - at[k + 1];
        A(i, i) = (before + after) / 3;
        if (i > 0)
        {
            A(i, i - 1) = before / 6;
        }
        if (i + 1 < n)
        {
            A(i, i + 1) = after / 6;
        }
        b[i] = (values[k + 2] - values[k + 1]) / after
            - (values[k + 1] - values[k]) / before;
    }
    const Eigen::VectorXd inner = A.partialPivLu().solve(b);
    std::copy(inner.data(), inner.data() + n, bending_.begin() + 1);
}


Index AxisFunction::interval(double u) const
{
    return Index(std::upper_bound(at_.begin(), at_.end(), u) - at_.begin()) - 1;
}


double AxisFunction::value(double u) const
{
    const Index interval = this->interval(u);
    if (interval < 0)
    {
        return values_.front();
    }
    if (interval + 1 >= Index(at_.size()))
    {
        return values_.back();
    }
    const std::size_t i = std::size_t(interval);
    const double h = at_[i + 1] - at_[i];
    const double b = (u - at_[i]) / h;
    const double a = 1 - b;
    return a * values_[i] + b * values_[i + 1]
        + ((a * a * a - a) * bending_[i] + (b * b * b - b) * bending_[i + 1])
        * h * h / 6;
}


double AxisFunction::slope(double u) const
{
    const Index interval = this->interval(u);
    if (interval < 0 || interval + 1 >= Index(at_.size()))
    {
        return 0;
    }
    const std::size_t i = std::size_t(interval);
    const double h = at_[i + 1] - at_[i];
    const double b = (u - at_[i]) / h;
    const double a = 1 - b;
    return (values_[i + 1] - values_[i]) / h
        + ((1 - 3 * a * a) * bending_[i] + (3 * b * b - 1) * bending_[i + 1])
        * h / 6;
}

// * * * The axis

SectionAxis::SectionAxis(
    const Vectors& points, AxisFunction::Kind line, const Vector3& normal,
    const Vector3& chord, const std::vector<Variable>& variables)
: points_(points),
  line_(line),
  normal_(normal.normalized()),
  chord_(chord - chord.dot(normal_) * normal_),
  variables_(variables)
{
    if (chord_.norm() < 1e-6 * chord.norm() || !(chord.norm() > 0))
    {
        throw std::invalid_argument(
            "the chord has the direction of the normal of the sections");
    }
    chord_.normalize();
    across_ = normal_.cross(chord_);

    const Index n = points.rows();
    if (n < 2)
    {
        throw std::invalid_argument("an axis needs at least two points");
    }
    start_ = normal_.dot(points.row(0));
    length_ = normal_.dot(points.row(n - 1)) - start_;
    for (Index i = 0; i < n; ++i)
    {
        fractions_.push_back(
            length_ > 0 ? (normal_.dot(points.row(i)) - start_) / length_
                        : 0.0);
        if (i > 0
            && !(fractions_[std::size_t(i)] > fractions_[std::size_t(i - 1)]))
        {
            throw std::invalid_argument(
                "point " + std::to_string(i)
                + " of the axis is not further"
                  " along the normal of the sections than the one before");
        }
    }
    for (Index c = 0; c < 3; ++c)
    {
        position_.emplace_back(fractions_, column(points, c), line);
    }
}


double SectionAxis::fraction(const Vector3& x) const
{
    return (normal_.dot(x) - start_) / length_;
}


double SectionAxis::rate(const Vector3& velocity) const
{
    return normal_.dot(velocity) / length_;
}


Vector3 SectionAxis::at(double u) const
{
    return Vector3(
        position_[0].value(u), position_[1].value(u), position_[2].value(u));
}


Vector3 SectionAxis::slope(double u) const
{
    return Vector3(
        position_[0].slope(u), position_[1].slope(u), position_[2].slope(u));
}


Vectors
SectionAxis::along(const std::vector<double>& u, const Vectors& points) const
{
    Vectors result(Index(u.size()), 3);
    for (Index c = 0; c < 3; ++c)
    {
        const AxisFunction component(fractions_, column(points, c), line_);
        for (std::size_t i = 0; i < u.size(); ++i)
        {
            result(Index(i), c) = component.value(u[i]);
        }
    }
    return result;
}


SectionAxis::Sums SectionAxis::sums(
    double u, const std::vector<double>& values, bool slopes) const
{
    Sums sums{};
    for (std::size_t i = 0; i < variables_.size(); ++i)
    {
        if (values[i] != 0)
        {
            const AxisFunction& along = variables_[i].along;
            sums[std::size_t(variables_[i].kind)] +=
                values[i] * (slopes ? along.slope(u) : along.value(u));
        }
    }
    return sums;
}


SectionAxis::Section SectionAxis::of(const Sums& sums) const
{
    const auto sum = [&](Kind kind) { return sums[std::size_t(kind)]; };

    // R - I and S - I, exactly zero where the variables are
    const double half = std::sin(0.5 * sum(Kind::twist));
    const Eigen::Matrix3d K = crossMatrix(normal_);
    const Eigen::Matrix3d turn =
        std::sin(sum(Kind::twist)) * K + 2 * half * half * K * K;
    const double chord = sum(Kind::chord);
    const double across = chord + (1 + chord) * sum(Kind::thickness);
    const Eigen::Matrix3d scale = chord * chord_ * chord_.transpose()
        + across * across_ * across_.transpose();

    Section section;
    section.shift = sum(Kind::sweep) * chord_ + sum(Kind::dihedral) * across_
        + sum(Kind::span) * normal_;
    section.change = turn + scale + turn * scale;
    return section;
}


SectionAxis::Section
SectionAxis::derivative(const Sums& sums, const Sums& rates) const
{
    const auto sum = [&](Kind kind) { return sums[std::size_t(kind)]; };
    const auto rate = [&](Kind kind) { return rates[std::size_t(kind)]; };

    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d K = crossMatrix(normal_);
    const double twist = sum(Kind::twist);
    const double half = std::sin(0.5 * twist);
    const Eigen::Matrix3d turn = std::sin(twist) * K + 2 * half * half * K * K;
    const Eigen::Matrix3d turning =
        rate(Kind::twist) * (std::cos(twist) * K + std::sin(twist) * K * K);

    const double chord = sum(Kind::chord);
    const double across = chord + (1 + chord) * sum(Kind::thickness);
    const double acrossRate = rate(Kind::chord) * (1 + sum(Kind::thickness))
        + (1 + chord) * rate(Kind::thickness);
    const Eigen::Matrix3d scale = chord * chord_ * chord_.transpose()
        + across * across_ * across_.transpose();
    const Eigen::Matrix3d scaling =
        rate(Kind::chord) * chord_ * chord_.transpose()
        + acrossRate * across_ * across_.transpose();

    Section section;
    section.shift = rate(Kind::sweep) * chord_ + rate(Kind::dihedral) * across_
        + rate(Kind::span) * normal_;
    section.change = turning * (identity + scale) + (identity + turn) * scaling;
    return section;
}


SectionAxis::Section
SectionAxis::section(double u, const std::vector<double>& values) const
{
    return of(sums(u, values, false));
}


SectionAxis::Section SectionAxis::byVariable(
    double u, const std::vector<double>& values, std::size_t variable) const
{
    Sums rates{};
    rates[std::size_t(variables_[variable].kind)] =
        variables_[variable].along.value(u);
    return derivative(sums(u, values, false), rates);
}


SectionAxis::Section
SectionAxis::byFraction(double u, const std::vector<double>& values) const
{
    return derivative(sums(u, values, false), sums(u, values, true));
}

} // namespace morph
