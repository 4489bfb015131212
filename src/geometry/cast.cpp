// SPDX-License-Identifier: MIT
// Derivation of the equations cited here: docs/theory/geometry.md, sections 5 and 6.

#include "geometry/cast.hpp"

#include <tamias2d/math/scalar.hpp>

#include <array>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

using Hit = std::optional<LocalRayHit>;

constexpr double kRounding = 1e-15;  // of a length computed from others   [1]

// A way that is not a point, by its direction: hits are kept as a distance along it until the end.
struct Ray {
    DVec2 from;
    double reach;     // [m]
    DVec2 direction;  // length 1
};

// The nearest of several hits; its `fraction` is a distance for the time being.
struct Nearest {
    Hit hit;

    void offer(double distance, DVec2 normal, const Ray& ray) noexcept
    {
        if (distance < 0 || distance > ray.reach) return;
        if (!hit || distance < hit->fraction) hit = LocalRayHit{distance, normal};
    }
};

// The disc about `center`, from outside (eq. 9).
void offerDisc(Nearest& nearest, const Ray& ray, DVec2 center, double radius) noexcept
{
    const DVec2 toCenter = center - ray.from;
    const double along = dot(toCenter, ray.direction);
    const double aside = cross(ray.direction, toCenter);
    const double square = radius * radius - aside * aside;
    if (square < 0) return;
    const double half = std::sqrt(square);
    if (along + half < 0) return;  // behind
    // The start is outside, so an entry behind it is one of rounding.
    const double distance = maximum(along - half, 0.0);
    const DVec2 out = distance * ray.direction - toCenter;
    nearest.offer(distance, (1 / length(out)) * out, ray);
}

// The edge from a to b, moved out by `radius`, from its outer side (eq. 10).
void offerEdge(Nearest& nearest, const Ray& ray, DVec2 a, DVec2 b, double radius) noexcept
{
    const double size = length(b - a);
    const DVec2 along = (1 / size) * (b - a);
    const DVec2 normal = {along.y, -along.x};
    const double closing = -dot(normal, ray.direction);
    if (closing <= 0) return;
    const double height = dot(normal, ray.from - a) - radius;
    if (height < -kRounding * (length(ray.from - a) + radius)) return;  // on its inner side
    const double distance = maximum(height, 0.0) / closing;
    const double place = dot(along, ray.from - a) + distance * dot(along, ray.direction);
    if (place >= 0 && place <= size) nearest.offer(distance, normal, ray);
}

// A sharp polygon, as what is behind all of its edges (eq. 11): no ray slips in between two of them.
void offerPolygon(Nearest& nearest, const Ray& ray, const Core& core) noexcept
{
    double enter = 0, leave = ray.reach;
    DVec2 normal;
    for (int i = 0; i < core.count; ++i) {
        const DVec2 edge = core.at(core.next(i)) - core.at(i);
        const DVec2 out = (1 / length(edge)) * DVec2{edge.y, -edge.x};
        const double height = dot(out, ray.from - core.at(i));
        const double closing = -dot(out, ray.direction);
        if (closing == 0) {
            if (height > 0) return;
            continue;
        }
        const double distance = height / closing;
        if (closing > 0 && distance >= enter) {
            enter = distance;
            normal = out;
        } else if (closing < 0) {
            leave = minimum(leave, distance);
        }
    }
    if (enter <= leave && normal != DVec2{}) nearest.offer(enter, normal, ray);
}

// A line without thickness: from either side, or along it onto one of its ends.
void offerLine(Nearest& nearest, const Ray& ray, DVec2 a, DVec2 b) noexcept
{
    offerEdge(nearest, ray, a, b, 0);
    offerEdge(nearest, ray, b, a, 0);
    if (cross(b - a, ray.direction) != 0 || cross(b - a, ray.from - a) != 0) return;
    for (const DVec2 end : {a, b}) nearest.offer(dot(end - ray.from, ray.direction), -ray.direction, ray);
}

// The corners of the shape's core as seen from the middle of a box.
Core placedCore(const Geometry& geometry, Position origin, Rot rotation, Position middle) noexcept
{
    Core core = coreOf(geometry);
    const double c = static_cast<double>(rotation.c), s = static_cast<double>(rotation.s);
    const DVec2 shift = origin - middle;
    for (int i = 0; i < core.count; ++i) {
        const DVec2 p = core.at(i);
        core.points[static_cast<std::size_t>(i)] = shift + DVec2{c * p.x - s * p.y, s * p.x + c * p.y};
    }
    return core;
}

