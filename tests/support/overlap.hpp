// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/tamias2d.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// Gaps between shapes by plain geometry in double, sharing no code with the library: the measure
// that the tests trust.
namespace tamias2d::test {

/// A convex set: all points within `radius` of the hull of `core` (one, two or more points,
/// counter-clockwise).
struct Outline {
    std::vector<DVec2> core;  ///< [m]
    double radius = 0;        ///< [m]
    DVec2 center;             ///< of a disc that holds it all   [m]
    double reach = 0;         ///< the radius of that disc       [m]
};

/// The outline of a shape in its own frame.
inline Outline outlineOf(const Geometry& geometry)
{
    Outline o;
    if (const auto* circle = std::get_if<Circle>(&geometry)) {
        o.core = {toDVec2(circle->center)};
        o.radius = static_cast<double>(circle->radius);
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
        o.core = {toDVec2(capsule->a), toDVec2(capsule->b)};
        o.radius = static_cast<double>(capsule->radius);
    } else if (const auto* segment = std::get_if<Segment>(&geometry)) {
        o.core = {toDVec2(segment->a), toDVec2(segment->b)};
        o.radius = static_cast<double>(segment->radius);
    } else {
        const auto& polygon = std::get<Polygon>(geometry);
        for (const Vec2 v : polygon.points()) o.core.push_back(toDVec2(v));
        o.radius = static_cast<double>(polygon.radius);
    }
    for (const DVec2 p : o.core) o.center += (1.0 / static_cast<double>(o.core.size())) * p;
    for (const DVec2 p : o.core) o.reach = std::max(o.reach, length(p - o.center) + o.radius);
    return o;
}

/// `local` turned by `angle` [rad] and moved by `to` [m], written into `out`.
inline void place(const Outline& local, DVec2 to, double angle, Outline& out)
{
    const double c = std::cos(angle), s = std::sin(angle);
    const auto moved = [&](DVec2 p) { return DVec2{to.x + c * p.x - s * p.y, to.y + s * p.x + c * p.y}; };
    out.core.resize(local.core.size());
    for (std::size_t i = 0; i < local.core.size(); ++i) out.core[i] = moved(local.core[i]);
    out.center = moved(local.center);
    out.radius = local.radius;
    out.reach = local.reach;
}

inline double distanceToEdge(DVec2 p, DVec2 a, DVec2 b)
{
    const DVec2 ab = b - a;
    const double along = dot(ab, ab) > 0 ? std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) : 0;
    return length(p - (a + along * ab));
}

/// The widest gap seen along the outward normals of A's faces; a line has two, a point none.
inline double gapAlongFaces(const std::vector<DVec2>& a, const std::vector<DVec2>& b)
{
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; a.size() > 1 && i < a.size(); ++i) {
        const DVec2 edge = a[(i + 1) % a.size()] - a[i];
        const DVec2 normal = (1 / length(edge)) * DVec2{edge.y, -edge.x};
        double gap = std::numeric_limits<double>::infinity();
        for (const DVec2 p : b) gap = std::min(gap, dot(normal, p - a[i]));
        best = std::max(best, gap);
    }
    return best;
}

/// The gap between two outlines [m]; less than zero: how deep they overlap along the shallowest way out.
inline double gapBetween(const Outline& a, const Outline& b)
{
    const double faces = std::max(gapAlongFaces(a.core, b.core), gapAlongFaces(b.core, a.core));
    const bool points = a.core.size() == 1 && b.core.size() == 1;
    if (!points && faces <= 0) return faces - a.radius - b.radius;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.core.size(); ++i) {
        for (std::size_t k = 0; k < b.core.size(); ++k) {
            const DVec2 p = a.core[i], q = b.core[k];
            nearest = std::min({nearest, distanceToEdge(p, q, b.core[(k + 1) % b.core.size()]),
                                distanceToEdge(q, p, a.core[(i + 1) % a.core.size()])});
        }
    }
    return nearest - a.radius - b.radius;
}

/// Where two outlines that do not overlap come closest: the middle of the gap [m].
inline DVec2 nearestPoint(const Outline& a, const Outline& b)
{
    double nearest = std::numeric_limits<double>::infinity();
    DVec2 middle;
    const auto consider = [&](const Outline& corners, const Outline& edges) {
        for (const DVec2 p : corners.core) {
            for (std::size_t i = 0; i < edges.core.size(); ++i) {
                const DVec2 from = edges.core[i], along = edges.core[(i + 1) % edges.core.size()] - from;
                const double size = dot(along, along);
                const double part = size > 0 ? std::clamp(dot(p - from, along) / size, 0.0, 1.0) : 0;
                const DVec2 q = from + part * along;
                const double distance = length(p - q);
                if (distance >= nearest) continue;
                nearest = distance;
                const DVec2 out = (1 / distance) * (q - p);
                middle = 0.5 * (p + corners.radius * out + q - edges.radius * out);
            }
        }
    };
    consider(a, b);
    consider(b, a);
    return middle;
}

/// The outline of a shape of the world as it lies now, seen from `origin` (which keeps digits far out).
inline Outline outlineInWorld(World& world, Shape shape, Position origin = {})
{
    const ShapeDef def = shape.definition();
    const Body body = world.body(shape.body());
    Outline inBody, out;
    place(outlineOf(def.geometry), toDVec2(def.offset), def.angle, inBody);
    place(inBody, body.position() - origin, body.angle(), out);
    return out;
}

/// The smallest gap between the shapes of two bodies [m]; less than zero is overlap.
inline double gapBetween(World& world, const Body& a, const Body& b)
{
    double gap = std::numeric_limits<double>::infinity();
    for (const Shape& s : a.shapes()) {
        for (const Shape& t : b.shapes()) {
            const Outline left = outlineInWorld(world, s, a.position());
            gap = std::min(gap, gapBetween(left, outlineInWorld(world, t, a.position())));
        }
    }
    return gap;
}

/// The deepest overlap of any two shapes that may collide, of which one is on a dynamic body [m]; >= 0.
inline double deepestOverlap(World& world)
{
    struct Item {
        Outline outline;
        Filter filter;
        BodyId body;
        bool dynamic = false;
    };
    const std::vector<BodyId> ids = world.bodies();
    std::vector<Item> items;
    Position origin;
    if (!ids.empty()) origin = world.body(ids.front()).position();
    for (const BodyId id : ids) {
        const Body body = world.body(id);
        if (!body.isEnabled()) continue;
        for (const Shape& shape : body.shapes()) {
            items.push_back(
                {outlineInWorld(world, shape, origin), shape.filter(), id, body.type() == BodyType::Dynamic});
        }
    }
    double deepest = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t k = i + 1; k < items.size(); ++k) {
            const Item &a = items[i], &b = items[k];
            if (a.body == b.body || !(a.dynamic || b.dynamic) || !shouldCollide(a.filter, b.filter)) continue;
            if (length(a.outline.center - b.outline.center) > a.outline.reach + b.outline.reach) continue;
            deepest = std::max(deepest, -gapBetween(a.outline, b.outline));
        }
    }
    return deepest;
}

}  // namespace tamias2d::test
