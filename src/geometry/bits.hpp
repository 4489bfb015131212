// SPDX-License-Identifier: MIT
#pragma once

#include "base/hash.hpp"

#include <tamias2d/geometry/shapes.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Adds all that a geometry means.
void addBits(Hasher& hash, const Geometry& geometry);

/// Do two mean the same, to the last bit?
bool sameBits(const Geometry& a, const Geometry& b);
bool sameBits(Vec2 a, Vec2 b);
bool sameBits(real a, real b);

}  // namespace tamias2d::inline TAMIAS_PRECISION