// Does a direction show a gap between the core and the box about (0, 0)? The sides of the box and the
// edges of the core are all that need to be asked.
bool areApart(const Core& core, DVec2 half) noexcept
{
    const auto gapAlong = [&](DVec2 axis) {
        double low = dot(axis, core.at(0)), high = low;
        for (int i = 1; i < core.count; ++i) {
            const double x = dot(axis, core.at(i));
            low = minimum(low, x);
            high = maximum(high, x);
        }
        const double reach = absolute(axis.x) * half.x + absolute(axis.y) * half.y;
        return low > reach || high < -reach;
    };
    if (gapAlong({1, 0}) || gapAlong({0, 1})) return true;
    for (int i = 0; core.count > 1 && i < core.count; ++i)
        if (gapAlong(perpendicular(core.at(core.next(i)) - core.at(i)))) return true;
    return false;
}

// The squared distance of the core from a box about (0, 0) that it does not meet: from a corner of one
// to the other.
double squaredGap(const Core& core, DVec2 half) noexcept
{
    double least = 0;
    for (int i = 0; i < core.count; ++i) {
        const DVec2 p = core.at(i);
        const DVec2 gap = {maximum(absolute(p.x) - half.x, 0.0), maximum(absolute(p.y) - half.y, 0.0)};
        least = i == 0 ? dot(gap, gap) : minimum(least, dot(gap, gap));
    }
    const std::array<DVec2, 4> corners = {half, DVec2{-half.x, half.y}, -half, DVec2{half.x, -half.y}};
    for (int i = 0; core.count > 1 && i < core.count; ++i)
        for (const DVec2 corner : corners)
            least = minimum(least, squaredDistance(corner, core.at(i), core.at(core.next(i))));
    return least;
}

}  // namespace

std::optional<LocalRayHit> castRay(const Core& core, DVec2 from, DVec2 to) noexcept
{
    if (containsPoint(core, from)) return LocalRayHit{};
    const double reach = length(to - from);
    if (!(reach > 0)) return std::nullopt;
    const Ray ray{from, reach, (1 / reach) * (to - from)};

    Nearest nearest;
    if (core.radius == 0 && core.count == 2) {
        offerLine(nearest, ray, core.at(0), core.at(1));
    } else if (core.radius == 0) {
        offerPolygon(nearest, ray, core);
    } else {
        for (int i = 0; i < core.count; ++i) {
            offerDisc(nearest, ray, core.at(i), core.radius);
            if (core.count > 1) offerEdge(nearest, ray, core.at(i), core.at(core.next(i)), core.radius);
        }
    }
    if (nearest.hit) nearest.hit->fraction = minimum(nearest.hit->fraction / reach, 1.0);
    return nearest.hit;
}

std::optional<LocalRayHit> castRay(const Geometry& geometry, DVec2 from, DVec2 to) noexcept
{
    return castRay(coreOf(geometry), from, to);
}

bool overlapsBox(const Geometry& geometry, Position origin, Rot rotation, const Aabb& box) noexcept
{
    // Halves first: the sum of two far corners may be out of range.
    const Position middle = {box.lower.x / 2 + box.upper.x / 2, box.lower.y / 2 + box.upper.y / 2};
    const DVec2 half = {box.upper.x / 2 - box.lower.x / 2, box.upper.y / 2 - box.lower.y / 2};
    const Core core = placedCore(geometry, origin, rotation, middle);
    if (!areApart(core, half)) return true;
    return core.radius > 0 && squaredGap(core, half) <= core.radius * core.radius;
}

Aabb boundsOf(const Geometry& geometry, Position origin, Rot rotation) noexcept
{
    const Core core = placedCore(geometry, origin, rotation, origin);
    DVec2 lower = core.at(0), upper = core.at(0);
    for (int i = 1; i < core.count; ++i) {
        const DVec2 p = core.at(i);
        lower = {minimum(lower.x, p.x), minimum(lower.y, p.y)};
        upper = {maximum(upper.x, p.x), maximum(upper.y, p.y)};
    }
    const DVec2 round = {core.radius, core.radius};
    return {origin + (lower - round), origin + (upper + round)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
