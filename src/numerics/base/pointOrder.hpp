// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The one order of points: by x, then y, then z. Whatever must not depend on
// ranks or on who was first is decided by it.

#ifndef morph_pointOrder_hpp
#define morph_pointOrder_hpp

#include "arrays.hpp"

#include <algorithm>

namespace morph
{

// a, b: three coordinates each
inline bool precedes(const double* a, const double* b)
{
    return std::lexicographical_compare(a, a + 3, b, b + 3);
}


inline bool before(const Vector3& a, const Vector3& b)
{
    return precedes(a.data(), b.data());
}

} // namespace morph

#endif
