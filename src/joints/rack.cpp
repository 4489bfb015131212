// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const RackJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisIn(kind.axis, pose);
    auto [way, j] = slideAlong(axis, pose);
    j.turnA += kind.radius;
    j.turnB -= kind.radius;
    const double turned = static_cast<double>(kind.radius) * pose.angle;
    const double error = way - turned - kind.offset;
    out.add(RowKind::Rigid, JointSlot::kBlock, j, static_cast<real>(error), false);
}

JointCoordinate coordinateOf(const RackJoint& kind, const JointPose& pose)
{
    return slideAlong(axisIn(kind.axis, pose), pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
