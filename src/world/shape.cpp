// SPDX-License-Identifier: MIT
#include "queries/search.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

ShapeRow& deadShapeRow()
{
    static thread_local ShapeRow row;
    return row = {};
}

}  // namespace

bool Shape::isAlive() const noexcept
{
    return world_ != nullptr && world_->impl_->shapes.ids.owns(id_);
}

World* Shape::alive() const
{
    if (isAlive()) return world_;
    fail(
        InputError("Shape", id_.isNull() ? "null" : textOf(id_.index), "must be a live shape of this world"));
    return nullptr;
}

// The row, or a fresh one that nobody keeps when a dead handle was let pass by the error handler.
#define TAMIAS_SHAPE_ROW(name)                                                                               \
    World* const w = alive();                                                                                \
    if (w) w->impl_->settleMass(w->impl_->shapes.rows[id_.index].body);                                      \
    ShapeRow& name = w ? w->impl_->shapes.rows[id_.index] : deadShapeRow()

BodyId Shape::body() const
{
    TAMIAS_SHAPE_ROW(s);
    return w ? w->impl_->bodies.ids.id(s.body) : BodyId{};
}

ShapeDef Shape::definition() const
{
    TAMIAS_SHAPE_ROW(s);
    return s.def;
}

void Shape::redefine(const ShapeDef& def)
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || refuse(check(def, w->impl_->settings.lengthUnit)) ||
        refuse(w->impl_->checkMassWith("ShapeDef.density", def, s.body, id_.index)))
        return;
    w->impl_->disturb(s.body);
    s.def = def;
    w->impl_->rebuildConvex(id_.index);
    w->impl_->updateMass(s.body);
    w->impl_->placeAgain(id_.index);
}

const Material& Shape::material() const
{
    TAMIAS_SHAPE_ROW(s);
    return s.def.material;
}

void Shape::setMaterial(const Material& material)
{
    TAMIAS_SHAPE_ROW(s);
    if (refuse(check(material))) return;
    if (w && material != s.def.material) w->impl_->disturbShape(id_.index);
    s.def.material = material;
}

Filter Shape::filter() const
{
    TAMIAS_SHAPE_ROW(s);
    return s.def.filter;
}

void Shape::setFilter(const Filter& filter)
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || filter == s.def.filter) return;
    w->impl_->disturbShape(id_.index);
    s.def.filter = filter;
    w->impl_->placeAgain(id_.index);
}

real Shape::density() const
{
    TAMIAS_SHAPE_ROW(s);
    return s.def.density;
}

void Shape::setDensity(real density)
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || refuse(checkRange("density", density, 0, 1e30, "must be finite and >= 0 kg/m^2"))) return;
    ShapeDef def = s.def;
    def.density = density;
    if (refuse(w->impl_->checkMassWith("density", def, s.body, id_.index))) return;
    if (density != s.def.density) w->impl_->disturb(s.body);
    s.def.density = density;
    w->impl_->updateMass(s.body);
}

std::uint64_t Shape::userData() const
{
    TAMIAS_SHAPE_ROW(s);
    return s.def.userData;
}

void Shape::setUserData(std::uint64_t value)
{
    TAMIAS_SHAPE_ROW(s);
    s.def.userData = value;
}

Aabb Shape::bounds() const
{
    TAMIAS_SHAPE_ROW(s);
    return w ? boundsOf(w->impl_->bodies.rows[s.body], s) : Aabb{};
}

bool Shape::contains(Position point) const
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || refuse(checkFinite("point", point, "must be finite m"))) return false;
    return containsPoint(w->impl_->bodies.rows[s.body], s, point);
}

void Shape::destroy()
{
    World* const w = alive();
    if (w) w->impl_->destroyShape(id_.index);
}

#undef TAMIAS_SHAPE_ROW

}  // namespace tamias2d::inline TAMIAS_PRECISION
