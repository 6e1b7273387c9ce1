// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Cells whose positive volume and outward faces are proven from their points
// alone, many at a time.
//
// What OpenFOAM asks of a cell is that the pyramid between each face and the
// centre of the cell is positive: A . (C - c) > 0, with the area vector A and
// the centre C of the face and
//
//     c = sum_k w_k (3/4 C_k + 1/4 e),    e = 1/N sum_k C_k
//
// the centre of the cell with N faces; w_k is the share of the pyramid from e
// on face k, V_k = A_k . (C_k - e), in the sum of them. The centre of a face is
// a mean of the centroids of its triangles, which are between an edge and the
// average m of its points, with their areas as weights.
//
// That takes roots and divisions, and the centres of all faces. This does
// without them, by bounds. With t = A . x for the area vector of one face:
//
//   - of the face itself A . C = A . m, exactly: A is normal to both diagonals
//     of a quadrilateral, so that its corners have two values of t in turn, and
//     the centroids of its triangles all have their mean;
//   - of another face k, A . C_k <= M_k, the largest t of the centroids of its
//     triangles, since weights are positive; of a triangle A . C_k = A . m;
//   - so D_k = A . C - M_k <= A . (C - C_k), and if
//         S = 1/N sum_{k != face} D_k > 0
//     for all faces, then A . (C - e) >= S: all V_k are positive, the volume is,
//     and all w_k lie between zero and one;
//   - then A . (C - c) >= 1/4 S + 3/4 min(0, min_k D_k), since the term of the
//     face itself vanishes.
//
// A cell is proven valid if that last bound exceeds what round-off may have
// made of it. The bound is that of the points as they are, so that affine maps
// of a box, however large, are proven as the box is; what is not proven may
// still be valid.

#ifndef morph_cellShapes_hpp
#define morph_cellShapes_hpp

#include "arrays.hpp"

#include <cstdint>
#include <vector>

namespace morph
{

enum class CellShape
{
    tetrahedron,
    pyramid,
    prism,
    hexahedron
};

constexpr int nCellShapes = 4;

// The base is numbered first, such that its normal points out of the cell; then
// the tip, or the points opposite to those of the base in their order
int nPoints(CellShape shape);

// The points of each face, such that its normal points outward; the base first
const std::vector<std::vector<int>>& faces(CellShape shape);

// In units of the size of the largest coordinate times the square of a cell's:
// more than the round-off of a pyramid's volume, by the formulas of OpenFOAM as
// well as by those here
constexpr double cellRoundOff = 1e4 * 2.2e-16;

// Which of n cells of a shape are not proven valid: their numbers, ascending.
// A coordinate that is not a number proves nothing.
// \param labels  nPoints(shape) for each cell
// \param points  three coordinates each
std::vector<Index> notProven(
    CellShape shape, const std::int32_t* labels, Index n, const double* points);

} // namespace morph

#endif
