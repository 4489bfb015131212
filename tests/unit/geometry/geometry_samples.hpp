// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/geometry/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <variant>
#include <vector>

namespace tamias2d::test {

inline Vec2 vec(double x, double y)
{
    return {static_cast<real>(x), static_cast<real>(y)};
}

/// Relative tolerance of what the library returns as `real`.
inline constexpr double kRealTolerance = 4 * static_cast<double>(std::numeric_limits<real>::epsilon());

/// A polygon as it stands, unchecked.
inline Polygon rawPolygon(std::span<const Vec2> vertices, double radius = 0)
{
    Polygon polygon;
    polygon.radius = static_cast<real>(radius);
    for (const Vec2 p : vertices) polygon.vertices[static_cast<std::size_t>(polygon.count++)] = p;
    return polygon;
}

/// Shapes of every kind, off their origin and lopsided, sharp and rounded.
inline std::vector<Geometry> sampleShapes()
{
    const std::vector<Vec2> kite = {vec(0.2, -1), vec(1.5, 0.25), vec(0.5, 1.25), vec(-1, 0.5)};
    const std::vector<Vec2> wedge = {vec(-1, -0.25), vec(2, 0), vec(-1, 0.125)};
    return {Circle{vec(0.5, -0.25), real(0.75)},
            Capsule{vec(-1, 0.5), vec(0.75, -0.25), real(0.375)},
            Segment{vec(-1, -0.5), vec(1.25, 0.5), real(0.125)},
            Segment{vec(-1, 0.25), vec(1, 0), 0},
            makePolygon(kite),
            makePolygon(kite, real(0.25)),
            makePolygon(wedge),
            makePolygon(wedge, real(0.5)),
            makeBox(2, 1),
            makeRegularPolygon(16, 1, real(0.125))};
}

/// Uniform in the square of half width `half` about the origin; each coordinate exact in float.
class RandomPoints {
public:
    explicit RandomPoints(std::uint64_t seed) : random_(seed) {}

    double number(double half) { return half * (static_cast<double>(random_() >> 44) * 0x1p-19 - 1); }
    DVec2 point(double half) { return {number(half), number(half)}; }

private:
    std::mt19937_64 random_;
};

inline double distanceFromLine(DVec2 p, DVec2 a, DVec2 b)
{
    const DVec2 way = b - a, to = p - a;
    const double place = dot(to, way) / dot(way, way);
    if (place < 0) return length(to);
    if (place > 1) return length(p - b);
    return std::abs(cross(way, to)) / length(way);
}

/// How far p is from a shape, negative inside a sharp core: the truth for points, rays and boxes, from
/// the definition of each kind of shape. Exact outside; inside a round rim, too.
inline double distanceFrom(const Geometry& geometry, DVec2 p)
{
    if (const auto* s = std::get_if<Circle>(&geometry))
        return length(p - toDVec2(s->center)) - double(s->radius);
    if (const auto* s = std::get_if<Capsule>(&geometry))
        return distanceFromLine(p, toDVec2(s->a), toDVec2(s->b)) - double(s->radius);
    if (const auto* s = std::get_if<Segment>(&geometry))
        return distanceFromLine(p, toDVec2(s->a), toDVec2(s->b)) - double(s->radius);

    const Polygon& s = std::get<Polygon>(geometry);
    double nearest = std::numeric_limits<double>::infinity();
    int windings = 0;  // of the border around p, by its crossings of the ray from p to the right
    for (std::size_t i = 0; i < s.points().size(); ++i) {
        const DVec2 a = toDVec2(s.points()[i]), b = toDVec2(s.points()[(i + 1) % s.points().size()]);
        nearest = std::min(nearest, distanceFromLine(p, a, b));
        if (a.y <= p.y && b.y > p.y && cross(b - a, p - a) > 0) ++windings;
        if (a.y > p.y && b.y <= p.y && cross(b - a, p - a) < 0) --windings;
    }
    return (windings != 0 ? -nearest : nearest) - double(s.radius);
}

}  // namespace tamias2d::test
