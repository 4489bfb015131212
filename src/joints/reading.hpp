// SPDX-License-Identifier: MIT
#pragma once

#include "model/bodies.hpp"
#include "model/joints.hpp"

#include <utility>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where the joint is now, and what it did in the last step, which took `dt`; all zero if it does not act.
JointReading readJoint(const JointRow& joint, const BodyTable& bodies, double dt);

/// What each of its rows did, and where it is now: rigid ones first; none if it does not act.
std::vector<JointRowReading> readRows(const JointRow& joint, const BodyTable& bodies, double dt);

/// Where a joint of one's own holds A and B now.
std::pair<Position, Position> ownAnchorsOf(const JointRow& joint, const BodyTable& bodies);

/// Stored in the springs of all joints that act, now.   [J]
double springEnergy(const JointTable& joints, const BodyTable& bodies);

}  // namespace tamias2d::inline TAMIAS_PRECISION
