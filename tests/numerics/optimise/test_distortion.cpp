// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Source of truth: the formula of Garanzha et al. 2021
// (doi:10.1145/3450626.3459847) written out with matrices, central differences,
// invariance under similarity, and meshes whose best shape is known.

#include "distortionMinimiser.hpp"
#include "reproducibleSum.hpp"
#include "simplexEnergy.hpp"
#include "simplexMesh.hpp"
#include "test_support.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace morph;

namespace
{

using Faces = std::vector<std::vector<int>>;

// A box of n x n x n hexahedra, or n x n quadrilaterals, on [0,1]^d
struct GridBox
{
    int dimension;
    int n;
    Vectors points;
    std::vector<Faces> cells;
    std::vector<bool> inside;

    GridBox(int dimension, int n)
    : dimension(dimension),
      n(n)
    {
        const int layers = dimension == 3 ? n + 1 : 1;
        points.resize((n + 1) * (n + 1) * layers, 3);
        for (int k = 0; k < layers; ++k)
        {
            for (int j = 0; j <= n; ++j)
            {
                for (int i = 0; i <= n; ++i)
                {
                    points.row(at(i, j, k)) << i, j, k;
                    inside.push_back(
                        i % n && j % n && (dimension == 2 || k % n));
                }
            }
        }
        points /= n;
        for (int k = 0; k < (dimension == 3 ? n : 1); ++k)
        {
            for (int j = 0; j < n; ++j)
            {
                for (int i = 0; i < n; ++i)
                {
                    cells.push_back(cell(i, j, k));
                }
            }
        }
    }

    int at(int i, int j, int k) const
    {
        return i + (n + 1) * (j + (n + 1) * k);
    }

    Faces cell(int i, int j, int k) const
    {
        const auto p = [&](int a, int b, int c)
        { return at(i + a, j + b, k + c); };
        if (dimension == 2)
        {
            return {{p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0)}};
        }
        return {
            {p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)},
            {p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)},
            {p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)},
            {p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0)},
            {p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0)},
            {p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)}};
    }

    // Inner points shifted at random, by so many cells
    Vectors shaken(double by, unsigned seed) const
    {
        test::Random random(seed);
        Vectors x = points;
        for (Index i = 0; i < x.rows(); ++i)
        {
            const Vector3 shift = by / n * random.inBox();
            if (inside[i])
            {
                x.row(i).head(dimension) += shift.head(dimension).transpose();
            }
        }
        return x;
    }
};


SimplexMesh
meshOf(const GridBox& box, SimplexTarget target = SimplexTarget::reference)
{
    SimplexMesh mesh(box.dimension, box.points.rows(), box.points, target);
    for (const Faces& cell : box.cells)
    {
        mesh.add(cell, true);
    }
    mesh.finish();
    return mesh;
}


// All points of one rank; those inside move freely
class FreeInside : public PointMotion
{
public:
    explicit FreeInside(const std::vector<bool>& inside)
    : inside_(inside)
    {
    }

    void exchange(Vectors&) override {}

    std::vector<bool> free() override { return inside_; }

    void project(const Vectors&, Vectors& v) override
    {
        for (std::size_t i = 0; i < inside_.size(); ++i)
        {
            if (!inside_[i])
            {
                v.row(i).setZero();
            }
        }
    }

    void retract(Vectors&) override {}

private:
    std::vector<bool> inside_;
};


double leastDeterminant(const SimplexMesh& mesh, const Vectors& x)
{
    const SimplexMesh::CellState state = mesh.cellState(x, {});
    return *std::min_element(
        state.determinant.begin(), state.determinant.end());
}


int minimise(
    const SimplexMesh& mesh, const std::vector<bool>& inside, Vectors& x,
    const DistortionMinimiser::Stage& stage)
{
    FreeInside motion(inside);
    SerialCommunicator communicator;
    DistortionMinimiser minimiser(mesh, motion, communicator);
    return minimiser.run(stage, x, [](const DistortionMinimiser::Progress&) {});
}


double distortion(
    const SimplexMesh& mesh, const Vectors& x,
    const SimplexMesh::Settings& settings, Vectors* derivative = nullptr)
{
    SerialCommunicator communicator;
    SimplexMesh::Result result;
    mesh.evaluate(x, settings, communicator, result);
    if (derivative)
    {
        *derivative = result.derivative;
    }
    return result.distortion;
}


