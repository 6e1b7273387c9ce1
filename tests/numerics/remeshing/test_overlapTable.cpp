// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What tetrahedra, and cells made of them, have in common.
//
// Sources of truth: closed forms of overlaps that are known (corner tetrahedra,
// slabs, the octahedron of Kepler's stella octangula), and that parts of a whole
// add up to it.

#include "boxTree.hpp"
#include "overlapTable.hpp"
#include "tetrahedra.hpp"
#include "tetrahedronOverlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace morph;

namespace
{

// In all places and for some orders of the corners
void expectOverlap(
    const Corners& a, const Corners& b, const double volume,
    const Vector3& centroid)
{
    std::mt19937 generator(1);
    for (int n = 0; n < 200; ++n)
    {
        const Eigen::Affine3d motion =
            n == 0 ? Eigen::Affine3d::Identity() : randomMotion(generator);
        Corners p = moved(a, motion), q = moved(b, motion);
        std::shuffle(p.begin(), p.end(), generator);
        std::shuffle(q.begin(), q.end(), generator);
        for (int side = 0; side < 2; ++side)
        {
            const Overlap common = overlap(Tetrahedron(p), Tetrahedron(q));
            const double scale = Tetrahedron(p).volume();
            EXPECT_NEAR(common.volume, volume, 1e-14 * scale);
            EXPECT_LT(
                (common.moment - common.volume * (motion * centroid)).norm(),
                2e-14 * scale);
            std::swap(p, q);
        }
    }
}


double length(const Corners& corners)
{
    double most = 0;
    for (int i = 0; i < 4; ++i)
    {
        for (int j = 0; j < i; ++j)
        {
            most = std::max(most, (corners[i] - corners[j]).norm());
        }
    }
    return most;
}


// The tetrahedron x <= s of the unit one's neighbourhood
Corners slab(const double s)
{
    const double far = 50;
    return {
        Vector3(s, -far, -far), Vector3(s, far, -far), Vector3(s, 0, far),
        Vector3(s - far, 0, 0)};
}

} // namespace


TEST(TetrahedronOverlap, cornersHaveTheirClosedForm)
{
    for (const double t : {0.0, 1e-3, 0.1, 0.2, 0.3, 0.33})
    {
        Corners b = unitCorners();
        for (Vector3& x : b)
        {
            x += Vector3::Constant(t);
        }
        const double side = 1 - 3 * t;
        expectOverlap(
            unitCorners(), b, std::pow(side, 3) / 6,
            Vector3::Constant(t + side / 4));
    }
}


TEST(TetrahedronOverlap, slabsHaveTheirClosedForm)
{
    for (const double s : {1e-2, 0.25, 0.5, 0.75, 0.99})
    {
        // Of {x <= s}: the whole without a corner of side 1 - s
        const double rest = std::pow(1 - s, 3) / 6;
        const double volume = 1. / 6 - rest;
        const Vector3 moment = Vector3::Constant(1. / 24)
            - rest * (Vector3::Constant((1 - s) / 4) + Vector3(s, 0, 0));
        const Overlap common =
            overlap(Tetrahedron(unitCorners()), Tetrahedron(slab(s)));
        EXPECT_NEAR(common.volume, volume, 1e-15);
        EXPECT_LT((common.moment - moment).norm(), 1e-15);
    }
}


TEST(TetrahedronOverlap, stellaOctangulaLeavesAnOctahedronOfHalfTheVolume)
{
    const Corners a{
        Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1),
        Vector3(-1, -1, 1)};
    Corners b = a;
    for (Vector3& x : b)
    {
        x = -x;
    }
    expectOverlap(a, b, 4. / 3, Vector3::Zero());
}


TEST(TetrahedronOverlap, whatIsWithinIsWhole)
{
    Corners small = unitCorners();
    for (Vector3& x : small)
    {
        x = 1e-5 * x + Vector3::Constant(0.1);
    }
    const Overlap common =
        overlap(Tetrahedron(unitCorners()), Tetrahedron(small));
    EXPECT_NEAR(common.volume, 1e-15 / 6, 1e-26);
    EXPECT_LT(
        (common.moment / common.volume - Tetrahedron(small).centroid()).norm(),
        1e-15);
}


