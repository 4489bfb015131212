// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

Vec2 axisOf(const PrismaticJoint& kind, const JointPose& pose)
{
    const DVec2 given = toDVec2(kind.axis);
    return rotate(pose.rotationA, toVec2((1 / length(given)) * given));
}

}  // namespace

void measure(const PrismaticJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisOf(kind, pose), across = perpendicular(axis);
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
    const Vec2 axis = axisOf(kind, pose);
    return {static_cast<double>(dot(axis, pose.between)), slideJacobian(axis, pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