// A prism, a pyramid, a tetrahedron, a hexahedron with a hanging point and one
// cell with a pentagon: random cells with outward faces
std::vector<std::pair<Vectors, Faces>> shapes()
{
    std::vector<std::pair<Vectors, Faces>> all;
    Vectors tetrahedron(4, 3);
    tetrahedron << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    all.push_back({tetrahedron, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});

    Vectors pyramid(5, 3);
    pyramid << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.4, 0.5, 0.8;
    all.push_back(
        {pyramid, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}});

    Vectors prism(6, 3);
    prism << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1, 1, 0, 0.1, 0, 1, 0.1;
    all.push_back(
        {prism,
         {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}});

    // A pentagonal prism, and a cube with a point on one edge
    Vectors pentagon(10, 3);
    for (int i = 0; i < 5; ++i)
    {
        const double angle = 2 * M_PI * i / 5;
        pentagon.row(i) << std::cos(angle), std::sin(angle), 0;
        pentagon.row(i + 5) << std::cos(angle), std::sin(angle), 1.3;
    }
    Faces sides{{4, 3, 2, 1, 0}, {5, 6, 7, 8, 9}};
    for (int i = 0; i < 5; ++i)
    {
        const int j = (i + 1) % 5;
        sides.push_back({i, j, j + 5, i + 5});
    }
    all.push_back({pentagon, sides});

    Vectors cube(9, 3);
    cube << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1,
        1, 0.5, 0, 0;
    all.push_back(
        {cube,
         {{0, 3, 2, 1, 8},
          {4, 5, 6, 7},
          {0, 8, 1, 5, 4},
          {1, 2, 6, 5},
          {2, 3, 7, 6},
          {3, 0, 4, 7}}});
    return all;
}

} // namespace


TEST(ReproducibleSum, isThatOfLongDoublesAndOfAnyOrder)
{
    test::Random random(3);
    SerialCommunicator communicator;
    std::vector<double> x, y;
    for (int i = 0; i < 1000; ++i)
    {
        const double size = std::pow(10.0, random.uniform(-12, 8));
        x.push_back(random.uniform(-1, 1) * size);
        y.push_back(random.uniform(-1, 1) / 7);
    }
    const auto sum = [&]()
    { return reproducibleDot(x.data(), y.data(), 1000, communicator); };
    const double first = sum();
    long double exact = 0;
    long double sizes = 0;
    for (int i = 0; i < 1000; ++i)
    {
        exact += (long double)(x[i]) * y[i];
        sizes += std::abs((long double)(x[i]) * y[i]);
    }
    EXPECT_TRUE(test::within(
        "reproducible sum", double(std::abs(first - exact) / sizes), 1e-16));
    for (unsigned seed = 0; seed < 5; ++seed)
    {
        const std::vector<Index> order = test::Random(seed).permutation(1000);
        std::vector<double> a, b;
        for (Index i : order)
        {
            a.push_back(x[i]);
            b.push_back(y[i]);
        }
        x.swap(a);
        y.swap(b);
        EXPECT_EQ(sum(), first);
    }
    EXPECT_EQ(reproducibleSum(x.data(), 0, communicator), 0);
    x[500] = std::nan("");
    EXPECT_TRUE(std::isnan(sum()));
    x[500] = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(sum()));
}


TEST(SimplexEnergy, isTheFormulaWithMatrices)
{
    test::Random random(1);
    for (int d : {2, 3})
    {
        SimplexBlock block;
        SimplexSettings settings;
        settings.sizeWeight = 0.7;
        settings.epsilonSquared = 0.01;
        for (double& w : block.target)
        {
            w = random.uniform(-1, 1);
        }
        for (double& e : block.edges)
        {
            e = random.uniform(-1, 1);
        }
        evaluateSimplices(d, settings, block);
        for (int lane = 0; lane < simplexLanes; ++lane)
        {
            Matrix W(d, d), E(d, d);
            for (int i = 0; i < d; ++i)
            {
                for (int j = 0; j < d; ++j)
                {
                    W(j, i) = block.target[(i * d + j) * simplexLanes + lane];
                    E(j, i) = block.edges[(i * d + j) * simplexLanes + lane];
                }
            }
            const Matrix J = E * W.inverse();
            const double D = J.determinant();
            const double chi = 0.5 * (D + std::sqrt(0.01 + D * D));
            const double mu =
                ((J.transpose() * J).trace() / (d * std::pow(chi, 2.0 / d))
                 + 0.7 * (D * D + 1) / (2 * chi))
                / 1.7;
            EXPECT_NEAR(block.mu[lane] / mu, 1, 1e-10);
            EXPECT_NEAR(block.determinant[lane], D, 1e-10 * (1 + std::abs(D)));
        }
    }
}


