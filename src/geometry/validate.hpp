// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/geometry/shapes.hpp>

#include "base/check.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {

// Bounds of shapes outside any world: their fourth powers, in inertias, neither overflow nor vanish.
inline constexpr double kSmallestSize = 1e-50;  ///< [m]
inline constexpr double kLargestSize = 1e50;    ///< [m]

/// What is wrong with a shape, naming the part, e.g. "ShapeDef.geometry.vertices[2]"; empty if nothing
/// is. Radii, edges and thickness must be at least `minSize`, coordinates and radii at most `maxSize`;
/// the rounding of segments and polygons may be 0.                                                 [m]
Complaint checkGeometry(std::string_view field, const Geometry& geometry, double minSize = kSmallestSize,
                        double maxSize = kLargestSize);

/// What is wrong with a rounding radius.   [m]
Complaint checkRounding(std::string_view field, real radius, double maxSize = kLargestSize);

/// "[(0, 0), (1, 0), (1, 1)]", or the number of points if they are many.
std::string textOf(std::span<const Vec2> points);

}  // namespace tamias2d::inline TAMIAS_PRECISION
