// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "simplexMesh.hpp"

#include "pointOrder.hpp"
#include "reproducibleSum.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace morph
{

namespace
{

const int L = simplexLanes;

// A simplex is flat below this fraction of the largest of its cell: no target
const double flat = 1e-3;

double powerOf(double x, int power)
{
    double result = 1;
    for (; power; power >>= 1)
    {
        result = power & 1 ? result * x : result;
        x *= x;
    }
    return result;
}

} // namespace


// Simplices of consecutive cells, in blocks
struct SimplexMesh::Scratch
{
    std::vector<SimplexBlock> blocks;
    Index size = 0;
    Vectors now;
    Vectors then;

    SimplexBlock& block(Index i) { return blocks[i / L]; }
    const SimplexBlock& block(Index i) const { return blocks[i / L]; }
};


void SimplexMesh::corners(Index celli, const Vectors& x, Vectors& corners) const
{
    const Cell& cell = cells_[celli];
    const int n = cell.nPoints;
    corners.resize(n + 1 + cell.nFaces, 3);
    corners.row(n).setZero();
    for (int i = 0; i < n; ++i)
    {
        corners.row(i) = x.row(points_[cell.point + i]);
        corners.row(n) += corners.row(i);
    }
    corners.row(n) /= n;
    for (int f = 0; f < cell.nFaces; ++f)
    {
        const Index start = faceStart_[cell.face + f];
        const Index end = faceStart_[cell.face + f + 1];
        corners.row(n + 1 + f).setZero();
        for (Index i = start; i < end; ++i)
        {
            corners.row(n + 1 + f) += corners.row(facePoints_[i]);
        }
        corners.row(n + 1 + f) /= double(end - start);
    }
}


double SimplexMesh::size(const Vectors& corners, const Simplex& simplex) const
{
    const auto edge = [&](int i) -> Vector3
    {
        return (corners.row(simplex.corner[i]) - corners.row(simplex.corner[0]))
            .transpose();
    };
    const Vector3 a = edge(1);
    const Vector3 b = edge(2);
    const double size =
        dimension_ == 2 ? a[0] * b[1] - a[1] * b[0] : a.cross(b).dot(edge(3));
    return simplex.positive ? size : -size;
}


SimplexMesh::Edge
SimplexMesh::edgesOf(const Vectors& corners, const Simplex& simplex) const
{
    const int d = dimension_;
    Edge edges{};
    for (int i = 0; i < d; ++i)
    {
        for (int j = 0; j < d; ++j)
        {
            edges[i * d + j] = corners(simplex.corner[i + 1], j)
                - corners(simplex.corner[0], j);
        }
    }
    return edges;
}


SimplexMesh::Edge
SimplexMesh::orthogonal(const Vectors& corners, const Simplex& simplex) const
{
    const int d = dimension_;
    std::array<Vector3, 4> x;
    double longest = 0;
    double mean = 0;
    const int n = d + (simplex.kind == Simplex::Kind::face ? 0 : 1);
    for (int i = 0; i <= d; ++i)
    {
        x[i] = corners.row(simplex.corner[i]).transpose();
        for (int j = 0; j < i; ++j)
        {
            const double length = (x[i] - x[j]).norm();
            longest = std::max(longest, length);
            mean += i < n ? length : 0;
        }
    }
    mean /= n * (n - 1) / 2;
    const double least = std::max(flat * longest, 1e-150);
    const auto length = [&](const Vector3& a)
    { return std::max(a.norm(), least); };
    const double side = std::max(mean, least);
    const double sign = simplex.positive ? 1 : -1;

    // Corners are in this order: points, the mean of the cell, that of a face
    std::array<Vector3, 4> y;
    y.fill(Vector3::Zero());
    if (simplex.kind == Simplex::Kind::edge)
    {
        const Vector3 middle = 0.5 * (x[0] + x[1]);
        y[1][0] = length(x[1] - x[0]);
        y[2][0] = 0.5 * y[1][0];
        if (d == 2)
        {
            y[2][1] = sign * length(x[2] - middle);
        }
        else
        {
            y[3] = y[2];
            y[3][1] = length(x[3] - middle);
            y[2] = y[3];
            y[2][2] = -sign * length(x[2] - x[3]);
        }
    }
    else
    {
        y[1][0] = side;
        y[2][0] = 0.5 * side;
        y[2][1] = std::sqrt(0.75) * side;
        if (d == 2)
        {
            y[2][1] *= sign;
        }
        else
        {
            const bool whole = simplex.kind == Simplex::Kind::whole;
            y[3] << 0.5 * side, std::sqrt(1.0 / 12) * side,
                sign
                * (whole ? std::sqrt(2.0 / 3) * side
                         : length(x[3] - (x[0] + x[1] + x[2]) / 3));
        }
    }

    Edge edges{};
    for (int i = 0; i < d; ++i)
    {
        for (int j = 0; j < d; ++j)
        {
            edges[i * d + j] = y[i + 1][j] - y[0][j];
        }
    }
    return edges;
}


void SimplexMesh::gather(Index celli, const Vectors& x, Scratch& scratch) const
{
    const Cell& cell = cells_[celli];
    const int n = dimension_ * dimension_;
    corners(celli, x, scratch.now);
    corners(celli, reference_, scratch.then);

    double largest = 0;
    for (int s = 0; s < cell.nSimplices; ++s)
    {
        largest =
            std::max(largest, size(scratch.then, simplices_[cell.simplex + s]));
    }
    for (int s = 0; s < cell.nSimplices; ++s)
    {
        const Simplex& simplex = simplices_[cell.simplex + s];
        const bool regular = target_ == SimplexTarget::orthogonal
            || !(size(scratch.then, simplex) > flat * largest);
        const Edge then = regular ? orthogonal(scratch.then, simplex)
                                  : edgesOf(scratch.then, simplex);
        const Edge now = edgesOf(scratch.now, simplex);
        const Index i = scratch.size++;
        if (i / L >= Index(scratch.blocks.size()))
        {
            scratch.blocks.emplace_back();
        }
        SimplexBlock& block = scratch.block(i);
        for (int j = 0; j < n; ++j)
        {
            block.target[j * L + i % L] = then[j];
            block.edges[j * L + i % L] = now[j];
        }
    }
}


template <class Visit>
void SimplexMesh::forAllCells(
    const Vectors& x, const SimplexSettings& settings, const Visit& visit) const
{
    // Some hundred simplices at once stay in the cache
    const Index enough = 16 * L;
    Scratch scratch;
    std::vector<std::pair<Index, Index>> cells;
    for (Index celli = 0; celli < nCells(); ++celli)
    {
        cells.emplace_back(celli, scratch.size);
        gather(celli, x, scratch);
        if (scratch.size < enough && celli + 1 < nCells())
        {
            continue;
        }

        // Lanes that are left over have any target that is not flat
        for (; scratch.size % L; ++scratch.size)
        {
            SimplexBlock& block = scratch.block(scratch.size);
            for (int j = 0; j < dimension_ * dimension_; ++j)
            {
                const double one = j % (dimension_ + 1) == 0;
                block.target[j * L + scratch.size % L] = one;
                block.edges[j * L + scratch.size % L] = one;
            }
        }
        for (Index i = 0; i < scratch.size; i += L)
        {
            evaluateSimplices(dimension_, settings, scratch.block(i));
        }
        for (const auto& [cell, first] : cells)
        {
            visit(cell, first, scratch);
        }
        cells.clear();
        scratch.size = 0;
    }
}


void SimplexMesh::derivative(
    Index celli, Index first, const Scratch& scratch, int power,
    Vectors& byCorners, Vectors& parts) const
{
    const Cell& cell = cells_[celli];
    const int n = cell.nPoints;
    const int d = dimension_;
    byCorners.setZero(n + 1 + cell.nFaces, 3);
    for (int s = 0; s < cell.nSimplices; ++s)
    {
        const Simplex& simplex = simplices_[cell.simplex + s];
        const SimplexBlock& block = scratch.block(first + s);
        const Index lane = (first + s) % L;
        const double factor = power * powerOf(block.mu[lane], power - 1);
        for (int i = 0; i < d; ++i)
        {
            for (int j = 0; j < d; ++j)
            {
                const double g =
                    factor * block.derivative[(i * d + j) * L + lane];
                byCorners(simplex.corner[i + 1], j) += g;
                byCorners(simplex.corner[0], j) -= g;
            }
        }
    }
    for (int f = 0; f < cell.nFaces; ++f)
    {
        const Index start = faceStart_[cell.face + f];
        const Index end = faceStart_[cell.face + f + 1];
        for (Index i = start; i < end; ++i)
        {
            byCorners.row(facePoints_[i]) +=
                byCorners.row(n + 1 + f) / double(end - start);
        }
    }
    for (int i = 0; i < n; ++i)
    {
        parts.row(cell.point + i) = byCorners.row(i) + byCorners.row(n) / n;
    }
}


void SimplexMesh::evaluate(
    const Vectors& x, const Settings& settings, Communicator& communicator,
    Result& result) const
{
    result.parts.resize(points_.size(), 3);
    result.derivative.resize(nOwned_, 3);
    std::vector<double> distortions;
    distortions.reserve(cells_.size());
    double least = std::numeric_limits<double>::max();
    Vectors byCorners;
    forAllCells(
        x, settings.simplex,
        [&](Index celli, Index first, const Scratch& scratch)
        {
            const Cell& cell = cells_[celli];
            derivative(
                celli, first, scratch, settings.power, byCorners, result.parts);
            if (!cell.own)
            {
                return;
            }
            double sum = 0;
            for (Index i = first; i < first + cell.nSimplices; ++i)
            {
                const SimplexBlock& block = scratch.block(i);
                sum += powerOf(block.mu[i % L], settings.power);
                least = std::min(least, block.determinant[i % L]);
            }
            distortions.push_back(sum);
        });

    for (Index i = 0; i < nOwned_; ++i)
    {
        result.derivative.row(i).setZero();
        for (Index s = slotStart_[i]; s < slotStart_[i + 1]; ++s)
        {
            result.derivative.row(i) += result.parts.row(slots_[s]);
        }
    }
    result.distortion = reproducibleSum(
        distortions.data(), Index(distortions.size()), communicator);
    result.leastDeterminant = -communicator.max(-least);
}


SimplexMesh::CellState
SimplexMesh::cellState(const Vectors& x, const Settings& settings) const
{
    CellState state;
    state.stiffness.resize(cells_.size());
    state.determinant.resize(cells_.size());
    const double epsilonSquared = settings.simplex.epsilonSquared;
    forAllCells(
        x, settings.simplex,
        [&](Index celli, Index first, const Scratch& scratch)
        {
            const Cell& cell = cells_[celli];
            double sum = 0;
            double least = std::numeric_limits<double>::max();
            for (Index i = first; i < first + cell.nSimplices; ++i)
            {
                const SimplexBlock& block = scratch.block(i);
                const double D = block.determinant[i % L];
                const double root =
                    std::sqrt(epsilonSquared + D * D) + std::abs(D);
                const double chi =
                    D > 0 ? 0.5 * root : 0.5 * epsilonSquared / root;
                const double mu = block.mu[i % L];
                sum += settings.power * powerOf(mu, settings.power - 1)
                    / std::pow(chi, 2.0 / dimension_);
                least = std::min(least, D);
            }
            state.stiffness[celli] = sum;
            state.determinant[celli] = least;
        });
    return state;
}


SimplexMesh::Edges SimplexMesh::edges() const
{
    // Of each cell its edges as pairs of its points, in order
    std::vector<Index> start{0};
    std::vector<std::array<int, 2>> pairs;
    for (const Cell& cell : cells_)
    {
        std::vector<std::array<int, 2>> mine;
        for (int s = 0; s < cell.nSimplices; ++s)
        {
            const Simplex& simplex = simplices_[cell.simplex + s];
            for (int i = 0; i <= dimension_; ++i)
            {
                for (int j = i + 1; j <= dimension_; ++j)
                {
                    if (simplex.corner[j] < cell.nPoints)
                    {
                        mine.push_back(
                            {int(simplex.corner[i]), int(simplex.corner[j])});
                    }
                }
            }
        }
        std::sort(mine.begin(), mine.end());
        mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
        pairs.insert(pairs.end(), mine.begin(), mine.end());
        start.push_back(Index(pairs.size()));
    }

    struct Part
    {
        int neighbour;
        int cell;
        double coefficient;
    };
    Edges edges;
    edges.row.push_back(0);
    edges.part.push_back(0);
    std::vector<Part> parts;
    for (Index point = 0; point < nOwned_; ++point)
    {
        parts.clear();
        for (Index s = slotStart_[point]; s < slotStart_[point + 1]; ++s)
        {
            const Index celli = slotCell_[s];
            const Cell& cell = cells_[celli];
            const int me = int(slots_[s] - cell.point);
            const double share =
                double(dimension_) / double(start[celli + 1] - start[celli]);
            for (Index e = start[celli]; e < start[celli + 1]; ++e)
            {
                if (pairs[e][0] != me && pairs[e][1] != me)
                {
                    continue;
                }
                const int other = points(
                    celli)[pairs[e][0] == me ? pairs[e][1] : pairs[e][0]];
                const double square =
                    (reference_.row(other) - reference_.row(point))
                        .squaredNorm();
                parts.push_back(
                    {other, int(celli), share / std::max(square, 1e-300)});
            }
        }
        std::stable_sort(
            parts.begin(), parts.end(),
            [this](const Part& a, const Part& b)
            { return place_[a.neighbour] < place_[b.neighbour]; });
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
            const Part& part = parts[i];
            if (i == 0 || parts[i - 1].neighbour != part.neighbour)
            {
                edges.neighbour.push_back(part.neighbour);
                edges.part.push_back(edges.part.back());
            }
            edges.cell.push_back(part.cell);
            edges.coefficient.push_back(part.coefficient);
            ++edges.part.back();
        }
        edges.row.push_back(Index(edges.neighbour.size()));
    }
    return edges;
}

} // namespace morph
