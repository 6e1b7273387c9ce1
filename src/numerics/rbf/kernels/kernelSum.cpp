// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "kernelSum.hpp"

#include "multiVersion.hpp"
#include "radialFunctions.hpp"
#include "wendlandSum.hpp"

namespace morph
{

namespace
{

template <class Formula>
inline __attribute__((always_inline)) void addTerms(
    Formula, const double* __restrict__ x, const double* __restrict__ y,
    const double* __restrict__ z, const double* const centres[3],
    const double* const weights[3], Index begin, Index end,
    double (&partX)[blockSize], double (&partY)[blockSize],
    double (&partZ)[blockSize])
{
    for (Index j = begin; j < end; ++j)
    {
        const double cx = centres[0][j];
        const double cy = centres[1][j];
        const double cz = centres[2][j];
        const double wx = weights[0][j];
        const double wy = weights[1][j];
        const double wz = weights[2][j];

        for (Index i = 0; i < blockSize; ++i)
        {
            const double dx = x[i] - cx;
            const double dy = y[i] - cy;
            const double dz = z[i] - cz;
            const double phi = Formula::value(dx * dx + dy * dy + dz * dz);
            partX[i] += phi * wx;
            partY[i] += phi * wy;
            partZ[i] += phi * wz;
        }
    }
}


template <class Formula>
inline __attribute__((always_inline)) void addBlock(
    Formula formula, const double* x, const double* y, const double* z,
    const double* const centres[3], const double* const weights[3],
    const CentreGroup& group, double* __restrict__ sumX,
    double* __restrict__ sumY, double* __restrict__ sumZ)
{
    double partX[blockSize] = {};
    double partY[blockSize] = {};
    double partZ[blockSize] = {};
    addTerms(
        formula, x, y, z, centres, weights, group.begin, group.end, partX,
        partY, partZ);
    addTerms(
        formula, x, y, z, centres, weights, group.rootlessBegin,
        group.rootlessEnd, partX, partY, partZ);
    for (Index i = 0; i < blockSize; ++i)
    {
        sumX[i] += partX[i];
        sumY[i] += partY[i];
        sumZ[i] += partZ[i];
    }
}


template <class Formula>
inline __attribute__((always_inline)) void fillColumn(
    Formula, const double* __restrict__ x, const double* __restrict__ y,
    const double* __restrict__ z, Index n, const double centre[3],
    double inverseRadius2, double* __restrict__ column)
{
    for (Index i = 0; i < n; ++i)
    {
        const double dx = x[i] - centre[0];
        const double dy = y[i] - centre[1];
        const double dz = z[i] - centre[2];
        column[i] =
            Formula::value((dx * dx + dy * dy + dz * dz) * inverseRadius2);
    }
}

} // namespace


MORPH_MULTIVERSION
static void addGroup(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const double* const weights[3],
    const CentreGroup& group, double* const sums[3])
{
    radial::dispatch(
        type, [&](auto formula) __attribute__((always_inline)) {
            for (Index i = 0; i < nPoints; i += blockSize)
            {
                addBlock(
                    formula, points[0] + i, points[1] + i, points[2] + i,
                    centres, weights, group, sums[0] + i, sums[1] + i,
                    sums[2] + i);
            }
        });
}


void addKernelSum(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const double* const weights[3],
    const std::vector<CentreGroup>& groups, double* const sums[3])
{
    if (hasWendlandSum(type))
    {
        addWendlandSum(type, points, nPoints, centres, weights, groups, sums);
        return;
    }
    for (const CentreGroup& group : groups)
    {
        addGroup(type, points, nPoints, centres, weights, group, sums);
    }
}


// Of a block of points, for one field: phi in columns of centres
static inline __attribute__((always_inline)) void addField(
    const double* __restrict__ phi, Index n, const double* wx, const double* wy,
    const double* wz, double* __restrict__ sumX, double* __restrict__ sumY,
    double* __restrict__ sumZ)
{
    double partX[blockSize] = {};
    double partY[blockSize] = {};
    double partZ[blockSize] = {};
    for (Index j = 0; j < n; ++j)
    {
        const double* __restrict__ column = phi + j * blockSize;
        for (Index i = 0; i < blockSize; ++i)
        {
            partX[i] += column[i] * wx[j];
            partY[i] += column[i] * wy[j];
            partZ[i] += column[i] * wz[j];
        }
    }
    for (Index i = 0; i < blockSize; ++i)
    {
        sumX[i] += partX[i];
        sumY[i] += partY[i];
        sumZ[i] += partZ[i];
    }
}


MORPH_MULTIVERSION
static void addGroupOfFields(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const FieldSum* fields, std::size_t nFields,
    Index begin, Index end)
{
    double phi[groupSize * blockSize];
    radial::dispatch(
        type, [&](auto formula) __attribute__((always_inline)) {
            for (Index i = 0; i < nPoints; i += blockSize)
            {
                for (Index j = begin; j < end; ++j)
                {
                    const double centre[3] = {
                        centres[0][j], centres[1][j], centres[2][j]};
                    fillColumn(
                        formula, points[0] + i, points[1] + i, points[2] + i,
                        blockSize, centre, 1, phi + (j - begin) * blockSize);
                }
                for (std::size_t k = 0; k < nFields; ++k)
                {
                    const FieldSum& f = fields[k];
                    addField(
                        phi, end - begin, f.weights[0] + begin,
                        f.weights[1] + begin, f.weights[2] + begin,
                        f.sums[0] + i, f.sums[1] + i, f.sums[2] + i);
                }
            }
        });
}


void addKernelSums(
    KernelType type, const double* const points[3], Index nPoints,
    const double* const centres[3], const std::vector<FieldSum>& fields,
    const std::vector<CentreGroup>& groups)
{
    for (const CentreGroup& group : groups)
    {
        addGroupOfFields(
            type, points, nPoints, centres, fields.data(), fields.size(),
            group.begin, group.end);
    }
}


MORPH_MULTIVERSION
static void fillMatrix(
    KernelType type, const double* const a[3], Index nA,
    const double* const b[3], Index nB, double inverseRadius2, double* values)
{
    radial::dispatch(
        type, [&](auto formula) __attribute__((always_inline)) {
            for (Index j = 0; j < nB; ++j)
            {
                const double centre[3] = {b[0][j], b[1][j], b[2][j]};
                fillColumn(
                    formula, a[0], a[1], a[2], nA, centre, inverseRadius2,
                    values + j * nA);
            }
        });
}


Matrix kernelMatrix(const Kernel& kernel, const Columns& a, const Columns& b)
{
    Matrix phi(a.rows(), b.rows());
    const double* const columnsA[3] = {
        a.col(0).data(), a.col(1).data(), a.col(2).data()};
    const double* const columnsB[3] = {
        b.col(0).data(), b.col(1).data(), b.col(2).data()};
    const double r0 = kernel.supportRadius();

    fillMatrix(
        kernel.type(), columnsA, a.rows(), columnsB, b.rows(), 1 / (r0 * r0),
        phi.data());
    return phi;
}

} // namespace morph
