// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The Laplacian of a mesh's edges, as a preconditioner: a fixed number of steps
// of Chebyshev's iteration (Golub, Varga 1961, doi:10.1007/BF01386013), which
// is a symmetric positive definite polynomial of the matrix and needs no sums
// over points.

#ifndef morph_edgeLaplacian_hpp
#define morph_edgeLaplacian_hpp

#include "simplexMesh.hpp"

#include <functional>

namespace morph
{

class EdgeLaplacian
{
public:
    // free: of every point, may it move?
    // exchange: gives points of other ranks the values they have there
    EdgeLaplacian(
        const SimplexMesh& mesh, const std::vector<bool>& free,
        const std::function<void(Vectors&)>& exchange);

    // From the stiffness of each cell
    void setStiffness(const std::vector<double>& stiffness);

    // Replace forces on the points of this rank by displacements of all points.
    // Collective
    void solve(Vectors& v) const;

    static constexpr int steps = 40;

private:
    // Matrix times displacements of all points, on those of this rank
    void multiply(const Vectors& v, Vectors& result) const;

    Index nPoints_;
    Index nOwned_;
    std::function<void(Vectors&)> exchange_;
    SimplexMesh::Edges edges_;
    std::vector<bool> free_;
    std::vector<double> weight_;

    // Inverse of the diagonal, zero where a point may not move
    std::vector<double> inverse_;
};

} // namespace morph

#endif
