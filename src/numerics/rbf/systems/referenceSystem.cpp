// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "referenceSystem.hpp"

#include "kernelSum.hpp"

#include <Eigen/Dense>

namespace morph
{

namespace
{

// C as the first k columns of an orthogonal matrix
Eigen::Matrix3d completed(const ControlPoint& p)
{
    if (!p.slides())
    {
        return p.directions;
    }
    Eigen::Matrix3d q = Eigen::HouseholderQR<Matrix>(p.C()).householderQ();
    q.leftCols(p.k) = p.C();
    return q;
}

} // namespace


Matrix referenceSystem(
    const Kernel& kernel, const ControlPoints& conditions,
    const ControlPoints& weights, bool same)
{
    const Matrix phi =
        kernelMatrix(kernel, positions(conditions), positions(weights));
    Matrix a = Matrix::Zero(3 * phi.rows(), 3 * phi.cols());
    for (Index j = 0; j < phi.cols(); ++j)
    {
        for (Index i = 0; i < phi.rows(); ++i)
        {
            const ControlPoint& p = conditions[i];
            a.block(3 * i, 3 * j, p.k, 3) = phi(i, j) * p.C().transpose();
        }
    }
    if (same)
    {
        for (Index i = 0; i < phi.rows(); ++i)
        {
            const int free = 3 - conditions[i].k;
            a.block(3 * i + conditions[i].k, 3 * i, free, 3) =
                completed(conditions[i]).rightCols(free).transpose();
        }
    }
    return a;
}


Matrix paperValues(const ControlPoints& conditions)
{
    Matrix s = Matrix::Zero(3 * conditions.size(), 1);
    for (std::size_t i = 0; i < conditions.size(); ++i)
    {
        s.block(3 * i, 0, conditions[i].k, 1) = conditions[i].g();
    }
    return s;
}


Columns paperWeights(const Matrix& gamma)
{
    return Eigen::Map<const Vectors>(gamma.data(), gamma.rows() / 3, 3);
}

} // namespace morph
