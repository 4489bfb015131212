// SPDX-License-Identifier: MIT
// Derivation: docs/theory/geometry.md, section 4.

#include <tamias2d/geometry/hull.hpp>

#include "base/check.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Twice the area of the triangle a, b, c: positive if it turns left. In double, so that float
// points are compared almost exactly.
double turn(Vec2 a, Vec2 b, Vec2 c) noexcept
{
    return cross(toDVec2(b) - toDVec2(a), toDVec2(c) - toDVec2(a));
}

// Adds `point` to a chain that only turns left, dropping the points that become inner ones.
// The first `fixed` points of `hull` belong to a finished chain and stay.
void extendChain(std::vector<Vec2>& hull, std::size_t fixed, Vec2 point)
{
    while (hull.size() > fixed && turn(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
    hull.push_back(point);
}

}  // namespace

std::vector<Vec2> convexHull(std::span<const Vec2> points)
{
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (isFinite(points[i])) continue;
        fail(InputError("convexHull.points[" + std::to_string(i) + "]", textOf(points[i]), "must be finite"));
        return {};
    }

    std::vector<Vec2> sorted(points.begin(), points.end());
    std::sort(sorted.begin(), sorted.end(),
              [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3) return sorted;

    std::vector<Vec2> hull;
    hull.reserve(sorted.size() + 1);
    for (const Vec2 p : sorted) extendChain(hull, 1, p);  // the lower side, left to right
    const std::size_t fixed = hull.size();
    for (auto p = sorted.rbegin() + 1; p != sorted.rend(); ++p) extendChain(hull, fixed, *p);
    hull.pop_back();  // the first point, reached again
    return hull;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
