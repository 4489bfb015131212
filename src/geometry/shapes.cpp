// SPDX-License-Identifier: MIT
#include <tamias2d/geometry/shapes.hpp>

#include <tamias2d/geometry/hull.hpp>
#include <tamias2d/math/scalar.hpp>

#include "geometry/validate.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// "must be finite and > 0 m", with the bounds only if it is they that are broken.
Complaint checkSize(const char* field, real size)
{
    if (!(size > 0) || !isFiniteValue(size)) return checkThat(false, field, size, "must be finite and > 0 m");
    return checkRange(field, size, kSmallestSize, kLargestSize, "must be in [1e-50, 1e+50] m");
}

Polygon polygonOf(std::span<const Vec2> corners, real radius)
{
    Polygon polygon;
    polygon.radius = radius;
    for (const Vec2 p : corners) polygon.vertices[static_cast<std::size_t>(polygon.count++)] = p;
    return polygon;
}

// Leaves out corners that stand no further out than their own rounding: 0.1, 0.2 and 0.3 are not
// evenly spaced in binary, but whoever gave them meant a straight edge.
void dropStraightCorners(std::vector<Vec2>& corners)
{
    double extent = 0;
    for (const Vec2 p : corners)
        extent = maximum(extent, maximum(absolute(double(p.x)), absolute(double(p.y))));
    const double slack = 2 * extent * static_cast<double>(std::numeric_limits<real>::epsilon());

    for (std::size_t i = 0; i < corners.size() && corners.size() > 2;) {
        const DVec2 before = toDVec2(corners[(i + corners.size() - 1) % corners.size()]);
        const DVec2 chord = toDVec2(corners[(i + 1) % corners.size()]) - before;
        const double height = cross(toDVec2(corners[i]) - before, chord) / length(chord);
        if (height > slack)
            ++i;
        else
            corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

}  // namespace

Polygon makeBox(real width, real height, real radius)
{
    if (Checks()
            .add(checkSize("makeBox.width", width))
            .add(checkSize("makeBox.height", height))
            .add(checkRounding("makeBox.radius", radius))
            .refuse())
        return {};
    const real x = width / 2, y = height / 2;
    const std::array<Vec2, 4> corners = {Vec2{-x, -y}, Vec2{x, -y}, Vec2{x, y}, Vec2{-x, y}};
    return polygonOf(corners, radius);
}

Polygon makeRegularPolygon(int count, real circumradius, real radius)
{
    if (Checks()
            .range("makeRegularPolygon.count", count, 3, kMaxPolygonVertices, "must be in [3, 16]")
            .add(checkSize("makeRegularPolygon.circumradius", circumradius))
            .add(checkRounding("makeRegularPolygon.radius", radius))
            .refuse())
        return {};
    Polygon polygon;
    polygon.radius = radius;
    for (; polygon.count < count; ++polygon.count) {
        const SinCos at = sinCos(kTwoPi * polygon.count / count);
        polygon.vertices[static_cast<std::size_t>(polygon.count)] =
            toVec2(static_cast<double>(circumradius) * DVec2{at.cos, at.sin});
    }
    return polygon;
}

Polygon makePolygon(std::span<const Vec2> points, real radius)
{
    const auto refused = [](std::span<const Vec2> given, const std::string& rule) {
        fail(InputError("makePolygon.points", textOf(given), rule));
        return Polygon{};
    };
    for (std::size_t i = 0; i < points.size(); ++i)
        if (Checks().finite("makePolygon.points[" + textOf(i) + "]", points[i]).refuse()) return {};
    if (Checks().add(checkRounding("makePolygon.radius", radius)).refuse()) return {};
    if (points.size() < 3) return refused(points, "must be at least 3 points");

    std::vector<Vec2> corners = convexHull(points);
    if (corners.size() < 2) return refused(points, "must be at least 3 different points; all are one");
    dropStraightCorners(corners);
    if (corners.size() < 3) return refused(points, "must not all lie on one line");
    if (corners.size() > kMaxPolygonVertices)
        return refused(points, "must have at most 16 corners in its hull; it has " + textOf(corners.size()));

    const Polygon polygon = polygonOf(corners, radius);
    if (Checks().add(checkGeometry("makePolygon", polygon)).refuse()) return {};
    return polygon;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
