// SPDX-License-Identifier: MIT
#include <tamias2d/world/joint.hpp>

#include "joints/kinds.hpp"
#include "joints/reading.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

JointRow& deadJointRow()
{
    static thread_local JointRow row;
    return row = {};
}

}  // namespace

bool Joint::isAlive() const noexcept
{
    return world_ != nullptr && world_->impl_->joints.ids.owns(id_);
}

World* Joint::alive() const
{
    if (isAlive()) return world_;
    fail(
        InputError("Joint", id_.isNull() ? "null" : textOf(id_.index), "must be a live joint of this world"));
    return nullptr;
}

// The row, or a fresh one that nobody keeps when a dead handle was let pass by the error handler.
#define TAMIAS_JOINT_ROW(name)                                                                               \
    World* const w = alive();                                                                                \
    JointRow& name = w ? w->impl_->joints.rows[id_.index] : deadJointRow()

JointDef Joint::definition() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def;
}

BodyId Joint::bodyA() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.bodyA;
}

BodyId Joint::bodyB() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.bodyB;
}

const std::string& Joint::name() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.name;
}

void Joint::setName(std::string_view name)
{
    TAMIAS_JOINT_ROW(j);
    j.def.name = name;
}

std::uint64_t Joint::userData() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.userData;
}

void Joint::setUserData(std::uint64_t value)
{
    TAMIAS_JOINT_ROW(j);
    j.def.userData = value;
}

const JointKind& Joint::kind() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.kind;
}

void Joint::setKind(const JointKind& kind)
{
    TAMIAS_JOINT_ROW(j);
    if (!w || refuse(check(kind, w->impl_->settings.lengthUnit))) return;
    w->impl_->disturbJoint(id_.index);
    if (kind.index() != j.def.kind.index()) std::fill(std::begin(j.impulses), std::end(j.impulses), real(0));
    j.def.kind = kind;
}

bool Joint::isEnabled() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.enabled;
}

void Joint::setEnabled(bool enabled)
{
    TAMIAS_JOINT_ROW(j);
    if (w && enabled != j.def.enabled) w->impl_->disturbJoint(id_.index);
    if (enabled) j.broken = false;
    if (!enabled) std::fill(std::begin(j.impulses), std::end(j.impulses), real(0));
    j.def.enabled = enabled;
}

bool Joint::isBroken() const
{
    TAMIAS_JOINT_ROW(j);
    return j.broken;
}

bool Joint::collidesConnected() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.collideConnected;
}

void Joint::setCollideConnected(bool collide)
{
    TAMIAS_JOINT_ROW(j);
    if (w && collide != j.def.collideConnected) w->impl_->disturbJoint(id_.index);
    j.def.collideConnected = collide;
}

const JointBreaking& Joint::breaking() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.breaking;
}

void Joint::setBreaking(const JointBreaking& breaking)
{
    TAMIAS_JOINT_ROW(j);
    if (!w || refuse(check(breaking))) return;
    w->impl_->disturbJoint(id_.index);
    j.def.breaking = breaking;
}

void Joint::setMotorSpeed(real speed)
{
    TAMIAS_JOINT_ROW(j);
    if (!w) return;
    JointKind changed = j.def.kind;
    const bool hasMotor = std::visit(
        [&](auto& k) {
            if constexpr (HasMotor<decltype(k)>) {
                if (!k.motor) return false;
                k.motor->speed = speed;
                return true;
            } else {
                return false;
            }
        },
        changed);
    if (refuse(checkThat(hasMotor, "speed", speed, "must be given to a joint that has a motor"))) return;
    setKind(changed);
}

void Joint::setTarget(Position target)
{
    TAMIAS_JOINT_ROW(j);
    if (!w) return;
    JointKind changed = j.def.kind;
    auto* const kind = std::get_if<TargetJoint>(&changed);
    if (refuse(checkThat(kind != nullptr, "target", target, "must be given to a TargetJoint"))) return;
    kind->target = target;
    setKind(changed);
}

Position Joint::anchorA() const
{
    TAMIAS_JOINT_ROW(j);
    if (!w) return {};
    const JointFrames frames = framesOf(j.def.kind);
    return frames.place ? *frames.place : toWorld(w->body(j.def.bodyA).transform(), frames.anchorA);
}

Position Joint::anchorB() const
{
    TAMIAS_JOINT_ROW(j);
    if (!w) return {};
    return toWorld(w->body(j.def.bodyB).transform(), framesOf(j.def.kind).anchorB);
}

JointReading Joint::reading() const
{
    TAMIAS_JOINT_ROW(j);
    return w ? readJoint(j, w->impl_->bodies, w->impl_->stepTime) : JointReading{};
}

void Joint::destroy()
{
    World* const w = alive();
    if (w) w->impl_->destroyJoint(id_.index);
}

#undef TAMIAS_JOINT_ROW

namespace {

// Bodies, the anchors of one place on both, and the angle between them.
template <class Kind>
JointDef holdAt(const Body& a, const Body& b, Position anchor, Kind kind)
{
    kind.anchorA = toLocal(a.transform(), anchor);
    kind.anchorB = toLocal(b.transform(), anchor);
    kind.referenceAngle = b.angle() - a.angle();
    JointDef def;
    def.bodyA = a.id();
    def.bodyB = b.id();
    def.kind = kind;
    return def;
}

}  // namespace

JointDef revoluteAt(const Body& a, const Body& b, Position anchor)
{
    return holdAt(a, b, anchor, RevoluteJoint{});
}

JointDef weldAt(const Body& a, const Body& b, Position anchor)
{
    return holdAt(a, b, anchor, WeldJoint{});
}

JointDef slideAlong(const Body& a, const Body& b, Position anchor, Vec2 axis)
{
    PrismaticJoint kind;
    kind.axis = inverseRotate(a.transform().rotation, axis);
    return holdAt(a, b, anchor, kind);
}

JointDef rodBetween(const Body& a, const Body& b, Position onA, Position onB)
{
    DistanceJoint kind;
    kind.anchorA = toLocal(a.transform(), onA);
    kind.anchorB = toLocal(b.transform(), onB);
    kind.length = static_cast<real>(length(onB - onA));
    JointDef def;
    def.bodyA = a.id();
    def.bodyB = b.id();
    def.kind = kind;
    return def;
}

JointDef dragAt(const Body& hand, const Body& b, Position point)
{
    TargetJoint kind;
    kind.anchor = toLocal(b.transform(), point);
    kind.target = point;
    JointDef def;
    def.bodyA = hand.id();
    def.bodyB = b.id();
    def.kind = kind;
    return def;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
