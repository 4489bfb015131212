// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const WeldJoint& kind, const JointPose& pose, JointRows& out)
{
    const Jacobian turn = turnJacobian();
    if (!kind.linear) addPoint(pose, out);
    if (!kind.angular)
        out.add(RowKind::Rigid, JointSlot::kBlock + 2, turn, static_cast<real>(pose.angle), true);

    if (kind.linear) {
        const Jacobian x = pointJacobian({1, 0}, pose), y = pointJacobian({0, 1}, pose);
        addSpring(*kind.linear, JointSlot::kSpring, x, static_cast<double>(pose.between.x), pose.mass, false,
                  out);
        addSpring(*kind.linear, JointSlot::kSpring + 1, y, static_cast<double>(pose.between.y), pose.mass,
                  false, out);
    }
    if (kind.angular)
        addSpring(*kind.angular, JointSlot::kSpring + 2, turn, pose.angle, pose.inertia, true, out);
}

JointCoordinate coordinateOf(const WeldJoint&, const JointPose& pose)
{
    return turnOf(pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
