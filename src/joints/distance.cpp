// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Along the line from anchor to anchor; where they meet, the line is any.
Vec2 lineOf(const JointPose& pose)
{
    const real distance = length(pose.between);
    return distance > 0 ? (1 / distance) * pose.between : Vec2{1, 0};
}

}  // namespace

void measure(const DistanceJoint& kind, const JointPose& pose, JointRows& out)
{
    const double distance = length(toDVec2(pose.between));
    const Vec2 line = lineOf(pose);
    const Jacobian j = pointJacobian(line, pose);
    out.distance = static_cast<real>(distance);
    out.across = pointJacobian(perpendicular(line), pose);
    if (!kind.limits && !kind.motor && !kind.spring) {
        const auto error = static_cast<real>(distance - static_cast<double>(kind.length));
        out.add(RowKind::Rigid, JointSlot::kBlock, j, error, false);
    }
    if (kind.spring) addSpring(*kind.spring, JointSlot::kSpring, j, distance, pose.mass, false, out);
    addMotor(kind.motor, j, false, out);
    std::optional<JointLimits> limits = kind.limits;
    if (limits && !(limits->lower > 0)) limits->lower = -kUnlimited;  // nothing is shorter than nothing
    addLimits(limits, j, distance, false, out);
    for (int i = 0; i < out.count; ++i) out.rows[i].bears = out.rows[i].kind == RowKind::Limit;
}

JointCoordinate coordinateOf(const DistanceJoint&, const JointPose& pose)
{
    return {length(toDVec2(pose.between)), pointJacobian(lineOf(pose), pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
