// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const RevoluteJoint& kind, const JointPose& pose, JointRows& out)
{
    addPoint(pose, out);
    const Jacobian turn = turnJacobian();
    if (kind.spring) addSpring(*kind.spring, JointSlot::kSpring, turn, pose.angle, pose.inertia, true, out);
    addMotor(kind.motor, turn, true, out);
    addLimits(kind.limits, turn, pose.angle, true, out);
}

JointCoordinate coordinateOf(const RevoluteJoint&, const JointPose& pose)
{
    return turnOf(pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
