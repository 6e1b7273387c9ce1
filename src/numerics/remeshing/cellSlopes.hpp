// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Gradients of values in cells by least squares, weighted by the inverse square
// of the distance: exact for linear values, whatever the cells.

#ifndef morph_cellSlopes_hpp
#define morph_cellSlopes_hpp

#include "arrays.hpp"

#include <vector>

namespace morph
{

class CellSlopes
{
public:
    // Rows of position are centres of cells, and behind them of what else there
    // is a value of: neighbours that are not mapped, boundary faces. Neighbours
    // of cell c are neighbour[start[c]], ..., neighbour[start[c + 1] - 1]
    CellSlopes(
        Vectors position, std::vector<Index> start, std::vector<int> neighbour);

    Index nCells() const { return Index(start_.size()) - 1; }
    Index nValues() const { return position_.rows(); }

    // Zero in directions in which a cell has no neighbours
    Vectors slopes(const Eigen::VectorXd& values) const;

    // Of a cell and its neighbours
    struct Range
    {
        double least;
        double most;
    };

    Range range(Index cell, const Eigen::VectorXd& values) const;

    // How far the values of the neighbours are from the plane of the slope, by
    // how far they are from the cell's: 0 where values are linear
    double roughness(
        Index cell, const Eigen::VectorXd& values, const Vector3& slope) const;

private:
    Vectors position_;
    std::vector<Index> start_;
    std::vector<int> neighbour_;

    // Pseudo-inverse of the sum of d d^T/d^2, with d the way to a neighbour
    std::vector<Eigen::Matrix3d> inverse_;
};

} // namespace morph

#endif
