// SPDX-License-Identifier: MIT
#include <tamias2d/world/joint.hpp>

#include "joints/own.hpp"
#include "joints/reading.hpp"
#include "world/impl.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

JointRow& deadJointRow()
{
    static thread_local JointRow row;
    return row = {};
}

// The part of an angle that is whole turns.
double wholeTurns(double angle)
{
    return kTwoPi * std::floor(angle / kTwoPi + 0.5);
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
    JointDef def = j.def;
    if (!w) return def;
    // A twin begins to count turns anew: what those of this one have added goes into its phase.
    const double angleA = w->impl_->row(def.bodyA).angle, angleB = w->impl_->row(def.bodyB).angle;
    if (auto* gear = std::get_if<GearJoint>(&def.kind)) {
        const double turns = countTurns(0, angleA, j.angleA) - angleA;
        const double phase = gear->phase + static_cast<double>(gear->ratio) * turns;
        if (turns != 0) gear->phase = phase - wholeTurns(phase);
    }
    std::visit(
        [&](auto& kind) {
            if constexpr (requires { kind.turns; }) {
                const double begun = countTurns(angleA, angleB, kind.referenceAngle);
                kind.turns =
                    static_cast<int>(wholeTurns(countTurns(angleA, angleB, j.angle) - begun) / kTwoPi);
            }
        },
        def.kind);
    if (auto* rack = std::get_if<RackJoint>(&def.kind))
        rack->offset += static_cast<double>(rack->radius) * wholeTurns(countTurns(angleA, angleB, j.angle));
    return def;
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

std::vector<BodyId> Joint::bodies() const
{
    TAMIAS_JOINT_ROW(j);
    std::vector<BodyId> all;
    if (w) j.eachBody([&](std::uint32_t body) { all.push_back(w->impl_->bodies.ids.id(body)); });
    return all;
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
    std::uint32_t layout = 0;
    if (!w || refuse(w->impl_->checkKind(j.def, kind, layout))) return;
    w->impl_->disturbJoint(id_.index);
    if (kind.index() != j.def.kind.index() || layout != j.layout) j.forgetLoads();
    j.layout = layout;
    const bool counts = countsAlike(kind, j.def.kind);
    j.def.kind = kind;
    if (!counts) beginCount(j, w->impl_->row(j.def.bodyA).angle, w->impl_->row(j.def.bodyB).angle);
    if (layout == 0) j.angles.clear();
    if (layout != 0 && j.angles.empty()) beginOwnCount(j, w->impl_->bodies);
}

bool Joint::isEnabled() const
{
    TAMIAS_JOINT_ROW(j);
    return j.def.enabled;
}

void Joint::setEnabled(bool enabled)
{
    TAMIAS_JOINT_ROW(j);
    if (w && enabled != j.def.enabled) {
        j.overTime = 0;
        w->impl_->disturbJoint(id_.index);
        // Gears and ratchets have turned freely meanwhile.
        const bool counts =
            std::holds_alternative<GearJoint>(j.def.kind) || std::holds_alternative<RatchetJoint>(j.def.kind);
        if (enabled && counts)
            beginCount(j, w->impl_->row(j.def.bodyA).angle, w->impl_->row(j.def.bodyB).angle);
    }
    if (enabled) j.broken = false;
    if (!enabled) j.forgetLoads();
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
    j.overTime = 0;
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
    if (j.layout != 0) return ownAnchorsOf(j, w->impl_->bodies).first;
    const JointFrames frames = framesOf(j.def.kind);
    return frames.place ? *frames.place : toWorld(w->body(j.def.bodyA).transform(), frames.anchorA);
}

Position Joint::anchorB() const
{
    TAMIAS_JOINT_ROW(j);
    if (!w) return {};
    if (j.layout != 0) return ownAnchorsOf(j, w->impl_->bodies).second;
    return toWorld(w->body(j.def.bodyB).transform(), framesOf(j.def.kind).anchorB);
}

JointReading Joint::reading() const
{
    TAMIAS_JOINT_ROW(j);
    return w ? readJoint(j, w->impl_->bodies, w->impl_->stepTime) : JointReading{};
}

std::vector<JointRowReading> Joint::rowReadings() const
{
    TAMIAS_JOINT_ROW(j);
    return w ? readRows(j, w->impl_->bodies, w->impl_->stepTime) : std::vector<JointRowReading>{};
}

void Joint::destroy()
{
    World* const w = alive();
    if (w) w->impl_->destroyJoint(id_.index);
}

#undef TAMIAS_JOINT_ROW

}  // namespace tamias2d::inline TAMIAS_PRECISION
