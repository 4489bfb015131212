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
    b.type = def.type;
    b.enabled = def.enabled;
    b.allowSleep = def.allowSleep;
    b.lockX = def.lockX;
    b.lockY = def.lockY;
    b.lockRotation = def.lockRotation;
    b.angle = wrapAngle(def.angle);
    b.rotation = Rot::ofAngle(b.angle);
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
    if (def.type != BodyType::Static || def.linearDamping != 0 || def.angularDamping != 0 ||
        def.gravityScale != 1) {
        MoverRow& mover = bodies.moverFor(b);
        mover.linearDamping = def.linearDamping;
        mover.angularDamping = def.angularDamping;
        mover.gravityScale = def.gravityScale;
    }
    if (def.gravity || !def.name.empty() || def.userData != 0) {
        BodyExtra& extra = bodies.extraFor(b);
        extra.gravity = def.gravity;
        extra.name = def.name;
        extra.userData = def.userData;
    }
    tally(b, true);
    if (!def.awake && b.isDynamic() && maySleep())
        makeAsleep(body.index);
    else
        refreshPart(body.index);
    return body;
}

void World::Impl::destroyBody(BodyId body)
{
    disturb(body.index);
    while (!row(body).shapes.empty()) removeShape(shapes.lastOf(row(body).shapes));
    while (!joints.of(body.index).empty()) destroyJoint(joints.of(body.index).back());
    tally(row(body), false);
    if (row(body).takesPart) partsAreSorted = false;
    std::erase_if(laws, [&](const PlacedLaw& placed) {
        if (placed.body != body) return false;
        lawIds.giveBack(placed.id.index);
        return true;
    });
    forgetKept(row(body));
    bodies.clear(row(body));
    bodies.ids.giveBack(body.index);
}

ShapeId World::Impl::createShape(BodyId body, const ShapeDef& def)
{
    const ShapeId shape = shapes.ids.take();
    if (shape.index == shapes.rows.size()) shapes.rows.emplace_back();
    BodyRow& b = row(body);
    shapes.rows[shape.index].body = body.index;
    shapes.rows[shape.index].userData = def.userData;
    shapes.setForm(shape.index, def.geometry, def.offset, def.angle, b.localCenter);
    forgetKept(b);
    shapes.setSurface(shape.index, {def.density, def.material, def.filter});
    shapes.link(b.shapes, shape.index);
    if (b.enabled) ++census.shapes;
    shapeAdded(b, shape.index);
    return shape;
}

// What a new shape means for its body. One that sleeps alone, as it was made, sleeps on.
void World::Impl::shapeAdded(BodyRow& b, std::uint32_t slot)
{
    const std::uint32_t body = shapes.rows[slot].body;
    if (b.isAsleep() && !asleep.groups[b.group].contacts.empty()) wake(body);
    bodies.beginStillness(b);
    if (b.isDynamic())
        updateMass(body);
    else
        makeMassStale(body);
    if (b.enabled && !b.takesPart) place(slot, !b.isAsleep());
}

void World::Impl::makeMassStale(std::uint32_t slot)
{
    BodyRow& b = bodies.rows[slot];
    if (!b.massIsStale) staleMasses.push_back(slot);
    b.massIsStale = true;
}

void World::Impl::destroyShape(std::uint32_t slot)
{
    disturbShape(slot);
    removeShape(slot);
}

void World::Impl::removeShape(std::uint32_t slot)
{
    const std::uint32_t body = shapes.rows[slot].body;
    BodyRow& b = bodies.rows[body];
    endContacts(slot);
    resting.remove(slot);
    if (b.enabled) --census.shapes;
    shapes.unlink(b.shapes, slot);
    shapes.clear(slot);
    shapes.ids.giveBack(slot);
    if (b.isDynamic())
        updateMass(body);
    else
        makeMassStale(body);
}

// Contacts of a shape that leaves: those that touched are told as ended.
void World::Impl::endContacts(std::uint32_t slot)
{
    leaveLanes();
    std::erase_if(contacts.rows, [&](const Contact& contact) {
        if (contact.shapeA != slot && contact.shapeB != slot) return false;
        if (contact.touching) endsOfDestroyed.push_back(touchEvent(contact));
        return true;
    });
    contacts.order.clear();  // made anew in the next step
    pairsAreCurrent = false;
}

// The center of mass of the body has moved.
void World::Impl::rebuildConvex(std::uint32_t slot)
{
    const ShapeForm& form = shapes.form(slot);
    shapes.setForm(slot, form.geometry, form.offset, form.angle,
                   bodies.rows[shapes.rows[slot].body].localCenter);
    forgetKept(bodies.rows[shapes.rows[slot].body]);
}

// Mass, center and inertia from the shapes [DD1, DD14], as they would be with `def` in the place of the shape
// in `slot`, or beside all others if that is kNoShape.
MassSum World::Impl::massOfShapes(const BodyRow& b, std::uint32_t slot, const ShapeDef* def) const
{
    MassSum sum;
    DVec2 weighted;
    std::vector<std::pair<MassProperties, DVec2>> parts;
    const auto add = [&](const Solid& solid, Vec2 offset, double angle, real density) {
        const MassProperties part = massOf(solid, density);
        const DVec2 center = toDVec2(offset + rotate(Rot::ofAngle(wrapAngle(angle)), part.center));
        parts.emplace_back(part, center);
        sum.mass += static_cast<double>(part.mass);
        weighted += static_cast<double>(part.mass) * center;
    };
    for (const std::uint32_t s : shapes.of(b)) {
        const ShapeForm& form = shapes.form(s);
        if (def && s == slot)
            add(solidOf(def->geometry), def->offset, def->angle, def->density);
        else
            add(form.solid, form.offset, form.angle, shapes.surface(s).density);
    }
    if (def && slot == kNoShape) add(solidOf(def->geometry), def->offset, def->angle, def->density);
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
    b.massIsStale = false;
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
    pairsAreCurrent = false;
    ++joints.changes;
    b.localCenter = center;
    b.center = origin + toDVec2(rotate(b.rotation, center));
    b.velocity += cross(b.spin, rotate(b.rotation, center - before));
    if (center != before) {
        for (const std::uint32_t s : shapes.of(b)) rebuildConvex(s);
        if (b.enabled && !b.takesPart) placeAll(slot, false);
        const auto moveAnchors = [&](Table<Contact>& all) {  // they are seen from the center of mass
            for (Contact& contact : all) {
                for (ContactPointRow& point : contact.points) {
                    if (shapes.rows[contact.shapeA].body == slot) point.anchor.localA += before - center;
                    if (shapes.rows[contact.shapeB].body == slot) point.anchor.localB += before - center;
                }
            }
        };
        leaveLanes();
        moveAnchors(contacts.rows);
        if (b.isAsleep()) moveAnchors(asleep.groups[b.group].contacts);
        if (!b.isDynamic() && !asleep.isEmpty())
            for (SleepGroup& group : asleep.groups) moveAnchors(group.contacts);
    }
    b.extent = 0;
    for (const std::uint32_t s : shapes.of(b)) b.extent = maximum(b.extent, shapes.convex(s).extent);
}

TouchEvent World::Impl::touchEvent(const Contact& contact) const
{
    return {shapes.ids.id(contact.shapeA), shapes.ids.id(contact.shapeB),
            bodies.ids.id(shapes.rows[contact.shapeA].body), bodies.ids.id(shapes.rows[contact.shapeB].body)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
