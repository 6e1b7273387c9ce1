// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "affineBasis.hpp"

#include <Eigen/Dense>

#include <stdexcept>

namespace morph
{

AffineBasis::AffineBasis(const Columns& nodes)
: nodes_(nodes)
{
    const Index d = nodes.rows() - 1;
    if (d < 0 || d > 3)
    {
        throw std::invalid_argument("an affine basis needs one to four nodes");
    }

    // With edges e_u = x_u - x_0 (3 x d) = Q R, the coordinates of x are
    // R^-1 Q^T (x - x_0)
    gradients_ = Matrix::Zero(3, d + 1);
    span_ = Matrix::Zero(3, d);
    if (d > 0)
    {
        const Matrix edges =
            (nodes.bottomRows(d).rowwise() - nodes.row(0)).transpose();
        const Eigen::HouseholderQR<Matrix> qr(edges);
        span_ = qr.householderQ() * Matrix::Identity(3, d);
        const Matrix inverse =
            edges.completeOrthogonalDecomposition().pseudoInverse();
        gradients_.rightCols(d) = inverse.transpose();
        gradients_.col(0) = -gradients_.rightCols(d).rowwise().sum();
    }
}


Matrix AffineBasis::values(const Columns& x) const
{
    Matrix l(x.rows(), size());
    if (size() > 0)
    {
        l.noalias() = (x.rowwise() - nodes_.row(0)) * gradients_;
        l.col(0).array() += 1;
    }
    return l;
}


Eigen::Matrix3d AffineBasis::gradient(const Matrix& v) const
{
    return gradients_ * v;
}


double AffineBasis::distance(const Vector3& x) const
{
    Vector3 e = x - nodes_.row(0).transpose();
    e -= span_ * (span_.transpose() * e);
    return e.norm();
}

} // namespace morph
