// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Images of control points: which of them there are, and the field that comes
// with them, against a dense solve in long double and the property that defines
// it, s(T x) = R_T s(x).

#include "test_support.hpp"

#include "imageGroup.hpp"

#include <Eigen/Dense>

#include <cmath>

using namespace test;

namespace
{

using reference::Real;
using reference::RealMatrix;

const Box unitBox{Vector3::Zero(), Vector3::Ones()};

const Vector3 ex(1, 0, 0), ey(0, 1, 0), ez(0, 0, 1);


struct Symmetry
{
    std::string name;
    std::vector<RigidMap> generators;

    // Written down one by one: those that come within 1.3 of the unit box, and
    // more
    std::vector<RigidMap> all;

    // A point that some of them leave where it is, and the rank of what a
    // displacement can be there
    Vector3 fixedPoint;
    int freedom;
};


std::vector<Symmetry> symmetries()
{
    const RigidMap identity;
    const RigidMap mx = RigidMap::reflection(Vector3::Zero(), ex);
    const RigidMap my = RigidMap::reflection(Vector3::Zero(), ey);
    const Vector3 oblique = Vector3(1, 2, -2) / 3;
    const RigidMap mo = RigidMap::reflection(ez, oblique);
    const RigidMap turn = RigidMap::rotation(Vector3::Zero(), ez, 2 * M_PI / 3);

    std::vector<RigidMap> row, plane, channel;
    for (int k = -5; k <= 5; ++k)
    {
        row.push_back(RigidMap::translation(k * ex));
        RigidMap mirrored = mx;
        mirrored.t = 2 * k * ex;
        channel.push_back(RigidMap::translation(2 * k * ex));
        channel.push_back(mirrored);
        for (int l = -5; l <= 5; ++l)
        {
            plane.push_back(
                RigidMap::translation(k * ex + l * Vector3(0.3, 1, 0)));
        }
    }
    return {
        {"mirror", {mx}, {identity, mx}, Vector3(0, 0.3, 0.4), 2},
        {"oblique mirror", {mo}, {identity, mo}, ez, 2},
        {"two mirrors",
         {mx, my},
         {identity, mx, my, mx.after(my)},
         Vector3(0, 0, 0.4),
         1},
        {"third of a turn",
         {turn},
         {identity, turn, turn.inverse()},
         Vector3(0, 0, 0.4),
         1},
        {"row", {RigidMap::translation(ex)}, row, Vector3(0.2, 0.3, 0.4), 3},
        {"plane of cells",
         {RigidMap::translation(-ex),
          RigidMap::translation(Vector3(0.3, 1, 0))},
         plane,
         Vector3(0.2, 0.3, 0.4),
         3},
        {"two parallel mirrors",
         {mx, RigidMap::reflection(ex, ex)},
         channel,
         Vector3(1, 0.3, 0.4),
         2}};
}


ControlPoints restricted(const ImageGroup& images, const ControlPoints& points)
{
    ControlPoints some;
    for (const ControlPoint& p : points)
    {
        double contradiction = 0;
        const ControlPoint rest = images.restricted(p, contradiction);
        EXPECT_LT(contradiction, 1e-12);
        if (rest.k > 0)
        {
            some.push_back(rest);
        }
    }
    return some;
}


// Random ones, and one at the fixed point with a displacement allowed there
ControlPoints randomPoints(const Symmetry& symmetry, const ImageGroup& images)
{
    Random random(7);
    ControlPoints points = randomControlPoints(random, {3, 20, 10, 5});
    points.push_back(ControlPoint::prescribed(
        symmetry.fixedPoint,
        images.projection(symmetry.fixedPoint) * random.inBox()));
    return restricted(images, points);
}


RbfInterpolant solved(
    const Kernel& kernel, const ImageGroup& images, const ControlPoints& points)
{
    SelectionSettings settings;
    settings.all = true;
    GreedySelection selection(kernel, Polynomial::none, settings, images);
    SerialCommunicator communicator;
    const SelectionResult result = selection.select(points, communicator);
    EXPECT_EQ(result.rejected, 0);
    return selection.interpolant();
}


// The field by its formula: LU with full pivoting, all images
Vectors referenceField(
    KernelType type, double radius, const std::vector<RigidMap>& maps,
    const ControlPoints& points, const Vectors& x)
{
    const auto kernel = [&](const Vector3& a, const Vector3& b)
    {
        RealMatrix sum = RealMatrix::Zero(3, 3);
        for (const RigidMap& map : maps)
        {
            const Real d = (a - map(b)).cast<Real>().norm() / Real(radius);
            sum += reference::phi(type, d) * map.R.cast<Real>();
        }
        return sum;
    };

    std::vector<Index> row(1, 0);
    for (const ControlPoint& p : points)
    {
        row.push_back(row.back() + p.k);
    }
    RealMatrix G(row.back(), row.back()), g(row.back(), 1);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const ControlPoint& p = points[i];
        g.block(row[i], 0, p.k, 1) = p.g().cast<Real>();
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const ControlPoint& q = points[j];
            G.block(row[i], row[j], p.k, q.k) = p.C().cast<Real>().transpose()
                * kernel(p.position, q.position) * q.C().cast<Real>();
        }
    }
    const RealMatrix alpha = G.fullPivLu().solve(g);

    Vectors s(x.rows(), 3);
    for (Index i = 0; i < x.rows(); ++i)
    {
        RealMatrix sum = RealMatrix::Zero(3, 1);
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const ControlPoint& q = points[j];
            sum += kernel(x.row(i).transpose(), q.position) * q.C().cast<Real>()
                * alpha.block(row[j], 0, q.k, 1);
        }
        s.row(i) = sum.cast<double>().transpose();
    }
    return s;
}


