// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A matrix to which rows and columns are appended.

#ifndef morph_growingMatrix_hpp
#define morph_growingMatrix_hpp

#include "arrays.hpp"

#include <vector>

namespace morph
{

// Stored in panels of rows. Neither rows nor columns that are added make a copy
// of the whole: rows go into new panels, and columns are at a panel's end.
class GrowingMatrix
{
public:
    Index rows() const { return rows_; }

    Index cols() const { return cols_; }

    // x: m x cols
    void appendRows(const Matrix& x);

    // x: rows x m
    void appendColumns(const Matrix& x);

    // from -= A^T b
    void subtractTransposedTimes(const Matrix& b, Matrix& from) const;

    // A b
    Matrix times(const Matrix& b) const;

private:
    Index rows_ = 0;
    Index cols_ = 0;
    std::vector<Matrix> panels_;
};

} // namespace morph

#endif
