// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "test_support.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

namespace test
{

namespace
{

struct Record
{
    double deviation = 0;
    double bound = 0;
};


std::map<std::string, Record>& records()
{
    static std::map<std::string, Record> all;
    return all;
}


class RecordsPrinter : public testing::Environment
{
public:
    void TearDown() override
    {
        std::printf("Largest deviations (and their bounds)\n");
        for (const auto& r : records())
        {
            std::printf(
                "  %-58s %9.2e (%.3g)\n", r.first.c_str(), r.second.deviation,
                r.second.bound);
        }
    }
};


const testing::Environment* const printer =
    testing::AddGlobalTestEnvironment(new RecordsPrinter);

} // namespace


testing::AssertionResult
within(const std::string& property, double deviation, double bound)
{
    Record& r = records()[property];
    r.deviation = std::max(r.deviation, deviation);
    r.bound = bound;

    if (deviation <= bound)
    {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
        << property << ": " << deviation << " exceeds " << bound;
}


double Random::uniform(double low, double high)
{
    return low + (high - low) * (engine_() / 4294967296.0);
}


Index Random::below(Index n)
{
    return engine_() % n;
}


Vector3 Random::inBox()
{
    const double x = uniform(-1, 1);
    const double y = uniform(-1, 1);
    const double z = uniform(-1, 1);
    return {x, y, z};
}


Vector3 Random::direction()
{
    while (true)
    {
        const Vector3 v = inBox();
        if (v.norm() > 0.1 && v.norm() < 1)
        {
            return v.normalized();
        }
    }
}


std::vector<Index> Random::permutation(Index n)
{
    std::vector<Index> p(n);
    std::iota(p.begin(), p.end(), Index(0));
    for (Index i = n - 1; i > 0; --i)
    {
        std::swap(p[i], p[below(i + 1)]);
    }
    return p;
}


std::vector<Vector3>
Random::pointsApart(Index n, int dimension, double distance)
{
    std::vector<Vector3> points;
    while (Index(points.size()) < n)
    {
        Vector3 x = 0.5 * (inBox() + Vector3::Ones());
        if (dimension == 2)
        {
            x.z() = 0.3;
        }
        const bool apart = std::all_of(
            points.begin(), points.end(),
            [&](const Vector3& p) { return (p - x).norm() > distance; });
        if (apart)
        {
            points.push_back(x);
        }
    }
    return points;
}


ControlPoints randomControlPoints(Random& random, const Mixture& mixture)
{
    const auto inSpace = [&](Vector3 v)
    {
        if (mixture.dimension == 2)
        {
            v.z() = 0;
        }
        return v;
    };
    const Index n = mixture.moving + mixture.onSurface + mixture.onEdge;
    const double distance = 0.5 * std::pow(1.0 / n, 1.0 / mixture.dimension);

    ControlPoints points;
    for (const Vector3& x : random.pointsApart(n, mixture.dimension, distance))
    {
        const Index i = points.size();
        const Vector3 s = inSpace(0.1 * random.inBox());
        const Vector3 a = inSpace(random.direction());
        const Vector3 b =
            mixture.dimension == 2 ? Vector3::UnitZ() : random.direction();
        points.push_back(
            i < mixture.moving ? ControlPoint::prescribed(x, s)
                : i < mixture.moving + mixture.onSurface
                ? ControlPoint::sliding(x, {a}, s)
                : ControlPoint::sliding(x, {a, b}, s));
    }

    // Not sorted by sort, as in a mesh
    ControlPoints shuffled;
    for (const Index i : random.permutation(n))
    {
        shuffled.push_back(points[i]);
    }
    return shuffled;
}


ControlPoints manyControlPoints()
{
    // Not on a lattice: the places are those of an additive recurrence
    ControlPoints points;
    for (Index i = 0; i < 45000; ++i)
    {
        const double u = std::fmod(0.5 + i * 0.7548776662466927, 1.0);
        const double v = std::fmod(0.5 + i * 0.5698402909980532, 1.0);
        const Vector3 x(u, v, 0.5 + 0.1 * std::sin(6 * u) * std::cos(5 * v));
        const Vector3 normal(
            -0.6 * std::cos(6 * u) * std::cos(5 * v),
            0.5 * std::sin(6 * u) * std::sin(5 * v), 1);
        points.push_back(
            i % 7 == 0 ? ControlPoint::sliding(x, {normal})
                       : ControlPoint::prescribed(x, Vector3::Zero()));
    }
    return points;
}


Vectors rows(const std::vector<Vector3>& x)
{
    Vectors v(x.size(), 3);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        v.row(i) = x[i].transpose();
    }
    return v;
}


Vectors positionRows(const ControlPoints& points)
{
    std::vector<Vector3> x;
    for (const ControlPoint& p : points)
    {
        x.push_back(p.position);
    }
    return rows(x);
}


double largestDisplacement(const ControlPoints& points)
{
    double largest = 0;
    for (const ControlPoint& p : points)
    {
        largest = std::max(largest, p.value.head(p.k).norm());
    }
    return largest;
}


double largestDifference(const Vectors& a, const Vectors& b)
{
    return a.rows() > 0 ? (a - b).rowwise().norm().maxCoeff() : 0;
}


std::string nameOf(KernelType type)
{
    return kernelNames()[int(type)].second;
}


std::vector<KernelType> allKernels()
{
    return {KernelType::wendlandC0,   KernelType::wendlandC2,
            KernelType::wendlandC4,   KernelType::wendlandC6,
            KernelType::gaussian,     KernelType::inverseMultiQuadric,
            KernelType::multiQuadric, KernelType::thinPlate};
}


std::vector<KernelType> positiveDefiniteKernels()
{
    std::vector<KernelType> types = allKernels();
    types.resize(6);
    return types;
}


double moderateRadius(KernelType type)
{
    switch (type)
    {
    case KernelType::gaussian:
    case KernelType::inverseMultiQuadric:
    case KernelType::multiQuadric:
        return 0.25;
    default:
        return 0.8;
    }
}


RbfInterpolant throughAll(
    const Kernel& kernel, Polynomial polynomial, const ControlPoints& points)
{
    SelectionSettings settings;
    settings.all = true;
    GreedySelection selection(kernel, polynomial, settings);
    SerialCommunicator alone;
    const SelectionResult result = selection.select(points, alone);
    EXPECT_EQ(result.selected, Index(points.size()));
    EXPECT_EQ(result.rejected, 0);
    return selection.interpolant();
}


namespace reference
{

namespace
{

using RealVector = Eigen::Matrix<Real, 3, 1>;


Real scaledDistance(const Vector3& a, const Vector3& b, double radius)
{
    const RealVector d = a.cast<Real>() - b.cast<Real>();
    return std::sqrt(d.dot(d)) / Real(radius);
}


std::vector<Index> firstRows(const ControlPoints& points)
{
    std::vector<Index> first(1, 0);
    for (const ControlPoint& p : points)
    {
        first.push_back(first.back() + p.k);
    }
    return first;
}


RealMatrix polynomials(const Vector3& x, const std::vector<Vector3>& axes)
{
    RealMatrix q(1 + axes.size(), 1);
    q(0) = 1;
    for (std::size_t m = 0; m < axes.size(); ++m)
    {
        q(m + 1) = axes[m].cast<Real>().dot(x.cast<Real>());
    }
    return q;
}


RealMatrix
gramMatrix(KernelType type, double radius, const ControlPoints& points)
{
    const std::vector<Index> first = firstRows(points);
    RealMatrix G(first.back(), first.back());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const Real value = phi(
                type,
                scaledDistance(points[i].position, points[j].position, radius));
            for (int a = 0; a < points[i].k; ++a)
            {
                for (int b = 0; b < points[j].k; ++b)
                {
                    G(first[i] + a, first[j] + b) = value
                        * points[i].directions.col(a).cast<Real>().dot(
                            points[j].directions.col(b).cast<Real>());
                }
            }
        }
    }
    return G;
}


// Field whose weights are C_i alpha_i
Field weighted(
    KernelType type, double radius, const ControlPoints& points,
    const RealMatrix& alpha)
{
    const std::vector<Index> first = firstRows(points);
    Field f;
    f.type = type;
    f.radius = radius;
    f.centres = positionRows(points);
    f.weights = RealMatrix::Zero(points.size(), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        for (int a = 0; a < points[i].k; ++a)
        {
            f.weights.row(i) += alpha(first[i] + a)
                * points[i].directions.col(a).cast<Real>().transpose();
        }
    }
    return f;
}

} // namespace


