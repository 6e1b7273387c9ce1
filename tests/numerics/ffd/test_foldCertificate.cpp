// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// When does a lattice fold? Against determinants sampled densely, and cases in
// which the first place to fold is known.

#include "foldCertificate.hpp"
#include "test_support.hpp"

#include <cmath>

using namespace test;

namespace
{

const double tolerance = 1e-4;

const double pi = std::acos(-1.0);


std::unique_ptr<FfdFrame> unitBox()
{
    return std::unique_ptr<FfdFrame>(new AffineFrame(
        Vector3::Zero(), Vector3::Ones(), Eigen::Matrix3d::Identity()));
}


// The determinant in coordinates of the frame by the gradient of the lattice,
// at the given scale
double determinantAt(
    const FfdFrame& frame, const FfdLattice& lattice, const Vectors& control,
    const Vector3& xi, double scale)
{
    Eigen::Matrix3d J = scale * lattice.gradient(xi, control);
    for (int d = 0; d < 3; ++d)
    {
        Vector3 from = xi, to = xi;
        from[d] = 0;
        to[d] = 1;
        J.col(d) += frame.frameCoordinates(to) - frame.frameCoordinates(from);
    }
    return J.determinant();
}


// The first scale at which a sampled determinant (or radius) is not positive
double sampledScale(
    const FfdFrame& frame, const FfdLattice& lattice, const Vectors& control,
    Index n)
{
    double first = 1;
    std::array<Index, 3> places;
    for (std::size_t d = 0; d < 3; ++d)
    {
        places[d] = lattice.basis(int(d)).size() > 1 ? n : 1;
    }
    for (Index i = 0; i < places[0]; ++i)
    {
        for (Index j = 0; j < places[1]; ++j)
        {
            for (Index k = 0; k < places[2]; ++k)
            {
                const Vector3 xi(
                    double(i) / double(n - 1), double(j) / double(n - 1),
                    double(k) / double(n - 1));
                for (double t = 0; t <= first; t += 0.01)
                {
                    if (determinantAt(frame, lattice, control, xi, t) <= 0)
                    {
                        double low = t - 0.01, high = t;
                        while (high - low > 1e-7)
                        {
                            const double middle = 0.5 * (low + high);
                            const bool folds =
                                determinantAt(
                                    frame, lattice, control, xi, middle)
                                <= 0;
                            (folds ? high : low) = middle;
                        }
                        first = std::min(first, high);
                        break;
                    }
                }
            }
        }
    }
    return first;
}

} // namespace


TEST(FoldCertificate, findsTheFirstFoldOfAParabola)
{
    // x = s + mu 2 s (1 - s): dx/ds = 1 + mu (2 - 4 s), zero at s = 1 for
    // mu = 1/2
    const auto box = unitBox();
    const FfdLattice lattice(
        {BSpline::bernstein(2), BSpline::bernstein(0), BSpline::bernstein(0)});
    for (const double mu : {0.49, 0.51, 0.8, 4.0})
    {
        Vectors control = Vectors::Zero(3, 3);
        control(1, 0) = mu;
        FoldCertificate certificate(*box, lattice, control);
        EXPECT_EQ(certificate.valid(), mu < 0.5);
        const double safe = certificate.safeScale(tolerance);
        EXPECT_LE(safe, 0.5 / mu + 1e-9);
        EXPECT_GE(safe, std::min(1.0, 0.5 / mu) - tolerance);
        if (mu > 0.5)
        {
            EXPECT_NEAR(certificate.where()[0], 1, 1e-12);
        }
    }
}


