// SPDX-License-Identifier: MIT
// Every shape is a convex core, made larger by a rounding radius on all sides: a circle rounds a
// point, capsules and segments round a line. What is written for cores holds for all of them.
#pragma once

#include <tamias2d/geometry/shapes.hpp>

#include <array>
#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The core of a shape, in double: 1 point, 2 ends or 3 to 16 corners counter-clockwise.   [m]
struct Core {
    std::array<DVec2, kMaxPolygonVertices> points{};
    int count = 0;
    double radius = 0;  ///< of rounding   >= 0

    DVec2 at(int i) const noexcept { return points[static_cast<std::size_t>(i)]; }
    int next(int i) const noexcept { return i + 1 < count ? i + 1 : 0; }
};

/// A polygon's count must be in [0, 16].
Core coreOf(const Geometry& geometry) noexcept;

/// From p to the nearest point of the segment between a and b, which differ.   [m^2]
double squaredDistance(DVec2 p, DVec2 a, DVec2 b) noexcept;

/// Is the point in the shape or on its border? Nothing is checked.
bool containsPoint(const Core& core, DVec2 p) noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
