// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bSpline.hpp"

#include "bernstein.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace morph
{

BSpline BSpline::bernstein(Index degree)
{
    return BSpline(degree + 1, degree);
}


BSpline::BSpline(Index nPoints, Index degree, Ends ends)
: size_(nPoints),
  degree_(degree),
  periodic_(ends == Ends::periodic),
  spans_(periodic_ ? nPoints : nPoints - degree)
{
    if (degree < 0 || degree >= nPoints)
    {
        throw std::invalid_argument(
            "degree " + std::to_string(degree) + " of a B-spline with "
            + std::to_string(nPoints)
            + " control points: it has to be smaller than their number");
    }
    for (Index i = 0; i < spans_ + 2 * degree_ + 1; ++i)
    {
        const double u = double(i - degree_) / double(spans_);
        knots_.push_back(periodic_ ? u : std::min(std::max(u, 0.0), 1.0));
    }
}


double BSpline::spanStart(Index span) const
{
    return knot(degree_ + span);
}


Index BSpline::spanOf(double s) const
{
    const Index span = Index(std::floor(s * double(spans_)));
    return std::min(std::max(span, Index(0)), spans_ - 1);
}


// The triangle of Cox and de Boor (Piegl and Tiller, The NURBS Book, A2.2):
// every operation adds positive numbers
void BSpline::coxDeBoor(Index span, double s, Index degree, double* row) const
{
    const Index k = span + degree_;
    row[0] = 1;
    for (Index d = 1; d <= degree; ++d)
    {
        double carried = 0;
        for (Index i = 0; i < d; ++i)
        {
            const double right = knot(k + i + 1) - s;
            const double left = s - knot(k + 1 - d + i);
            const double part = row[i] / (right + left);
            row[i] = carried + right * part;
            carried = left * part;
        }
        row[d] = carried;
    }
}


Index BSpline::values(double s, double* row, double* derivatives) const
{
    s = std::min(std::max(s, 0.0), 1.0);
    const Index span = spanOf(s);
    if (derivatives && degree_ > 0)
    {
        // N_i' = p (N_i^(p-1)/(u_(i+p) - u_i) - N_(i+1)^(p-1)/(...))
        coxDeBoor(span, s, degree_ - 1, row);
        double carried = 0;
        for (Index i = 0; i < degree_; ++i)
        {
            const double part = double(degree_) * row[i]
                / (knot(span + degree_ + 1 + i) - knot(span + 1 + i));
            derivatives[i] = carried - part;
            carried = part;
        }
        derivatives[degree_] = carried;
    }
    else if (derivatives)
    {
        derivatives[0] = 0;
    }

    if (spans_ == 1 && !periodic_)
    {
        bernsteinRow(degree_, s, row);
    }
    else
    {
        coxDeBoor(span, s, degree_, row);
    }
    return span;
}


Index BSpline::extendedSize() const
{
    return spans_ + degree_;
}


Index BSpline::control(Index extended) const
{
    if (!periodic_)
    {
        return extended;
    }
    // Function e reaches from knot e - degree to e + 1, in spans
    const Index middle = extended - degree_ + (degree_ + 1) / 2;
    return (middle % size_ + size_) % size_;
}


Matrix BSpline::extraction(Index span) const
{
    const Index n = degree_ + 1;
    if (spans_ == 1 && !periodic_)
    {
        return Matrix::Identity(n, n);
    }

    // Both bases at degree + 1 places of the span: N = E B
    const double start = spanStart(span);
    const double length = spanStart(span + 1) - start;
    Matrix ours(n, n), bernsteins(n, n);
    for (Index place = 0; place < n; ++place)
    {
        const double u = n > 1 ? double(place) / double(n - 1) : 0.5;
        coxDeBoor(span, start + u * length, degree_, ours.col(place).data());
        bernsteinRow(degree_, u, bernsteins.col(place).data());
    }
    return bernsteins.transpose()
        .partialPivLu()
        .solve(ours.transpose())
        .transpose();
}

} // namespace morph
