// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

// The groove's start is A's anchor.
void measure(const GrooveJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisIn(kind.end - kind.start, pose), across = perpendicular(axis);
    out.add(RowKind::Rigid, JointSlot::kBlock, slideJacobian(across, pose), dot(across, pose.between), false);

    const JointLimits ends{0, static_cast<real>(length(toDVec2(kind.end - kind.start)))};
    addLimits(ends, slideJacobian(axis, pose), static_cast<double>(dot(axis, pose.between)), false, out);
}

JointCoordinate coordinateOf(const GrooveJoint& kind, const JointPose& pose)
{
    const Vec2 axis = axisIn(kind.end - kind.start, pose);
    return {static_cast<double>(dot(axis, pose.between)), slideJacobian(axis, pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
