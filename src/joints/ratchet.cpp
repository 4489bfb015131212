// SPDX-License-Identifier: MIT
#include "joints/kinds.hpp"

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {

// Teeth are counted in the direction in which they let pass.
double toothAt(const RatchetJoint& kind, double angle)
{
    constexpr double kCaught = 1e-3;  // part of a tooth before it at which it is passed
    return std::floor(angle / static_cast<double>(kind.tooth) + kCaught);
}

void measure(const RatchetJoint& kind, const JointPose& pose, JointRows& out)
{
    const double past = pose.angle - pose.notch * static_cast<double>(kind.tooth);
    const bool forwards = kind.tooth > 0;
    out.add(RowKind::Limit, JointSlot::kLower, forwards ? turnJacobian() : -turnJacobian(),
            static_cast<real>(forwards ? past : -past), true);
}

JointCoordinate coordinateOf(const RatchetJoint&, const JointPose& pose)
{
    return turnOf(pose);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
