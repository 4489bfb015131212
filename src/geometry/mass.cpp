// SPDX-License-Identifier: MIT
// A rounded shape is its core, a rectangle along each edge and a circular sector at each corner.
// Derivation of the equations cited here: docs/theory/geometry.md, sections 1 to 3.

#include <tamias2d/geometry/mass.hpp>

#include <tamias2d/math/scalar.hpp>

#include "geometry/core.hpp"
#include "geometry/solid.hpp"
#include "geometry/validate.hpp"
#include "math/angle.hpp"

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Integrals of 1, of the position and of its square over an area, about a common origin.
struct Moments {
    double area = 0;    // [m^2]
    DVec2 first;        // [m^3]
    double second = 0;  // [m^4]

    // Adds a part of which the moments about its own point `at` are known.
    void add(double partArea, DVec2 partFirst, double partSecond, DVec2 at) noexcept
    {
        area += partArea;
        first += partFirst + partArea * at;
        second += partSecond + 2 * dot(at, partFirst) + partArea * dot(at, at);
    }
};

// The triangle of the origin, a and b (eq. 1 to 3).
void addTriangle(Moments& sum, DVec2 a, DVec2 b) noexcept
{
    const double twice = cross(a, b);
    sum.area += twice / 2;
    sum.first += (twice / 6) * (a + b);
    sum.second += twice / 12 * (dot(a, a) + dot(a, b) + dot(b, b));
}

// The rectangle of height `radius` outside the edge from a to b (eq. 4).
void addEdge(Moments& sum, DVec2 a, DVec2 b, DVec2 normal, double radius) noexcept
{
    const double edge = length(b - a);
    const DVec2 center = 0.5 * (a + b) + (radius / 2) * normal;
    const double part = edge * radius;
    sum.add(part, {}, part * (edge * edge + radius * radius) / 12, center);
}

// The sector about `corner` from direction `from` to direction `to`, `angle` apart (eq. 5).
void addSector(Moments& sum, DVec2 corner, DVec2 from, DVec2 to, double angle, double radius) noexcept
{
    const double square = radius * radius;
    const DVec2 first = (square * radius / 3) * (perpendicular(from) - perpendicular(to));
    sum.add(square * angle / 2, first, square * square * angle / 4, corner);
}

DVec2 outwardNormal(DVec2 a, DVec2 b) noexcept
{
    const DVec2 edge = b - a;
    return (1 / length(edge)) * DVec2{edge.y, -edge.x};
}

// Moments about `origin`, which should lie near: far away, the differences below lose digits.
Moments momentsOf(const Core& core, DVec2 origin) noexcept
{
    Moments sum;
    if (core.count == 1) {
        addSector(sum, core.at(0) - origin, {1, 0}, {1, 0}, kTwoPi, core.radius);
        return sum;
    }
    for (int i = 0; i < core.count; ++i) {
        const DVec2 a = core.at(i) - origin;
        const DVec2 b = core.at(core.next(i)) - origin;
        addTriangle(sum, a, b);
        if (core.radius == 0) continue;
        const DVec2 c = core.at(core.next(core.next(i))) - origin;
        const DVec2 normal = outwardNormal(a, b);
        const DVec2 nextNormal = outwardNormal(b, c);
        addEdge(sum, a, b, normal, core.radius);
        addSector(sum, b, normal, nextNormal, angleBetween(normal, nextNormal), core.radius);
    }
    return sum;
}

DVec2 meanPoint(const Core& core) noexcept
{
    DVec2 sum;
    for (int i = 0; i < core.count; ++i) sum += core.at(i);
    return (1.0 / core.count) * sum;
}

}  // namespace

Solid solidOf(const Geometry& geometry) noexcept
{
    const Core core = coreOf(geometry);
    const DVec2 origin = meanPoint(core);
    const Moments m = momentsOf(core, origin);
    if (!(m.area > 0)) return {0, origin, 0};
    DVec2 shift = (1 / m.area) * m.first;
    // Rounding must not put the center of a symmetric shape off its middle: a stack would notice.
    if (length(shift) <= 1e-15 * std::sqrt(m.second / m.area)) shift = {};
    return {m.area, origin + shift, m.second - m.area * dot(shift, shift)};
}

MassProperties massOf(const Solid& solid, real density) noexcept
{
    const double perArea = static_cast<double>(density);
    return {static_cast<real>(perArea * solid.area), toVec2(solid.center),
            static_cast<real>(perArea * solid.second)};
}

real area(const Geometry& geometry)
{
    if (Checks().add(checkGeometry("area.geometry", geometry)).refuse()) return 0;
    return static_cast<real>(solidOf(geometry).area);
}

Vec2 centroid(const Geometry& geometry)
{
    if (Checks().add(checkGeometry("centroid.geometry", geometry)).refuse()) return {};
    return toVec2(solidOf(geometry).center);
}

MassProperties massProperties(const Geometry& geometry, real density)
{
    if (Checks()
            .add(checkGeometry("massProperties.geometry", geometry))
            .range("massProperties.density", density, 0, kAnyFinite, "must be finite and >= 0 kg/m^2")
            .refuse())
        return {};
    return massOf(solidOf(geometry), density);
}

bool containsPoint(const Geometry& geometry, Vec2 point)
{
    if (Checks()
            .add(checkGeometry("containsPoint.geometry", geometry))
            .finite("containsPoint.point", point)
            .refuse())
        return false;
    return containsPoint(coreOf(geometry), toDVec2(point));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