std::vector<Real> wendland(int k)
{
    // (1 - d)^l by repeated multiplication
    std::vector<Real> f(1, 1);
    for (int l = 0; l < k + 2; ++l)
    {
        f.push_back(0);
        for (std::size_t m = f.size() - 1; m > 0; --m)
        {
            f[m] -= f[m - 1];
        }
    }

    for (int pass = 0; pass < k; ++pass)
    {
        std::vector<Real> integral(f.size() + 2, 0);
        for (std::size_t m = 0; m < f.size(); ++m)
        {
            integral[0] += f[m] / (m + 2);
            integral[m + 2] -= f[m] / (m + 2);
        }
        f = integral;
    }

    const Real atZero = f[0];
    for (Real& c : f)
    {
        c /= atZero;
    }
    return f;
}


Real phi(KernelType type, Real d)
{
    switch (type)
    {
    case KernelType::gaussian:
        return std::exp(-d * d);
    case KernelType::inverseMultiQuadric:
        return 1 / std::sqrt(1 + d * d);
    case KernelType::multiQuadric:
        return -std::sqrt(1 + d * d);
    case KernelType::thinPlate:
        return d > 0 ? d * d * std::log(d) : Real(0);
    default:
        break;
    }

    static const std::vector<Real> functions[4] = {
        wendland(0), wendland(1), wendland(2), wendland(3)};
    if (d >= 1)
    {
        return 0;
    }
    const std::vector<Real>& c = functions[int(type)];
    Real value = 0;
    for (std::size_t m = c.size(); m > 0; --m)
    {
        value = value * d + c[m - 1];
    }
    return value;
}


