// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/vec2.hpp>

#include <span>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The convex hull of any number of points, counter-clockwise, starting at the lowest of the
/// leftmost points; points on an edge are left out. One point or a line gives fewer than three.  [m]
/// Andrew's monotone chain, O(n log n).
/// @throws InputError if a point is not finite
std::vector<Vec2> convexHull(std::span<const Vec2> points);

}  // namespace tamias2d::inline TAMIAS_PRECISION
