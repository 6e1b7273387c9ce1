// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Free-form deformation: bases, boxes, lattices, what they keep.

#include "bernstein.hpp"
#include "ffdFrame.hpp"
#include "ffdLattice.hpp"
#include "test_support.hpp"

#include <cmath>

using namespace test;

namespace
{

using Real = long double;

const double pi = std::acos(-1.0);


// Seed of the formulas: b_i^n(s) = C(n,i) s^i (1 - s)^(n - i), as it stands
Real bernstein(Index n, Index i, Real s)
{
    Real c = 1;
    for (Index k = 1; k <= i; ++k)
    {
        c = c * Real(n - k + 1) / Real(k);
    }
    return c * std::pow(s, Real(i)) * std::pow(1 - s, Real(n - i));
}


// The recursive definition of Cox and de Boor, by itself (Piegl and Tiller,
// The NURBS Book, eq. 2.5), with clamped uniform knots
Real coxDeBoor(Index n, Index i, Index p, Index degree, Real s)
{
    const Index spans = n - degree;
    const auto knot = [&](Index j)
    {
        return std::min(
            std::max(Real(j - degree) / Real(spans), Real(0)), Real(1));
    };
    if (p == 0)
    {
        const bool last = s == 1 && knot(i) < 1 && knot(i + 1) == 1;
        return last || (knot(i) <= s && s < knot(i + 1)) ? 1 : 0;
    }
    Real value = 0;
    if (knot(i + p) > knot(i))
    {
        value += (s - knot(i)) / (knot(i + p) - knot(i))
            * coxDeBoor(n, i, p - 1, degree, s);
    }
    if (knot(i + p + 1) > knot(i + 1))
    {
        value += (knot(i + p + 1) - s) / (knot(i + p + 1) - knot(i + 1))
            * coxDeBoor(n, i + 1, p - 1, degree, s);
    }
    return value;
}


FfdLattice bernsteinLattice(Index l, Index m, Index n)
{
    return FfdLattice(
        {BSpline::bernstein(l), BSpline::bernstein(m), BSpline::bernstein(n)});
}


Vectors randomVectors(Random& random, Index n, double size = 1)
{
    Vectors v(n, 3);
    for (Index i = 0; i < n; ++i)
    {
        v.row(i) = size * random.inBox().transpose();
    }
    return v;
}


// In [0,1]^3, with the corners
Vectors insidePoints(Random& random, Index n)
{
    Vectors xi(n + 8, 3);
    for (Index i = 0; i < n; ++i)
    {
        xi.row(i) = 0.5 * (random.inBox().array() + 1).matrix().transpose();
    }
    for (Index i = 0; i < 8; ++i)
    {
        xi.row(n + i) << double(i & 1), double((i >> 1) & 1), double(i >> 2);
    }
    return xi;
}


Eigen::Matrix3d rotation(const Vector3& axis, double angle)
{
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}


// Frames of every kind, the hexahedron with none of its sides flat
std::vector<std::unique_ptr<FfdFrame>> frames()
{
    std::vector<std::unique_ptr<FfdFrame>> frames;
    const Eigen::Matrix3d R = rotation(Vector3(1, 2, 3), 0.7);
    frames.emplace_back(
        new AffineFrame(Vector3(0.1, -2, 3), Vector3(2, 1, 0.5), R));
    frames.emplace_back(new CylindricalFrame(
        Vector3(1, 2, 3), R, Vector3(0.5, 2.5, -1), Vector3(0.7, 2, 3)));
    frames.emplace_back(new HexahedralFrame(
        {Vector3(0, 0, 0), Vector3(2, 0.1, 0), Vector3(-0.1, 1, 0.2),
         Vector3(1.8, 1.3, -0.1), Vector3(0.2, 0.1, 1), Vector3(1.6, 0, 1.2),
         Vector3(0.1, 1.2, 0.9), Vector3(2.2, 1.1, 1.4)}));
    return frames;
}

} // namespace


