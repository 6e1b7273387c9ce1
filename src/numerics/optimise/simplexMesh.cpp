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


int placeIn(const std::vector<int>& list, int value)
{
    return int(std::find(list.begin(), list.end(), value) - list.begin());
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


SimplexMesh::SimplexMesh(
    int dimension, Index nOwned, const Vectors& reference, SimplexTarget target)
: dimension_(dimension),
  nOwned_(nOwned),
  reference_(reference),
  target_(target),
  place_(reference.rows())
{
    std::vector<int> order(reference.rows());
    std::iota(order.begin(), order.end(), 0);
    std::sort(
        order.begin(), order.end(),
        [&](int a, int b)
        {
            const double* x = reference_.data();
            return precedes(x + 3 * a, x + 3 * b);
        });
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        place_[order[i]] = int(i);
    }
}


std::vector<int> SimplexMesh::sorted(std::vector<int> points) const
{
    std::sort(
        points.begin(), points.end(),
        [this](int a, int b) { return place_[a] < place_[b]; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}


void SimplexMesh::addFace(
    const std::vector<int>& face, const std::vector<int>& cellPoints)
{
    for (int point : sorted(face))
    {
        facePoints_.push_back(placeIn(cellPoints, point));
    }
    faceStart_.push_back(Index(facePoints_.size()));
}


// Sorts the corners; an odd permutation turns the simplex around
void SimplexMesh::addSimplex(
    std::vector<int> corners, bool positive, Simplex::Kind kind)
{
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        for (std::size_t j = i + 1; j < corners.size(); ++j)
        {
            if (corners[j] < corners[i])
            {
                std::swap(corners[i], corners[j]);
                positive = !positive;
            }
        }
    }
    Simplex simplex{{0, 0, 0, 0}, positive, kind};
    std::copy(corners.begin(), corners.end(), simplex.corner.begin());
    simplices_.push_back(simplex);
}


void SimplexMesh::addPolygon(
    const std::vector<int>& polygon, const std::vector<int>& cellPoints)
{
    const int mean = int(cellPoints.size());
    std::vector<int> p;
    for (int point : polygon)
    {
        p.push_back(placeIn(cellPoints, point));
    }
    if (p.size() == 3)
    {
        addSimplex(p, true, Simplex::Kind::whole);
        return;
    }
    for (std::size_t i = 0; i < p.size(); ++i)
    {
        addSimplex(
            {mean, p[i], p[(i + 1) % p.size()]}, true, Simplex::Kind::edge);
    }
}


void SimplexMesh::addPolyhedron(
    const std::vector<std::vector<int>>& faces,
    const std::vector<int>& cellPoints)
{
    const int mean = int(cellPoints.size());
    const bool tetrahedron = mean == 4 && faces.size() == 4;
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
        std::vector<int> p;
        for (int point : faces[f])
        {
            p.push_back(placeIn(cellPoints, point));
        }
        if (tetrahedron)
        {
            // Seen from the fourth corner the face's normal points away
            p.push_back(6 - p[0] - p[1] - p[2]);
            addSimplex(p, false, Simplex::Kind::whole);
            return;
        }
        if (p.size() == 3)
        {
            p.push_back(mean);
            addSimplex(p, false, Simplex::Kind::face);
            continue;
        }
        for (std::size_t i = 0; i < p.size(); ++i)
        {
            addSimplex(
                {mean, mean + 1 + int(f), p[i], p[(i + 1) % p.size()]}, true,
                Simplex::Kind::edge);
        }
    }
}


void SimplexMesh::add(const std::vector<std::vector<int>>& given, bool own)
{
    std::vector<int> all;
    for (const std::vector<int>& face : given)
    {
        all.insert(all.end(), face.begin(), face.end());
    }
    const std::vector<int> cellPoints = sorted(all);

    // In the order of their points: nothing depends on how the cell was given
    std::vector<std::vector<int>> faces(given);
    std::sort(
        faces.begin(), faces.end(),
        [this](const std::vector<int>& a, const std::vector<int>& b)
        {
            const std::vector<int> p = sorted(a);
            const std::vector<int> q = sorted(b);
            return std::lexicographical_compare(
                p.begin(), p.end(), q.begin(), q.end(),
                [this](int i, int j) { return place_[i] < place_[j]; });
        });

    Cell cell;
    cell.point = Index(points_.size());
    cell.nPoints = int(cellPoints.size());
    cell.nFaces = dimension_ == 3 ? int(faces.size()) : 0;
    cell.face = Index(faceStart_.size());
    cell.simplex = Index(simplices_.size());
    cell.own = own;
    points_.insert(points_.end(), cellPoints.begin(), cellPoints.end());
    if (dimension_ == 3)
    {
        faceStart_.push_back(Index(facePoints_.size()));
        for (const std::vector<int>& face : faces)
        {
            addFace(face, cellPoints);
        }
        addPolyhedron(faces, cellPoints);
    }
    else
    {
        addPolygon(faces[0], cellPoints);
    }
    std::sort(
        simplices_.begin() + cell.simplex, simplices_.end(),
        [](const Simplex& a, const Simplex& b) { return a.corner < b.corner; });
    cell.nSimplices = int(Index(simplices_.size()) - cell.simplex);
    nSimplices_ += own ? cell.nSimplices : 0;
    cells_.push_back(cell);
}


void SimplexMesh::finish()
{
    // Cells in the order of their points
    std::vector<Index> order(cells_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(
        order.begin(), order.end(),
        [this](Index a, Index b)
        {
            const int* p = points(a);
            const int* q = points(b);
            return std::lexicographical_compare(
                p, p + nPoints(a), q, q + nPoints(b),
                [this](int i, int j) { return place_[i] < place_[j]; });
        });

    slotStart_.assign(nOwned_ + 1, 0);
    for (int point : points_)
    {
        if (point < nOwned_)
        {
            ++slotStart_[point + 1];
        }
    }
    std::partial_sum(slotStart_.begin(), slotStart_.end(), slotStart_.begin());
    slots_.resize(slotStart_.back());
    slotCell_.resize(slots_.size());
    std::vector<Index> next(slotStart_.begin(), slotStart_.end() - 1);
    for (Index celli : order)
    {
        const Cell& cell = cells_[celli];
        for (int i = 0; i < cell.nPoints; ++i)
        {
            const int point = points_[cell.point + i];
            if (point < nOwned_)
            {
                slotCell_[next[point]] = int(celli);
                slots_[next[point]++] = cell.point + i;
            }
        }
    }
}


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
