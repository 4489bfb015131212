// SPDX-License-Identifier: MIT
// Questions about the present poses. What holds still is found in its trees; of what moves each shape is
// looked at, by rays first at the box around it.

#include "queries/search.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

DVec2 rotated(const SinCos& q, DVec2 v)
{
    return {q.cos * v.x - q.sin * v.y, q.sin * v.x + q.cos * v.y};
}

// Visits the shapes that may be meant: of those that hold still, what `eachResting` says.
template <class EachResting, class Visit>
void eachShape(const SearchSpace& space, EachResting eachResting, Visit visit)
{
    const auto visitOne = [&](std::uint32_t slot) {
        if (!shouldCollide(space.filter, space.shapes.filter(slot))) return;
        visit(slot, space.bodies.rows[space.shapes.rows[slot].body], space.shapes.form(slot));
    };
    eachResting(visitOne);
    std::vector<std::uint32_t> parts = space.bodies.parts;  // some may be there twice
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (const std::uint32_t part : parts) {
        if (!space.bodies.rows[part].takesPart) continue;
        for (const std::uint32_t slot : space.shapes.of(space.bodies.rows[part])) visitOne(slot);
    }
}

}  // namespace

DVec2 ShapeFrame::toLocal(Position world) const
{
    const SinCos q = sinCos(angle);
    return rotated({-q.sin, q.cos}, world - origin);
}

ShapeFrame frameOf(const BodyRow& body, const ShapeForm& shape)
{
    const DVec2 offset = toDVec2(shape.offset - body.localCenter);
    const double angle = wrapAngle(body.angle + wrapAngle(shape.angle));
    return {body.center + rotated(sinCos(body.angle), offset), angle, Rot::ofAngle(angle)};
}

Aabb boundsOf(const BodyRow& body, const ShapeForm& shape)
{
    const ShapeFrame frame = frameOf(body, shape);
    return boundsOf(shape.geometry, frame.origin, frame.rotation);
}

bool containsPoint(const BodyRow& body, const ShapeForm& shape, Position point)
{
    return containsPoint(coreOf(shape.geometry), frameOf(body, shape).toLocal(point));
}

std::vector<ShapeId> shapesAt(const SearchSpace& space, Position point)
{
    std::vector<ShapeId> found;
    const auto resting = [&](auto visit) { space.resting.eachOverlapping({point, point}, visit); };
    eachShape(space, resting, [&](std::uint32_t slot, const BodyRow& body, const ShapeForm& shape) {
        if (containsPoint(body, shape, point)) found.push_back(space.shapes.ids.id(slot));
    });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<ShapeId> shapesIn(const SearchSpace& space, const Aabb& box)
{
    std::vector<ShapeId> found;
    const auto resting = [&](auto visit) { space.resting.eachOverlapping(box, visit); };
    eachShape(space, resting, [&](std::uint32_t slot, const BodyRow& body, const ShapeForm& shape) {
        const ShapeFrame frame = frameOf(body, shape);
        if (overlapsBox(shape.geometry, frame.origin, frame.rotation, box))
            found.push_back(space.shapes.ids.id(slot));
    });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<RayHit> shapesAlong(const SearchSpace& space, Position from, Position to)
{
    const Aabb way{{minimum(from.x, to.x), minimum(from.y, to.y)},
                   {maximum(from.x, to.x), maximum(from.y, to.y)}};
    std::vector<RayHit> hits;
    const auto resting = [&](auto visit) { space.resting.eachAlong(from, to, visit); };
    eachShape(space, resting, [&](std::uint32_t slot, const BodyRow& body, const ShapeForm& shape) {
        if (!overlaps(way, boundsOf(body, shape))) return;
        const ShapeFrame frame = frameOf(body, shape);
        const auto local = castRay(shape.geometry, frame.toLocal(from), frame.toLocal(to));
        if (!local) return;
        RayHit hit;
        hit.shape = space.shapes.ids.id(slot);
        hit.body = space.bodies.ids.id(space.shapes.rows[slot].body);
        hit.fraction = local->fraction;
        hit.point = from + local->fraction * (to - from);
        hit.normal = toVec2(rotated(sinCos(frame.angle), local->normal));
        hits.push_back(hit);
    });
    std::sort(hits.begin(), hits.end(), [](const RayHit& a, const RayHit& b) {
        return a.fraction != b.fraction ? a.fraction < b.fraction : a.shape < b.shape;
    });
    return hits;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