TEST(FoldCertificate, refusesTheBoundaryPointOfTheThesisThatIsMovedInwards)
{
    // As in Lombardi's fig. 2.8 and 2.9: a point of the upper boundary of a
    // 2D lattice moves along y, by -0.6 outside in, or by 0.6; with the point
    // of the lower boundary the signs change. x is at rest, so that the
    // determinant is 1 + mu b(s) b'(t), whose extremes are known: at s = 1/2
    // b_2^4 = 3/8, and b_0^4'(0) = -4
    const auto box = unitBox();
    const FfdLattice lattice(
        {BSpline::bernstein(4), BSpline::bernstein(4), BSpline::bernstein(0)});
    Vectors control = Vectors::Zero(25, 3);
    control(lattice.number(2, 0, 0), 1) = -0.6;
    EXPECT_TRUE(FoldCertificate(*box, lattice, control).valid());

    // 1 - 4*3/8 mu = 0 at mu = 2/3: 0.6 does not fold one point of five by
    // five, 0.8 does
    control *= -1;
    EXPECT_TRUE(FoldCertificate(*box, lattice, control).valid());
    control(lattice.number(2, 0, 0), 1) = 0.8;
    FoldCertificate folded(*box, lattice, control);
    EXPECT_FALSE(folded.valid());
    EXPECT_NEAR(folded.safeScale(tolerance), (2.0 / 3) / 0.8, tolerance);

    // A corner's function is one at the corner: folds at mu = 1/4
    control.setZero();
    control(lattice.number(0, 0, 0), 1) = 0.6;
    FoldCertificate corner(*box, lattice, control);
    EXPECT_FALSE(corner.valid());
    EXPECT_NEAR(corner.safeScale(tolerance), 0.25 / 0.6, tolerance);
    EXPECT_LT(corner.where().head<2>().norm(), 1e-9);
}


TEST(FoldCertificate, agreesWithDenseSampling)
{
    Random random(1);
    const BSpline quadratic(4, 2);
    const auto box = unitBox();
    const HexahedralFrame hexahedron(
        {Vector3(0, 0, 0), Vector3(2, 0.1, 0), Vector3(-0.1, 1, 0.2),
         Vector3(1.8, 1.3, -0.1), Vector3(0.2, 0.1, 1), Vector3(1.6, 0, 1.2),
         Vector3(0.1, 1.2, 0.9), Vector3(2.2, 1.1, 1.4)});
    std::vector<double> weights;
    for (int i = 0; i < 16; ++i)
    {
        weights.push_back(random.uniform(0.5, 2));
    }
    const BSpline none = BSpline::bernstein(0);
    const std::vector<FfdLattice> lattices{
        FfdLattice({BSpline::bernstein(3), BSpline::bernstein(3), none}),
        FfdLattice({quadratic, quadratic, none}),
        FfdLattice({quadratic, BSpline::bernstein(3), none}, weights),
        FfdLattice(
            {BSpline::bernstein(2), BSpline::bernstein(2),
             BSpline::bernstein(2)})};
    int folded = 0;
    for (const FfdLattice& lattice : lattices)
    {
        const Index n = lattice.basis(2).size() > 1 ? 9 : 33;
        for (int repeat = 0; repeat < 6; ++repeat)
        {
            Vectors control(lattice.size(), 3);
            for (Index i = 0; i < control.rows(); ++i)
            {
                control.row(i) =
                    0.12 * (1 + repeat) * random.inBox().transpose();
            }
            const std::vector<const FfdFrame*> boxes{box.get(), &hexahedron};
            for (const FfdFrame* frame : boxes)
            {
                FoldCertificate certificate(*frame, lattice, control);
                const double sampled =
                    sampledScale(*frame, lattice, control, n);
                const double safe = certificate.safeScale(tolerance);

                // Sampling can only miss a fold; where one was found, there
                // is one
                EXPECT_LE(safe, sampled + 1e-6);
                if (safe < 1 - tolerance)
                {
                    ++folded;
                    double least = 1;
                    for (int i = 0; i <= 20; ++i)
                    {
                        least = std::min(
                            least,
                            determinantAt(
                                *frame, lattice, control, certificate.where(),
                                safe + 0.1 * i * tolerance));
                    }
                    EXPECT_LE(least, 1e-12);
                    EXPECT_TRUE(FoldCertificate(*frame, lattice, control)
                                    .valid(0.999 * safe));
                }
                else
                {
                    EXPECT_TRUE(certificate.valid());
                }
            }
        }
    }
    EXPECT_GT(folded, 20);
    EXPECT_LT(folded, 48);
}


