// SPDX-License-Identifier: MIT
#include "model/shapes.hpp"

#include "geometry/bits.hpp"

#include <bit>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// What makes a form or a surface, to find it by.
struct FormKey {
    const Geometry& geometry;
    Vec2 offset;
    double angle;
    Vec2 center;

    std::uint64_t hash() const
    {
        Hasher hash;
        addBits(hash, geometry);
        for (const real value : {offset.x, offset.y, center.x, center.y}) hash.add(value);
        hash.add(angle);
        return hash.value();
    }
    bool matches(const ShapeForm& form) const
    {
        return sameBits(geometry, form.geometry) && sameBits(offset, form.offset) &&
               std::bit_cast<std::uint64_t>(angle) == std::bit_cast<std::uint64_t>(form.angle) &&
               sameBits(center, form.center);
    }
    ShapeForm make() const
    {
        return {geometry,
                offset,
                angle,
                center,
                makeConvex(geometry, offset, Rot::ofAngle(wrapAngle(angle)), center),
                solidOf(geometry)};
    }
};

struct SurfaceKey {
    const ShapeSurface& surface;

    std::uint64_t hash() const
    {
        Hasher hash;
        const Material& m = surface.material;
        for (const real value :
             {surface.density, m.friction, m.restitution, m.rollingResistance, m.surfaceSpeed})
            hash.add(value);
        hash.add(static_cast<std::uint64_t>(m.frictionMixing) << 8 |
                 static_cast<std::uint64_t>(m.restitutionMixing));
        hash.add(surface.filter.category);
        hash.add(surface.filter.mask);
        hash.add(static_cast<std::uint64_t>(surface.filter.group));
        return hash.value();
    }
    bool matches(const ShapeSurface& other) const
    {
        const Material &m = surface.material, &n = other.material;
        return m == n && surface.filter == other.filter && sameBits(surface.density, other.density) &&
               sameBits(m.friction, n.friction) && sameBits(m.restitution, n.restitution) &&
               sameBits(m.rollingResistance, n.rollingResistance) && sameBits(m.surfaceSpeed, n.surfaceSpeed);
    }
    ShapeSurface make() const { return surface; }
};

}  // namespace

bool ShapeTable::isLastGeometry(const Geometry& geometry) const
{
    const ShapeForm* last = forms.last();
    return last != nullptr && sameBits(geometry, last->geometry);
}

ShapeDef ShapeTable::def(std::uint32_t slot) const
{
    const ShapeForm& f = form(slot);
    const ShapeSurface& s = surface(slot);
    return {f.geometry, f.offset, f.angle, s.density, s.material, s.filter, rows[slot].userData};
}

// The new one is taken before the old one is given back, which may be the very same.
void ShapeTable::setForm(std::uint32_t slot, const Geometry& geometry, Vec2 offset, double angle, Vec2 center)
{
    const std::uint32_t taken = forms.take(FormKey{geometry, offset, angle, center});
    forms.giveBack(rows[slot].form);
    rows[slot].form = taken;
}

void ShapeTable::setSurface(std::uint32_t slot, const ShapeSurface& surface)
{
    const std::uint32_t taken = surfaces.take(SurfaceKey{surface});
    surfaces.giveBack(rows[slot].surface);
    rows[slot].surface = taken;
}

void ShapeTable::link(ShapeList& list, std::uint32_t slot)
{
    if (list.empty()) {
        list.first = rows[slot].next = rows[slot].previous = slot;
    } else {
        const std::uint32_t last = lastOf(list);
        rows[slot].next = list.first;
        rows[slot].previous = last;
        rows[last].next = rows[list.first].previous = slot;
    }
    ++list.count;
}

void ShapeTable::unlink(ShapeList& list, std::uint32_t slot)
{
    ShapeRow& row = rows[slot];
    rows[row.next].previous = row.previous;
    rows[row.previous].next = row.next;
    if (list.first == slot) list.first = row.next;
    if (--list.count == 0) list = {};
}

void ShapeTable::clear(std::uint32_t slot)
{
    forms.giveBack(rows[slot].form);
    surfaces.giveBack(rows[slot].surface);
    rows[slot] = {};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
