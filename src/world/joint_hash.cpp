// SPDX-License-Identifier: MIT
// A field added to a joint belongs here, too; of code its name.

#include "world/joint_hash.hpp"

#include "joints/own.hpp"
#include "world/hash_values.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

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

}  // namespace

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

}  // namespace tamias2d::inline TAMIAS_PRECISION
