// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Cells of any shape as simplices, and the distortion of a mesh as a function
// of its points (simplexEnergy.hpp).
//
// A polyhedron is cut into tetrahedra between the mean of its points, the means
// of the points of its faces, and its edges; a polygon into triangles between
// the mean of its points and its edges. Triangular faces, triangles and
// tetrahedra stay whole. Means depend on the points alone, so the distortion and
// its derivative do as well, and no cell is a special case.
//
// Cells are known to every rank that owns one of their points. Everything is
// added up in the order of positions, so that the derivative at a point is the
// same to the last bit however the mesh is distributed.

#ifndef morph_simplexMesh_hpp
#define morph_simplexMesh_hpp

#include "arrays.hpp"
#include "communicator.hpp"
#include "simplexEnergy.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace morph
{

// The shape that simplices should have
enum class SimplexTarget
{
    // That of the reference
    reference,

    // Regular, with the lengths of the reference: the line from cell to face
    // normal to the face, the one from face to edge normal to the edge; where
    // the reference is no good shape
    orthogonal
};


class SimplexMesh
{
public:
    // Points that this rank owns come first, then those of other ranks.
    // reference: their positions
    SimplexMesh(
        int dimension, Index nOwned, const Vectors& reference,
        SimplexTarget target);

    // A cell by its faces, whose points are in order around the outward normal
    // (dimension 3), or a polygon, in positive order (dimension 2, one face).
    // own: is it a cell of this rank, or of another that shares a point?
    void add(const std::vector<std::vector<int>>& faces, bool own);

    // After the last cell
    void finish();

    int dimension() const { return dimension_; }

    Index nPoints() const { return reference_.rows(); }
    Index nOwned() const { return nOwned_; }
    Index nCells() const { return Index(cells_.size()); }
    Index nSimplices() const { return nSimplices_; }
    const Vectors& reference() const { return reference_; }

    // Points of a cell, in the order of positions
    const int* points(Index cell) const { return &points_[cells_[cell].point]; }
    int nPoints(Index cell) const { return cells_[cell].nPoints; }

    struct Settings
    {
        SimplexSettings simplex;

        // Distortion is the sum of mu^power over simplices
        int power = 1;
    };

    struct Result
    {
        // Over all ranks
        double distortion;

        // The smallest D of the rank's cells
        double leastDeterminant;

        // Derivative by the points of this rank
        Vectors derivative;

        // Its parts, by the points of each cell
        Vectors parts;
    };

    // At these positions. Collective
    void evaluate(
        const Vectors& x, const Settings& settings, Communicator& communicator,
        Result& result) const;

    // The scale of the second derivative in each cell, the sum of
    // power mu^(power - 1)/chi^(2/d) over its simplices; and its smallest D
    struct CellState
    {
        std::vector<double> stiffness;
        std::vector<double> determinant;
    };

    CellState cellState(const Vectors& x, const Settings& settings) const;

    // The Laplacian of the mesh's edges that the second derivative resembles:
    // for each point of this rank its neighbours in order of position, and for
    // each the cells around the edge with the coefficient of their stiffness
    struct Edges
    {
        std::vector<Index> row;
        std::vector<int> neighbour;
        std::vector<Index> part;
        std::vector<int> cell;
        std::vector<double> coefficient;
    };

    Edges edges() const;

private:
    struct Cell
    {
        Index point;
        Index face;
        Index simplex;
        int nPoints;
        int nFaces;
        int nSimplices;
        bool own;
    };

    // Corners: points of the cell, then its mean, then the means of its faces
    struct Simplex
    {
        enum class Kind : std::uint8_t
        {
            whole, // of points alone
            face,  // of a triangular face and the mean of the cell
            edge   // of an edge and means
        };

        std::array<std::uint16_t, 4> corner;
        bool positive;
        Kind kind;
    };

    struct Scratch;

    std::vector<int> sorted(std::vector<int> points) const;
    void
    addFace(const std::vector<int>& face, const std::vector<int>& cellPoints);
    void addPolygon(
        const std::vector<int>& polygon, const std::vector<int>& cellPoints);
    void addPolyhedron(
        const std::vector<std::vector<int>>& faces,
        const std::vector<int>& cellPoints);
    void
    addSimplex(std::vector<int> corners, bool positive, Simplex::Kind kind);

    // Corners of a cell at these positions, in rows
    void corners(Index cell, const Vectors& x, Vectors& corners) const;

    // Signed size of a simplex, d! times its area or volume
    double size(const Vectors& corners, const Simplex& simplex) const;

    // Edges of a simplex, and of its target shape
    using Edge = std::array<double, 9>;
    Edge edgesOf(const Vectors& corners, const Simplex& simplex) const;
    Edge orthogonal(const Vectors& corners, const Simplex& simplex) const;

    // Calls visit(cell, first, blocks) with the simplices of all cells, in
    // which those of this cell start at the given place
    template <class Visit>
    void forAllCells(
        const Vectors& x, const SimplexSettings& settings,
        const Visit& visit) const;
    void gather(Index cell, const Vectors& x, Scratch& scratch) const;

    // Derivative by the points of a cell, of which the block has those by the
    // edges
    void derivative(
        Index cell, Index first, const Scratch& scratch, int power,
        Vectors& byCorners, Vectors& parts) const;

    int dimension_;
    Index nOwned_;
    Vectors reference_;
    SimplexTarget target_;

    // Of each point, its place in the order of positions
    std::vector<int> place_;

    Index nSimplices_ = 0;
    std::vector<Cell> cells_;
    std::vector<int> points_;
    std::vector<Index> faceStart_;
    std::vector<int> facePoints_;
    std::vector<Simplex> simplices_;

    // Of each point of this rank the entries of points_ that are it, cells in
    // the order of positions
    std::vector<Index> slotStart_;
    std::vector<Index> slots_;
    std::vector<int> slotCell_;
};

} // namespace morph

#endif