const KernelType types[] = {
    KernelType::wendlandC0, KernelType::wendlandC2, KernelType::wendlandC6};

constexpr double radius = 1.3;

constexpr Index most = 1000;

} // namespace


TEST(ImageGroup, HasTheMapsThatBringTheBoxWithinReachOfItselfAndNoOther)
{
    const auto count = [&](const std::vector<RigidMap>& g, double reach)
    { return ImageGroup(g, unitBox, reach, most).maps().size(); };
    const double infinite = std::numeric_limits<double>::infinity();
    const RigidMap mirror = RigidMap::reflection(Vector3::Zero(), ex);
    const RigidMap step = RigidMap::translation(ex);

    EXPECT_EQ(count({}, 1), 1u);
    EXPECT_EQ(count({mirror}, infinite), 2u);
    EXPECT_EQ(count({RigidMap::reflection(-2 * ex, ex)}, 3.9), 1u);
    EXPECT_EQ(count({RigidMap::reflection(-2 * ex, ex)}, 4.1), 2u);
    EXPECT_EQ(count({step}, 0.5), 3u);
    EXPECT_EQ(count({step}, 1.5), 5u);
    EXPECT_EQ(count({step, RigidMap::translation(ey)}, 0.5), 9u);
    EXPECT_EQ(count({mirror, RigidMap::reflection(ex, ex)}, 0.5), 3u);
    for (int n = 2; n < 40; ++n)
    {
        const RigidMap turn = RigidMap::rotation(ey, ez, 2 * M_PI / n);
        EXPECT_EQ(count({turn}, infinite), std::size_t(n));
    }
    EXPECT_EQ(count({step, step, step.inverse(), RigidMap()}, 0.5), 3u);
}


TEST(ImageGroup, HasTheInverseOfEveryMap)
{
    for (const Symmetry& symmetry : symmetries())
    {
        const ImageGroup images(symmetry.generators, unitBox, radius, most);
        for (const RigidMap& map : images.maps())
        {
            const RigidMap inverse = map.inverse();
            double nearest = 1;
            for (const RigidMap& other : images.maps())
            {
                nearest = std::min(
                    nearest,
                    (other.R - inverse.R).norm()
                        + (other.t - inverse.t).norm());
            }
            EXPECT_LT(nearest, 1e-13) << symmetry.name;
        }
    }
}


TEST(ImageGroup, WithMoreImagesThanWantedIsRefused)
{
    const std::vector<RigidMap> step(1, RigidMap::translation(0.01 * ex));
    EXPECT_NO_THROW(ImageGroup(step, unitBox, 1, 500));
    EXPECT_THROW(ImageGroup(step, unitBox, 1, 300), TooManyImages);
    EXPECT_THROW(
        ImageGroup(step, unitBox, std::numeric_limits<double>::infinity(), 300),
        TooManyImages);
}


