// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

namespace {

// From a wheel to where the rope holds a body.
struct End {
    double length = 0;
    Vec2 line;
};

End endOf(Vec2 hang)
{
    const double distance = length(toDVec2(hang));
    return {distance, distance > 0 ? toVec2((1 / distance) * toDVec2(hang)) : Vec2{0, -1}};
}

// How an end lengthens.
Jacobian endJacobianA(const End& end, const JointPose& pose)
{
    return {end.line, {}, cross(pose.armA, end.line), 0};
}
Jacobian endJacobianB(const End& end, const JointPose& pose)
{
    return {{}, end.line, 0, cross(pose.armB, end.line)};
}

}  // namespace

void measure(const PulleyJoint& kind, const JointPose& pose, JointRows& out)
{
    const End a = endOf(pose.hangA), b = endOf(pose.hangB);
    const Jacobian onA = endJacobianA(a, pose), onB = endJacobianB(b, pose);
    const Jacobian rope{onA.linearA, kind.ratio * onB.linearB, onA.turnA, kind.ratio * onB.turnB};
    const auto over = static_cast<real>(a.length + static_cast<double>(kind.ratio) * b.length -
                                        static_cast<double>(kind.length));
    if (kind.taut)
        out.add(RowKind::Rigid, JointSlot::kBlock, rope, over, false);
    else
        out.add(RowKind::Limit, JointSlot::kRope, -rope, -over, false);
    out.add(RowKind::Limit, JointSlot::kLower, onA,
            static_cast<real>(a.length - static_cast<double>(kind.stopA)), false);
    out.add(RowKind::Limit, JointSlot::kUpper, onB,
            static_cast<real>(b.length - static_cast<double>(kind.stopB)), false);
}

JointCoordinate coordinateOf(const PulleyJoint&, const JointPose& pose)
{
    const End a = endOf(pose.hangA);
    return {a.length, endJacobianA(a, pose)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
