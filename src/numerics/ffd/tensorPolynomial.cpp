// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tensorPolynomial.hpp"

#include "bernstein.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace morph
{

namespace
{

// Of one product: some ten seconds
const double mostOperations = 2e10;


Index count(const TensorPolynomial::Degrees& degrees)
{
    return (degrees[0] + 1) * (degrees[1] + 1) * (degrees[2] + 1);
}


// Multiply (or divide) coefficients by the binomials of their functions
void scaleByBinomials(
    const TensorPolynomial::Degrees& degrees, bool divide,
    std::vector<double>& coefficients)
{
    std::array<std::vector<double>, 3> binomials;
    for (std::size_t d = 0; d < 3; ++d)
    {
        for (Index i = 0; i <= degrees[d]; ++i)
        {
            binomials[d].push_back(binomial(degrees[d], i));
        }
    }
    auto c = coefficients.begin();
    for (const double z : binomials[2])
    {
        for (const double y : binomials[1])
        {
            for (const double x : binomials[0])
            {
                *c = divide ? *c / (x * y * z) : *c * (x * y * z);
                ++c;
            }
        }
    }
}

} // namespace


TensorPolynomial::TensorPolynomial(double value)
: degrees_{{0, 0, 0}},
  coefficients_(1, value)
{
}


TensorPolynomial::TensorPolynomial(
    const Degrees& degrees, const std::vector<double>& coefficients)
: degrees_(degrees),
  coefficients_(coefficients)
{
}


double TensorPolynomial::smallest() const
{
    return *std::min_element(coefficients_.begin(), coefficients_.end());
}


double TensorPolynomial::largest() const
{
    return *std::max_element(coefficients_.begin(), coefficients_.end());
}


double TensorPolynomial::operator()(const Vector3& x) const
{
    std::vector<double> row[3];
    for (std::size_t d = 0; d < 3; ++d)
    {
        row[d].resize(std::size_t(degrees_[d] + 1));
        bernsteinRow(degrees_[d], x[Index(d)], row[d].data());
    }
    double sum = 0;
    auto c = coefficients_.begin();
    for (const double z : row[2])
    {
        for (const double y : row[1])
        {
            for (const double value : row[0])
            {
                sum += value * y * z * (*c++);
            }
        }
    }
    return sum;
}


double TensorPolynomial::corner(int number) const
{
    Index i = 0;
    for (int d = 0; d < 3; ++d)
    {
        if (number & (1 << d))
        {
            i += stride(d) * degrees_[std::size_t(d)];
        }
    }
    return coefficients_[std::size_t(i)];
}


Index TensorPolynomial::stride(int direction) const
{
    Index stride = 1;
    for (int d = 0; d < direction; ++d)
    {
        stride *= degrees_[std::size_t(d)] + 1;
    }
    return stride;
}


TensorPolynomial TensorPolynomial::derivative(int direction) const
{
    const Index n = degrees_[std::size_t(direction)];
    if (n == 0)
    {
        return TensorPolynomial(0);
    }
    Degrees degrees = degrees_;
    degrees[std::size_t(direction)] = n - 1;

    const Index step = stride(direction);
    std::vector<double> result;
    result.reserve(std::size_t(count(degrees)));
    for (Index i = 0; i < Index(coefficients_.size()); ++i)
    {
        if ((i / step) % (n + 1) < n)
        {
            const std::size_t c = std::size_t(i);
            result.push_back(
                double(n)
                * (coefficients_[c + std::size_t(step)] - coefficients_[c]));
        }
    }
    return TensorPolynomial(degrees, result);
}


TensorPolynomial TensorPolynomial::elevated(const Degrees& degrees) const
{
    Degrees missing, reached;
    bool some = false;
    for (std::size_t d = 0; d < 3; ++d)
    {
        missing[d] = std::max(degrees[d] - degrees_[d], Index(0));
        reached[d] = degrees_[d] + missing[d];
        some = some || missing[d] > 0;
    }
    if (!some)
    {
        return *this;
    }
    if (isZero())
    {
        return TensorPolynomial(
            reached, std::vector<double>(std::size_t(count(reached)), 0.0));
    }
    TensorPolynomial result(*this);
    for (std::size_t d = 0; d < 3; ++d)
    {
        Degrees along{{0, 0, 0}};
        along[d] = missing[d];
        const std::vector<double> ones(std::size_t(missing[d] + 1), 1.0);
        result = result * TensorPolynomial(along, ones);
    }
    return result;
}


std::pair<TensorPolynomial, TensorPolynomial>
TensorPolynomial::halves(int direction) const
{
    const Index n = degrees_[std::size_t(direction)];
    const Index step = stride(direction);
    TensorPolynomial lower(*this);
    TensorPolynomial upper(*this);
    for (Index i = 0; i < Index(coefficients_.size()); ++i)
    {
        if ((i / step) % (n + 1) != 0)
        {
            continue;
        }
        // De Casteljau at 1/2: the first of each round stays below, what is
        // left at the end is above
        double* const below = lower.coefficients_.data() + i;
        double* const above = upper.coefficients_.data() + i;
        for (Index round = 1; round <= n; ++round)
        {
            for (Index j = 0; j <= n - round; ++j)
            {
                above[j * step] =
                    0.5 * (above[j * step] + above[(j + 1) * step]);
            }
            below[round * step] = above[0];
        }
    }
    return {lower, upper};
}


double TensorPolynomial::variation(int direction) const
{
    const Index n = degrees_[std::size_t(direction)];
    const Index step = stride(direction);
    double largest = 0;
    for (Index i = 0; i < Index(coefficients_.size()); ++i)
    {
        if ((i / step) % (n + 1) < n)
        {
            const std::size_t c = std::size_t(i);
            largest = std::max(
                largest,
                std::abs(
                    coefficients_[c + std::size_t(step)] - coefficients_[c]));
        }
    }
    return double(n) * largest;
}


bool TensorPolynomial::isZero() const
{
    return std::all_of(
        coefficients_.begin(), coefficients_.end(),
        [](double c) { return c == 0; });
}


Index TensorPolynomial::nonZero() const
{
    return Index(coefficients_.size())
        - Index(std::count(coefficients_.begin(), coefficients_.end(), 0.0));
}


TensorPolynomial& TensorPolynomial::operator+=(const TensorPolynomial& other)
{
    Degrees degrees;
    for (std::size_t d = 0; d < 3; ++d)
    {
        degrees[d] = std::max(degrees_[d], other.degrees_[d]);
    }
    *this = elevated(degrees);
    const TensorPolynomial term = other.elevated(degrees);
    for (std::size_t i = 0; i < coefficients_.size(); ++i)
    {
        coefficients_[i] += term.coefficients_[i];
    }
    return *this;
}


TensorPolynomial& TensorPolynomial::operator*=(double factor)
{
    for (double& c : coefficients_)
    {
        c *= factor;
    }
    return *this;
}


TensorPolynomial
operator*(const TensorPolynomial& first, const TensorPolynomial& second)
{
    // What is zero costs nothing: few points of a large lattice move
    const double some[] = {double(first.nonZero()), double(second.nonZero())};
    if (some[0] == 0 || some[1] == 0)
    {
        return TensorPolynomial(0);
    }
    const double costs[] = {
        some[0] * double(second.coefficients_.size()),
        some[1] * double(first.coefficients_.size())};
    const bool inOrder = costs[0] <= costs[1];
    const TensorPolynomial& a = inOrder ? first : second;
    const TensorPolynomial& b = inOrder ? second : first;
    if (std::min(costs[0], costs[1]) > mostOperations)
    {
        throw std::length_error(
            "so many control points of so high an order move that it would"
            " take minutes to see whether the lattice folds");
    }

    // Of coefficients times binomials, a product is a plain convolution
    std::vector<double> scaledA = a.coefficients_;
    std::vector<double> scaledB = b.coefficients_;
    scaleByBinomials(a.degrees_, false, scaledA);
    scaleByBinomials(b.degrees_, false, scaledB);

    TensorPolynomial::Degrees n;
    for (std::size_t d = 0; d < 3; ++d)
    {
        n[d] = a.degrees_[d] + b.degrees_[d];
    }
    std::vector<double> product(std::size_t(count(n)), 0.0);

    const double* valueA = scaledA.data();
    for (Index ka = 0; ka <= a.degrees_[2]; ++ka)
    {
        for (Index ja = 0; ja <= a.degrees_[1]; ++ja)
        {
            for (Index ia = 0; ia <= a.degrees_[0]; ++ia)
            {
                const double factor = *valueA++;
                if (factor == 0)
                {
                    continue;
                }
                const double* valueB = scaledB.data();
                for (Index kb = 0; kb <= b.degrees_[2]; ++kb)
                {
                    for (Index jb = 0; jb <= b.degrees_[1]; ++jb)
                    {
                        double* const to = product.data() + ia
                            + (n[0] + 1) * (ja + jb + (n[1] + 1) * (ka + kb));
                        for (Index ib = 0; ib <= b.degrees_[0]; ++ib)
                        {
                            to[ib] += factor * valueB[ib];
                        }
                        valueB += b.degrees_[0] + 1;
                    }
                }
            }
        }
    }
    scaleByBinomials(n, true, product);
    return TensorPolynomial(n, product);
}

} // namespace morph
