// SPDX-License-Identifier: MIT
// One number for everything that decides how a world goes on: a field added to a table belongs here, too.
// Names, user data and the world's number decide nothing and are left out; of a force law, code cannot be
// hashed.

#include "geometry/bits.hpp"
#include "world/hash_values.hpp"
#include "world/impl.hpp"
#include "world/joint_hash.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void add(Hasher& hash, const WorldDef& def)
{
    add(hash, def.gravity);
    hash.add(def.gravitationConstant);
    hash.add(def.lengthUnit);
    addFlags(hash, def.frictionMixing, def.restitutionMixing);
    const Tuning& t = def.tuning;
    for (const real value : {t.restGap, t.touchingFactor, t.pushRate, t.pushSpeed, t.pushSlack, t.restless,
                             t.calmRate, t.calmSpeed, t.quiet, t.impactThreshold})
        hash.add(value);
    for (const int value : {t.extraPasses, t.settlingPasses, t.crowd, t.impactsPerContact})
        hash.add(static_cast<std::uint64_t>(value));
    hash.add(t.sleepTime);
    hash.add(t.sleepSpeed);
    addFlags(hash, def.allowSleep);
}

void add(Hasher& hash, const ShapeForm& form, const ShapeSurface& surface)
{
    addBits(hash, form.geometry);
    add(hash, form.offset);
    hash.add(form.angle);
    const Material& m = surface.material;
    for (const real value : {surface.density, m.friction, m.restitution, m.rollingResistance, m.surfaceSpeed})
        hash.add(value);
    addFlags(hash, m.frictionMixing, m.restitutionMixing);
    hash.add(surface.filter.category);
    hash.add(surface.filter.mask);
    hash.add(static_cast<std::uint64_t>(surface.filter.group));
}

void add(Hasher& hash, const BodyRow& b, const MoverRow& mover, const BodyExtra& extra)
{
    addFlags(hash, b.allowSleep, b.isAsleep());
    hash.add(mover.stillTime);
    hash.add(mover.stillSpeed);
    addFlags(hash, b.type, b.enabled, b.lockX, b.lockY, b.lockRotation, b.massIsSet,
             extra.gravity.has_value());
    add(hash, b.center);
    hash.add(b.angle);
    add(hash, b.localCenter);
    for (const real value :
         {b.velocity.x, b.velocity.y, b.spin, b.mass, b.inertia, mover.stepForce.x, mover.stepForce.y,
          mover.stepTorque, mover.linearDamping, mover.angularDamping, mover.gravityScale})
        hash.add(value);
    add(hash, extra.gravity.value_or(Vec2{}));
    hash.add(std::uint64_t{extra.lasting.size()});
    for (const LastingForce& f : extra.lasting) {
        add(hash, f.force);
        add(hash, f.point);
        addFlags(hash, f.forceTurns, f.pointTurns);
        hash.add(f.torque);
    }
}

void add(Hasher& hash, const Contact& c)
{
    hash.add((std::uint64_t{c.shapeA} << 32) | c.shapeB);
    addFlags(hash, c.count, c.touching);
    hash.add(c.rollingImpulse);
    if (c.stiffSteps != 0) hash.add(static_cast<std::uint64_t>(c.stiffSteps));
    for (int i = 0; i < c.count; ++i) {
        hash.add(c.points[i].normalImpulse);
        hash.add(c.points[i].tangentImpulse);
    }
}

}  // namespace

// Out of memory there is nothing to go on with. NOLINTNEXTLINE(bugprone-exception-escape)
std::uint64_t World::stateHash() const noexcept
{
    impl_->settle();
    impl_->sortContacts();
    impl_->solverScratch.passes.tell(impl_->contacts);
    Hasher hash;
    hash.add(impl_->time);
    hash.add(impl_->steps);
    add(hash, impl_->settings);
    for (const PlacedLaw& placed : impl_->laws) {
        hash.add(std::uint64_t{placed.body.index});
        add(hash, placed.law.name);
        add(hash, placed.law.parameters);
    }
    for (std::uint32_t slot = 0; slot < impl_->bodies.rows.size(); ++slot) {
        if (!impl_->bodies.ids.isAlive(slot)) continue;
        const BodyRow& body = impl_->bodies.rows[slot];
        hash.add(std::uint64_t{slot});
        add(hash, body, impl_->bodies.mover(body), impl_->bodies.extra(body));
        hash.add(std::uint64_t{body.shapes.size()});
        for (const std::uint32_t shape : impl_->shapes.of(body)) {
            hash.add(std::uint64_t{shape});
            add(hash, impl_->shapes.form(shape), impl_->shapes.surface(shape));
        }
        if (!body.isAsleep()) continue;
        // Who wakes with it, and what they carry; told once, by the first of a group.
        const SleepGroup& group = impl_->asleep.groups[body.group];
        hash.add(std::uint64_t{group.bodies.front()});
        if (group.bodies.front() == slot)
            for (const Contact& contact : group.contacts) add(hash, contact);
    }
    for (const Contact& contact : impl_->contacts.rows) add(hash, contact);
    for (std::uint32_t slot = 0; slot < impl_->joints.rows.size(); ++slot) {
        if (!impl_->joints.ids.isAlive(slot)) continue;
        hash.add(std::uint64_t{slot});
        add(hash, impl_->joints.rows[slot]);
        addRows(hash, impl_->joints.rows[slot], impl_->bodies);
    }
    return hash.value();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
