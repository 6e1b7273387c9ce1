// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "overlapTable.hpp"

#include "boxTree.hpp"
#include "tetrahedronOverlap.hpp"

#include <numeric>
#include <utility>

namespace morph
{

namespace
{

Box boxOf(const std::array<Vector3, 4>& corners)
{
    Box box = Box::empty();
    for (const Vector3& x : corners)
    {
        box.extend(x);
    }
    return box;
}


} // namespace


OverlapTable::OverlapTable(
    const CellTetrahedra& donors, const CellTetrahedra& targets)
: nDonors_(donors.nCells)
{
    std::vector<Tetrahedron> target;
    std::vector<Box> boxes;
    target.reserve(targets.corners.size());
    boxes.reserve(targets.corners.size());
    for (const auto& corners : targets.corners)
    {
        target.emplace_back(corners);
        boxes.push_back(boxOf(corners));
    }
    const BoxTree tree(std::move(boxes));

    // Of each target cell its entry with the donor cell at hand, if that is not
    // before the donor's first
    std::vector<Index> latest(targets.nCells, -1);
    std::vector<Entry> entries;
    Index first = 0;
    for (std::size_t n = 0; n < donors.corners.size(); ++n)
    {
        const int cell = donors.cell[n];
        if (n > 0 && cell != donors.cell[n - 1])
        {
            first = Index(entries.size());
        }
        const Tetrahedron donor(donors.corners[n]);
        tree.forAllTouching(
            boxOf(donors.corners[n]),
            [&](const int i)
            {
                const Overlap common = overlap(donor, target[i]);
                if (common.volume == 0)
                {
                    return;
                }
                Index& entry = latest[targets.cell[i]];
                if (entry < first)
                {
                    entry = Index(entries.size());
                    entries.push_back(
                        {targets.cell[i], cell, 0, Vector3::Zero()});
                }
                const int sign = donor.sign() * target[i].sign();
                entries[entry].volume += sign * common.volume;
                entries[entry].moment += sign * common.moment;
            });
    }
    fill(targets.nCells, entries);
}


void OverlapTable::fill(const int nTargets, const std::vector<Entry>& entries)
{
    // Entries are in the order of donors, and so are those of each target
    start_.assign(nTargets + 1, 0);
    for (const Entry& entry : entries)
    {
        ++start_[entry.target + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());

    donor_.resize(entries.size());
    volume_.resize(entries.size());
    moment_.resize(Index(entries.size()), 3);
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    for (const Entry& entry : entries)
    {
        const Index e = next[entry.target]++;
        donor_[e] = entry.donor;
        volume_[e] = entry.volume;
        moment_.row(e) = entry.moment;
    }
}


OverlapTable::Sums OverlapTable::donorSums() const
{
    Sums sums{Eigen::VectorXd::Zero(nDonors_), Vectors::Zero(nDonors_, 3)};
    for (Index e = 0; e < size(); ++e)
    {
        sums.volume[donor(e)] += volume(e);
        sums.moment.row(donor(e)) += moment(e);
    }
    return sums;
}


OverlapTable::Sums OverlapTable::targetSums() const
{
    Sums sums{Eigen::VectorXd::Zero(nTargets()), Vectors::Zero(nTargets(), 3)};
    for (int i = 0; i < nTargets(); ++i)
    {
        for (Index e = begin(i); e < end(i); ++e)
        {
            sums.volume[i] += volume(e);
            sums.moment.row(i) += moment(e);
        }
    }
    return sums;
}

} // namespace morph
