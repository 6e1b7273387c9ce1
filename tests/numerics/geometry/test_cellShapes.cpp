// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Cells that are proven valid without their geometry.
//
// Source of truth: the formulas of OpenFOAM for the centres and areas of faces
// and for the centre and volume of a cell (primitiveMeshFaceCentresAndAreas.C,
// primitiveMeshCellCentresAndVols.C), written down again in long double.

#include "cellShapes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <random>

using namespace morph;

namespace
{

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;
using Cell = std::vector<Vector3>;

const CellShape shapes[] = {
    CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
    CellShape::hexahedron};


// The smallest pyramid of a face with the cell's centre, and three times the
// volume
std::pair<Real, Real> openFoam(const CellShape shape, const Cell& cell)
{
    std::vector<Point> areas, centres;
    for (const std::vector<int>& f : faces(shape))
    {
        std::vector<Point> x;
        Point middle = Point::Zero();
        for (const int i : f)
        {
            x.push_back(cell[i].cast<Real>());
            middle += x.back();
        }
        middle /= Real(f.size());
        Point sum = Point::Zero(), moment = Point::Zero();
        Real weight = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            const Point& next = x[(i + 1) % x.size()];
            const Point n = (next - x[i]).cross(middle - x[i]);
            sum += n;
            weight += n.norm();
            moment += n.norm() * (x[i] + next + middle);
        }
        areas.push_back(sum / 2);
        centres.push_back(weight > 0 ? Point(moment / (3 * weight)) : middle);
    }
    Point estimate = Point::Zero();
    for (const Point& c : centres)
    {
        estimate += c / Real(centres.size());
    }
    Point centre = Point::Zero();
    Real volume = 0;
    for (std::size_t f = 0; f < areas.size(); ++f)
    {
        const Real pyramid = areas[f].dot(centres[f] - estimate);
        centre += pyramid * (0.75L * centres[f] + 0.25L * estimate);
        volume += pyramid;
    }
    centre /= volume;
    Real smallest = volume;
    for (std::size_t f = 0; f < areas.size(); ++f)
    {
        smallest = std::min(smallest, areas[f].dot(centres[f] - centre));
    }
    return {smallest, volume};
}


bool valid(const CellShape shape, const Cell& cell)
{
    return openFoam(shape, cell).first > 0;
}


