// SPDX-License-Identifier: MIT
#include "narrowphase/convex.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void setCore(Convex& shape, const Geometry& geometry)
{
    if (const auto* circle = std::get_if<Circle>(&geometry)) {
        shape.count = 1;
        shape.vertices[0] = circle->center;
        shape.radius = circle->radius;
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
        shape.count = 2;
        shape.vertices[0] = capsule->a;
        shape.vertices[1] = capsule->b;
        shape.radius = capsule->radius;
    } else if (const auto* segment = std::get_if<Segment>(&geometry)) {
        shape.count = 2;
        shape.vertices[0] = segment->a;
        shape.vertices[1] = segment->b;
        shape.radius = segment->radius;
    } else if (const auto* polygon = std::get_if<Polygon>(&geometry)) {
        shape.count = polygon->count;
        shape.vertices = polygon->vertices;
        shape.radius = polygon->radius;
    }
}

// A line without thickness has no width; its length stands in, so that it has a rest gap.
real smallestWidth(const Convex& shape)
{
    if (shape.count == 1) return 2 * shape.radius;
    if (shape.count == 2)
        return shape.radius > 0 ? 2 * shape.radius : length(shape.vertices[1] - shape.vertices[0]);

    real smallest = std::numeric_limits<real>::max();
    for (int i = 0; i < shape.count; ++i) {
        real width = 0;
        for (int k = 0; k < shape.count; ++k)
            width = maximum(width, dot(shape.normals[i], shape.vertices[i] - shape.vertices[k]));
        smallest = minimum(smallest, width);
    }
    return smallest + 2 * shape.radius;
}

}  // namespace

Convex makeConvex(const Geometry& geometry, Vec2 offset, Rot rotation, Vec2 center)
{
    Convex shape;
    setCore(shape, geometry);
    for (int i = 0; i < shape.count; ++i) {
        shape.vertices[i] = offset + rotate(rotation, shape.vertices[i]) - center;
        shape.extent = maximum(shape.extent, length(shape.vertices[i]));
    }
    for (int i = 0; i < shape.faces(); ++i) {
        const Vec2 edge = shape.vertices[i + 1 < shape.count ? i + 1 : 0] - shape.vertices[i];
        const real invLength = 1 / length(edge);
        shape.normals[i] = {invLength * edge.y, -invLength * edge.x};
    }
    for (std::size_t i = static_cast<std::size_t>(shape.count); i < kMaxPolygonVertices; ++i) {
        shape.vertices[i] = shape.vertices[i - 1];
        shape.normals[i] = shape.normals[i - 1];
    }
    shape.extent += shape.radius;
    shape.size = smallestWidth(shape);
    return shape;
}

PlacedCore::PlacedCore(const Convex& shape, const Pose& pose) : count(shape.count)
{
    const Lanes c(pose.q.c), s(pose.q.s);
    const BasicVec2<Lanes> p{pose.p.x, pose.p.y};
    const auto turned = [c, s](const Vec2* vectors) { return rotate(c, s, loadVectors<kLanes>(vectors)); };
    for (int i = 0; i < count; i += kLanes) vertices.setLanes(i, p + turned(shape.vertices.data() + i));
    for (int i = 0; i < shape.faces(); i += kLanes) normals.setLanes(i, turned(shape.normals.data() + i));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
