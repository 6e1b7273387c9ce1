// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Volume of a tetrahedron whose vertices move along straight lines, and when it
// first vanishes.
//
// The volume is a cubic polynomial of the fraction t of the motion. It is kept
// by its Bernstein coefficients on [0, 1]: they bound it from both sides, so
// that for all but a few tetrahedra their signs alone tell that there is no
// root, and evaluation by them does not cancel.

#ifndef morph_movingTetrahedron_hpp
#define morph_movingTetrahedron_hpp

#include "arrays.hpp"

#include <array>

namespace morph
{

// Bernstein coefficients of a cubic on [0, 1]
using Cubic = std::array<double, 4>;

// Returned if there is no root; larger than any fraction
constexpr double noRoot = 2;


// Six times the volume of a tetrahedron, positive where the three edges are
// right-handed. Swapping the edges a and b changes the sign of all coefficients
// and nothing else, to the last bit.
// \param a, b, c  edges at t = 0 (b and a from one vertex, c anywhere)
// \param a1, b1, c1  the same at t = 1
Cubic movingVolume(
    const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& a1,
    const Vector3& b1, const Vector3& c1);


// Do the Bernstein coefficients alone show that the cubic is positive on [0,
// end]? Needs no root
bool surelyPositive(const Cubic& p, double end);


// The cubic at t (de Casteljau)
double value(const Cubic& p, double t);


// The largest t in [0, 1] up to which the cubic is positive, to the last bits,
// if it has a root in (0, 1], otherwise noRoot. A cubic that is not positive at
// t = 0 was invalid before the motion and counts as without a root; one with a
// coefficient that is not a number gives 0.
double positiveUpTo(const Cubic& p);

} // End namespace morph

#endif
