// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Lagrange functions of one to four points.

#include "affineBasis.hpp"
#include "test_support.hpp"

#include <Eigen/Geometry>

using namespace test;

namespace
{

Columns randomNodes(Random& random, Index n)
{
    return rows(random.pointsApart(n, 3, 0.3));
}

} // namespace


TEST(AffineBasis, isOneAtItsNodeAndZeroAtTheOthers)
{
    for (Index n = 1; n <= 4; ++n)
    {
        Random random(41);
        const AffineBasis basis(randomNodes(random, n));
        ASSERT_EQ(basis.size(), n);
        EXPECT_LT(
            (basis.values(basis.nodes()) - Matrix::Identity(n, n)).norm(),
            1e-13)
            << n << " nodes";
    }
}


TEST(AffineBasis, ofFourNodesReproducesEveryAffineFunction)
{
    Random random(42);
    const AffineBasis basis(randomNodes(random, 4));
    const Eigen::Matrix3d A = Eigen::Matrix3d::Random();
    const Eigen::RowVector3d b(1, -2, 3);
    const Columns x = rows(random.pointsApart(50, 3, 0));
    const auto affine = [&](const Columns& y)
    { return Matrix((y * A).rowwise() + b); };
    const Matrix v = affine(basis.nodes());
    EXPECT_LT((basis.values(x) * v - affine(x)).norm(), 1e-12);
    EXPECT_LT((basis.gradient(v) - A).norm(), 1e-12);
}


TEST(AffineBasis, ofFewerNodesIsConstantNormalToTheirSpan)
{
    for (Index n = 1; n <= 3; ++n)
    {
        Random random(43);
        const Columns nodes = randomNodes(random, n);
        const AffineBasis basis(nodes);

        // A direction normal to all edges
        Vector3 normal = random.direction();
        if (n == 2)
        {
            normal = normal.cross(Vector3(nodes.row(1) - nodes.row(0)));
        }
        else if (n == 3)
        {
            normal = Vector3(nodes.row(1) - nodes.row(0))
                         .cross(Vector3(nodes.row(2) - nodes.row(0)));
        }
        normal.normalize();

        const Columns x = rows(random.pointsApart(20, 3, 0));
        const Columns shifted = x.rowwise() + 2 * normal.transpose();
        EXPECT_LT((basis.values(x) - basis.values(shifted)).norm(), 1e-12);
        EXPECT_LT(
            (basis.values(x).rowwise().sum().array() - 1).matrix().norm(),
            1e-12);

        // In the span, edges are combined as their ends are
        const Matrix mix = Matrix::Constant(1, n, 1.0 / n);
        const Columns middle = mix * nodes;
        EXPECT_LT((basis.values(middle) - mix).norm(), 1e-13);

        // And the distance grows along the normal alone
        EXPECT_NEAR(basis.distance(middle.row(0)), 0, 1e-14);
        EXPECT_NEAR(
            basis.distance(middle.row(0).transpose() + 0.7 * normal), 0.7,
            1e-13);
    }
}


TEST(AffineBasis, withoutNodesHasNoFunctions)
{
    const AffineBasis none;
    EXPECT_EQ(none.size(), 0);
    EXPECT_EQ(none.values(Columns::Ones(5, 3)).cols(), 0);
    EXPECT_EQ(none.values(Columns::Ones(5, 3)).rows(), 5);
}


TEST(AffineBasis, takesOneToFourNodes)
{
    EXPECT_THROW(AffineBasis(Columns(0, 3)), std::invalid_argument);
    EXPECT_THROW(AffineBasis(Columns::Random(5, 3)), std::invalid_argument);
}
