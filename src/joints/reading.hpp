// SPDX-License-Identifier: MIT
#pragma once

#include "model/bodies.hpp"
#include "model/joints.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where the joint is now, and what it did in the last step, which took `dt`; all zero if it does not act.
JointReading readJoint(const JointRow& joint, const BodyTable& bodies, double dt);

/// Stored in the springs of all joints that act, now.   [J]
double springEnergy(const JointTable& joints, const BodyTable& bodies);

}  // namespace tamias2d::inline TAMIAS_PRECISION
