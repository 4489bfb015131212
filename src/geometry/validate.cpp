// SPDX-License-Identifier: MIT
#include "geometry/validate.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cstddef>
#include <variant>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

std::string between(const char* before, double low, double high)
{
    return std::string("must be finite and ") + before + "in [" + textOf(low) + ", " + textOf(high) + "] m";
}

std::string indexed(std::string_view field, std::size_t i)
{
    return std::string(field) + "[" + std::to_string(i) + "]";
}

struct CheckShape {
    std::string_view field;
    double minSize;
    double maxSize;

    std::string part(const char* name) const { return std::string(field) + name; }

    bool isNear(Vec2 p) const { return absolute(double(p.x)) <= maxSize && absolute(double(p.y)) <= maxSize; }
    Complaint place(const std::string& name, Vec2 p) const
    {
        if (auto wrong = checkFinite(name, p)) return wrong;
        return isNear(p) ? std::nullopt
                         : checkThat(false, name, p, between("each coordinate ", -maxSize, maxSize));
    }
    Complaint solidRadius(real radius) const
    {
        const bool fits = double(radius) >= minSize && double(radius) <= maxSize;
        return fits ? std::nullopt : checkThat(false, part(".radius"), radius, between("", minSize, maxSize));
    }
    Complaint ends(Vec2 a, Vec2 b) const
    {
        if (auto wrong = place(part(".a"), a)) return wrong;
        if (auto wrong = place(part(".b"), b)) return wrong;
        if (length(toDVec2(b) - toDVec2(a)) >= minSize) return std::nullopt;
        return InputError(part(".b"), textOf(b), "must be at least " + textOf(minSize) + " m from a");
    }

    Complaint operator()(const Circle& s) const
    {
        if (auto wrong = place(part(".center"), s.center)) return wrong;
        return solidRadius(s.radius);
    }
    Complaint operator()(const Capsule& s) const
    {
        if (auto wrong = ends(s.a, s.b)) return wrong;
        return solidRadius(s.radius);
    }
    Complaint operator()(const Segment& s) const
    {
        if (auto wrong = ends(s.a, s.b)) return wrong;
        return checkRounding(part(".radius"), s.radius, maxSize);
    }
    Complaint operator()(const Polygon& s) const
    {
        if (s.count < 3 || s.count > kMaxPolygonVertices)
            return InputError(part(".count"), textOf(s.count),
                              "must be in [3, " + textOf(kMaxPolygonVertices) + "]");
        if (auto wrong = vertices(s.points())) return wrong;
        return checkRounding(part(".radius"), s.radius, maxSize);
    }

    Complaint vertices(std::span<const Vec2> points) const;
    Complaint order(std::span<const Vec2> points) const;
    Complaint thickness(std::span<const Vec2> points) const;
};

Complaint CheckShape::vertices(std::span<const Vec2> points) const
{
    const auto name = [&](std::size_t i) { return indexed(part(".vertices"), i); };
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!isNear(points[i])) return place(name(i), points[i]);

    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t next = (i + 1) % points.size();
        if (length(toDVec2(points[next]) - toDVec2(points[i])) >= minSize) continue;
        return InputError(name(next), textOf(points[next]),
                          "must be at least " + textOf(minSize) + " m from " + indexed("vertices", i));
    }
    if (auto wrong = order(points)) return wrong;
    return thickness(points);
}

// Every corner must turn left, and all of them together only once around.
Complaint CheckShape::order(std::span<const Vec2> points) const
{
    const std::size_t n = points.size();
    const auto edge = [&](std::size_t i) { return toDVec2(points[(i + 1) % n]) - toDVec2(points[i % n]); };

    bool anyLeft = false, anyRight = false;
    for (std::size_t i = 0; i < n; ++i) {
        const double turn = cross(edge(i + n - 1), edge(i));
        anyLeft = anyLeft || turn > 0;
        anyRight = anyRight || turn < 0;
    }
    if (!anyLeft && !anyRight)
        return InputError(part(".vertices"), textOf(points), "must not all lie on one line");
    if (!anyLeft) return InputError(part(".vertices"), textOf(points), "must be in counter-clockwise order");

    for (std::size_t i = 0; i < n; ++i) {
        const double turn = cross(edge(i + n - 1), edge(i));
        if (turn > 0) continue;
        const char* way = turn < 0 ? "turns right" : "lies on the line of its neighbours";
        return InputError(indexed(part(".vertices"), i), textOf(points[i]),
                          std::string("must be a corner of a convex polygon; it ") + way +
                              " (makePolygon keeps the corners of the hull)");
    }
    // Left turns everywhere can still make a star. Its corners lie well behind some edge, while those of
    // a convex polygon are at most a rounding error behind one.
    for (std::size_t i = 0; i < n; ++i) {
        for (const Vec2 p : points) {
            const DVec2 to = toDVec2(p) - toDVec2(points[i]);
            const double turn = cross(edge(i), to);
            if (turn >= 0 || turn >= -1e-9 * length(edge(i)) * length(to)) continue;
            return InputError(part(".vertices"), textOf(points), "must go around once; its edges cross");
        }
    }
    return std::nullopt;
}

Complaint CheckShape::thickness(std::span<const Vec2> points) const
{
    double thinnest = maxSize;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DVec2 from = toDVec2(points[i]);
        const DVec2 edge = toDVec2(points[(i + 1) % points.size()]) - from;
        const double along = length(edge);
        double height = 0;
        for (const Vec2 p : points) height = maximum(height, cross(edge, toDVec2(p) - from) / along);
        thinnest = minimum(thinnest, height);
    }
    if (thinnest >= minSize) return std::nullopt;
    return InputError(part(".vertices"), textOf(points),
                      "must be at least " + textOf(minSize) + " m thick; it is " + textOf(thinnest));
}

}  // namespace

Complaint checkGeometry(std::string_view field, const Geometry& geometry, double minSize, double maxSize)
{
    return std::visit(CheckShape{field, minSize, maxSize}, geometry);
}

Complaint checkRounding(std::string_view field, real radius, double maxSize)
{
    const bool fits = radius >= 0 && double(radius) <= maxSize;
    return fits ? std::nullopt : checkThat(false, field, radius, between("", 0, maxSize));
}

std::string textOf(std::span<const Vec2> points)
{
    if (points.size() > kMaxPolygonVertices) return textOf(points.size()) + " points";
    std::string text = "[";
    for (const Vec2 p : points) text += (text.size() > 1 ? ", " : "") + textOf(p);
    return text + "]";
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