TEST(TetrahedronOverlap, whatCoincidesIsWholeAndWhatTouchesIsNothing)
{
    const Corners a = unitCorners();
    expectOverlap(a, a, 1. / 6, Vector3::Constant(0.25));

    // Over a face, on a part of a face, over an edge, at a corner
    Corners b = a;
    b[3] = Vector3(0.1, 0.2, -2);
    expectOverlap(a, b, 0, Vector3::Zero());
    expectOverlap(
        a,
        {Vector3(0.1, 0.1, 0), Vector3(0.4, 0.1, 0), Vector3(0.1, 0.4, 0),
         Vector3(0.2, 0.2, -1)},
        0, Vector3::Zero());
    expectOverlap(
        a,
        {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, -1, 0),
         Vector3(0, 0, -1)},
        0, Vector3::Zero());
    expectOverlap(
        a,
        {Vector3(0, 0, 0), Vector3(-1, 0, 0), Vector3(0, -1, 0),
         Vector3(0, 0, -1)},
        0, Vector3::Zero());
}


TEST(TetrahedronOverlap, flatTetrahedraOverlapWithNothing)
{
    std::mt19937 generator(2);
    for (int n = 0; n < 1000; ++n)
    {
        Corners flat = unitCorners();
        flat[3] = Vector3(0.3, 0.4, 0);
        const Eigen::Affine3d motion = randomMotion(generator);
        EXPECT_EQ(
            overlap(
                Tetrahedron(moved(unitCorners(), motion)),
                Tetrahedron(moved(flat, motion)))
                .volume,
            0);
    }
}


// Parts with faces, edges and corners in common, most of them slivers, down to
// the round-off of their corners
TEST(TetrahedronOverlap, partsAddUpToTheWholeThatTheyFill)
{
    std::mt19937 generator(3);
    double worst = 0, thinnest = 1;
    for (int n = 0; n < 60; ++n)
    {
        const Eigen::Affine3d motion = randomMotion(generator);
        const Corners whole = moved(unitCorners(), motion);
        const auto donors = splitted(whole, 40, generator);
        const auto targets = splitted(whole, 40, generator);
        for (const Corners& d : donors)
        {
            const Tetrahedron donor(d);
            if (donor.volume() < 1e-14 * std::pow(length(d), 3))
            {
                continue;
            }
            double sum = 0;
            for (const Corners& t : targets)
            {
                sum += overlap(donor, Tetrahedron(t)).volume;
            }
            worst = std::max(worst, std::abs(sum / donor.volume() - 1));
            thinnest =
                std::min(thinnest, donor.volume() / std::pow(length(d), 3));
        }
    }
    EXPECT_LT(worst, 1e-12);
    EXPECT_LT(thinnest, 1e-10);
}


// Layers of 1e-6 of their width, all planes parallel or the same, cut by
// others in the same planes
TEST(TetrahedronOverlap, thinLayersAddUp)
{
    std::mt19937 generator(4);
    for (const double thickness : {1e-3, 1e-6, 1e-8})
    {
        const Eigen::Affine3d motion = randomMotion(generator);
        const auto place = [&](const int seed)
        {
            return [&, seed](const Vector3& x)
            {
                Vector3 y = jitter(x, 0.03, seed);
                y[2] = thickness * x[2];
                return Vector3(motion * y);
            };
        };
        const CubeMesh donors(4, place(1)), targets(4, place(2));
        const OverlapTable table(donors.tetrahedra, targets.tetrahedra);
        const OverlapTable::Sums sums = table.donorSums();
        for (int j = 0; j < table.nDonors(); ++j)
        {
            EXPECT_NEAR(
                sums.volume[j] / donors.volume[j], 1,
                1e-12 + 1e-15 / thickness);
        }
    }
}


