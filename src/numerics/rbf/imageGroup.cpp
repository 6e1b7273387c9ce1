// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imageGroup.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace morph
{

namespace
{

// Of the box's diameter: points closer than this are one
constexpr double samePlaceFraction = 1e-6;

// Maps whose rotations differ by less are the same
constexpr double sameRotation = 1e-8;

// Singular values below this are those of directions without a condition
constexpr double noDirection = 1e-6;


// The box around the image of a box
Box boxOf(const RigidMap& map, const Box& box)
{
    const Vector3 middle = 0.5 * (box.low + box.high);
    const Vector3 centre = map(middle);
    const Vector3 half = map.R.cwiseAbs() * (0.5 * (box.high - box.low));
    return {centre - half, centre + half};
}


double distance(const Box& a, const Box& b)
{
    return (a.low - b.high)
        .cwiseMax(b.low - a.high)
        .cwiseMax(Vector3::Zero())
        .norm();
}

} // namespace


Columns RigidMap::operator()(const Columns& x) const
{
    return (x * R.transpose()).rowwise() + t.transpose();
}


RigidMap RigidMap::inverse() const
{
    RigidMap map;
    map.R = R.transpose();
    map.t = -(R.transpose() * t);
    return map;
}


RigidMap RigidMap::after(const RigidMap& other) const
{
    RigidMap map;
    map.R = R * other.R;
    map.t = R * other.t + t;
    return map;
}


RigidMap RigidMap::reflection(const Vector3& point, const Vector3& normal)
{
    RigidMap map;
    map.R -= 2 * normal * normal.transpose();
    map.t = 2 * normal.dot(point) * normal;
    return map;
}


RigidMap RigidMap::translation(const Vector3& t)
{
    RigidMap map;
    map.t = t;
    return map;
}


RigidMap
RigidMap::rotation(const Vector3& point, const Vector3& axis, double angle)
{
    RigidMap map;
    map.R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    map.t = point - map.R * point;
    return map;
}


TooManyImages::TooManyImages(Index most)
: std::length_error(
    "more than " + std::to_string(most) + " images are within reach"),
  most(most)
{
}


ImageGroup::ImageGroup()
: maps_(1)
{
}


ImageGroup::ImageGroup(
    const std::vector<RigidMap>& generators, const Box& box, double reach,
    Index most)
: maps_(1),
  box_(box),
  reach_(reach),
  samePlace_(samePlaceFraction * box.diameter())
{
    std::vector<RigidMap> steps(generators);
    for (const RigidMap& generator : generators)
    {
        steps.push_back(generator.inverse());
    }

    // Breadth first, a little beyond the reach, since the way to an image in
    // reach may lead over one that is just out of it
    const double margin = box.diameter();
    std::vector<RigidMap> all(maps_);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        for (const RigidMap& step : steps)
        {
            const RigidMap map = step.after(all[i]);
            if (!inReach(map, margin) || known(map, all))
            {
                continue;
            }
            all.push_back(map);
            if (inReach(map, 0))
            {
                maps_.push_back(map);
            }
            if (Index(maps_.size()) > most || Index(all.size()) > 20 * most)
            {
                throw TooManyImages(most);
            }
        }
    }
}


bool ImageGroup::inReach(const RigidMap& map, double margin) const
{
    return !(distance(boxOf(map, box_), box_) > (1 + 1e-9) * (reach_ + margin));
}


bool ImageGroup::known(
    const RigidMap& map, const std::vector<RigidMap>& maps) const
{
    const Vector3 centre = 0.5 * (box_.low + box_.high);
    const Vector3 there = map(centre);
    return std::any_of(
        maps.begin(), maps.end(),
        [&](const RigidMap& other)
        {
            return (map.R - other.R).norm() < sameRotation
                && (there - other(centre)).norm() <= samePlace_;
        });
}


Eigen::Matrix3d ImageGroup::projection(const Vector3& x) const
{
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    int count = 0;
    for (const RigidMap& map : maps_)
    {
        if ((map(x) - x).norm() <= samePlace_)
        {
            sum += map.R;
            ++count;
        }
    }
    return sum / count;
}


ControlPoint
ImageGroup::restricted(const ControlPoint& point, double& contradiction) const
{
    contradiction = 0;
    const Eigen::Matrix3d P = projection(point.position);
    if (P.isIdentity(sameRotation))
    {
        return point;
    }

    // C^T s = C^T P s: with P C = U S V^T the condition U^T s = S^-1 V^T g
    const Eigen::JacobiSVD<Matrix> svd(
        P * point.C(), Eigen::ComputeThinU | Eigen::ComputeThinV);
    ControlPoint rest;
    rest.position = point.position;
    rest.directions.setZero();
    rest.k = 0;
    const Eigen::VectorXd rotated = svd.matrixV().transpose() * point.g();
    for (int a = 0; a < point.k; ++a)
    {
        const double scale = svd.singularValues()[a];
        if (scale > noDirection)
        {
            rest.directions.col(rest.k) = svd.matrixU().col(a);
            rest.value[rest.k] = rotated[a] / scale;
            ++rest.k;
        }
        else
        {
            contradiction = std::hypot(contradiction, rotated[a]);
        }
    }
    return rest;
}


std::vector<ImageGroup::Replica>
ImageGroup::replicas(const Columns& points, double reach) const
{
    std::vector<Replica> found;
    for (std::size_t m = 1; m < maps_.size(); ++m)
    {
        for (Index j = 0; j < points.rows(); ++j)
        {
            const Vector3 x = points.row(j).transpose();
            const Vector3 y = maps_[m](x);
            const bool elsewhere = (y - x).norm() > samePlace_;
            if (elsewhere && distance({y, y}, box_) <= (1 + 1e-9) * reach)
            {
                found.push_back({j, Index(m), y});
            }
        }
    }
    return found;
}


void ImageGroup::replicate(Columns& centres, Columns& weights) const
{
    const Index n = centres.rows();
    std::vector<Eigen::RowVector3d> x, w;
    for (std::size_t m = 1; m < maps_.size(); ++m)
    {
        const Columns images = maps_[m](Columns(centres.topRows(n)));
        const Columns rotated = weights.topRows(n) * maps_[m].R.transpose();
        for (Index j = 0; j < n; ++j)
        {
            const Vector3 image = images.row(j).transpose();
            if (!(distance({image, image}, box_) > (1 + 1e-9) * reach_))
            {
                x.push_back(images.row(j));
                w.push_back(rotated.row(j));
            }
        }
    }
    centres.conservativeResize(n + x.size(), 3);
    weights.conservativeResize(n + x.size(), 3);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        centres.row(n + i) = x[i];
        weights.row(n + i) = w[i];
    }
}

} // namespace morph
