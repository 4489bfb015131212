// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/transform.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// An axis-aligned box in the world.
struct Aabb {
    Position lower = {};  ///< left and bottom   [m]
    Position upper = {};  ///< right and top     [m]
};

constexpr bool overlaps(const Aabb& a, const Aabb& b) noexcept
{
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y;
}
constexpr bool contains(const Aabb& outer, const Aabb& inner) noexcept
{
    return outer.lower.x <= inner.lower.x && outer.lower.y <= inner.lower.y &&
           inner.upper.x <= outer.upper.x && inner.upper.y <= outer.upper.y;
}
constexpr Aabb merged(const Aabb& a, const Aabb& b) noexcept
{
    return {{minimum(a.lower.x, b.lower.x), minimum(a.lower.y, b.lower.y)},
            {maximum(a.upper.x, b.upper.x), maximum(a.upper.y, b.upper.y)}};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