TEST(FfdLattice, isTheTensorProductOfBernsteinPolynomials)
{
    Random random(1);
    for (const auto& order : std::vector<std::array<Index, 3>>{
             {{6, 6, 6}}, {{1, 2, 3}}, {{0, 4, 0}}, {{20, 3, 9}}})
    {
        const FfdLattice lattice =
            bernsteinLattice(order[0], order[1], order[2]);
        const Vectors control = randomVectors(random, lattice.size());
        const Vectors xi = insidePoints(random, 200);
        const Vectors d = lattice.displacement(lattice.rows(xi), control);
        for (Index point = 0; point < xi.rows(); ++point)
        {
            Real expected[3] = {0, 0, 0};
            for (Index i = 0; i < lattice.size(); ++i)
            {
                const Index l = i % (order[0] + 1);
                const Index m = i / (order[0] + 1) % (order[1] + 1);
                const Index n = i / ((order[0] + 1) * (order[1] + 1));
                const Real b = bernstein(order[0], l, xi(point, 0))
                    * bernstein(order[1], m, xi(point, 1))
                    * bernstein(order[2], n, xi(point, 2));
                for (int c = 0; c < 3; ++c)
                {
                    expected[c] += b * Real(control(i, c));
                }
            }
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_TRUE(within(
                    "Bernstein tensor product",
                    double(std::abs(expected[c] - Real(d(point, c)))), 1e-14));
            }
        }
    }
}


// All control points move, at the ends and where the functions are least alike
TEST(FfdLattice, isExactForOrderForty)
{
    Random random(40);
    const Index n = 40;
    for (const auto& order : std::vector<std::array<Index, 3>>{
             {{n, 1, 1}}, {{1, n, n}}, {{n, n, n}}})
    {
        const FfdLattice lattice =
            bernsteinLattice(order[0], order[1], order[2]);
        const Vectors control = randomVectors(random, lattice.size());
        const Vectors xi = insidePoints(random, 20);
        const Vectors d = lattice.displacement(lattice.rows(xi), control);
        for (Index point = 0; point < xi.rows(); ++point)
        {
            std::array<std::vector<Real>, 3> b;
            for (int a = 0; a < 3; ++a)
            {
                for (Index i = 0; i <= order[a]; ++i)
                {
                    b[a].push_back(bernstein(order[a], i, xi(point, a)));
                }
            }
            Real expected[3] = {0, 0, 0};
            for (Index i = 0; i < lattice.size(); ++i)
            {
                const Index l = i % (order[0] + 1);
                const Index m = i / (order[0] + 1) % (order[1] + 1);
                const Index k = i / ((order[0] + 1) * (order[1] + 1));
                for (int c = 0; c < 3; ++c)
                {
                    expected[c] += b[0][std::size_t(l)] * b[1][std::size_t(m)]
                        * b[2][std::size_t(k)] * Real(control(i, c));
                }
            }
            for (int c = 0; c < 3; ++c)
            {
                EXPECT_TRUE(within(
                    "Bernstein polynomials of order 40",
                    double(std::abs(expected[c] - Real(d(point, c)))), 1e-13));
            }
        }
    }
}


TEST(BSpline, isThatOfCoxAndDeBoor)
{
    Random random(2);
    for (Index degree = 0; degree <= 6; ++degree)
    {
        for (Index n = degree + 1; n <= degree + 5; ++n)
        {
            const BSpline basis(n, degree);
            std::vector<double> row(std::size_t(degree + 1));
            for (int place = 0; place <= 40; ++place)
            {
                const double s = place <= 8 ? place / 8.0 : random.uniform();
                const Index first = basis.values(s, row.data());
                for (Index i = 0; i < n; ++i)
                {
                    const double value = i < first || i > first + degree
                        ? 0
                        : row[std::size_t(i - first)];
                    EXPECT_NEAR(
                        value, double(coxDeBoor(n, i, degree, degree, s)),
                        2e-15)
                        << n << ' ' << degree << ' ' << i << ' ' << s;
                }
            }
        }
    }
}


