// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void measure(const GearJoint& kind, const JointPose& pose, JointRows& out)
{
    const double error =
        pose.angleA + pose.angle - static_cast<double>(kind.ratio) * pose.angleA - kind.phase;
    out.add(RowKind::Rigid, JointSlot::kBlock, {{}, {}, -kind.ratio, 1}, static_cast<real>(error), true);
}

JointCoordinate coordinateOf(const GearJoint&, const JointPose& pose)
{
    return {pose.angleA + pose.angle, {{}, {}, 0, 1}};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
