// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "simplexEnergy.hpp"

#include "multiVersion.hpp"
#include "vectorMath.hpp"

#include <cmath>

namespace morph
{

namespace
{

const int L = simplexLanes;

// x^(-2/3)
inline double powerMinusTwoThirds(double x)
{
    const double t = 2.0 / 3.0 * vectorMath::logarithm(x);
    const double size = t > 0 ? t : -t;
    const double e = vectorMath::exponential(-size);
    return t > 0 ? e : 1 / e;
}


MORPH_MULTIVERSION
void evaluate3(double lambda, double epsilonSquared, SimplexBlock& block)
{
    const double* __restrict w = block.target;
    const double* __restrict e = block.edges;
    double* __restrict g = block.derivative;
    double* __restrict mu = block.mu;
    double* __restrict det = block.determinant;
    const double scale = 1 / (1 + lambda);

    for (int k = 0; k < L; ++k)
    {
        const double w00 = w[k], w10 = w[L + k], w20 = w[2 * L + k];
        const double w01 = w[3 * L + k], w11 = w[4 * L + k], w21 = w[5 * L + k];
        const double w02 = w[6 * L + k], w12 = w[7 * L + k], w22 = w[8 * L + k];
        const double e00 = e[k], e10 = e[L + k], e20 = e[2 * L + k];
        const double e01 = e[3 * L + k], e11 = e[4 * L + k], e21 = e[5 * L + k];
        const double e02 = e[6 * L + k], e12 = e[7 * L + k], e22 = e[8 * L + k];

        // V = W^-1, by cofactors
        const double a00 = w11 * w22 - w12 * w21;
        const double a10 = w12 * w20 - w10 * w22;
        const double a20 = w10 * w21 - w11 * w20;
        const double one = 1 / (w00 * a00 + w01 * a10 + w02 * a20);
        const double v00 = a00 * one;
        const double v10 = a10 * one;
        const double v20 = a20 * one;
        const double v01 = (w02 * w21 - w01 * w22) * one;
        const double v11 = (w00 * w22 - w02 * w20) * one;
        const double v21 = (w01 * w20 - w00 * w21) * one;
        const double v02 = (w01 * w12 - w02 * w11) * one;
        const double v12 = (w02 * w10 - w00 * w12) * one;
        const double v22 = (w00 * w11 - w01 * w10) * one;

        const double j00 = e00 * v00 + e01 * v10 + e02 * v20;
        const double j01 = e00 * v01 + e01 * v11 + e02 * v21;
        const double j02 = e00 * v02 + e01 * v12 + e02 * v22;
        const double j10 = e10 * v00 + e11 * v10 + e12 * v20;
        const double j11 = e10 * v01 + e11 * v11 + e12 * v21;
        const double j12 = e10 * v02 + e11 * v12 + e12 * v22;
        const double j20 = e20 * v00 + e21 * v10 + e22 * v20;
        const double j21 = e20 * v01 + e21 * v11 + e22 * v21;
        const double j22 = e20 * v02 + e21 * v12 + e22 * v22;

        // dD/dJ
        const double c00 = j11 * j22 - j12 * j21;
        const double c01 = j12 * j20 - j10 * j22;
        const double c02 = j10 * j21 - j11 * j20;
        const double c10 = j02 * j21 - j01 * j22;
        const double c11 = j00 * j22 - j02 * j20;
        const double c12 = j01 * j20 - j00 * j21;
        const double c20 = j01 * j12 - j02 * j11;
        const double c21 = j02 * j10 - j00 * j12;
        const double c22 = j00 * j11 - j01 * j10;
        const double D = j00 * c00 + j01 * c01 + j02 * c02;

        const double T = j00 * j00 + j01 * j01 + j02 * j02 + j10 * j10
            + j11 * j11 + j12 * j12 + j20 * j20 + j21 * j21 + j22 * j22;

        // chi without cancellation where D < 0
        const double root = std::sqrt(epsilonSquared + D * D);
        const double sum = root + (D > 0 ? D : -D);
        const double chi = D > 0 ? 0.5 * sum : 0.5 * epsilonSquared / sum;
        const double inverse = 1 / chi;
        const double slope = chi / root;
        const double power = powerMinusTwoThirds(chi);
        const double shape = T * power / 3;
        const double size = 0.5 * lambda * (D * D + 1) * inverse;

        mu[k] = (shape + size) * scale;
        det[k] = D;

        const double byJ = 2 * power / 3 * scale;
        const double byD =
            (lambda * D - (2.0 / 3.0 * shape + size) * slope) * inverse * scale;
        const double d00 = byJ * j00 + byD * c00;
        const double d01 = byJ * j01 + byD * c01;
        const double d02 = byJ * j02 + byD * c02;
        const double d10 = byJ * j10 + byD * c10;
        const double d11 = byJ * j11 + byD * c11;
        const double d12 = byJ * j12 + byD * c12;
        const double d20 = byJ * j20 + byD * c20;
        const double d21 = byJ * j21 + byD * c21;
        const double d22 = byJ * j22 + byD * c22;

        // dmu/dE = dmu/dJ W^-T
        g[k] = d00 * v00 + d01 * v01 + d02 * v02;
        g[L + k] = d10 * v00 + d11 * v01 + d12 * v02;
        g[2 * L + k] = d20 * v00 + d21 * v01 + d22 * v02;
        g[3 * L + k] = d00 * v10 + d01 * v11 + d02 * v12;
        g[4 * L + k] = d10 * v10 + d11 * v11 + d12 * v12;
        g[5 * L + k] = d20 * v10 + d21 * v11 + d22 * v12;
        g[6 * L + k] = d00 * v20 + d01 * v21 + d02 * v22;
        g[7 * L + k] = d10 * v20 + d11 * v21 + d12 * v22;
        g[8 * L + k] = d20 * v20 + d21 * v21 + d22 * v22;
    }
}


MORPH_MULTIVERSION
void evaluate2(double lambda, double epsilonSquared, SimplexBlock& block)
{
    const double* __restrict w = block.target;
    const double* __restrict e = block.edges;
    double* __restrict g = block.derivative;
    double* __restrict mu = block.mu;
    double* __restrict det = block.determinant;
    const double scale = 1 / (1 + lambda);

    for (int k = 0; k < L; ++k)
    {
        const double w00 = w[k], w10 = w[L + k];
        const double w01 = w[2 * L + k], w11 = w[3 * L + k];
        const double e00 = e[k], e10 = e[L + k];
        const double e01 = e[2 * L + k], e11 = e[3 * L + k];

        const double one = 1 / (w00 * w11 - w01 * w10);
        const double v00 = w11 * one;
        const double v01 = -w01 * one;
        const double v10 = -w10 * one;
        const double v11 = w00 * one;

        const double j00 = e00 * v00 + e01 * v10;
        const double j01 = e00 * v01 + e01 * v11;
        const double j10 = e10 * v00 + e11 * v10;
        const double j11 = e10 * v01 + e11 * v11;
        const double D = j00 * j11 - j01 * j10;
        const double T = j00 * j00 + j01 * j01 + j10 * j10 + j11 * j11;

        const double root = std::sqrt(epsilonSquared + D * D);
        const double sum = root + (D > 0 ? D : -D);
        const double chi = D > 0 ? 0.5 * sum : 0.5 * epsilonSquared / sum;
        const double inverse = 1 / chi;
        const double slope = chi / root;
        const double shape = 0.5 * T * inverse;
        const double size = 0.5 * lambda * (D * D + 1) * inverse;

        mu[k] = (shape + size) * scale;
        det[k] = D;

        const double byJ = inverse * scale;
        const double byD =
            (lambda * D - (shape + size) * slope) * inverse * scale;
        const double d00 = byJ * j00 + byD * j11;
        const double d01 = byJ * j01 - byD * j10;
        const double d10 = byJ * j10 - byD * j01;
        const double d11 = byJ * j11 + byD * j00;

        g[k] = d00 * v00 + d01 * v01;
        g[L + k] = d10 * v00 + d11 * v01;
        g[2 * L + k] = d00 * v10 + d01 * v11;
        g[3 * L + k] = d10 * v10 + d11 * v11;
    }
}

} // namespace


void evaluateSimplices(
    int dimension, const SimplexSettings& settings, SimplexBlock& block)
{
    if (dimension == 2)
    {
        evaluate2(settings.sizeWeight, settings.epsilonSquared, block);
    }
    else
    {
        evaluate3(settings.sizeWeight, settings.epsilonSquared, block);
    }
}

} // namespace morph