TEST(SimplexMesh, derivativeIsThatOfCentralDifferences)
{
    SimplexMesh::Settings settings;
    settings.simplex.sizeWeight = 0.6;
    for (int power : {1, 3, 8})
    {
        settings.power = power;
        for (double epsilonSquared : {1e-12, 0.3})
        {
            settings.simplex.epsilonSquared = epsilonSquared;
            for (SimplexTarget target :
                 {SimplexTarget::reference, SimplexTarget::orthogonal})
            {
                for (const auto& [points, faces] : shapes())
                {
                    SimplexMesh mesh(3, points.rows(), points, target);
                    mesh.add(faces, true);
                    mesh.finish();
                    test::Random random(7);
                    Vectors x = points;
                    for (Index i = 0; i < x.size(); ++i)
                    {
                        x.data()[i] += 0.02 * random.uniform(-1, 1);
                    }
                    Vectors g;
                    distortion(mesh, x, settings, &g);
                    const double h = 1e-6;
                    double worst = 0;
                    for (Index i = 0; i < x.size(); ++i)
                    {
                        Vectors a = x;
                        Vectors b = x;
                        a.data()[i] += h;
                        b.data()[i] -= h;
                        const double difference =
                            (distortion(mesh, a, settings)
                             - distortion(mesh, b, settings))
                            / (2 * h);
                        worst =
                            std::max(worst, std::abs(difference - g.data()[i]));
                    }
                    EXPECT_TRUE(test::within(
                        "derivative against differences",
                        worst / g.cwiseAbs().maxCoeff(), 2e-6));
                }
            }
        }
    }
}


TEST(SimplexMesh, derivativeOfFoldedPolygons)
{
    const GridBox box(2, 4);
    const SimplexMesh mesh = meshOf(box);
    const Vectors x = box.shaken(1.5, 2);
    ASSERT_LT(leastDeterminant(mesh, x), 0);
    SimplexMesh::Settings settings;
    settings.simplex.epsilonSquared = 0.1;
    settings.power = 2;
    Vectors g;
    distortion(mesh, x, settings, &g);
    for (Index i = 0; i < x.rows(); ++i)
    {
        for (int j = 0; j < 2; ++j)
        {
            Vectors a = x, b = x;
            a(i, j) += 1e-6;
            b(i, j) -= 1e-6;
            const double difference =
                (distortion(mesh, a, settings) - distortion(mesh, b, settings))
                / 2e-6;
            EXPECT_NEAR(difference, g(i, j), 1e-6 * g.cwiseAbs().maxCoeff());
        }
    }
}


TEST(SimplexMesh, isOneWhereNothingIsDistorted)
{
    SimplexMesh::Settings settings;
    settings.power = 8;
    for (const auto& [points, faces] : shapes())
    {
        SimplexMesh mesh(3, points.rows(), points, SimplexTarget::reference);
        mesh.add(faces, true);
        mesh.finish();
        const double n = double(mesh.nSimplices());
        EXPECT_NEAR(distortion(mesh, points, settings), n, 1e-9 * n);

        // Turned and shifted
        const Eigen::Matrix3d R =
            Eigen::AngleAxisd(2, Vector3(1, 2, 3).normalized())
                .toRotationMatrix();
        Vectors x = points * R.transpose();
        x.rowwise() += Vector3(3, -5, 2).transpose();
        EXPECT_NEAR(distortion(mesh, x, settings), n, 1e-9 * n);

        // The shape is the same at any size: (1 + (s^6 + 1)/(2 s^3))/2
        const double s = 1.3;
        const double mu = (1 + (std::pow(s, 6) + 1) / (2 * s * s * s)) / 2;
        EXPECT_NEAR(
            distortion(mesh, s * x, settings) / (n * std::pow(mu, 8)), 1, 1e-9);

        // Mirrored it is folded throughout
        x.col(0) *= -1;
        EXPECT_NEAR(leastDeterminant(mesh, x), -1, 1e-9);
    }
}


TEST(SimplexMesh, orthogonalTargetIsTheCellWhereThatIsOrthogonal)
{
    Vectors points;
    Faces faces;
    const GridBox box(3, 1);
    const Vectors stretched = box.points * Vector3(1, 0.01, 3).asDiagonal();
    SimplexMesh mesh(3, 8, stretched, SimplexTarget::orthogonal);
    mesh.add(box.cells[0], true);
    mesh.finish();
    EXPECT_NEAR(distortion(mesh, stretched, {}), 24, 1e-9);

    // Sheared by s it has tr(J^T J) = 3 + s^2, D = 1
    const double s = 0.4;
    Vectors sheared = stretched;
    sheared.col(0) += s * stretched.col(2);
    EXPECT_NEAR(distortion(mesh, sheared, {}), 24 * (1 + s * s / 6), 1e-9);

    // As a target, a sheared cell is turned into one with right angles
    SimplexMesh other(3, 8, sheared, SimplexTarget::orthogonal);
    other.add(box.cells[0], true);
    other.finish();
    EXPECT_LT(distortion(other, stretched, {}), distortion(other, sheared, {}));
}


