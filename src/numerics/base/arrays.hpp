// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The array types of the numerical core.

#ifndef morph_arrays_hpp
#define morph_arrays_hpp

#include <Eigen/Core>

#include <cstddef>

namespace morph
{

using Index = std::ptrdiff_t;

using Vector3 = Eigen::Vector3d;

using Matrix = Eigen::MatrixXd;

// n vectors as rows, contiguous in memory: the layout of OpenFOAM's pointField,
// which can be mapped without a copy
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// n vectors as three contiguous columns: the layout of vectorised loops
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor>;

} // namespace morph

#endif
