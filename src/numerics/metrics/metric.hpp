// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Sizes that cells should have in each direction, as metrics: symmetric,
// positive definite matrices M in which an edge e has the length
// sqrt(e^T M e). The size along a unit vector n is (n^T M n)^(-1/2) [m]; along
// the i-th eigenvector, with the eigenvalue lambda_i [1/m^2], lambda_i^(-1/2).
//
// Mesri, Y. (2007). Gestion et controle des maillages non structures
// anisotropes. Loseille, A., Alauzet, F. (2011). Continuous mesh framework
// part I. SIAM Journal on Numerical Analysis 49(1), doi:10.1137/090754078

#ifndef morph_metric_hpp
#define morph_metric_hpp

#include "arrays.hpp"

#include <functional>
#include <vector>

namespace morph
{

using Metric = Eigen::Matrix3d;

// f of the eigenvalues of a symmetric matrix
Metric spectral(const Metric& m, const std::function<double(double)>& f);

// The directions that count are those of a basis, d columns: 3 in space, 2 in a
// plane. Across, metrics are whatever they are given
using Basis = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// |H|: eigenvalues of a Hessian as sizes see them, in the directions that
// count, none below a fraction of the largest of the field
Metric absolute(const Metric& hessian, const Basis& basis, double least);

// Smallest and largest size in the directions that count [m]
struct Sizes
{
    double least;
    double most;
};

Sizes sizes(const Metric& m, const Basis& basis);

// det of the directions that count
double determinant(const Metric& m, const Basis& basis);

// Of all metrics whose complexity, the integral of sqrt(det M), is N, the one
// with the least error of linear interpolation in the L^p norm:
//
//     M = D det|H|^(-1/(2p+d)) |H|,   D = N^(2/d) (int det|H|^(p/(2p+d)))^(-2/d)
//
// This is M/D: D follows from the integral of its sqrt(det), which is that one.
Metric optimal(const Metric& absoluteHessian, const Basis& basis, double p);

// Sizes between these, in the directions that count
Metric bounded(const Metric& m, const Basis& basis, double hMin, double hMax);

// The largest metric (in the sense of volume) whose ellipsoid, the vectors of
// length 1, is in those of both: each direction as fine as the finer one wants
// it, by simultaneous reduction
Metric intersection(const Metric& a, const Metric& b);

// What a metric at a distance e [m] allows here, where sizes grow by no more
// than the given factor from a cell to the next (Alauzet 2010,
// doi:10.1016/j.finel.2009.06.028, with sizes that grow alike in all
// directions): M/(1 + ln(growth) sqrt(e^T M e))^2
Metric grown(const Metric& m, const Vector3& e, double growth);

} // namespace morph

#endif