TEST(ImageGroup, LeavesOfAConditionWhatFieldsOfItCanFail)
{
    for (const Symmetry& symmetry : symmetries())
    {
        const ImageGroup images(symmetry.generators, unitBox, radius, most);
        const Eigen::Matrix3d P = images.projection(symmetry.fixedPoint);
        EXPECT_LT((P * P - P).norm(), 1e-14) << symmetry.name;
        EXPECT_NEAR(P.trace(), symmetry.freedom, 1e-14) << symmetry.name;

        Random random(3);
        const Vector3 s = P * random.inBox();
        for (int k = 1; k <= 3; ++k)
        {
            std::vector<Vector3> normals;
            while (int(normals.size()) < k)
            {
                normals.push_back(random.direction());
            }
            double contradiction = 1;
            const ControlPoint rest = images.restricted(
                ControlPoint::sliding(symmetry.fixedPoint, normals, s),
                contradiction);
            EXPECT_LT(contradiction, 1e-14);
            EXPECT_EQ(rest.k, std::min(k, symmetry.freedom));
            EXPECT_LT(
                (rest.C().transpose() * rest.C()
                 - Matrix::Identity(rest.k, rest.k))
                    .norm(),
                1e-14);
            EXPECT_LT((P * rest.C() - rest.C()).norm(), 1e-13);
            EXPECT_LT(rest.residual(s).norm(), 1e-13);
        }
    }
}


TEST(ImageGroup, TellsByHowMuchAConditionContradictsIt)
{
    const ImageGroup images(
        {RigidMap::reflection(Vector3::Zero(), ex)}, unitBox, 1, most);
    double contradiction = 0;
    const ControlPoint moving = images.restricted(
        ControlPoint::prescribed(Vector3(0, 0.5, 0.5), Vector3(0.3, 0.1, 0.2)),
        contradiction);
    EXPECT_EQ(moving.k, 2);
    EXPECT_NEAR(contradiction, 0.3, 1e-15);
    EXPECT_LT(moving.residual(Vector3(0, 0.1, 0.2)).norm(), 1e-15);

    const ControlPoint across = images.restricted(
        ControlPoint::sliding(Vector3(0, 0.5, 0.5), {ex}, 0.2 * ex),
        contradiction);
    EXPECT_EQ(across.k, 0);
    EXPECT_NEAR(contradiction, 0.2, 1e-15);
}


TEST(ImageSystem, GivesTheFieldOfADenseSolveInLongDouble)
{
    Random random(11);
    const Vectors probes = rows(random.pointsApart(50, 3, 0));
    for (const Symmetry& symmetry : symmetries())
    {
        const ImageGroup images(symmetry.generators, unitBox, radius, most);
        const ControlPoints points = randomPoints(symmetry, images);
        for (const KernelType type : types)
        {
            const RbfInterpolant found =
                solved(Kernel(type, radius), images, points);
            const Vectors expected =
                referenceField(type, radius, symmetry.all, points, probes);
            EXPECT_TRUE(within(
                "images: difference from the dense solve",
                largestDifference(found(probes), expected)
                    / largestDisplacement(points),
                1e-12))
                << symmetry.name << ", " << test::nameOf(type);
        }
    }
}


TEST(ImageSystem, GivesAFieldWithItsSymmetryToRoundOff)
{
    Random random(12);
    for (const Symmetry& symmetry : symmetries())
    {
        const ImageGroup images(symmetry.generators, unitBox, radius, most);
        const ControlPoints points = randomPoints(symmetry, images);
        const RbfInterpolant field =
            solved(Kernel(KernelType::wendlandC2, radius), images, points);
        const double roundOff = std::numeric_limits<double>::epsilon()
            * field.weights().rowwise().norm().sum();

        // Pairs of which both are in the box, and points that stay
        int pairs = 0;
        for (const RigidMap& map : symmetry.generators)
        {
            for (int i = 0; i < 400; ++i)
            {
                Vector3 x = random.pointsApart(1, 3, 0)[0];
                if (i == 0)
                {
                    x = symmetry.fixedPoint;
                }
                else if (symmetry.freedom == 3)
                {
                    x -= map.t.dot(x) / map.t.squaredNorm() * map.t;
                    x += (map.t.sum() < 0 ? 1 : 0) * -map.t;
                }
                const Vector3 y = map(x);
                const bool inside = (y.array() >= -1e-9).all()
                    && (y.array() <= 1 + 1e-9).all()
                    && (x.array() >= -1e-9).all()
                    && (x.array() <= 1 + 1e-9).all();
                if (!inside)
                {
                    continue;
                }
                ++pairs;
                const Vectors s = field(rows({x, y}));
                const Vector3 there = map.R * s.row(0).transpose();
                EXPECT_TRUE(within(
                    "images: asymmetry in units of round-off",
                    (there - s.row(1).transpose()).norm() / roundOff, 1))
                    << symmetry.name;
            }
        }
        EXPECT_GT(pairs, 0) << symmetry.name;
    }
}


