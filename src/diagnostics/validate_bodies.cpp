// SPDX-License-Identifier: MIT
// What must hold of bodies and of their shapes.

#include "diagnostics/validate.hpp"

#include "geometry/validate.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void validateMotion(const BodyRow& b, real lengthUnit, Faults& faults)
{
    // A center of mass lies at most some greatest sizes away from an origin at the edge of the world.
    const double most = (kMaxPosition + 4 * kMaxSize) * static_cast<double>(lengthUnit);
    faults.range("center.x", b.center.x, -most, most, "must be within the world");
    faults.range("center.y", b.center.y, -most, most, "must be within the world");
    faults.that(b.angle >= 0 && b.angle < kTwoPi, "angle", b.angle, "must be in [0, 2 pi)");
    const Rot rotation = Rot::ofAngle(b.angle);
    faults.that(rotation.c == b.rotation.c && rotation.s == b.rotation.s, "rotation", b.rotation.s,
                "must be that of the angle");
    faults.finite("velocity", b.velocity);
    faults.finite("spin", b.spin);
    const bool still = b.velocity == Vec2{} && b.spin == 0;
    faults.that(b.type != BodyType::Static || still, "velocity", b.velocity, "must be 0 of a static body");
}

void validateMover(const MoverRow& mover, Faults& faults)
{
    faults.finite("previousCenter", mover.previousCenter);
    faults.that(mover.previousAngle >= 0 && mover.previousAngle < kTwoPi, "previousAngle",
                mover.previousAngle, "must be in [0, 2 pi)");
    faults.finite("previousLocalCenter", mover.previousLocalCenter);
    faults.range("linearDamping", mover.linearDamping, 0, kAnyFinite, "must be finite and >= 0 1/s");
    faults.range("angularDamping", mover.angularDamping, 0, kAnyFinite, "must be finite and >= 0 1/s");
    faults.finite("gravityScale", mover.gravityScale);
}

void validateMassOf(const BodyRow& b, Faults& faults)
{
    faults.finite("localCenter", b.localCenter);
    if (!b.isDynamic()) return;
    faults.that(isFiniteValue(b.mass) && b.mass > 0, "mass", b.mass, "must be finite and > 0 kg");
    faults.that(isFiniteValue(b.inertia) && b.inertia >= 0, "inertia", b.inertia,
                "must be finite and >= 0 kg*m^2");
    faults.finite("invMass", b.invMass());
    faults.finite("invInertia", b.invInertia());
}

void validateExtra(const BodyExtra& extra, Faults& faults)
{
    for (const LastingForce& held : extra.lasting) {
        faults.finite("lasting.force", held.force);
        faults.finite("lasting.point", held.point);
        faults.finite("lasting.torque", held.torque);
    }
    faults.finite("gravity", extra.gravity.value_or(Vec2{}));
}

// The shapes of a body, one after the other and back to the first.
void validateRing(const ShapeList& list, std::uint32_t body, const ShapeTable& shapes,
                  std::vector<bool>& seen, Faults& faults)
{
    std::uint32_t shape = list.first;
    for (std::uint32_t i = 0; i < list.count; ++i) {
        const bool lives = shape < shapes.rows.size() && shapes.ids.isAlive(shape);
        faults.that(lives && shapes.rows[shape].body == body, "shapes", shape, "must be a live shape of it");
        if (!lives) return;
        faults.that(!seen[shape], "shapes", shape, "must be of one body, once");
        if (seen[shape]) return;
        seen[shape] = true;
        const std::uint32_t next = shapes.rows[shape].next;
        const bool tied = next < shapes.rows.size() && shapes.rows[next].previous == shape;
        faults.that(tied, "next", next, "must come after it");
        shape = next;
    }
    if (!list.empty()) faults.that(shape == list.first, "next", shape, "must lead back to the first");
}

}  // namespace

