// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A lower triangular matrix to which rows are appended.

#ifndef morph_blockTriangularFactor_hpp
#define morph_blockTriangularFactor_hpp

#include "arrays.hpp"

#include <vector>

namespace morph
{

// Stored in panels of rows, each as wide as its last row: half the memory of a
// square matrix, and only the last panel is copied when it grows.
class BlockTriangularFactor
{
public:
    Index size() const { return size_; }

    // [L 0; above^T corner], above: size x m, corner: m x m, of which only the
    // lower triangle is looked at
    void append(const Matrix& above, const Matrix& corner);

    // Replaces everything; again the lower triangle counts
    void set(const Matrix& lower);

    // L^-1 b
    Matrix solved(Matrix b) const;

    // L^-T b
    Matrix solvedTransposed(Matrix b) const;

private:
    Index size_ = 0;
    std::vector<Matrix> panels_;
};

} // namespace morph

#endif
