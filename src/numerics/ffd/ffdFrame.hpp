// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The boxes of free-form deformation: coordinates of a point in the box, and
// the displacement in space that a displacement of the lattice causes.

#ifndef morph_ffdFrame_hpp
#define morph_ffdFrame_hpp

#include "arrays.hpp"

#include <Eigen/Dense>

#include <array>
#include <memory>

namespace morph
{

// A box maps xi in [0,1]^3 to space. The lattice displaces points by a vector
// d(xi) in coordinates of the frame: metres along the axes of space for
// straight-sided boxes; radius, angle and height for cylindrical ones.
class FfdFrame
{
public:
    virtual ~FfdFrame() = default;

    // Box coordinates xi of a point, also outside the box; not a number if
    // there are none
    virtual Vector3 coordinates(const Vector3& x) const = 0;

    // Position of box coordinates in space [m]
    virtual Vector3 position(const Vector3& xi) const = 0;

    // Displacement of x if the lattice displaces it by d
    virtual Vector3 displacement(const Vector3& x, const Vector3& d) const;

    // The derivative of displacement by d
    virtual Eigen::Matrix3d
    displacementByLattice(const Vector3& x, const Vector3& d) const;

    // The derivative of displacement by x, at constant d
    virtual Eigen::Matrix3d
    displacementByPosition(const Vector3& x, const Vector3& d) const;

    // d xi / d x
    virtual Eigen::Matrix3d gradient(const Vector3& x) const = 0;

    // Where xi is in coordinates of the frame: trilinear, unless the map has
    // control points
    virtual Vector3 frameCoordinates(const Vector3& xi) const = 0;

    // Its derivative by xi
    virtual Eigen::Matrix3d frameJacobian(const Vector3& xi) const;

    // Of a map that is a sum over the functions of the lattice; none otherwise
    virtual const Vectors* controlPoints() const { return nullptr; }

    // The displacement, in coordinates of the frame, of a lattice point whose
    // rest is at xi, by a vector in fractions of the box
    virtual Vector3
    fromFractions(const Vector3& xi, const Vector3& fractions) const;

    // The same for a vector along the axes of the box in the units of its span
    virtual Vector3 fromUnits(const Vector3& vector) const = 0;

    // Is the second coordinate periodic, so that the box is a ring?
    virtual bool ring() const { return false; }

    // Is the first coordinate a radius?
    virtual bool radial() const { return false; }
};


// A rectangular box in any direction
class AffineFrame : public FfdFrame
{
public:
    // origin [m], lengths of the sides [m], their directions as columns.
    // Throws std::invalid_argument unless the lengths are positive
    AffineFrame(
        const Vector3& origin, const Vector3& span,
        const Eigen::Matrix3d& axes);

    Vector3 coordinates(const Vector3& x) const override;
    Vector3 position(const Vector3& xi) const override;
    Eigen::Matrix3d gradient(const Vector3& x) const override;
    Vector3 frameCoordinates(const Vector3& xi) const override;
    Vector3
    fromFractions(const Vector3& xi, const Vector3& fractions) const override;
    Vector3 fromUnits(const Vector3& vector) const override;

private:
    Vector3 origin_;
    Vector3 span_;
    Eigen::Matrix3d axes_;
};


// Part of a ring about an axis: radius, angle, height
class CylindricalFrame : public FfdFrame
{
public:
    // start, span: radius [m], angle [rad], height [m] of xi = 0 and from there
    // to xi = 1. axes: columns are the directions of angle 0, of angle pi/2 and
    // of the height. Throws std::invalid_argument unless the span is positive,
    // the angle at most 2 pi and the radius not negative
    CylindricalFrame(
        const Vector3& origin, const Eigen::Matrix3d& axes,
        const Vector3& start, const Vector3& span);

    Vector3 coordinates(const Vector3& x) const override;
    Vector3 position(const Vector3& xi) const override;
    Vector3 displacement(const Vector3& x, const Vector3& d) const override;
    Eigen::Matrix3d
    displacementByLattice(const Vector3& x, const Vector3& d) const override;
    Eigen::Matrix3d
    displacementByPosition(const Vector3& x, const Vector3& d) const override;
    Eigen::Matrix3d gradient(const Vector3& x) const override;
    Vector3 frameCoordinates(const Vector3& xi) const override;
    Vector3 fromUnits(const Vector3& vector) const override;

    bool ring() const override { return ring_; }
    bool radial() const override { return true; }

private:
    // Radius and the direction of it
    struct Polar
    {
        Vector3 local;
        double radius;
        double cosine;
        double sine;
    };

    Polar polar(const Vector3& x) const;

    Vector3 origin_;
    Eigen::Matrix3d axes_;
    Vector3 start_;
    Vector3 span_;
    bool ring_;
};


// A hexahedron with eight corners anywhere, filled trilinearly
class HexahedralFrame : public FfdFrame
{
public:
    // The corners in the order of xi = 000 100 010 110 001 101 011 111. Throws
    // std::invalid_argument unless the map is one to one
    explicit HexahedralFrame(const std::array<Vector3, 8>& corners);

    // By Newton's method; not a number if it does not converge
    Vector3 coordinates(const Vector3& x) const override;
    Vector3 position(const Vector3& xi) const override;
    Eigen::Matrix3d gradient(const Vector3& x) const override;
    Vector3 frameCoordinates(const Vector3& xi) const override;
    Vector3 fromUnits(const Vector3& vector) const override;

private:
    std::array<Vector3, 8> corners_;

    Vector3 low_;
    Vector3 high_;
};

} // namespace morph

#endif