TEST(SimplexMesh, sameBitsHoweverCellsAreGiven)
{
    const GridBox box(3, 3);
    const Vectors x = box.shaken(0.8, 5);
    SimplexMesh::Settings settings;
    settings.power = 4;
    settings.simplex.epsilonSquared = 0.1;
    Vectors expected;
    const double energy = distortion(meshOf(box), x, settings, &expected);

    test::Random random(11);
    const Index n = x.rows();
    for (int repeat = 0; repeat < 3; ++repeat)
    {
        // Points, cells and faces in another order, faces from another corner
        const std::vector<Index> newLabel = random.permutation(n);
        Vectors reference(n, 3), y(n, 3);
        for (Index i = 0; i < n; ++i)
        {
            reference.row(newLabel[i]) = box.points.row(i);
            y.row(newLabel[i]) = x.row(i);
        }
        SimplexMesh mesh(3, n, reference, SimplexTarget::reference);
        for (Index c : random.permutation(Index(box.cells.size())))
        {
            Faces faces;
            for (Index f : random.permutation(6))
            {
                std::vector<int> face;
                for (int p : box.cells[c][f])
                {
                    face.push_back(int(newLabel[p]));
                }
                std::rotate(
                    face.begin(), face.begin() + random.below(4), face.end());
                faces.push_back(face);
            }
            mesh.add(faces, true);
        }
        mesh.finish();
        Vectors g;
        EXPECT_EQ(distortion(mesh, y, settings, &g), energy);
        for (Index i = 0; i < n; ++i)
        {
            EXPECT_EQ(
                (g.row(newLabel[i]) - expected.row(i)).cwiseAbs().maxCoeff(),
                0);
        }
    }
}


TEST(DistortionMinimiser, leavesAMeshAtRestAlone)
{
    for (int d : {2, 3})
    {
        const GridBox box(d, 5);
        const SimplexMesh mesh = meshOf(box);
        Vectors x = box.points;
        minimise(mesh, box.inside, x, {8, 1, 50});
        EXPECT_TRUE(test::within(
            "rest", (x - box.points).cwiseAbs().maxCoeff(), 1e-14));
    }
}


TEST(DistortionMinimiser, untanglesABoxOfRandomPoints)
{
    for (int d : {2, 3})
    {
        const GridBox box(d, d == 2 ? 20 : 8);
        const SimplexMesh mesh = meshOf(box);
        for (unsigned seed = 0; seed < 3; ++seed)
        {
            Vectors x = box.shaken(2, seed);
            ASSERT_LT(leastDeterminant(mesh, x), -1);
            minimise(mesh, box.inside, x, {1, 1, 300});
            EXPECT_GT(leastDeterminant(mesh, x), 0);

            // The only minimum that is known is the reference
            minimise(mesh, box.inside, x, {1, 1, 300});
            EXPECT_LT((x - box.points).cwiseAbs().maxCoeff(), 0.05 / box.n);
        }
    }
}


TEST(DistortionMinimiser, findsTheSimilarityThatTheBoundaryMakes)
{
    // Of a uniform mesh whose boundary turns and grows, it is the minimum
    const GridBox box(3, 6);
    const SimplexMesh mesh = meshOf(box);
    const Eigen::Matrix3d A = 1.2
        * Eigen::AngleAxisd(0.5, Vector3(1, 1, 0).normalized())
              .toRotationMatrix();
    const Vectors exact = box.points * A.transpose();
    Vectors x = exact;
    const Vectors shaken = box.shaken(0.3, 4);
    x += (shaken - box.points) * A.transpose();
    minimise(mesh, box.inside, x, {2, 1, 300});
    EXPECT_LT((x - exact).cwiseAbs().maxCoeff(), 1e-3 / 6);
}


TEST(DistortionMinimiser, affineMotionOfAUniformMeshIsStationary)
{
    // Sum of constant derivatives around an inner point of a uniform mesh
    const GridBox box(2, 6);
    const SimplexMesh mesh = meshOf(box);
    Eigen::Matrix3d A;
    A << 1.5, 0.4, 0, -0.2, 0.7, 0, 0, 0, 1;
    const Vectors x = box.points * A.transpose();
    SimplexMesh::Settings settings;
    settings.power = 8;
    Vectors g;
    distortion(mesh, x, settings, &g);
    for (Index i = 0; i < x.rows(); ++i)
    {
        if (box.inside[i])
        {
            EXPECT_LT(g.row(i).norm(), 1e-10 * g.norm());
        }
    }
}
