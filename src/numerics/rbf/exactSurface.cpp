// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "exactSurface.hpp"

#include <algorithm>
#include <numeric>

namespace morph
{

void ExactSurface::start
(
    const ControlPoints& controlPoints,
    Communicator& communicator,
    const Vectors& points
)
{
    std::vector<double> mine;
    for (const ControlPoint& p : controlPoints)
    {
        mine.insert
        (
            mine.end(), p.position.data(), p.position.data() + 3
        );
    }
    const std::vector<double> all = communicator.gather(mine);
    const auto position = [&all](Index i)
    {
        return Vector3(Eigen::Map<const Vector3>(&all[3*i]));
    };

    // One order, whichever rank they are from
    std::vector<Index> order(all.size()/3);
    std::iota(order.begin(), order.end(), Index(0));
    std::sort
    (
        order.begin(),
        order.end(),
        [&](Index a, Index b) { return before(position(a), position(b)); }
    );

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
    correction_.reset
    (
        new SurfaceCorrection(centres.topRows(nCentres_), radius_)
    );
    reach_ = correction_->reach(points);
}


void ExactSurface::add
(
    const ControlPoints& controlPoints,
    const Vectors& residuals,
    Communicator& communicator,
    const Vectors& points,
    Vectors& displacements
)
{
    if (!correction_)
    {
        start(controlPoints, communicator, points);
    }
    const std::vector<double> all = communicator.gather
    (
        std::vector<double>
        (
            residuals.data(), residuals.data() + residuals.size()
        )
    );

    // Of several at a place the first by its residual
    Vectors open(nCentres_, 3);
    std::vector<char> there(nCentres_, 0);
    for (std::size_t i = 0; i < centre_.size(); ++i)
    {
        const Vector3 r = Eigen::Map<const Vector3>(&all[3*i]);
        const Index c = centre_[i];
        if (!there[c] || before(r, open.row(c).transpose()))
        {
            open.row(c) = r.transpose();
            there[c] = 1;
        }
    }
    correction_->set(open);
    correction_->add(reach_, displacements);
}

} // namespace morph
