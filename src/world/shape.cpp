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

const ShapeSurface kNoSurface;

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
    [[maybe_unused]] const ShapeSurface& surface = w ? w->impl_->shapes.surface(id_.index) : kNoSurface;     \
    [[maybe_unused]] ShapeRow& name = w ? w->impl_->shapes.rows[id_.index] : deadShapeRow()

BodyId Shape::body() const
{
    TAMIAS_SHAPE_ROW(s);
    return w ? w->impl_->bodies.ids.id(s.body) : BodyId{};
}

ShapeDef Shape::definition() const
{
    TAMIAS_SHAPE_ROW(s);
    return w ? w->impl_->shapes.def(id_.index) : ShapeDef{};
}

void Shape::redefine(const ShapeDef& def)
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || refuse(check(def, w->impl_->settings.lengthUnit)) ||
        refuse(w->impl_->checkMassWith("ShapeDef.density", def, s.body, id_.index)))
        return;
    w->impl_->disturb(s.body);
    s.userData = def.userData;
    ShapeTable& shapes = w->impl_->shapes;
    shapes.setForm(id_.index, def.geometry, def.offset, def.angle, w->impl_->bodies.rows[s.body].localCenter);
    w->impl_->forgetKept(w->impl_->bodies.rows[s.body]);
    shapes.setSurface(id_.index, {def.density, def.material, def.filter});
    w->impl_->updateMass(s.body);
    w->impl_->placeAgain(id_.index);
}

Material Shape::material() const
{
    TAMIAS_SHAPE_ROW(s);
    return surface.material;
}

void Shape::setMaterial(const Material& material)
{
    TAMIAS_SHAPE_ROW(s);
    if (refuse(check(material))) return;
    if (!w) return;
    ShapeSurface changed = surface;
    if (material != surface.material) {
        w->impl_->disturbShape(id_.index);
        w->impl_->pairsAreCurrent = false;
    }
    changed.material = material;
    w->impl_->shapes.setSurface(id_.index, changed);
}

Filter Shape::filter() const
{
    TAMIAS_SHAPE_ROW(s);
    return surface.filter;
}

void Shape::setFilter(const Filter& filter)
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || filter == surface.filter) return;
    w->impl_->disturbShape(id_.index);
    ShapeSurface changed = surface;
    changed.filter = filter;
    w->impl_->shapes.setSurface(id_.index, changed);
    w->impl_->pairsAreCurrent = false;
    w->impl_->placeAgain(id_.index);
}

real Shape::density() const
{
    TAMIAS_SHAPE_ROW(s);
    return surface.density;
}

void Shape::setDensity(real density)
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || refuse(checkRange("density", density, 0, 1e30, "must be finite and >= 0 kg/m^2"))) return;
    ShapeDef def = w->impl_->shapes.def(id_.index);
    def.density = density;
    if (refuse(w->impl_->checkMassWith("density", def, s.body, id_.index))) return;
    if (density != surface.density) w->impl_->disturb(s.body);
    w->impl_->shapes.setSurface(id_.index, {def.density, def.material, def.filter});
    w->impl_->updateMass(s.body);
}

std::uint64_t Shape::userData() const
{
    TAMIAS_SHAPE_ROW(s);
    return s.userData;
}

void Shape::setUserData(std::uint64_t value)
{
    TAMIAS_SHAPE_ROW(s);
    s.userData = value;
}

Aabb Shape::bounds() const
{
    TAMIAS_SHAPE_ROW(s);
    return w ? boundsOf(w->impl_->bodies.rows[s.body], w->impl_->shapes.form(id_.index)) : Aabb{};
}

bool Shape::contains(Position point) const
{
    TAMIAS_SHAPE_ROW(s);
    if (!w || refuse(checkFinite("point", point, "must be finite m"))) return false;
    return containsPoint(w->impl_->bodies.rows[s.body], w->impl_->shapes.form(id_.index), point);
}

void Shape::destroy()
{
    World* const w = alive();
    if (w) w->impl_->destroyShape(id_.index);
}

#undef TAMIAS_SHAPE_ROW

}  // namespace tamias2d::inline TAMIAS_PRECISION