TEST(BSpline, isAPartitionOfUnity)
{
    Random random(3);
    for (const auto ends : {BSpline::Ends::clamped, BSpline::Ends::periodic})
    {
        for (Index degree = 0; degree <= 12; ++degree)
        {
            const BSpline basis(degree + 4, degree, ends);
            std::vector<double> row(std::size_t(degree + 1));
            std::vector<double> slope(row.size());
            for (int place = 0; place < 50; ++place)
            {
                basis.values(random.uniform(), row.data(), slope.data());
                double sum = 0, slopes = 0;
                for (std::size_t i = 0; i < row.size(); ++i)
                {
                    EXPECT_GE(row[i], 0);
                    sum += row[i];
                    slopes += slope[i];
                }
                EXPECT_NEAR(sum, 1, 1e-14);
                EXPECT_NEAR(slopes, 0, 1e-12);
            }
        }
    }
}


TEST(BSpline, ofAPeriodicBasisIsSmoothAcrossTheSeam)
{
    // Derivatives up to degree - 1 by differences over the seam: the spline of
    // control points sin(2 pi i/n) approaches a sine everywhere alike
    const Index n = 12, degree = 3;
    const BSpline basis(n, degree, BSpline::Ends::periodic);
    const auto spline = [&](double s)
    {
        double row[4], sum = 0;
        const Index first = basis.values(s - std::floor(s), row);
        for (Index i = 0; i <= degree; ++i)
        {
            sum += row[i]
                * std::sin(
                       2 * pi * double(basis.control(first + i)) / double(n));
        }
        return sum;
    };
    const double h = 1e-4;
    for (const double s : {0.0, 0.25, 1.0 / 3})
    {
        // A uniform cubic spline of a sine is a multiple of it at knots
        const double factor = (2 + std::cos(2 * pi / double(n))) / 3;
        EXPECT_NEAR(spline(s), factor * std::sin(2 * pi * s), 1e-14);
        const double left = (spline(s) - spline(s - h)) / h;
        const double right = (spline(s + h) - spline(s)) / h;

        // and its second derivative there a second difference of them
        const double second = 2 * double(n * n)
            * (std::cos(2 * pi / double(n)) - 1) * std::sin(2 * pi * s);
        EXPECT_NEAR((right - left) / h, second, 0.05);
    }
    EXPECT_DOUBLE_EQ(spline(0), spline(1));
}


TEST(BSpline, derivativesAreThoseOfDifferences)
{
    Random random(4);
    for (const auto ends : {BSpline::Ends::clamped, BSpline::Ends::periodic})
    {
        for (Index degree = 1; degree <= 6; ++degree)
        {
            const BSpline basis(degree + 3, degree, ends);
            const std::size_t n = std::size_t(degree + 1);
            std::vector<double> slope(n), row(n), above(n), below(n);
            const double h = 1e-6;
            for (int place = 0; place < 20; ++place)
            {
                const double s = random.uniform(h, 1 - h);
                const Index first = basis.values(s, row.data(), slope.data());
                if (basis.values(s - h, below.data()) != first
                    || basis.values(s + h, above.data()) != first)
                {
                    continue;
                }
                for (std::size_t i = 0; i < n; ++i)
                {
                    EXPECT_NEAR(
                        slope[i], (above[i] - below[i]) / (2 * h), 1e-7);
                }
            }
        }
    }
}


TEST(BSpline, extractionGivesItsBernsteinForm)
{
    for (const auto ends : {BSpline::Ends::clamped, BSpline::Ends::periodic})
    {
        for (Index degree = 0; degree <= 5; ++degree)
        {
            const BSpline basis(degree + 4, degree, ends);
            Eigen::VectorXd row(degree + 1), b(degree + 1);
            for (Index span = 0; span < basis.spans(); ++span)
            {
                const Matrix E = basis.extraction(span);
                for (const double u : {0.1, 0.35, 0.9})
                {
                    const double s = basis.spanStart(span)
                        + u
                            * (basis.spanStart(span + 1)
                               - basis.spanStart(span));
                    ASSERT_EQ(basis.values(s, row.data()), basis.firstOf(span));
                    bernsteinRow(degree, u, b.data());
                    EXPECT_LT((E * b - row).cwiseAbs().maxCoeff(), 1e-13);
                }
            }
        }
    }
}


