// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "edgeLaplacian.hpp"

#include "multiVersion.hpp"

namespace morph
{

namespace
{

// Eigenvalues of the Laplacian, scaled by its diagonal, are between 0 and 2.
// Those below this are reduced by less than others
const double least = 2e-3;
const double most = 2;

} // namespace


EdgeLaplacian::EdgeLaplacian(
    const SimplexMesh& mesh, const std::vector<bool>& free,
    const std::function<void(Vectors&)>& exchange)
: nPoints_(mesh.nPoints()),
  nOwned_(mesh.nOwned()),
  exchange_(exchange),
  edges_(mesh.edges()),
  free_(free),
  weight_(edges_.neighbour.size()),
  inverse_(nOwned_)
{
}


void EdgeLaplacian::setStiffness(const std::vector<double>& stiffness)
{
    for (Index i = 0; i < nOwned_; ++i)
    {
        double diagonal = 0;
        for (Index e = edges_.row[i]; e < edges_.row[i + 1]; ++e)
        {
            double weight = 0;
            for (Index p = edges_.part[e]; p < edges_.part[e + 1]; ++p)
            {
                weight += edges_.coefficient[p] * stiffness[edges_.cell[p]];
            }
            weight_[e] = weight;
            diagonal += weight;
        }
        inverse_[i] = free_[i] && diagonal > 0 ? 1 / diagonal : 0;
    }
}


void EdgeLaplacian::multiply(const Vectors& v, Vectors& result) const
{
    const double* x = v.data();
    for (Index i = 0; i < nOwned_; ++i)
    {
        double sum[3] = {0, 0, 0};
        if (inverse_[i] > 0)
        {
            for (Index e = edges_.row[i]; e < edges_.row[i + 1]; ++e)
            {
                const double w = weight_[e];
                const double* y = x + 3 * edges_.neighbour[e];
                for (int k = 0; k < 3; ++k)
                {
                    sum[k] += w * (x[3 * i + k] - y[k]);
                }
            }
        }
        for (int k = 0; k < 3; ++k)
        {
            result(i, k) = sum[k];
        }
    }
}


void EdgeLaplacian::solve(Vectors& v) const
{
    const double theta = 0.5 * (most + least);
    const double delta = 0.5 * (most - least);
    const double sigma = theta / delta;
    double rho = 1 / sigma;

    Vectors residual = v.topRows(nOwned_);
    Vectors step = Vectors::Zero(nPoints_, 3);
    Vectors product(nOwned_, 3);
    v.setZero(nPoints_, 3);
    for (Index i = 0; i < nOwned_; ++i)
    {
        step.row(i) = residual.row(i) * (inverse_[i] / theta);
    }
    for (int n = 0; n < steps; ++n)
    {
        exchange_(step);
        v += step;
        if (n + 1 == steps)
        {
            break;
        }
        multiply(step, product);
        residual -= product;
        const double next = 1 / (2 * sigma - rho);
        for (Index i = 0; i < nOwned_; ++i)
        {
            step.row(i) = next * rho * step.row(i)
                + residual.row(i) * (inverse_[i] * 2 * next / delta);
        }
        rho = next;
    }
}

} // namespace morph
