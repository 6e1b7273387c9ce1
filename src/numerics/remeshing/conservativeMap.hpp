// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Values in the cells of one mesh become values in those of another, without
// loss and to second order:
//
//     phi_i = sum_j V_ij (phi_j + g_j (x_ij - x_j)) / sum_j V_ij
//
// with the volume V_ij that target i and donor j have in common, its centroid
// x_ij, and the centroid x_j of all that targets have of donor j. Since
// sum_i V_ij (x_ij - x_j) = 0, the integral stays whatever the slopes g_j, which
// may be limited.

#ifndef morph_conservativeMap_hpp
#define morph_conservativeMap_hpp

#include "arrays.hpp"
#include "cellSlopes.hpp"
#include "overlapTable.hpp"

#include <limits>
#include <utility>

namespace morph
{

// What values must not leave
struct ValueBounds
{
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
};


class ConservativeMap
{
public:
    explicit ConservativeMap(OverlapTable table);

    const OverlapTable& table() const { return table_; }

    // values: of donors, then of whatever else the slopes know. They lie within
    // the bounds
    Eigen::VectorXd
    map(const CellSlopes& slopes, const Eigen::VectorXd& values,
        const ValueBounds& bounds) const;

    // The same with slopes as they are, one for each donor
    Eigen::VectorXd
    map(const Eigen::VectorXd& values, const Vectors& slopes) const;

    // Makes slopes less steep until no part of a donor gets a value beyond those
    // of its neighbours or the bounds (Barth and Jespersen, AIAA 89-0366). Where
    // values are linear there is nothing to guard against but the bounds
    void limit(
        const CellSlopes& slopes, const Eigen::VectorXd& values,
        const ValueBounds& bounds, Vectors& gradient) const;

private:
    OverlapTable table_;

    // Of each donor
    Vectors centroid_;

    // Of each entry, the way from its donor's centroid
    Vectors way_;

    // Of each donor its entries
    std::vector<Index> start_;
    std::vector<Index> entry_;
};

} // namespace morph

#endif