TEST(BSpline, refusesADegreeThatItsPointsDoNotAllow)
{
    EXPECT_THROW(BSpline(3, 3), std::invalid_argument);
    EXPECT_THROW(BSpline(3, -1), std::invalid_argument);
    EXPECT_NO_THROW(BSpline(3, 2));
}


// --- lattices


TEST(FfdLattice, withAllControlPointsMovedAlikeMovesEveryPointSo)
{
    Random random(5);
    const BSpline cubic(7, 3);
    for (const FfdLattice& lattice :
         {bernsteinLattice(6, 6, 6), FfdLattice({cubic, cubic, cubic})})
    {
        const Vector3 d(0.3, -0.2, 0.7);
        const Vectors control =
            Vectors::Zero(lattice.size(), 3).rowwise() + d.transpose();
        const Vectors xi = insidePoints(random, 100);
        const Vectors moved = lattice.displacement(lattice.rows(xi), control);
        EXPECT_TRUE(within(
            "partition of unity",
            (moved.rowwise() - d.transpose()).cwiseAbs().maxCoeff(), 1e-14));
    }
}


TEST(FfdLattice, carriesAnAffineMapOfItsControlPointsToEveryPoint)
{
    // Bernstein polynomials reproduce s itself from l/L; clamped splines from
    // their Greville abscissae (Farin, ch. 8): the means of degree knots
    Random random(6);
    const Index n = 6;
    for (const Index degree : {Index(3), n})
    {
        const BSpline basis(n + 1, degree);
        const FfdLattice lattice({basis, basis, basis});
        const auto abscissa = [&](Index i)
        {
            double sum = 0;
            for (Index j = i + 1; j <= i + degree; ++j)
            {
                const double u = double(j - degree) / double(basis.spans());
                sum += std::min(std::max(u, 0.0), 1.0);
            }
            return sum / double(degree);
        };
        const Eigen::Matrix3d A = Eigen::Matrix3d::Random();
        const Vector3 b = random.inBox();
        Vectors control(lattice.size(), 3);
        for (Index i = 0; i < lattice.size(); ++i)
        {
            const Vector3 at(
                abscissa(i % 7), abscissa(i / 7 % 7), abscissa(i / 49));
            control.row(i) = (A * at + b).transpose();
        }
        const Vectors xi = insidePoints(random, 100);
        const Vectors d = lattice.displacement(lattice.rows(xi), control);
        const Vectors expected = (xi * A.transpose()).rowwise() + b.transpose();
        EXPECT_TRUE(within(
            "affine invariance", (d - expected).cwiseAbs().maxCoeff(),
            2e-15 * 8));
    }
}


TEST(FfdLattice, movesTheCornersOfTheBoxAsItsOwn)
{
    Random random(7);
    const BSpline cubic(7, 3);
    for (const FfdLattice& lattice :
         {bernsteinLattice(6, 6, 6), FfdLattice({cubic, cubic, cubic})})
    {
        const Vectors control = randomVectors(random, lattice.size());
        for (Index corner = 0; corner < 8; ++corner)
        {
            const Vector3 xi(
                double(corner & 1), double((corner >> 1) & 1),
                double(corner >> 2));
            const Index number = lattice.number(
                6 * (corner & 1), 6 * ((corner >> 1) & 1), 6 * (corner >> 2));
            EXPECT_EQ(
                lattice.displacement(xi, control),
                Vector3(control.row(number).transpose()));
        }
    }
}


TEST(FfdLattice, isSmoothAcrossAFaceByTheLayersThatRest)
{
    // r layers at rest: the displacement grows with the power r of the
    // distance, so that the map is C^(r - 1)
    const BSpline cubic(9, 3);
    for (const BSpline& basis : {BSpline::bernstein(6), cubic})
    {
        const FfdLattice lattice(
            {basis, BSpline::bernstein(2), BSpline::bernstein(2)});
        for (Index layers = 1; layers <= 3; ++layers)
        {
            Vectors control = Vectors::Zero(lattice.size(), 3);
            for (Index l = layers; l < basis.size(); ++l)
            {
                for (Index i = 0; i < 9; ++i)
                {
                    control.row(l + basis.size() * i) << 0.1, 0.3, -0.2;
                }
            }
            const double h = 1e-3;
            const double near =
                lattice.displacement(Vector3(h, 0.4, 0.6), control).norm();
            const double far =
                lattice.displacement(Vector3(2 * h, 0.4, 0.6), control).norm();
            const double exponent = std::log2(far / near);
            EXPECT_TRUE(within(
                "exponent of " + std::to_string(layers) + " frozen layers",
                std::abs(exponent - double(layers)), 0.02));
        }
    }
}


