// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "exactSurface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace morph
{

namespace
{

// Of images that matter, in largest radii: points in the mesh feel centres
// within one, and what these are given depends on centres within one, a half,
// a quarter ... further
constexpr double farthest = 3;


// Positions, found again to within a tolerance
class PlaceTable
{
public:
    PlaceTable(const Columns& x, double tolerance)
    : tolerance_(tolerance)
    {
        for (Index i = 0; i < x.rows(); ++i)
        {
            add(x.row(i).transpose());
        }
    }

    void add(const Vector3& x)
    {
        cells_[cell(x)].push_back(positions_.size());
        positions_.push_back(x);
    }

    // -1 if there is none
    Index find(const Vector3& x) const
    {
        const Cell middle = cell(x);
        for (int n = 0; n < 27; ++n)
        {
            const auto found = cells_.find(
                {middle[0] + n % 3 - 1, middle[1] + n / 3 % 3 - 1,
                 middle[2] + n / 9 - 1});
            if (found == cells_.end())
            {
                continue;
            }
            for (const Index i : found->second)
            {
                if ((positions_[i] - x).norm() <= tolerance_)
                {
                    return i;
                }
            }
        }
        return -1;
    }

private:
    using Cell = std::array<double, 3>;

    // Larger than the tolerance, so that neighbours are enough
    Cell cell(const Vector3& x) const
    {
        Cell c;
        for (int a = 0; a < 3; ++a)
        {
            c[a] = std::floor(x[a] / (4 * tolerance_));
        }
        return c;
    }

    double tolerance_;
    std::vector<Vector3> positions_;
    std::map<Cell, std::vector<Index>> cells_;
};

} // namespace


std::vector<Index> ExactSurface::addImages(Columns& centres)
{
    std::vector<Index> family;
    if (images_.trivial())
    {
        return family;
    }
    family.resize(nCentres_);
    std::iota(family.begin(), family.end(), Index(0));

    // An image may be where another centre is, or another map has brought it
    const PlaceTable places(centres, images_.samePlace());
    PlaceTable added(Columns(0, 3), images_.samePlace());
    const double reach = farthest * radius_;
    for (const ImageGroup::Replica& r : images_.replicas(centres, reach))
    {
        const Index there = places.find(r.position);
        if (there >= 0 && family[there] != family[r.of])
        {
            const Index a = std::min(family[there], family[r.of]);
            const Index b = std::max(family[there], family[r.of]);
            std::replace(family.begin(), family.end(), b, a);
        }
        if (there < 0 && added.find(r.position) < 0)
        {
            added.add(r.position);
            replicas_.push_back(r);
        }
    }
    centres.conservativeResize(nCentres_ + Index(replicas_.size()), 3);
    for (std::size_t i = 0; i < replicas_.size(); ++i)
    {
        centres.row(nCentres_ + i) = replicas_[i].position.transpose();
        family.push_back(family[replicas_[i].of]);
    }
    return family;
}


void ExactSurface::start(
    const ControlPoints& controlPoints, Communicator& communicator,
    const Vectors& points)
{
    std::vector<double> mine;
    for (const ControlPoint& p : controlPoints)
    {
        mine.insert(mine.end(), p.position.data(), p.position.data() + 3);
    }
    const std::vector<double> all = communicator.gather(mine);
    const auto position = [&all](Index i)
    { return Vector3(Eigen::Map<const Vector3>(&all[3 * i])); };

    // One order, whichever rank they are from
    std::vector<Index> order(all.size() / 3);
    std::iota(order.begin(), order.end(), Index(0));
    std::sort(
        order.begin(), order.end(),
        [&](Index a, Index b) { return before(position(a), position(b)); });

    centre_.resize(order.size());
    Columns centres(order.size(), 3);
    nCentres_ = 0;
    for (std::size_t k = 0; k < order.size(); ++k)
    {
        const Vector3 x = position(order[k]);
        if (k == 0 || x != position(order[k - 1]))
        {
            centres.row(nCentres_++) = x.transpose();
        }
        centre_[order[k]] = nCentres_ - 1;
    }
    centres.conservativeResize(nCentres_, 3);
    const std::vector<Index> family = addImages(centres);
    correction_.reset(new SurfaceCorrection(centres, radius_, family));
    reach_ = correction_->reach(points);
}


void ExactSurface::add(
    const ControlPoints& controlPoints, const Vectors& residuals,
    Communicator& communicator, const Vectors& points, Vectors& displacements)
{
    if (!correction_)
    {
        start(controlPoints, communicator, points);
    }
    const std::vector<double> all = communicator.gather(std::vector<double>(
        residuals.data(), residuals.data() + residuals.size()));

    // Of several at a place the first by its residual
    Vectors open(nCentres_ + Index(replicas_.size()), 3);
    std::vector<char> there(nCentres_, 0);
    for (std::size_t i = 0; i < centre_.size(); ++i)
    {
        const Vector3 r = Eigen::Map<const Vector3>(&all[3 * i]);
        const Index c = centre_[i];
        if (!there[c] || before(r, open.row(c).transpose()))
        {
            open.row(c) = r.transpose();
            there[c] = 1;
        }
    }
    for (std::size_t i = 0; i < replicas_.size(); ++i)
    {
        const ImageGroup::Replica& r = replicas_[i];
        open.row(nCentres_ + i) =
            open.row(r.of) * images_.maps()[r.map].R.transpose();
    }
    correction_->set(open);
    correction_->add(reach_, displacements);
}

} // namespace morph