Vectors Field::operator()(const Vectors& x) const
{
    Vectors s(x.rows(), 3);
    for (Index i = 0; i < x.rows(); ++i)
    {
        const Vector3 p = x.row(i).transpose();
        RealVector sum = RealVector::Zero();
        for (Index j = 0; j < centres.rows(); ++j)
        {
            const Vector3 c = centres.row(j).transpose();
            sum += phi(type, scaledDistance(p, c, radius))
                * weights.row(j).transpose();
        }
        if (coefficients.rows() > 0)
        {
            sum += coefficients.transpose() * polynomials(p, axes);
        }
        s.row(i) = sum.cast<double>().transpose();
    }
    return s;
}


Field plainSum(const RbfInterpolant& interpolant)
{
    Field f;
    f.type = interpolant.kernel().type();
    f.radius = interpolant.kernel().supportRadius();
    f.centres = interpolant.centres();
    f.weights = interpolant.weights().cast<Real>();
    return f;
}


Field gram(KernelType type, double radius, const ControlPoints& points)
{
    return augmented(type, radius, points, {});
}


Field paper(KernelType type, double radius, const ControlPoints& points)
{
    // Unknowns Gamma_1, Gamma_2, Gamma_3 as in (6)
    const Index n = points.size();
    RealMatrix A = RealMatrix::Zero(3 * n, 3 * n);
    RealMatrix b = RealMatrix::Zero(3 * n, 1);
    for (Index i = 0; i < n; ++i)
    {
        const ControlPoint& p = points[i];

        // The normals first, then the tangents that complete them
        Eigen::Matrix<Real, 3, 3> frame = p.directions.cast<Real>();
        if (p.k < 3)
        {
            Eigen::Matrix<Real, 3, 3> given = Eigen::Matrix<Real, 3, 3>::Zero();
            given.leftCols(p.k) = frame.leftCols(p.k);
            const Eigen::FullPivLU<RealMatrix> lu(
                RealMatrix(given.leftCols(p.k).transpose()));
            frame.rightCols(3 - p.k) = lu.kernel();
        }

        for (int row = 0; row < 3; ++row)
        {
            for (int c = 0; c < 3; ++c)
            {
                if (row < p.k)
                {
                    for (Index j = 0; j < n; ++j)
                    {
                        A(3 * i + row, c * n + j) = frame(c, row)
                            * phi(type,
                                  scaledDistance(
                                      p.position, points[j].position, radius));
                    }
                }
                else
                {
                    A(3 * i + row, c * n + i) = frame(c, row);
                }
            }
            b(3 * i + row) = row < p.k ? p.value(row) : 0;
        }
    }

    const RealMatrix gamma = A.fullPivLu().solve(b);
    Field f;
    f.type = type;
    f.radius = radius;
    f.centres = positionRows(points);
    f.weights.resize(n, 3);
    for (int c = 0; c < 3; ++c)
    {
        f.weights.col(c) = gamma.middleRows(c * n, n);
    }
    return f;
}


