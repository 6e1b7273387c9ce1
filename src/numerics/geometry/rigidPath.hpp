// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The way of points that move as a rigid body, in parts.

#ifndef morph_rigidPath_hpp
#define morph_rigidPath_hpp

#include "communicator.hpp"

#include "arrays.hpp"

namespace morph
{

// A straight line, or with a rotation R about the points' mean c
//
//     d(x, f) = R^f (x - c) - (x - c) + f r(x),   r(x) = d(x) - (R - 1)(x - c)
//
// where f is the part of the motion, R^f turns by f times the angle about the
// same axis, and r is the displacement that the rotation leaves: the same for
// all points of a body. d(x, 0) = 0, d(x, 1) = d(x).
class RigidPath
{
public:
    // A straight line
    RigidPath() = default;

    // The rotation that takes the positions x (n x 3) on all ranks to x + d in
    // the sense of least squares (Kabsch 1976, doi:10.1107/S0567739476001873).
    // A straight line where they do not move as a rigid body does, to 1e-6 of
    // the largest displacement, or are all on one straight line. The same to
    // the bit however they are ordered or distributed. Collective
    static RigidPath
    fit(const Vectors& x, const Vectors& d, Communicator& communicator);

    // d(x, f), where the displacement is d
    Vector3 displacement(const Vector3& x, const Vector3& d, double f) const;

    // The axis times the angle [rad], up to half a turn; zero for a straight
    // line
    const Vector3& rotation() const { return rotation_; }

private:
    Vector3 turned(const Vector3& x, double f) const;

    Vector3 centre_ = Vector3::Zero();
    Vector3 rotation_ = Vector3::Zero();
};

} // namespace morph

#endif
