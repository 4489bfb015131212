// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const PrismaticJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisIn(kind.axis, pose);
    addSlide(axis, pose, out);
    out.add(RowKind::Rigid, JointSlot::kBlock + 1, turnJacobian(), static_cast<real>(pose.angle), true);

    const auto [way, along] = slideAlong(axis, pose);
    if (kind.spring) addSpring(*kind.spring, JointSlot::kSpring, along, way, pose.mass, false, out);
    addMotor(kind.motor, along, false, out);
    addLimits(kind.limits, along, way, false, out);
}

JointCoordinate coordinateOf(const PrismaticJoint& kind, const JointPose& pose)
{
    return slideAlong(axisIn(kind.axis, pose), pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