TEST(BoxTree, findsWhatASearchFinds)
{
    std::mt19937 generator(5);
    std::vector<Box> boxes;
    for (int n = 0; n < 500; ++n)
    {
        Box box = Box::empty();
        const Vector3 x = randomPoint(generator);
        box.extend(x);
        // Some are points, some the same as others
        box.extend(n % 7 == 0 ? x : Vector3(x + randomPoint(generator, 0.1)));
        boxes.push_back(n % 11 == 10 ? boxes.back() : box);
    }
    const BoxTree tree(boxes);
    for (int n = 0; n < 200; ++n)
    {
        Box box = Box::empty();
        box.extend(randomPoint(generator));
        box.extend(randomPoint(generator));
        std::multiset<int> found, expected;
        tree.forAllTouching(box, [&](const int i) { found.insert(i); });
        for (int i = 0; i < int(boxes.size()); ++i)
        {
            if (boxes[i].touches(box))
            {
                expected.insert(i);
            }
        }
        EXPECT_EQ(found, expected);
    }
    BoxTree({}).forAllTouching(Box::empty(), [](int) { FAIL(); });
}


TEST(OverlapTable, sumsAreThoseOfTheCells)
{
    const CubeMesh donors(
        5, [](const Vector3& x) { return jitter(x, 0.03, 1); });
    const CubeMesh targets(
        4, [](const Vector3& x) { return jitter(x, 0.04, 2); });
    const OverlapTable table(donors.tetrahedra, targets.tetrahedra);
    const auto ofDonors = table.donorSums();
    const auto ofTargets = table.targetSums();
    for (int j = 0; j < table.nDonors(); ++j)
    {
        EXPECT_NEAR(ofDonors.volume[j] / donors.volume[j], 1, 1e-13);
        EXPECT_LT(
            (ofDonors.moment.row(j) / donors.volume[j] - donors.centre.row(j))
                .norm(),
            1e-13);
    }
    for (int i = 0; i < table.nTargets(); ++i)
    {
        EXPECT_NEAR(ofTargets.volume[i] / targets.volume[i], 1, 1e-13);
        EXPECT_LT(
            (ofTargets.moment.row(i) / targets.volume[i]
             - targets.centre.row(i))
                .norm(),
            1e-13);
        for (Index e = table.begin(i); e + 1 < table.end(i); ++e)
        {
            EXPECT_LT(table.donor(e), table.donor(e + 1));
        }
    }
}


TEST(OverlapTable, meshWithItselfIsTheIdentity)
{
    const CubeMesh mesh(4, [](const Vector3& x) { return jitter(x, 0.03, 1); });
    const OverlapTable table(mesh.tetrahedra, mesh.tetrahedra);
    ASSERT_EQ(table.size(), mesh.tetrahedra.nCells);
    for (int i = 0; i < table.nTargets(); ++i)
    {
        EXPECT_EQ(table.donor(table.begin(i)), i);
        EXPECT_NEAR(table.volume(table.begin(i)) / mesh.volume[i], 1, 1e-14);
    }
}


// A cell whose tetrahedra meet at a point outside: a whole of which one is
// negative
TEST(OverlapTable, tetrahedraThatFoldOverCancel)
{
    const Vector3 apex(0.8, 0.7, 0.6); // outside of the unit tetrahedron
    CellTetrahedra donor;
    donor.nCells = 1;
    for (int i = 0; i < 4; ++i)
    {
        Corners part = unitCorners();
        part[i] = apex;
        donor.corners.push_back(part);
        donor.cell.push_back(0);
    }
    const CubeMesh targets(
        4, [](const Vector3& x) { return jitter(x, 0.04, 2); });
    const auto folded = OverlapTable(donor, targets.tetrahedra).targetSums();

    CellTetrahedra plain;
    plain.nCells = 1;
    plain.corners.push_back(unitCorners());
    plain.cell.push_back(0);
    const auto expected = OverlapTable(plain, targets.tetrahedra).targetSums();

    EXPECT_LT((folded.volume - expected.volume).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((folded.moment - expected.moment).cwiseAbs().maxCoeff(), 1e-15);
}