TEST(FfdLattice, withControlPointsAtRestGivesExactlyZero)
{
    Random random(8);
    const BSpline cubic(7, 3);
    const FfdLattice lattice({cubic, cubic, cubic});
    const Vectors xi = insidePoints(random, 100);
    const Vectors d = lattice.displacement(
        lattice.rows(xi), Vectors::Zero(lattice.size(), 3));
    EXPECT_EQ(d, Vectors::Zero(xi.rows(), 3));
}


TEST(FfdLattice, withWeightsIsTheRationalSum)
{
    Random random(9);
    const std::array<BSpline, 3> basis{
        {BSpline(5, 2), BSpline::bernstein(3), BSpline::bernstein(0)}};
    const Index n = 20;
    std::vector<double> weights;
    for (Index i = 0; i < n; ++i)
    {
        weights.push_back(random.uniform(0.2, 4));
    }
    const FfdLattice lattice(basis, weights);
    const FfdLattice plain(basis);
    const Vectors control = randomVectors(random, n);

    // Numerator and denominator by a lattice without weights
    Vectors weighted(n, 3), weight(n, 3);
    for (Index i = 0; i < n; ++i)
    {
        weighted.row(i) = weights[std::size_t(i)] * control.row(i);
        weight.row(i).setConstant(weights[std::size_t(i)]);
    }
    const Vectors xi = insidePoints(random, 50);
    const Vectors d = lattice.displacement(lattice.rows(xi), control);
    const LatticeRows rows = plain.rows(xi);
    const Vectors expected =
        plain.displacement(rows, weighted)
            .cwiseQuotient(plain.displacement(rows, weight));
    EXPECT_LT((d - expected).cwiseAbs().maxCoeff(), 1e-14);

    // Weights that are all alike change nothing
    const FfdLattice alike(basis, std::vector<double>(std::size_t(n), 3.0));
    EXPECT_LT(
        (alike.displacement(alike.rows(xi), control)
         - plain.displacement(rows, control))
            .cwiseAbs()
            .maxCoeff(),
        1e-14);
}


TEST(FfdLattice, gradientIsThatOfDifferences)
{
    Random random(10);
    const std::array<BSpline, 3> basis{
        {BSpline(6, 3), BSpline::bernstein(4), BSpline(5, 2)}};
    std::vector<double> weights;
    for (Index i = 0; i < 150; ++i)
    {
        weights.push_back(random.uniform(0.5, 2));
    }
    for (const FfdLattice& lattice :
         {FfdLattice(basis), FfdLattice(basis, weights)})
    {
        const Vectors control = randomVectors(random, lattice.size());
        for (int i = 0; i < 20; ++i)
        {
            const Vector3 xi = 0.5 * (random.inBox().array() + 1);
            const Eigen::Matrix3d gradient = lattice.gradient(xi, control);
            const double h = 1e-5;
            for (int d = 0; d < 3; ++d)
            {
                const Vector3 step = h * Vector3::Unit(d);
                const Vector3 difference =
                    lattice.displacement(xi + step, control)
                    - lattice.displacement(xi - step, control);
                // Second derivatives of these splines jump at knots
                EXPECT_LT(
                    (gradient.col(d) - difference / (2 * h)).norm(), 2e-4);
            }
        }
    }
}


// --- boxes


TEST(FfdFrame, findsAPointWhereItPutIt)
{
    Random random(11);
    for (const auto& frame : frames())
    {
        const Vectors xi = insidePoints(random, 200);
        for (Index i = 0; i < xi.rows(); ++i)
        {
            const Vector3 at = xi.row(i).transpose();
            EXPECT_LT(
                (frame->coordinates(frame->position(at)) - at).norm(), 1e-13);
        }
    }
}


