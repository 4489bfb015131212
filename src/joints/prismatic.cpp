// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const PrismaticJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisIn(kind.axis, pose), across = perpendicular(axis);
    out.add(RowKind::Rigid, JointSlot::kBlock, slideJacobian(across, pose), dot(across, pose.between), false);
    out.add(RowKind::Rigid, JointSlot::kBlock + 1, turnJacobian(), static_cast<real>(pose.angle), true);

    const Jacobian along = slideJacobian(axis, pose);
    const auto way = static_cast<double>(dot(axis, pose.between));
    if (kind.spring) addSpring(*kind.spring, JointSlot::kSpring, along, way, pose.mass, false, out);
    addMotor(kind.motor, along, false, out);
    addLimits(kind.limits, along, way, false, out);
}

JointCoordinate coordinateOf(const PrismaticJoint& kind, const JointPose& pose)
{
    const Vec2 axis = axisIn(kind.axis, pose);
    return {static_cast<double>(dot(axis, pose.between)), slideJacobian(axis, pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
