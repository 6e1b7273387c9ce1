// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "rbfInterpolant.hpp"

#include "kernelSum.hpp"

#include <algorithm>

namespace morph
{

namespace
{

// Which of the centres are without a root (kernelSum.hpp): by their place among
// all, so that those left out as out of reach change nothing
bool rootless(Index j)
{
    return j % groupSize >= rootsOfGroup;
}

} // namespace


RbfInterpolant::RbfInterpolant(const Kernel& kernel)
: kernel_(kernel),
  centres_(0, 3),
  weights_(0, 3),
  polynomial_(false),
  origin_(Vector3::Zero()),
  offset_(Vector3::Zero()),
  gradient_(Eigen::Matrix3d::Zero())
{
}


void RbfInterpolant::set(const Columns& centres, const Columns& weights)
{
    centres_ = centres;
    weights_ = weights;
}


void RbfInterpolant::setPolynomial(
    const Vector3& origin, const Vector3& offset,
    const Eigen::Matrix3d& gradient)
{
    polynomial_ = true;
    origin_ = origin;
    offset_ = offset;
    gradient_ = gradient;
}


void RbfInterpolant::addPolynomial(
    const PointCloud& points, const PointCloud::Leaf& leaf, Columns& sums) const
{
    if (!polynomial_)
    {
        return;
    }
    for (Index i = 0; i < leaf.count; ++i)
    {
        const Vector3 d =
            points.sorted().row(leaf.begin + i).transpose() - origin_;
        sums.row(i) += (offset_ + gradient_.transpose() * d).transpose();
    }
}


Vectors RbfInterpolant::operator()(const PointCloud& points) const
{
    Vectors s(points.size(), 3);

    // Lengths in units of the support radius, from the first centre: scaled
    // alone, positions far from the origin would lose digits.
    const double scale = 1 / kernel_.supportRadius();
    const Index n = centres_.rows();
    const Eigen::RowVector3d from = n > 0
        ? Eigen::RowVector3d(centres_.row(0))
        : Eigen::RowVector3d(Eigen::RowVector3d::Zero());
    const Columns scaled = scale * (centres_.rowwise() - from);

    // With the numbers of the sum itself, and a margin for the order of its
    // operations: what is skipped would have added zero.
    const double reach2 = 1 + 1e-12;

    Columns c(n, 3), w(n, 3), x, sums;
    std::vector<CentreGroup> groups; // in c and w

    // Those without a root stand behind all others
    const Index nRooted =
        n / groupSize * rootsOfGroup + std::min(n % groupSize, rootsOfGroup);
    for (const PointCloud::Leaf& leaf : points.leaves())
    {
        PointCloud::Leaf box = leaf;
        box.low = scale * (leaf.low - from.transpose());
        box.high = scale * (leaf.high - from.transpose());

        groups.clear();
        CentreGroup group = {0, 0, nRooted, nRooted};
        for (Index j = 0; j < n; ++j)
        {
            const Vector3 centre = scaled.row(j).transpose();
            if (!kernel_.compact() || box.distance2(centre) < reach2)
            {
                Index& m = rootless(j) ? group.rootlessEnd : group.end;
                c.row(m) = scaled.row(j);
                w.row(m) = weights_.row(j);
                ++m;
            }
            if ((j + 1) % groupSize == 0 || j + 1 == n)
            {
                if (!group.empty())
                {
                    groups.push_back(group);
                }
                group = {
                    group.end, group.end, group.rootlessEnd, group.rootlessEnd};
            }
        }

        const Index size = leaf.end - leaf.begin;
        x = points.sorted().middleRows(leaf.begin, size).rowwise() - from;
        x *= scale;
        sums = Columns::Zero(size, 3);

        const double* const xs[3] = {
            x.col(0).data(), x.col(1).data(), x.col(2).data()};
        double* const ss[3] = {
            sums.col(0).data(), sums.col(1).data(), sums.col(2).data()};
        const double* const cs[3] = {
            c.col(0).data(), c.col(1).data(), c.col(2).data()};
        const double* const ws[3] = {
            w.col(0).data(), w.col(1).data(), w.col(2).data()};
        addKernelSum(kernel_.type(), xs, size, cs, ws, groups, ss);

        addPolynomial(points, leaf, sums);

        for (Index i = 0; i < leaf.count; ++i)
        {
            s.row(points.index()[leaf.begin + i]) = sums.row(i);
        }
    }

    return s;
}


std::vector<Vectors> RbfInterpolant::together(
    const std::vector<RbfInterpolant>& fields, const PointCloud& points)
{
    std::vector<Vectors> s(fields.size(), Vectors(points.size(), 3));
    if (fields.empty())
    {
        return s;
    }
    const RbfInterpolant& first = fields.front();
    const Kernel& kernel = first.kernel_;
    const double scale = 1 / kernel.supportRadius();
    const Index n = first.centres_.rows();
    const Eigen::RowVector3d from = n > 0
        ? Eigen::RowVector3d(first.centres_.row(0))
        : Eigen::RowVector3d(Eigen::RowVector3d::Zero());
    const Columns scaled = scale * (first.centres_.rowwise() - from);
    const double reach2 = 1 + 1e-12;

    Columns c(n, 3), x;
    std::vector<Columns> w(fields.size(), Columns(n, 3));
    std::vector<Columns> sums(fields.size());
    for (const PointCloud::Leaf& leaf : points.leaves())
    {
        PointCloud::Leaf box = leaf;
        box.low = scale * (leaf.low - from.transpose());
        box.high = scale * (leaf.high - from.transpose());

        std::vector<CentreGroup> groups;
        CentreGroup group = {0, 0, 0, 0};
        for (Index j = 0; j < n; ++j)
        {
            const Vector3 centre = scaled.row(j).transpose();
            if (!kernel.compact() || box.distance2(centre) < reach2)
            {
                c.row(group.end) = scaled.row(j);
                for (std::size_t k = 0; k < fields.size(); ++k)
                {
                    w[k].row(group.end) = fields[k].weights_.row(j);
                }
                ++group.end;
            }
            if ((j + 1) % groupSize == 0 || j + 1 == n)
            {
                if (!group.empty())
                {
                    groups.push_back(group);
                }
                group.begin = group.end;
            }
        }

        const Index size = leaf.end - leaf.begin;
        x = points.sorted().middleRows(leaf.begin, size).rowwise() - from;
        x *= scale;
        std::vector<FieldSum> terms;
        for (std::size_t k = 0; k < fields.size(); ++k)
        {
            sums[k] = Columns::Zero(size, 3);
            terms.push_back(
                {{w[k].col(0).data(), w[k].col(1).data(), w[k].col(2).data()},
                 {sums[k].col(0).data(), sums[k].col(1).data(),
                  sums[k].col(2).data()}});
        }
        const double* const xs[3] = {
            x.col(0).data(), x.col(1).data(), x.col(2).data()};
        const double* const cs[3] = {
            c.col(0).data(), c.col(1).data(), c.col(2).data()};
        addKernelSums(kernel.type(), xs, size, cs, terms, groups);

        for (std::size_t k = 0; k < fields.size(); ++k)
        {
            fields[k].addPolynomial(points, leaf, sums[k]);
            for (Index i = 0; i < leaf.count; ++i)
            {
                s[k].row(points.index()[leaf.begin + i]) = sums[k].row(i);
            }
        }
    }
    return s;
}


Vectors RbfInterpolant::operator()(const Vectors& points) const
{
    return (*this)(PointCloud(points));
}

} // namespace morph
