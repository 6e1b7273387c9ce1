// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "metric.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace morph
{

namespace
{

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

// f of the eigenvalues in the directions of a basis; across, what is there
Metric inBasis(
    const Metric& m, const Basis& basis, const std::function<double(double)>& f)
{
    const Eigen::MatrixXd part = basis.transpose() * m * basis;
    const Solver solver(part);
    Eigen::VectorXd values = solver.eigenvalues();
    std::transform(values.begin(), values.end(), values.begin(), f);
    const Eigen::MatrixXd vectors = basis * solver.eigenvectors();
    const Metric across =
        Metric::Identity() - Metric(basis * basis.transpose());
    return vectors * values.asDiagonal() * vectors.transpose()
        + across * m * across;
}

} // namespace


Metric spectral(const Metric& m, const std::function<double(double)>& f)
{
    return inBasis(m, Basis::Identity(3, 3), f);
}


Metric absolute(const Metric& hessian, const Basis& basis, const double least)
{
    return inBasis(
        hessian, basis,
        [least](double value) { return std::max(std::abs(value), least); });
}


Sizes sizes(const Metric& m, const Basis& basis)
{
    const Eigen::MatrixXd part = basis.transpose() * m * basis;
    const Eigen::VectorXd values =
        Solver(part, Eigen::EigenvaluesOnly).eigenvalues();
    return {1 / std::sqrt(values.maxCoeff()), 1 / std::sqrt(values.minCoeff())};
}


double determinant(const Metric& m, const Basis& basis)
{
    return Eigen::MatrixXd(basis.transpose() * m * basis).determinant();
}


Metric
optimal(const Metric& absoluteHessian, const Basis& basis, const double p)
{
    const double d = double(basis.cols());
    const double scale =
        std::pow(determinant(absoluteHessian, basis), -1 / (2 * p + d));
    return inBasis(
        absoluteHessian, basis,
        [scale](double value) { return scale * value; });
}


Metric bounded(
    const Metric& m, const Basis& basis, const double hMin, const double hMax)
{
    return inBasis(
        m, basis,
        [hMin, hMax](double value)
        { return std::clamp(value, 1 / (hMax * hMax), 1 / (hMin * hMin)); });
}


Metric intersection(const Metric& a, const Metric& b)
{
    const Metric root = spectral(a, [](double x) { return std::sqrt(x); });
    const Metric inverse =
        spectral(a, [](double x) { return 1 / std::sqrt(x); });
    const Metric seen = inverse * b * inverse;
    return root
        * spectral(
               0.5 * (seen + seen.transpose()),
               [](double x) { return std::max(x, 1.0); })
        * root;
}


Metric grown(const Metric& m, const Vector3& e, const double growth)
{
    const double length = std::sqrt(std::max(e.dot(m * e), 0.0));
    const double factor = 1 + std::log(growth) * length;
    return m / (factor * factor);
}

} // namespace morph
