// SPDX-License-Identifier: MIT
// Rays and boxes against one shape, exact but for rounding: round corners count as round.
#pragma once

#include <tamias2d/geometry/aabb.hpp>
#include <tamias2d/geometry/shapes.hpp>

#include "geometry/core.hpp"

#include <optional>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where a ray enters a shape, in the shape's frame.
struct LocalRayHit {
    double fraction = 0;  ///< of the way from start to end   in [0, 1]
    DVec2 normal;         ///< of the surface, outwards, length 1; zero if the ray starts inside
};

/// The first point of the way from `from` to `to`, both in the shape's frame, that is in the shape.   [m]
std::optional<LocalRayHit> castRay(const Core& core, DVec2 from, DVec2 to) noexcept;
std::optional<LocalRayHit> castRay(const Geometry& geometry, DVec2 from, DVec2 to) noexcept;

/// Do the shape, its frame at `origin` and turned by `rotation`, and the box share a point?
bool overlapsBox(const Geometry& geometry, Position origin, Rot rotation, const Aabb& box) noexcept;

/// The smallest box around the shape, its frame at `origin` and turned by `rotation`.
Aabb boundsOf(const Geometry& geometry, Position origin, Rot rotation) noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
