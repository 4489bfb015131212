// SPDX-License-Identifier: MIT
#include "geometry/core.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

Core withPoints(std::span<const Vec2> points, real radius) noexcept
{
    Core core;
    core.radius = static_cast<double>(radius);
    for (const Vec2 p : points) core.points[static_cast<std::size_t>(core.count++)] = toDVec2(p);
    return core;
}

Core withEnds(Vec2 a, Vec2 b, real radius) noexcept
{
    const std::array<Vec2, 2> ends = {a, b};
    return withPoints(ends, radius);
}

}  // namespace

Core coreOf(const Geometry& geometry) noexcept
{
    if (const auto* s = std::get_if<Circle>(&geometry)) return withPoints({&s->center, 1}, s->radius);
    if (const auto* s = std::get_if<Capsule>(&geometry)) return withEnds(s->a, s->b, s->radius);
    if (const auto* s = std::get_if<Segment>(&geometry)) return withEnds(s->a, s->b, s->radius);
    if (const auto* s = std::get_if<Polygon>(&geometry)) return withPoints(s->points(), s->radius);
    return {};
}

double squaredDistance(DVec2 p, DVec2 a, DVec2 b) noexcept
{
    const DVec2 edge = b - a;
    const double t = clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
    const DVec2 gap = p - (a + t * edge);
    return dot(gap, gap);
}

bool containsPoint(const Core& core, DVec2 p) noexcept
{
    const double reach = core.radius * core.radius;
    if (core.count == 1) {
        const DVec2 gap = p - core.at(0);
        return dot(gap, gap) <= reach;
    }
    bool inside = core.count > 2;
    for (int i = 0; i < core.count; ++i) {
        const DVec2 a = core.at(i), b = core.at(core.next(i));
        if (squaredDistance(p, a, b) <= reach) return true;
        inside = inside && cross(b - a, p - a) >= 0;
    }
    return inside;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