TEST(ImageSystem, MeetsTheConditionsOfWhatItDidNotSelectToTheTolerance)
{
    for (const Symmetry& symmetry : symmetries())
    {
        const ImageGroup images(symmetry.generators, unitBox, radius, most);
        Random random(5);
        ControlPoints points;
        for (const Vector3& x : random.pointsApart(250, 3, 0.01))
        {
            const Vector3 d = images.projection(x)
                * Vector3(x[1], std::sin(x[2]), x[0] * x[1]);
            points.push_back(ControlPoint::prescribed(x, d));
        }
        SelectionSettings settings;
        settings.tolerance = 0.02;
        GreedySelection selection(
            Kernel(KernelType::wendlandC2, radius), Polynomial::none, settings,
            images);
        SerialCommunicator communicator;
        const SelectionResult result = selection.select(points, communicator);
        EXPECT_TRUE(result.converged()) << symmetry.name;
        EXPECT_LT(result.selected, 240) << symmetry.name;

        const std::vector<double> errors = reference::errors(
            points, selection.interpolant()(positionRows(points)));
        EXPECT_LE(
            *std::max_element(errors.begin(), errors.end()),
            result.tolerance * (1 + 1e-9))
            << symmetry.name;

        // Twice the values, twice the field; nothing has to be selected
        for (ControlPoint& p : points)
        {
            p.value *= 2;
        }
        const Columns once = selection.interpolant().weights();
        EXPECT_EQ(selection.select(points, communicator).added, 0);
        EXPECT_LT(
            (selection.interpolant().weights() - 2 * once).norm(),
            1e-12 * once.norm())
            << symmetry.name;
    }
}


TEST(ImageSystem, IsTheSameOnAnyNumberOfRanks)
{
    const ImageGroup images(
        {RigidMap::rotation(Vector3::Zero(), ez, 2 * M_PI / 3)}, unitBox,
        radius, most);
    Random random(6);
    ControlPoints points;
    for (const Vector3& x : random.pointsApart(300, 3, 0.01))
    {
        points.push_back(ControlPoint::prescribed(x, random.inBox()));
    }
    Columns expected;
    for (int ranks = 1; ranks <= 3; ++ranks)
    {
        onRanks(
            ranks,
            [&](Communicator& communicator)
            {
                ControlPoints mine;
                for (std::size_t i = communicator.rank(); i < points.size();
                     i += ranks)
                {
                    mine.push_back(points[i]);
                }
                SelectionSettings settings;
                settings.maxPoints = 60;
                GreedySelection selection(
                    Kernel(KernelType::wendlandC2, radius), Polynomial::none,
                    settings, images);
                selection.select(mine, communicator);
                if (communicator.rank() == ranks - 1)
                {
                    const Columns& found = selection.interpolant().weights();
                    if (ranks == 1)
                    {
                        expected = found;
                    }
                    EXPECT_TRUE(found == expected) << ranks;
                }
            });
    }
}


TEST(GreedySelection, RefusesImagesWhereTheyHaveNoMeaning)
{
    const ImageGroup images(
        {RigidMap::reflection(Vector3::Zero(), ex)}, unitBox, 1, most);
    const Kernel kernel(KernelType::wendlandC2, 1);
    SelectionSettings settings;
    EXPECT_THROW(
        GreedySelection(kernel, Polynomial::linear, settings, images),
        std::invalid_argument);
    settings.algorithm = Algorithm::standard;
    EXPECT_THROW(
        GreedySelection(kernel, Polynomial::none, settings, images),
        std::invalid_argument);
}