TEST(FfdFrame, derivativesAreThoseOfDifferences)
{
    Random random(12);
    const double h = 1e-6;
    for (const auto& frame : frames())
    {
        for (int i = 0; i < 30; ++i)
        {
            const Vector3 xi = 0.5 * (0.9 * random.inBox().array() + 1);
            const Vector3 x = frame->position(xi);
            const Vector3 d = 0.2 * random.inBox();
            for (int c = 0; c < 3; ++c)
            {
                const Vector3 step = h * Vector3::Unit(c);
                const Vector3 byPosition = frame->displacement(x + step, d)
                    - frame->displacement(x - step, d);
                const Vector3 byLattice = frame->displacement(x, d + step)
                    - frame->displacement(x, d - step);
                const Vector3 coordinates =
                    frame->coordinates(x + step) - frame->coordinates(x - step);
                EXPECT_LT(
                    (frame->displacementByPosition(x, d).col(c)
                     - byPosition / (2 * h))
                        .norm(),
                    1e-8);
                EXPECT_LT(
                    (frame->displacementByLattice(x, d).col(c)
                     - byLattice / (2 * h))
                        .norm(),
                    1e-8);
                EXPECT_LT(
                    (frame->gradient(x).col(c) - coordinates / (2 * h)).norm(),
                    1e-7);
            }
        }
    }
}


TEST(FfdFrame, ofARingHasNoCut)
{
    // A quarter that lies across the angle pi: neighbours remain neighbours
    const CylindricalFrame frame(
        Vector3::Zero(), Eigen::Matrix3d::Identity(), Vector3(1, 0.75 * pi, 0),
        Vector3(1, 0.5 * pi, 1));
    for (const double side : {-1e-12, 1e-12})
    {
        const Vector3 xi = frame.coordinates(Vector3(-1.5, side, 0.5));
        EXPECT_NEAR(xi[1], 0.5, 1e-11);
    }
    EXPECT_NEAR(frame.coordinates(Vector3(-1.5, 1.5, 0.5))[1], 0, 1e-14);
    EXPECT_NEAR(frame.coordinates(Vector3(-1.5, -1.5, 0.5))[1], 1, 1e-14);
    EXPECT_FALSE(frame.ring());
}


TEST(FfdFrame, displacesInCylindricalCoordinates)
{
    const CylindricalFrame frame(
        Vector3(1, 0, 0), Eigen::Matrix3d::Identity(), Vector3(0, 0, 0),
        Vector3(2, 2 * pi, 1));
    EXPECT_TRUE(frame.ring());
    const Vector3 x(1 + std::cos(0.4), std::sin(0.4), 0.3);
    const Vector3 moved = x + frame.displacement(x, Vector3(0.5, 0.2, -0.1));
    EXPECT_LT(
        (moved - Vector3(1 + 1.5 * std::cos(0.6), 1.5 * std::sin(0.6), 0.2))
            .norm(),
        1e-15);
    EXPECT_EQ(frame.displacement(x, Vector3::Zero()), Vector3::Zero());
}


TEST(FfdFrame, refusesBoxesThatAreNone)
{
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    const Vector3 zero = Vector3::Zero();
    const Vector3 one = Vector3::Ones();
    EXPECT_THROW(AffineFrame(zero, Vector3(1, 0, 1), I), std::invalid_argument);
    EXPECT_THROW(
        AffineFrame(zero, Vector3(1, 1, -1), I), std::invalid_argument);
    EXPECT_THROW(
        CylindricalFrame(zero, I, Vector3(-0.1, 0, 0), one),
        std::invalid_argument);
    EXPECT_THROW(
        CylindricalFrame(zero, I, zero, Vector3(1, 7, 1)),
        std::invalid_argument);
    std::array<Vector3, 8> corners;
    for (int i = 0; i < 8; ++i)
    {
        corners[std::size_t(i)] = Vector3(i & 1, (i >> 1) & 1, i >> 2);
    }
    EXPECT_NO_THROW(HexahedralFrame{corners});
    std::swap(corners[6], corners[7]);
    EXPECT_THROW(HexahedralFrame{corners}, std::invalid_argument);
}
