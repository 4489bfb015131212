// SPDX-License-Identifier: MIT
// One number for everything that decides how a world goes on: a field added to a table belongs here, too.
// Names, user data and the world's number decide nothing and are left out; of a force law, code cannot be
// hashed.

#include "base/hash.hpp"
#include "geometry/bits.hpp"
#include "joints/own.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void add(Hasher& hash, Vec2 v)
{
    hash.add(v.x);
    hash.add(v.y);
}

void add(Hasher& hash, Position p)
{
    hash.add(p.x);
    hash.add(p.y);
}

template <class... Flags>
void addFlags(Hasher& hash, Flags... flags)
{
    std::uint64_t bits = 1;
    ((bits = bits << 8 | static_cast<std::uint64_t>(flags)), ...);
    hash.add(bits);
}

void add(Hasher& hash, const std::string& text)
{
    hash.add(std::uint64_t{text.size()});
    for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
}

void add(Hasher& hash, const WorldDef& def)
{
    add(hash, def.gravity);
    hash.add(def.gravitationConstant);
    hash.add(def.lengthUnit);
    addFlags(hash, def.frictionMixing, def.restitutionMixing);
    const Tuning& t = def.tuning;
    for (const real value : {t.restGap, t.touchingFactor, t.pushRate, t.pushSpeed, t.pushSlack, t.restless,
                             t.calmRate, t.calmSpeed, t.impactThreshold})
        hash.add(value);
    for (const int value : {t.extraPasses, t.crowd, t.impactsPerContact})
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

void add(Hasher& hash, const std::optional<JointLimits>& limits)
{
    addFlags(hash, limits.has_value());
    if (!limits) return;
    hash.add(limits->lower);
    hash.add(limits->upper);
}

void add(Hasher& hash, const std::optional<JointMotor>& motor)
{
    addFlags(hash, motor.has_value());
    if (!motor) return;
    hash.add(motor->speed);
    hash.add(motor->maxForce);
}

void add(Hasher& hash, const std::optional<JointSpring>& spring)
{
    addFlags(hash, spring.has_value());
    if (!spring) return;
    for (const real value : {spring->frequency, spring->dampingRatio, spring->rest}) hash.add(value);
}

// What may stand at a kind's free coordinate.
template <class Kind>
void addFree(Hasher& hash, const Kind& k)
{
    add(hash, k.limits);
    add(hash, k.motor);
    add(hash, k.spring);
}

void add(Hasher& hash, const RevoluteJoint& k)
{
    hash.add(k.referenceAngle);
    addFree(hash, k);
}

void add(Hasher& hash, const DistanceJoint& k)
{
    hash.add(k.length);
    addFree(hash, k);
}

void add(Hasher& hash, const PrismaticJoint& k)
{
    add(hash, k.axis);
    hash.add(k.referenceAngle);
    addFree(hash, k);
}

void add(Hasher& hash, const WeldJoint& k)
{
    hash.add(k.referenceAngle);
    add(hash, k.linear);
    add(hash, k.angular);
}

void add(Hasher& hash, const TargetJoint& k)
{
    add(hash, k.target);
    addFlags(hash, k.angle.has_value());
    hash.add(k.angle.value_or(0));
    for (const real value : {k.frequency, k.dampingRatio, k.maxForce, k.maxTorque}) hash.add(value);
}

void add(Hasher& hash, const WheelJoint& k)
{
    add(hash, k.axis);
    addFree(hash, k);
}

void add(Hasher& hash, const GrooveJoint& k)
{
    add(hash, k.end);
}

void add(Hasher& hash, const RotaryJoint& k)
{
    hash.add(k.referenceAngle);
    addFree(hash, k);
}

void add(Hasher& hash, const RatchetJoint& k)
{
    hash.add(k.referenceAngle);
    hash.add(k.tooth);
}

void add(Hasher& hash, const GearJoint& k)
{
    hash.add(k.ratio);
    hash.add(k.phase);
}

void add(Hasher& hash, const RackJoint& k)
{
    add(hash, k.axis);
    hash.add(k.radius);
    hash.add(k.offset);
}

void add(Hasher& hash, const PulleyJoint& k)
{
    add(hash, k.wheelA);
    add(hash, k.wheelB);
    for (const real value : {k.ratio, k.length, k.stopA, k.stopB}) hash.add(value);
    addFlags(hash, k.taut);
}

void add(Hasher& hash, const MotorJoint& k)
{
    hash.add(k.referenceAngle);
    add(hash, k.linear);
    add(hash, k.angular);
    add(hash, k.velocity);
    for (const real value : {k.spin, k.maxForce, k.maxTorque}) hash.add(value);
}

void add(Hasher& hash, const FrictionJoint& k)
{
    hash.add(k.maxForce);
    hash.add(k.maxTorque);
}

void add(Hasher&, const FilterJoint&) {}

// Of code its name.
void add(Hasher& hash, const OwnJoint& k)
{
    add(hash, std::string(k.name()));
}

// And what it asks for now.
void addRows(Hasher& hash, const JointRow& j, const BodyTable& bodies)
{
    if (j.layout == 0) return;
    for (const std::uint32_t body : j.more) hash.add(std::uint64_t{body});
    for (const CountedAngle& angle : j.angles) {
        hash.add(angle.now);
        hash.add(angle.start);
    }
    JointRows rows;
    MoreBodies more;
    measureOwn(j, ownPoseOf(j, bodies), rows, &more);
    for (int i = 0; i < rows.count; ++i) {
        const ConstraintRow& row = rows.rows[i];
        for (const real value :
             {row.j.linearA.x, row.j.linearA.y, row.j.turnA, row.j.linearB.x, row.j.linearB.y, row.j.turnB,
              row.error, row.stiffness, row.damping, row.speed, row.most})
            hash.add(value);
        for (std::size_t k = 0; k < j.more.size(); ++k)
            for (const real value :
                 {more.parts[i][k].linear.x, more.parts[i][k].linear.y, more.parts[i][k].turn})
                hash.add(value);
    }
}

void add(Hasher& hash, const JointRow& j)
{
    hash.add((std::uint64_t{j.bodyA} << 32) | j.bodyB);
    const JointFrames frames = framesOf(j.def.kind);
    addFlags(hash, j.def.kind.index(), j.def.collideConnected, j.def.enabled, j.broken, j.held[0], j.held[1],
             j.held[2]);
    add(hash, frames.anchorA);
    add(hash, frames.anchorB);
    std::visit([&](const auto& kind) { add(hash, kind); }, j.def.kind);
    for (const real value : {j.def.breaking.force, j.def.breaking.torque, j.def.breaking.error})
        hash.add(value);
    if (j.def.breaking.window > 0) {
        hash.add(j.def.breaking.window);
        hash.add(j.overTime);
    }
    for (const double value : {j.angle, j.angleA, j.notch}) hash.add(value);
    for (const real impulse : j.impulses) hash.add(impulse);
}

}  // namespace

// Out of memory there is nothing to go on with. NOLINTNEXTLINE(bugprone-exception-escape)
std::uint64_t World::stateHash() const noexcept
{
    impl_->settle();
    impl_->sortContacts();
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