// The regular one, of size 1
Cell regular(const CellShape shape)
{
    switch (shape)
    {
    case CellShape::tetrahedron:
        return {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0.3, 0.3, 0.8}};
    case CellShape::pyramid:
        return {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0.5, 0.5, 0.8}};
    case CellShape::prism:
        return {{0, 0, 0}, {0, 1, 0}, {1, 0, 0},
                {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
    case CellShape::hexahedron:
        return {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0},
                {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
    }
    return {};
}


std::vector<bool> proven(const CellShape shape, const std::vector<Cell>& cells)
{
    std::vector<double> points;
    std::vector<std::int32_t> labels;
    for (const Cell& cell : cells)
    {
        for (const Vector3& x : cell)
        {
            labels.push_back(points.size() / 3);
            points.insert(points.end(), x.data(), x.data() + 3);
        }
    }
    std::vector<bool> result(cells.size(), true);
    Index last = -1;
    for (const Index i :
         notProven(shape, labels.data(), cells.size(), points.data()))
    {
        EXPECT_GT(i, last);
        last = i;
        result[i] = false;
    }
    return result;
}


struct Random
{
    std::mt19937 generator{7};

    double operator()(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(generator);
    }

    Vector3 vector(double size)
    {
        return {
            (*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
    }
};

} // namespace


TEST(CellShapes, regularCellsAreValidAndProven)
{
    for (const CellShape shape : shapes)
    {
        const Cell cell = regular(shape);
        EXPECT_EQ(int(cell.size()), nPoints(shape));
        EXPECT_TRUE(valid(shape, cell));
        EXPECT_TRUE(proven(shape, {cell})[0]);
    }
}


// Each edge belongs to two faces, once in each direction
TEST(CellShapes, facesAreClosed)
{
    for (const CellShape shape : shapes)
    {
        std::vector<std::pair<int, int>> edges;
        for (const std::vector<int>& f : faces(shape))
        {
            for (std::size_t i = 0; i < f.size(); ++i)
            {
                edges.emplace_back(f[i], f[(i + 1) % f.size()]);
            }
        }
        for (const auto& e : edges)
        {
            EXPECT_EQ(std::count(edges.begin(), edges.end(), e), 1);
            EXPECT_EQ(
                std::count(
                    edges.begin(), edges.end(),
                    std::make_pair(e.second, e.first)),
                1);
        }
    }
}


// Points thrown about by anything up to the size of the cell, stretched to any
// aspect ratio, far from the origin: what is proven is valid, always
TEST(CellShapes, nothingInvalidIsProven)
{
    Random random;
    for (const CellShape shape : shapes)
    {
        std::vector<Cell> cells;
        for (int i = 0; i < 100000; ++i)
        {
            const double size = std::pow(10, random(-2, 0.3));
            const Vector3 stretch(
                1, std::pow(10, random(-4, 0)), std::pow(10, random(-6, 0)));
            const Vector3 shift = random.vector(std::pow(10, random(-3, 3)));
            const Eigen::Matrix3d turn =
                Eigen::Quaterniond::UnitRandom().toRotationMatrix();
            Cell cell = regular(shape);
            for (Vector3& x : cell)
            {
                x += random.vector(size);
                x = shift + turn * x.cwiseProduct(stretch);
            }
            cells.push_back(cell);
        }
        const std::vector<bool> found = proven(shape, cells);
        int nProven = 0, nInvalid = 0;
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
            const bool good = valid(shape, cells[i]);
            EXPECT_TRUE(good || !found[i]) << int(shape) << ' ' << i;
            nProven += found[i];
            nInvalid += !good;
        }
        // There is enough of both to tell
        EXPECT_GT(nProven, 20000) << int(shape);
        EXPECT_GT(nInvalid, 5000) << int(shape);
    }
}


// The boundary between valid and invalid itself: each cell is pushed to where
// it breaks, by bisection, and looked at on both sides of it
TEST(CellShapes, nothingIsProvenWhereACellBreaks)
{
    Random random;
    for (const CellShape shape : shapes)
    {
        int n = 0;
        for (int i = 0; i < 3000; ++i)
        {
            const Vector3 stretch(1, 1, std::pow(10, random(-5, 0)));
            Cell start = regular(shape), end = start;
            for (std::size_t j = 0; j < start.size(); ++j)
            {
                end[j] += random.vector(1.5);
                start[j] = start[j].cwiseProduct(stretch);
                end[j] = end[j].cwiseProduct(stretch);
            }
            const auto at = [&](double t)
            {
                Cell cell = start;
                for (std::size_t j = 0; j < cell.size(); ++j)
                {
                    cell[j] += t * (end[j] - start[j]);
                }
                return cell;
            };
            if (valid(shape, end))
            {
                continue;
            }
            double low = 0, high = 1;
            for (int k = 0; k < 60; ++k)
            {
                const double middle = 0.5 * (low + high);
                (valid(shape, at(middle)) ? low : high) = middle;
            }
            ++n;
            for (const double t : {high, high + 1e-14, high + 1e-9})
            {
                EXPECT_TRUE(valid(shape, at(t)) || !proven(shape, {at(t)})[0]);
            }
        }
        EXPECT_GT(n, 300);
    }
}


// Neither a shear nor a stretch, however large, costs a proof: a box stays one
// that is
TEST(CellShapes, affineMapsAreProven)
{
    Random random;
    for (const CellShape shape : shapes)
    {
        std::vector<Cell> cells;
        for (int i = 0; i < 1000; ++i)
        {
            Eigen::Matrix3d map;
            do
            {
                map << random.vector(3), random.vector(3), random.vector(3);
            } while (map.determinant() < 1e-2);
            Cell cell = regular(shape);
            for (Vector3& x : cell)
            {
                x = map * x;
            }
            cells.push_back(cell);
        }
        for (const bool found : proven(shape, cells))
        {
            EXPECT_TRUE(found);
        }
    }
}


// Cells of a mesh are nearly parallelepipeds: those are to be proven
TEST(CellShapes, smallWarpsAreProven)
{
    Random random;
    for (const CellShape shape : shapes)
    {
        std::vector<Cell> cells;
        for (int i = 0; i < 10000; ++i)
        {
            Cell cell = regular(shape);
            for (Vector3& x : cell)
            {
                x += random.vector(0.04);
                x[2] *= 1e-3;
            }
            cells.push_back(cell);
        }
        for (const bool found : proven(shape, cells))
        {
            EXPECT_TRUE(found);
        }
    }
}


TEST(CellShapes, flatInvertedAndUnknownCellsAreNotProven)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const CellShape shape : shapes)
    {
        const Cell good = regular(shape);
        Cell flat = good, mirrored = good, small = good, far = good;
        for (Vector3& x : flat)
        {
            x[2] = 0;
        }
        for (Vector3& x : mirrored)
        {
            x[2] = -x[2];
        }
        // Smaller than what OpenFOAM calculates with
        for (Vector3& x : small)
        {
            x *= 1e-80;
        }
        // So far away that its size is round-off
        for (Vector3& x : far)
        {
            x += Vector3(1e14, 0, 0);
        }
        std::vector<Cell> cells{flat, mirrored, small, far};
        for (std::size_t j = 0; j < good.size(); ++j)
        {
            for (int a = 0; a < 3; ++a)
            {
                for (const double value :
                     {nan, std::numeric_limits<double>::infinity(), 1e200})
                {
                    cells.push_back(good);
                    cells.back()[j][a] = value;
                }
            }
        }
        for (const bool found : proven(shape, cells))
        {
            EXPECT_FALSE(found) << int(shape);
        }
    }
}


// Any number of cells, not only multiples of what is looked at together
TEST(CellShapes, eachCellIsLookedAt)
{
    for (const CellShape shape : shapes)
    {
        Cell bad = regular(shape);
        std::swap(bad[0], bad[1]);
        ASSERT_FALSE(valid(shape, bad));
        for (std::size_t n = 0; n < 20; ++n)
        {
            for (std::size_t i = 0; i < n; ++i)
            {
                std::vector<Cell> cells(n, regular(shape));
                cells[i] = bad;
                const std::vector<bool> found = proven(shape, cells);
                for (std::size_t j = 0; j < n; ++j)
                {
                    EXPECT_EQ(found[j], j != i);
                }
            }
            EXPECT_EQ(
                proven(shape, std::vector<Cell>(n, bad)),
                std::vector<bool>(n, false));
        }
    }
}
