// SPDX-License-Identifier: MIT
#include "geometry/bits.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void addBits(Hasher& hash, Vec2 v)
{
    hash.add(v.x);
    hash.add(v.y);
}

bool same(const Circle& a, const Circle& b)
{
    return sameBits(a.center, b.center) && sameBits(a.radius, b.radius);
}

template <class Line>
bool same(const Line& a, const Line& b)
{
    return sameBits(a.a, b.a) && sameBits(a.b, b.b) && sameBits(a.radius, b.radius);
}

bool same(const Polygon& a, const Polygon& b)
{
    const auto p = a.points(), q = b.points();
    return a.count == b.count && sameBits(a.radius, b.radius) &&
           std::equal(p.begin(), p.end(), q.begin(), [](Vec2 u, Vec2 v) { return sameBits(u, v); });
}

}  // namespace

void addBits(Hasher& hash, const Geometry& geometry)
{
    hash.add(std::uint64_t{geometry.index()});
    if (const auto* circle = std::get_if<Circle>(&geometry)) {
        addBits(hash, circle->center);
        hash.add(circle->radius);
    } else if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
        addBits(hash, capsule->a);
        addBits(hash, capsule->b);
        hash.add(capsule->radius);
    } else if (const auto* segment = std::get_if<Segment>(&geometry)) {
        addBits(hash, segment->a);
        addBits(hash, segment->b);
        hash.add(segment->radius);
    } else if (const auto* polygon = std::get_if<Polygon>(&geometry)) {
        hash.add(static_cast<std::uint64_t>(polygon->count));
        for (const Vec2 v : polygon->points()) addBits(hash, v);
        hash.add(polygon->radius);
    }
}

bool sameBits(real a, real b)
{
    return a == b && std::signbit(a) == std::signbit(b);
}

bool sameBits(Vec2 a, Vec2 b)
{
    return sameBits(a.x, b.x) && sameBits(a.y, b.y);
}

bool sameBits(const Geometry& a, const Geometry& b)
{
    if (a.index() != b.index()) return false;
    return std::visit(
        [&b](const auto& kind) { return same(kind, *std::get_if<std::decay_t<decltype(kind)>>(&b)); }, a);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
