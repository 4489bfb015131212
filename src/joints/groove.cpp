// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

// The groove's start is A's anchor.
void measure(const GrooveJoint& kind, const JointPose& pose, JointRows& out)
{
    const Vec2 axis = axisIn(kind.end - kind.start, pose);
    addSlide(axis, pose, out);

    const JointLimits ends{0, static_cast<real>(length(toDVec2(kind.end - kind.start)))};
    const auto [way, along] = slideAlong(axis, pose);
    addLimits(ends, along, way, false, out);
}

JointCoordinate coordinateOf(const GrooveJoint& kind, const JointPose& pose)
{
    return slideAlong(axisIn(kind.end - kind.start, pose), pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
