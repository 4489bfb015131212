// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/vec2.hpp>

#include <array>
#include <span>
#include <variant>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The most vertices a polygon may have.
inline constexpr int kMaxPolygonVertices = 16;

/// A disc.
struct Circle {
    Vec2 center = {};           ///< in the shape's frame   [m]
    real radius = real(0.5);    ///< [m]   > 0
};

/// All points within `radius` of the segment from a to b: a stadium.
struct Capsule {
    Vec2 a = {real(-0.5), 0};   ///< in the shape's frame   [m]
    Vec2 b = {real(0.5), 0};    ///< [m]   different from a
    real radius = real(0.25);   ///< [m]   > 0
};

/// A line from a to b, solid from both sides: grounds and walls. It has no area, so no mass.
struct Segment {
    Vec2 a = {real(-0.5), 0};   ///< in the shape's frame   [m]
    Vec2 b = {real(0.5), 0};    ///< [m]   different from a
    real radius = 0;            ///< of rounding            [m]   >= 0
};

/// A convex polygon, counter-clockwise, its corners rounded outwards by `radius`.
/// Make one with makeBox, makeRegularPolygon or makePolygon; the last orders any points.
struct Polygon {
    std::array<Vec2, kMaxPolygonVertices> vertices{};  ///< in the shape's frame   [m]
    int count = 0;                                     ///< 3 to 16
    real radius = 0;                                   ///< of rounding            [m]   >= 0

    std::span<const Vec2> points() const noexcept
    {
        return {vertices.data(), static_cast<std::size_t>(count < 0 ? 0 : count)};
    }
};

/// Any shape a body may carry.
using Geometry = std::variant<Circle, Capsule, Segment, Polygon>;

/// A rectangle of `width` by `height` about the origin, its outside rounded by `radius`: a rounded
/// box is 2 radius wider and higher than its sharp core.                    [m]   each > 0; radius >= 0
Polygon makeBox(real width, real height, real radius = 0);

/// A regular polygon whose corners lie on a circle of `circumradius`, the first one at angle 0.
/// `count` 3 to 16.                                                          [m]   > 0
Polygon makeRegularPolygon(int count, real circumradius, real radius = 0);

/// The convex hull of `points` as a polygon: 3 to 16 corners must be left.   [m]
/// @throws InputError if fewer than three points are left, or all lie on a line, with the reason
Polygon makePolygon(std::span<const Vec2> points, real radius = 0);

}  // namespace tamias2d::inline TAMIAS_PRECISION
