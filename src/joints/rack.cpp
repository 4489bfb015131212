// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const RackJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisIn(kind.axis, pose);
    Jacobian j = slideJacobian(axis, pose);
    j.turnA += kind.radius;
    j.turnB -= kind.radius;
    const double turned = static_cast<double>(kind.radius) * pose.angle;
    const auto error = static_cast<double>(dot(axis, pose.between)) - turned - kind.offset;
    out.add(RowKind::Rigid, JointSlot::kBlock, j, static_cast<real>(error), false);
}

JointCoordinate coordinateOf(const RackJoint& kind, const JointPose& pose)
{
    const Vec2 axis = axisIn(kind.axis, pose);
    return {static_cast<double>(dot(axis, pose.between)), slideJacobian(axis, pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
