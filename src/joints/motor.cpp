// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

namespace {

// Of B's anchor against A, along A's own axes.
void addLinear(const MotorJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axes[2] = {axisIn({1, 0}, pose), axisIn({0, 1}, pose)};
    const real speeds[2] = {kind.velocity.x, kind.velocity.y};
    for (int i = 0; i < 2; ++i) {
        const Jacobian j = slideJacobian(axes[i], pose);
        const auto place = static_cast<double>(dot(axes[i], pose.between));
        if (kind.linear)
            addSpring(*kind.linear, JointSlot::kSpring + i, j, place, pose.mass, false, out);
        else
            out.add(RowKind::Motor, JointSlot::kBlock + i, j, 0, false).speed = speeds[i];
        out.rows[out.count - 1].most = kind.maxForce;
    }
    out.rows[out.count - 1].pairBound = true;
}

void addAngular(const MotorJoint& kind, const JointPose& pose, JointRows& out)
{
    if (kind.angular)
        addSpring(*kind.angular, JointSlot::kSpring + 2, turnJacobian(), pose.angle, pose.inertia, true, out);
    else
        out.add(RowKind::Motor, JointSlot::kMotor, turnJacobian(), 0, true).speed = kind.spin;
    out.rows[out.count - 1].most = kind.maxTorque;
}

}  // namespace

void measure(const MotorJoint& kind, const JointPose& pose, JointRows& out)
{
    if (kind.maxForce > 0) addLinear(kind, pose, out);
    if (kind.maxTorque > 0) addAngular(kind, pose, out);
}

JointCoordinate coordinateOf(const MotorJoint&, const JointPose& pose)
{
    return turnOf(pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
