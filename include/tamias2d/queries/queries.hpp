// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/ids.hpp>
#include <tamias2d/geometry/aabb.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where a ray first meets a shape.
struct RayHit {
    ShapeId shape;
    BodyId body;
    Position point;       ///< [m]
    Vec2 normal;          ///< of the surface, outwards; zero if the ray starts inside
    double fraction = 0;  ///< of the way from start to end   in [0, 1]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
