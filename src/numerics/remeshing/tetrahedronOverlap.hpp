// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What two tetrahedra have in common: its volume and its first moment.
//
// One is cut by the planes of the other into tetrahedra, each by the signs of
// its corners alone, so that no position of faces, edges and corners is a
// special case. Corners are kept by their barycentric coordinates in the
// tetrahedron that is cut: the parts of a sliver add up to it as exactly as
// those of a regular one. The plane of a face is made from its corners in the
// order of their positions, so both tetrahedra that share the face have the
// same one to the last bit: what one cuts off is what the other keeps.

#ifndef morph_tetrahedronOverlap_hpp
#define morph_tetrahedronOverlap_hpp

#include "arrays.hpp"

#include <array>

namespace morph
{

class Tetrahedron
{
public:
    // Corners in any order
    explicit Tetrahedron(const std::array<Vector3, 4>& corners);

    const Vector3& corner(int i) const { return corner_[i]; }

    // Never negative
    double volume() const { return volume_; }

    // 1 where the triangle of the first three corners is seen in positive order
    // from the fourth, -1 where in negative, 0 where there is no volume beyond
    // round-off
    int sign() const { return sign_; }

    Vector3 centroid() const;

    // Distance from the plane of the face opposite to a corner, times twice the
    // area of the face: positive inside, 0 within round-off
    double inside(int face, const Vector3& x) const
    {
        const Plane& plane = plane_[face];
        const Vector3 r = x - plane.origin;
        const double d = plane.normal.dot(r);
        return d * d <= plane.roundOff2 * r.squaredNorm() ? 0 : d;
    }

private:
    struct Plane
    {
        Vector3 origin;
        Vector3 normal;

        // Square of the round-off of a product with the normal, by length
        double roundOff2;
    };

    std::array<Vector3, 4> corner_;
    std::array<Plane, 4> plane_;
    double volume_;
    int sign_;
};


struct Overlap
{
    double volume = 0;

    // Integral of the position
    Vector3 moment = Vector3::Zero();
};

// The part of cut that is in other. A tetrahedron without volume overlaps with
// nothing. Its error is round-off by the volume of cut
Overlap overlap(const Tetrahedron& cut, const Tetrahedron& other);

} // namespace morph

#endif
