// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Cells as simplices, in an order that depends on where they are alone

#include "pointOrder.hpp"
#include "simplexMesh.hpp"

#include <algorithm>
#include <numeric>

namespace morph
{

namespace
{

int placeIn(const std::vector<int>& list, int value)
{
    return int(std::find(list.begin(), list.end(), value) - list.begin());
}

} // namespace


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

} // namespace morph
