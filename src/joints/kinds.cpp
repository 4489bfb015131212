// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

JointFrames framesFor(const TargetJoint& k)
{
    return {{}, k.anchor, k.angle.value_or(0), &k.target, true};
}
JointFrames framesFor(const GrooveJoint& k)
{
    return {k.start, k.anchorB};
}
JointFrames framesFor(const FrictionJoint& k)
{
    return {{}, k.anchor};
}
template <class Kind>
JointFrames framesFor(const Kind& k)
{
    JointFrames frames;
    if constexpr (requires { k.anchorA; }) {
        frames.anchorA = k.anchorA;
        frames.anchorB = k.anchorB;
    }
    if constexpr (requires { k.referenceAngle; }) frames.reference = k.referenceAngle;
    if constexpr (requires { k.turns; }) frames.turns = k.turns;
    return frames;
}

}  // namespace

JointFrames framesOf(const JointKind& kind)
{
    return std::visit([](const auto& k) { return framesFor(k); }, kind);
}

Vec2 axisIn(Vec2 given, const JointPose& pose)
{
    const DVec2 axis = toDVec2(given);
    return rotate(pose.rotationA, toVec2((1 / length(axis)) * axis));
}

void addPoint(const JointPose& pose, JointRows& out)
{
    out.add(RowKind::Rigid, JointSlot::kBlock, pointJacobian({1, 0}, pose), pose.between.x, false);
    out.add(RowKind::Rigid, JointSlot::kBlock + 1, pointJacobian({0, 1}, pose), pose.between.y, false);
}

void addSlide(Vec2 axis, const JointPose& pose, JointRows& out)
{
    const Vec2 across = perpendicular(axis);
    out.add(RowKind::Rigid, JointSlot::kBlock, slideJacobian(across, pose), dot(across, pose.between), false);
}

void addSpring(const JointSpring& spring, int slot, const Jacobian& j, double position, real mass,
               bool angular, JointRows& out)
{
    const real error = static_cast<real>(position - static_cast<double>(spring.rest));
    ConstraintRow& row = out.add(RowKind::Spring, slot, j, error, angular);
    const real turn = static_cast<real>(kTwoPi) * spring.frequency;
    row.stiffness = mass * turn * turn;
    row.damping = 2 * spring.dampingRatio * mass * turn;
}

void addMotor(const std::optional<JointMotor>& motor, const Jacobian& j, bool angular, JointRows& out)
{
    if (!motor) return;
    ConstraintRow& row = out.add(RowKind::Motor, JointSlot::kMotor, j, 0, angular);
    row.speed = motor->speed;
    row.most = motor->maxForce;
}

void addLimits(const std::optional<JointLimits>& limits, const Jacobian& j, double position, bool angular,
               JointRows& out)
{
    if (!limits) return;
    const auto above = static_cast<real>(position - static_cast<double>(limits->lower));
    const auto below = static_cast<real>(static_cast<double>(limits->upper) - position);
    if (limits->lower > -kUnlimited) out.add(RowKind::Limit, JointSlot::kLower, j, above, angular);
    if (limits->upper < kUnlimited) out.add(RowKind::Limit, JointSlot::kUpper, -j, below, angular);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
