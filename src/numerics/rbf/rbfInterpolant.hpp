// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// A displacement field given by control points and their weights.

#ifndef morph_rbfInterpolant_hpp
#define morph_rbfInterpolant_hpp

#include "arrays.hpp"
#include "kernel.hpp"
#include "pointCloud.hpp"

#include <vector>

namespace morph
{

// s(x) = sum_j phi(|x - x_j|/r0) gamma_j + offset + (x - origin) gradient
// (Mastrippolito et al. 2019, eq. 1, with a linear polynomial), in metres.
// The polynomial is zero unless it has been set.
class RbfInterpolant
{
public:
    explicit RbfInterpolant(const Kernel& kernel);

    const Kernel& kernel() const { return kernel_; }

    // n x 3 [m]
    const Columns& centres() const { return centres_; }

    // gamma: n x 3 [m]
    const Columns& weights() const { return weights_; }

    void set(const Columns& centres, const Columns& weights);

    void setPolynomial(
        const Vector3& origin, const Vector3& offset,
        const Eigen::Matrix3d& gradient);

    // s at all points of the cloud, in the order in which they were given to
    // it: n x 3 [m]. Centres out of a leaf's reach are skipped, which changes
    // no bit of the result.
    Vectors operator()(const PointCloud& points) const;

    // s at a few points: n x 3 [m]
    Vectors operator()(const Vectors& points) const;

    // Several interpolants with the same centres at all points of the cloud:
    // the kernel is evaluated once. As by operator(), but for round-off
    static std::vector<Vectors> together(
        const std::vector<RbfInterpolant>& fields, const PointCloud& points);

private:
    // The polynomial at the points of a leaf
    void addPolynomial(
        const PointCloud& points, const PointCloud::Leaf& leaf,
        Columns& sums) const;

    Kernel kernel_;
    Columns centres_;
    Columns weights_;
    bool polynomial_;
    Vector3 origin_;
    Vector3 offset_;
    Eigen::Matrix3d gradient_;
};

} // namespace morph

#endif
