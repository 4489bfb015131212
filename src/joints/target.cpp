// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const TargetJoint& kind, const JointPose& pose, JointRows& out)
{
    const JointSpring spring{kind.frequency, kind.dampingRatio, 0};
    const Jacobian x = pointJacobian({1, 0}, pose), y = pointJacobian({0, 1}, pose);
    addSpring(spring, JointSlot::kSpring, x, static_cast<double>(pose.between.x), pose.mass, false, out);
    addSpring(spring, JointSlot::kSpring + 1, y, static_cast<double>(pose.between.y), pose.mass, false, out);
    for (int i = out.count - 2; i < out.count; ++i) out.rows[i].most = kind.maxForce;
    out.rows[out.count - 1].pairBound = true;

    if (!kind.angle) return;
    addSpring(spring, JointSlot::kSpring + 2, turnJacobian(), pose.angle, pose.inertia, true, out);
    out.rows[out.count - 1].most = kind.maxTorque;
}

JointCoordinate coordinateOf(const TargetJoint&, const JointPose& pose)
{
    const real distance = length(pose.between);
    const Vec2 line = distance > 0 ? (1 / distance) * pose.between : Vec2{1, 0};
    return {static_cast<double>(distance), pointJacobian(line, pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