TEST(FoldCertificate, decidesWhereCoefficientsAloneDoNot)
{
    // Two control points that move against each other: the determinant has a
    // negative coefficient and is positive all the same
    const auto box = unitBox();
    const FfdLattice lattice(
        {BSpline::bernstein(4), BSpline::bernstein(0), BSpline::bernstein(0)});
    // dx/ds has the coefficients 1 + 4 (d_(i+1) - d_i)
    Vectors control = Vectors::Zero(5, 3);
    control(1, 0) = 0.25 * 0.5;
    control(2, 0) = control(1, 0) - 0.25 * 1.2;
    control(3, 0) = control(2, 0) + 0.25 * 0.5;
    control(4, 0) = control(3, 0);
    FoldCertificate certificate(*box, lattice, control);
    double smallest = 1;
    for (int i = 0; i <= 1000; ++i)
    {
        smallest = std::min(
            smallest,
            determinantAt(
                *box, lattice, control, Vector3(i / 1000.0, 0, 0), 1));
    }
    ASSERT_GT(smallest, 0.1);
    EXPECT_TRUE(certificate.valid());
    EXPECT_EQ(certificate.safeScale(tolerance), 1);
}


TEST(FoldCertificate, keepsTheRadiusOfACylindricalBoxPositive)
{
    // The radius moves by -mu everywhere: at mu = the inner radius it is zero,
    // though the determinant in (r, theta, z) stays what it was
    const FfdLattice lattice(
        {BSpline::bernstein(1), BSpline::bernstein(1), BSpline::bernstein(0)});
    const CylindricalFrame frame(
        Vector3::Zero(), Eigen::Matrix3d::Identity(), Vector3(0.5, 0, 0),
        Vector3(1, 0.5 * pi, 1));
    Vectors control = Vectors::Zero(4, 3);
    control.col(0).setConstant(-0.8);
    FoldCertificate certificate(frame, lattice, control);
    EXPECT_FALSE(certificate.valid());
    EXPECT_NEAR(certificate.safeScale(tolerance), 0.5 / 0.8, tolerance);

    // From the axis on: r = s (1 + t d) for a layer at rest and one that moves
    const CylindricalFrame whole(
        Vector3::Zero(), Eigen::Matrix3d::Identity(), Vector3(0, 0, 0),
        Vector3(1, 2 * pi, 1));
    control.setZero();
    control(1, 0) = control(3, 0) = -0.9;
    FoldCertificate onAxis(whole, lattice, control);
    EXPECT_TRUE(onAxis.valid());
    EXPECT_EQ(onAxis.safeScale(tolerance), 1);
}


TEST(FoldCertificate, passesALatticeAtRest)
{
    const auto box = unitBox();
    const FfdLattice lattice(
        {BSpline::bernstein(6), BSpline::bernstein(6), BSpline::bernstein(6)});
    FoldCertificate certificate(*box, lattice, Vectors::Zero(343, 3));
    EXPECT_TRUE(certificate.valid());
    EXPECT_EQ(certificate.safeScale(tolerance), 1);
}


TEST(TensorPolynomial, productsAndHalvesAreThoseOfValues)
{
    Random random(2);
    const auto polynomial = [&](const TensorPolynomial::Degrees& n)
    {
        std::vector<double> c;
        for (Index i = 0; i < (n[0] + 1) * (n[1] + 1) * (n[2] + 1); ++i)
        {
            c.push_back(random.uniform(-1, 1));
        }
        return TensorPolynomial(n, c);
    };
    const TensorPolynomial a = polynomial({{3, 0, 2}});
    const TensorPolynomial b = polynomial({{1, 4, 2}});
    const TensorPolynomial product = a * b;
    const TensorPolynomial sum = a + b;
    for (int i = 0; i < 20; ++i)
    {
        const Vector3 x = 0.5 * (random.inBox().array() + 1);
        EXPECT_NEAR(product(x), a(x) * b(x), 1e-14);
        EXPECT_NEAR(sum(x), a(x) + b(x), 1e-14);
        for (int d = 0; d < 3; ++d)
        {
            const auto halves = b.halves(d);
            Vector3 y = x;
            y[d] *= 0.5;
            EXPECT_NEAR(halves.first(x), b(y), 1e-14);
            y[d] += 0.5;
            EXPECT_NEAR(halves.second(x), b(y), 1e-14);
            const double h = 1e-6;
            const Vector3 step = h * Vector3::Unit(d);
            EXPECT_NEAR(
                b.derivative(d)(x), (b(x + step) - b(x - step)) / (2 * h),
                1e-8);
        }
    }
}
