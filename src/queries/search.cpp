// SPDX-License-Identifier: MIT
// Questions about the present poses. Each looks at all shapes, rays first at the boxes around them: linear
// in the number of shapes.

#include "queries/search.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

DVec2 rotated(const SinCos& q, DVec2 v)
{
    return {q.cos * v.x - q.sin * v.y, q.sin * v.x + q.cos * v.y};
}

template <class Visit>
void eachShape(const SearchSpace& space, Visit visit)
{
    for (std::uint32_t slot = 0; slot < space.shapes.rows.size(); ++slot) {
        if (!space.shapes.ids.isAlive(slot)) continue;
        const ShapeRow& shape = space.shapes.rows[slot];
        const BodyRow& body = space.bodies.rows[shape.body];
        if (body.enabled && shouldCollide(space.filter, shape.def.filter)) visit(slot, body, shape);
    }
}

}  // namespace

DVec2 ShapeFrame::toLocal(Position world) const
{
    const SinCos q = sinCos(angle);
    return rotated({-q.sin, q.cos}, world - origin);
}

ShapeFrame frameOf(const BodyRow& body, const ShapeRow& shape)
{
    const DVec2 offset = toDVec2(shape.def.offset - body.localCenter);
    const double angle = wrapAngle(body.angle + wrapAngle(shape.def.angle));
    return {body.center + rotated(sinCos(body.angle), offset), angle, Rot::ofAngle(angle)};
}

Aabb boundsOf(const BodyRow& body, const ShapeRow& shape)
{
    const ShapeFrame frame = frameOf(body, shape);
    return boundsOf(shape.def.geometry, frame.origin, frame.rotation);
}

bool containsPoint(const BodyRow& body, const ShapeRow& shape, Position point)
{
    return containsPoint(coreOf(shape.def.geometry), frameOf(body, shape).toLocal(point));
}

std::vector<ShapeId> shapesAt(const SearchSpace& space, Position point)
{
    std::vector<ShapeId> found;
    eachShape(space, [&](std::uint32_t slot, const BodyRow& body, const ShapeRow& shape) {
        if (containsPoint(body, shape, point)) found.push_back(space.shapes.ids.id(slot));
    });
    return found;
}

std::vector<ShapeId> shapesIn(const SearchSpace& space, const Aabb& box)
{
    std::vector<ShapeId> found;
    eachShape(space, [&](std::uint32_t slot, const BodyRow& body, const ShapeRow& shape) {
        const ShapeFrame frame = frameOf(body, shape);
        if (overlapsBox(shape.def.geometry, frame.origin, frame.rotation, box))
            found.push_back(space.shapes.ids.id(slot));
    });
    return found;
}

std::vector<RayHit> shapesAlong(const SearchSpace& space, Position from, Position to)
{
    const Aabb way{{minimum(from.x, to.x), minimum(from.y, to.y)},
                   {maximum(from.x, to.x), maximum(from.y, to.y)}};
    std::vector<RayHit> hits;
    eachShape(space, [&](std::uint32_t slot, const BodyRow& body, const ShapeRow& shape) {
        if (!overlaps(way, boundsOf(body, shape))) return;
        const ShapeFrame frame = frameOf(body, shape);
        const auto local = castRay(shape.def.geometry, frame.toLocal(from), frame.toLocal(to));
        if (!local) return;
        RayHit hit;
        hit.shape = space.shapes.ids.id(slot);
        hit.body = space.bodies.ids.id(shape.body);
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