void validateBodies(const BodyTable& bodies, const ShapeTable& shapes, real lengthUnit, Faults& faults)
{
    validateIds(bodies.ids, "bodies", bodies.rows.size(), faults);
    std::size_t owned = 0, movers = 0, extras = 0;
    std::vector<bool> seen(shapes.rows.size(), false);
    for (std::uint32_t slot = 0; slot < bodies.rows.size(); ++slot) {
        const BodyRow& b = bodies.rows[slot];
        faults.at("bodies", slot);
        if (!bodies.ids.isAlive(slot)) {
            faults.that(b.shapes.empty(), "shapes", b.shapes.size(), "must be none of a dead body");
            faults.that(b.mover == BodyRow::kNone && b.extra == BodyRow::kNone, "mover", b.mover,
                        "must be none of a dead body");
            continue;
        }
        const auto type = static_cast<int>(b.type);
        faults.that(type >= 0 && type <= 2, "type", type, "must be Static, Kinematic or Dynamic");
        validateMotion(b, lengthUnit, faults);
        validateMassOf(b, faults);
        faults.that(b.type == BodyType::Static || b.mover != BodyRow::kNone, "mover", b.mover,
                    "must be one unless it is static");
        validateMover(bodies.mover(b), faults);
        validateExtra(bodies.extra(b), faults);
        movers += b.mover != BodyRow::kNone ? 1 : 0;
        extras += b.extra != BodyRow::kNone ? 1 : 0;
        owned += b.shapes.size();
        validateRing(b.shapes, slot, shapes, seen, faults);
    }
    faults.at("bodies", 0);
    faults.that(movers == bodies.movers.size(), "movers", bodies.movers.size(), "must be of one body each");
    faults.that(extras == bodies.extras.size(), "extras", bodies.extras.size(), "must be of one body each");
    faults.at("shapes", 0);
    faults.that(owned == shapes.ids.alive(), "owned", owned, "must be all live shapes");
}

namespace {

// How many use each row of what shapes share.
template <class Table>
void validateUsers(const Table& table, const std::vector<std::uint32_t>& users, std::string_view name,
                   Faults& faults)
{
    std::size_t used = 0;
    for (std::uint32_t i = 0; i < table.slots(); ++i) {
        faults.at(name, i);
        faults.that(table.users(i) == users[i], "users", table.users(i), "must be the shapes that have it");
        used += users[i] > 0 ? 1 : 0;
    }
    faults.at(name, 0);
    faults.that(used == table.size(), "size", table.size(), "must be that of those in use");
}

void validateForm(const ShapeForm& form, std::uint32_t slot, Faults& faults)
{
    const Complaint wrong = checkGeometry("geometry", form.geometry);
    faults.that(!wrong, "def", slot, wrong ? std::string_view(wrong->what()) : std::string_view());

    const Convex& c = form.convex;
    faults.range("convex.count", c.count, 1, kMaxPolygonVertices, "must be in [1, 16]");
    faults.range("convex.radius", c.radius, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.range("convex.extent", c.extent, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.that(isFiniteValue(c.size) && c.size > 0, "convex.size", c.size, "must be finite and > 0 m");
    for (int i = 0; i < minimum(c.count, kMaxPolygonVertices); ++i) {
        const auto k = static_cast<std::size_t>(i);
        faults.finite("convex.vertices", c.vertices[k]);
        if (i >= c.faces()) continue;
        faults.unit("convex.normals", c.normals[k]);
    }
}

void validateSurface(const ShapeSurface& surface, Faults& faults)
{
    const Material& m = surface.material;
    faults.range("density", surface.density, 0, kAnyFinite, "must be finite and >= 0 kg/m^2");
    faults.range("material.friction", m.friction, 0, kAnyFinite, "must be >= 0");
    faults.range("material.restitution", m.restitution, 0, 1, "must be in [0, 1]");
    faults.range("material.rollingResistance", m.rollingResistance, 0, kAnyFinite, "must be >= 0");
}

}  // namespace

void validateShapes(const ShapeTable& shapes, const BodyTable& bodies, Faults& faults)
{
    validateIds(shapes.ids, "shapes", shapes.rows.size(), faults);
    std::vector<std::uint32_t> formUsers(shapes.forms.slots(), 0), surfaceUsers(shapes.surfaces.slots(), 0);
    for (std::uint32_t slot = 0; slot < shapes.rows.size(); ++slot) {
        const ShapeRow& s = shapes.rows[slot];
        faults.at("shapes", slot);
        if (!shapes.ids.isAlive(slot)) {
            faults.that(s.form == BodyRow::kNone && s.surface == BodyRow::kNone, "form", s.form,
                        "must be none of a dead shape");
            continue;
        }
        faults.that(s.body < bodies.rows.size() && bodies.ids.isAlive(s.body), "body", s.body,
                    "must be a live body");
        const bool hasBoth = s.form < formUsers.size() && s.surface < surfaceUsers.size();
        faults.that(hasBoth, "form", s.form, "must be one that there is");
        if (!hasBoth) continue;
        if (formUsers[s.form]++ == 0) validateForm(shapes.forms[s.form], slot, faults);
        if (surfaceUsers[s.surface]++ == 0) validateSurface(shapes.surfaces[s.surface], faults);
    }
    validateUsers(shapes.forms, formUsers, "forms", faults);
    validateUsers(shapes.surfaces, surfaceUsers, "surfaces", faults);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
