// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const RotaryJoint& kind, const JointPose& pose, JointRows& out)
{
    const Jacobian turn = turnJacobian();
    if (!kind.limits && !kind.motor && !kind.spring)
        out.add(RowKind::Rigid, JointSlot::kBlock, turn, static_cast<real>(pose.angle), true);
    if (kind.spring) addSpring(*kind.spring, JointSlot::kSpring, turn, pose.angle, pose.inertia, true, out);
    addMotor(kind.motor, turn, true, out);
    addLimits(kind.limits, turn, pose.angle, true, out);
}

JointCoordinate coordinateOf(const RotaryJoint&, const JointPose& pose)
{
    return turnOf(pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
