// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

// Motors that want nothing to move, at the place of A that is where B's anchor is.
void measure(const FrictionJoint& kind, const JointPose& pose, JointRows& out)
{
    for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}}) {
        const int slot = JointSlot::kBlock + out.count;
        out.add(RowKind::Motor, slot, slideJacobian(axis, pose), 0, false).most = kind.maxForce;
    }
    out.rows[out.count - 1].pairBound = true;
    out.add(RowKind::Motor, JointSlot::kMotor, turnJacobian(), 0, true).most = kind.maxTorque;
}

JointCoordinate coordinateOf(const FrictionJoint&, const JointPose& pose)
{
    return turnOf(pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
