// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// How the cells of one mesh overlap with those of another: for each pair that
// does, the volume in common and its centroid.
//
// Cells are sums of tetrahedra, whose order of corners says whether they count
// as positive or negative: where the tetrahedra of a cell fold over each other,
// the surplus cancels, and what is left is the cell.

#ifndef morph_overlapTable_hpp
#define morph_overlapTable_hpp

#include "arrays.hpp"

#include <array>
#include <vector>

namespace morph
{

struct CellTetrahedra
{
    int nCells = 0;

    // Of tetrahedra, in ascending order of their cells
    std::vector<std::array<Vector3, 4>> corners;
    std::vector<int> cell;
};


class OverlapTable
{
public:
    // All pairs, for each target cell the donors in ascending order. Cost: for
    // meshes of like fineness some 30 microseconds a tetrahedron of the donors;
    // memory: 0.4 kB a tetrahedron of the targets and some 100 bytes a pair
    OverlapTable(const CellTetrahedra& donors, const CellTetrahedra& targets);

    int nDonors() const { return nDonors_; }
    int nTargets() const { return int(start_.size()) - 1; }

    // Entries of a target are [begin(target), end(target))
    Index begin(int target) const { return start_[target]; }
    Index end(int target) const { return start_[target + 1]; }
    Index size() const { return Index(donor_.size()); }

    int donor(Index entry) const { return donor_[entry]; }
    double volume(Index entry) const { return volume_[entry]; }
    auto moment(Index entry) const { return moment_.row(entry); }

    // What each donor or target has in common with all others
    struct Sums
    {
        Eigen::VectorXd volume;
        Vectors moment;
    };

    Sums donorSums() const;
    Sums targetSums() const;

private:
    struct Entry
    {
        int target;
        int donor;
        double volume;
        Vector3 moment;
    };

    void fill(int nTargets, const std::vector<Entry>& entries);

    int nDonors_;
    std::vector<Index> start_;
    std::vector<int> donor_;
    std::vector<double> volume_;
    Vectors moment_;
};

} // namespace morph

#endif
