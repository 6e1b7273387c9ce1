// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Polynomials of three variables on [0,1]^3 in the Bernstein basis.

#ifndef morph_tensorPolynomial_hpp
#define morph_tensorPolynomial_hpp

#include "arrays.hpp"

#include <array>
#include <utility>
#include <vector>

namespace morph
{

// sum_ijk c_ijk b_i(x) b_j(y) b_k(z), of a degree in each variable. Its
// coefficients bound it from both sides, and those at the corners are its
// values there (Farouki 2012, The Bernstein polynomial basis: a centennial
// retrospective, DOI 10.1016/j.cagd.2012.03.001)
class TensorPolynomial
{
public:
    using Degrees = std::array<Index, 3>;

    // A constant
    explicit TensorPolynomial(double value = 0);

    // Coefficient (i,j,k) is number i + (n_x + 1)(j + (n_y + 1) k)
    TensorPolynomial(
        const Degrees& degrees, const std::vector<double>& coefficients);

    const Degrees& degrees() const { return degrees_; }

    const std::vector<double>& coefficients() const { return coefficients_; }

    double smallest() const;

    double largest() const;

    // By de Casteljau's algorithm
    double operator()(const Vector3& x) const;

    // Value at a corner: bit d of its number tells which end of direction d
    double corner(int number) const;

    TensorPolynomial derivative(int direction) const;

    // The same polynomial with degrees at least as given
    TensorPolynomial elevated(const Degrees& degrees) const;

    // On the lower and on the upper half, each with variables in [0,1]
    std::pair<TensorPolynomial, TensorPolynomial> halves(int direction) const;

    // Largest difference of neighbouring coefficients along a direction, times
    // the degree: a bound of the slope
    double variation(int direction) const;

    // Is it zero, coefficient for coefficient?
    bool isZero() const;

    // The number of coefficients that are not zero
    Index nonZero() const;

    TensorPolynomial& operator+=(const TensorPolynomial& other);

    TensorPolynomial& operator*=(double factor);

    friend TensorPolynomial
    operator*(const TensorPolynomial& a, const TensorPolynomial& b);

private:
    Index stride(int direction) const;

    Degrees degrees_;

    std::vector<double> coefficients_;
};


inline TensorPolynomial operator+(TensorPolynomial a, const TensorPolynomial& b)
{
    return a += b;
}


inline TensorPolynomial operator*(double factor, TensorPolynomial a)
{
    return a *= factor;
}

} // namespace morph

#endif
