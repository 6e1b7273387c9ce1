// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the tests of the numerical core have in common: point sets, independent
// computations to compare with, and a record of the largest deviations.

#ifndef morph_test_support_hpp
#define morph_test_support_hpp

#include "communicator.hpp"
#include "controlPoints.hpp"
#include "greedySelection.hpp"
#include "kernel.hpp"
#include "rbfInterpolant.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace test
{

using namespace morph;

// True if deviation <= bound; the largest deviation of each property is printed
// when all tests have run, so that the margin can be seen
testing::AssertionResult
within(const std::string& property, double deviation, double bound);


// The same numbers on every machine
class Random
{
public:
    explicit Random(unsigned seed)
    : engine_(seed)
    {
    }

    double uniform(double low = 0, double high = 1);
    Index below(Index n);
    Vector3 inBox();     // in [-1,1]^3
    Vector3 direction(); // of unit length
    std::vector<Index> permutation(Index n);

    // In [0,1]^dimension (third coordinate 0.3 in 2D), further apart than given
    std::vector<Vector3> pointsApart(Index n, int dimension, double distance);

private:
    std::mt19937 engine_;
};

// How many control points of which sort
struct Mixture
{
    int dimension;
    Index moving;
    Index onSurface;
    Index onEdge;
};

// Control points at random places, no two closer than about half the mean
// distance, with random displacements and normals (in 2D in the plane, where
// the second normal of an edge is that of the plane)
ControlPoints randomControlPoints(Random& random, const Mixture& mixture);

// So many on a wavy sheet in the unit cube that a selection sweeps a sample of
// them: displaced by zero, every seventh slides on the sheet
ControlPoints manyControlPoints();

Vectors rows(const std::vector<Vector3>& x);
Vectors positionRows(const ControlPoints& points);
double largestDisplacement(const ControlPoints& points);

// The largest |a_i - b_i|
double largestDifference(const Vectors& a, const Vectors& b);

std::string nameOf(KernelType type);
std::vector<KernelType> allKernels();
std::vector<KernelType> positiveDefiniteKernels();

// In a unit box of some tens of points: large enough that every point feels
// others, small enough that the system is well conditioned
double moderateRadius(KernelType type);

// The interpolant through all points, none left out
RbfInterpolant throughAll(
    const Kernel& kernel, Polynomial polynomial, const ControlPoints& points);


// Independent computations in long double: nothing in here calls the code
// under test.
namespace reference
{

using Real = long double;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// The coefficients of the Wendland function of smoothness 2k in R^3 by
// Wendland's construction: phi_{3,k} = I^k (1 - d)^(k + 2) with the operator
// I f(d) = int_d^1 t f(t) dt (Wendland 1995, doi:10.1007/BF02123482), scaled to
// 1 at d = 0
std::vector<Real> wendland(int k);

// phi(d)
Real phi(KernelType type, Real d);

// sum_j phi(|x - x_j|/r0) gamma_j + sum_m c_m q_m(x) with q_0 = 1 and
// q_m(x) = axis_m . x
struct Field
{
    KernelType type;
    double radius;
    Columns centres;
    RealMatrix weights; // n x 3
    std::vector<Vector3> axes;
    RealMatrix coefficients; // (1 + number of axes) x 3, or none

    Vectors operator()(const Vectors& x) const;
};

// The plain sum of an interpolant that has no polynomial
Field plainSum(const RbfInterpolant& interpolant);

// G alpha = g, G_ij = phi_ij C_i^T C_j (gramFactor.hpp), by LU with
// full pivoting
Field gram(KernelType type, double radius, const ControlPoints& points);

// The 3 N_c x 3 N_c system (6) of Mastrippolito et al. 2019: rows (2) for
// moving, (3) for the normals and (4, 5) for the tangents of sliding points
Field paper(KernelType type, double radius, const ControlPoints& points);

// [G B; B^T 0] with the polynomials 1 and axis_m . x
Field augmented(
    KernelType type, double radius, const ControlPoints& points,
    const std::vector<Vector3>& axes);

// |g_i - C_i^T s(x_i)|
std::vector<double> errors(const ControlPoints& points, const Vectors& s);

// The standard greedy algorithm (Aubert et al. 2017): the whole system is
// solved anew, then the point of the largest error joins, of equals the first
// by position; until no error exceeds the tolerance [m]. Indices in the order
// of selection.
std::vector<Index> greedy(
    KernelType type, double radius, const ControlPoints& candidates,
    double tolerance);

} // namespace reference


// Runs the action on ranks that are threads of this process, and rethrows what
// one of them threw
void onRanks(int ranks, const std::function<void(Communicator&)>& action);

} // namespace test

#endif