Field augmented(
    KernelType type, double radius, const ControlPoints& points,
    const std::vector<Vector3>& axes)
{
    // No axes: no polynomial at all
    const std::vector<Index> first = firstRows(points);
    const Index n = first.back();
    const Index nq = axes.empty() ? 0 : 1 + axes.size();

    RealMatrix A = RealMatrix::Zero(n + 3 * nq, n + 3 * nq);
    RealMatrix b = RealMatrix::Zero(n + 3 * nq, 1);
    A.topLeftCorner(n, n) = gramMatrix(type, radius, points);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const RealMatrix q = polynomials(points[i].position, axes);
        for (int a = 0; a < points[i].k; ++a)
        {
            const Index row = first[i] + a;
            b(row) = points[i].value(a);
            for (Index m = 0; m < nq; ++m)
            {
                for (int c = 0; c < 3; ++c)
                {
                    A(row, n + 3 * m + c) = points[i].directions(c, a) * q(m);
                    A(n + 3 * m + c, row) = A(row, n + 3 * m + c);
                }
            }
        }
    }

    const RealMatrix solution = A.fullPivLu().solve(b);
    Field f = weighted(type, radius, points, solution.topRows(n));
    f.axes = axes;
    f.coefficients.resize(nq, 3);
    for (Index m = 0; m < nq; ++m)
    {
        f.coefficients.row(m) = solution.middleRows(n + 3 * m, 3).transpose();
    }
    return f;
}


std::vector<double> errors(const ControlPoints& points, const Vectors& s)
{
    std::vector<double> e;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        double sum = 0;
        for (int a = 0; a < points[i].k; ++a)
        {
            const double difference = points[i].value(a)
                - points[i].directions.col(a).dot(s.row(i).transpose());
            sum += difference * difference;
        }
        e.push_back(std::sqrt(sum));
    }
    return e;
}


std::vector<Index> greedy(
    KernelType type, double radius, const ControlPoints& candidates,
    double tolerance)
{
    // In double: that is what was published, and fast enough
    const Matrix G = gramMatrix(type, radius, candidates).cast<double>();
    const std::vector<Index> first = firstRows(candidates);
    Matrix g(first.back(), 1);
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        g.middleRows(first[i], candidates[i].k) =
            candidates[i].value.head(candidates[i].k);
    }

    std::vector<Index> selected;
    std::vector<Index> unknowns;
    Matrix residual = g;
    while (true)
    {
        Index worst = -1;
        double largest = tolerance;
        for (std::size_t i = 0; i < candidates.size(); ++i)
        {
            const double error =
                residual.middleRows(first[i], candidates[i].k).norm();
            const bool taken =
                std::count(selected.begin(), selected.end(), Index(i)) > 0;
            const auto key = [&](Index p)
            {
                const Vector3& x = candidates[p].position;
                return std::vector<double>{x[0], x[1], x[2]};
            };
            if (!taken
                && (error > largest
                    || (worst >= 0 && error == largest && key(i) < key(worst))))
            {
                largest = error;
                worst = i;
            }
        }
        if (worst < 0)
        {
            return selected;
        }

        selected.push_back(worst);
        for (int a = 0; a < candidates[worst].k; ++a)
        {
            unknowns.push_back(first[worst] + a);
        }
        const Index m = unknowns.size();
        Matrix A(m, m), columns(G.rows(), m), b(m, 1);
        for (Index j = 0; j < m; ++j)
        {
            columns.col(j) = G.col(unknowns[j]);
            b(j) = g(unknowns[j]);
            for (Index i = 0; i < m; ++i)
            {
                A(i, j) = G(unknowns[i], unknowns[j]);
            }
        }
        residual = g - columns * A.partialPivLu().solve(b);
    }
}

} // namespace reference
} // namespace test
