// SPDX-License-Identifier: MIT
// Creating and destroying: the only code that touches all tables at once.

#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

BodyId World::Impl::createBody(const BodyDef& def)
{
    const BodyId body = bodies.ids.take();
    if (body.index == bodies.rows.size()) bodies.rows.emplace_back();
    BodyRow& b = bodies.rows[body.index];
    b = {};
    b.type = def.type;
    b.enabled = def.enabled;
    b.lockX = def.lockX;
    b.lockY = def.lockY;
    b.lockRotation = def.lockRotation;
    b.angle = wrapAngle(def.angle);
    b.rotation = Rot::ofAngle(b.angle);
    b.linearDamping = def.linearDamping;
    b.angularDamping = def.angularDamping;
    b.gravityScale = def.gravityScale;
    b.gravity = def.gravity;
    b.name = def.name;
    b.userData = def.userData;
    if (def.type != BodyType::Static) {
        b.velocity = def.linearVelocity;
        b.spin = def.angularVelocity;
    }
    if (def.mass) {
        b.massIsSet = true;
        b.mass = def.mass->mass;
        b.inertia = def.mass->inertia;
        b.localCenter = def.mass->center;
    } else {
        b.mass = 1;  // of a body without shapes; it cannot turn
    }
    b.center = def.position + toDVec2(rotate(b.rotation, b.localCenter));
    b.previousCenter = b.center;
    b.previousAngle = b.angle;
    b.previousLocalCenter = b.localCenter;
    return body;
}

void World::Impl::destroyBody(BodyId body)
{
    while (!row(body).shapes.empty()) destroyShape(row(body).shapes.back());
    std::erase_if(laws, [&](const PlacedLaw& placed) {
        if (placed.body != body) return false;
        lawIds.giveBack(placed.id.index);
        return true;
    });
    row(body) = {};
    bodies.ids.giveBack(body.index);
}

ShapeId World::Impl::createShape(BodyId body, const ShapeDef& def)
{
    const ShapeId shape = shapes.ids.take();
    if (shape.index == shapes.rows.size()) shapes.rows.emplace_back();
    shapes.rows[shape.index] = {};
    shapes.rows[shape.index].body = body.index;
    shapes.rows[shape.index].def = def;
    row(body).shapes.push_back(shape.index);
    rebuildConvex(shape.index);
    updateMass(body.index);
    return shape;
}

void World::Impl::destroyShape(std::uint32_t slot)
{
    endContacts(slot);
    const std::uint32_t body = shapes.rows[slot].body;
    std::erase(bodies.rows[body].shapes, slot);
    shapes.rows[slot] = {};
    shapes.ids.giveBack(slot);
    updateMass(body);
}

// Contacts of a shape that leaves: those that touched are told as ended.
void World::Impl::endContacts(std::uint32_t slot)
{
    std::erase_if(contacts.rows, [&](const Contact& contact) {
        if (contact.shapeA != slot && contact.shapeB != slot) return false;
        if (contact.touching) endsOfDestroyed.push_back(touchEvent(contact));
        return true;
    });
    contacts.order.clear();  // made anew in the next step
}

void World::Impl::rebuildConvex(std::uint32_t slot)
{
    ShapeRow& shape = shapes.rows[slot];
    shape.convex = makeConvex(shape.def.geometry, shape.def.offset, Rot::ofAngle(wrapAngle(shape.def.angle)),
                              bodies.rows[shape.body].localCenter);
}

// Mass, center and inertia from the shapes [DD1, DD14], as they would be with `def` in the place of the shape
// in `slot`, or beside all others if that is kNoShape.
MassSum World::Impl::massOfShapes(const BodyRow& b, std::uint32_t slot, const ShapeDef* def) const
{
    MassSum sum;
    DVec2 weighted;
    std::vector<std::pair<MassProperties, DVec2>> parts;
    const auto add = [&](const ShapeDef& shape) {
        const MassProperties part = massProperties(shape.geometry, shape.density);
        const DVec2 center =
            toDVec2(shape.offset + rotate(Rot::ofAngle(wrapAngle(shape.angle)), part.center));
        parts.emplace_back(part, center);
        sum.mass += static_cast<double>(part.mass);
        weighted += static_cast<double>(part.mass) * center;
    };
    for (const std::uint32_t s : b.shapes) add(def && s == slot ? *def : shapes.rows[s].def);
    if (def && slot == kNoShape) add(*def);
    if (!(sum.mass > 0)) return sum;

    sum.center = (1 / sum.mass) * weighted;
    for (const auto& [part, center] : parts) {
        const DVec2 arm = center - sum.center;
        sum.inertia += static_cast<double>(part.inertia) + static_cast<double>(part.mass) * dot(arm, arm);
    }
    return sum;
}

Complaint World::Impl::checkMassWith(std::string_view field, const ShapeDef& def, std::uint32_t bodySlot,
                                     std::uint32_t slot) const
{
    const BodyRow& b = bodies.rows[bodySlot];
    if (b.massIsSet || !b.isDynamic()) return std::nullopt;
    return checkMass(field, textOf(def.density), massOfShapes(b, slot, &def));
}

void World::Impl::updateMass(std::uint32_t slot)
{
    BodyRow& b = bodies.rows[slot];
    const Position origin = b.origin();
    const Vec2 before = b.localCenter;
    if (!b.massIsSet) {
        const MassSum sum = massOfShapes(b);
        b.mass = sum.mass > 0 ? static_cast<real>(sum.mass) : real(1);
        b.localCenter = toVec2(sum.center);
        b.inertia = static_cast<real>(sum.inertia);
    }
    moveCenter(slot, origin, before, b.localCenter);
}

// The center of mass moves within the body: its origin stays where it is, and the velocity of its
// matter too.
void World::Impl::moveCenter(std::uint32_t slot, Position origin, Vec2 before, Vec2 center)
{
    BodyRow& b = bodies.rows[slot];
    b.localCenter = center;
    b.center = origin + toDVec2(rotate(b.rotation, center));
    b.velocity += cross(b.spin, rotate(b.rotation, center - before));
    if (center == before) return;
    for (const std::uint32_t s : b.shapes) rebuildConvex(s);
    for (Contact& contact : contacts.rows) {  // anchors are seen from the center of mass
        for (ContactPointRow& point : contact.points) {
            if (shapes.rows[contact.shapeA].body == slot) point.anchor.localA += before - center;
            if (shapes.rows[contact.shapeB].body == slot) point.anchor.localB += before - center;
        }
    }
}

TouchEvent World::Impl::touchEvent(const Contact& contact) const
{
    return {shapes.ids.id(contact.shapeA), shapes.ids.id(contact.shapeB),
            bodies.ids.id(shapes.rows[contact.shapeA].body), bodies.ids.id(shapes.rows[contact.shapeB].body)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
