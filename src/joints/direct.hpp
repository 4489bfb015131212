// SPDX-License-Identifier: MIT
// Groups of joints, and contacts, solved at once, exactly: docs/theory/joints.md, section 7.
#pragma once

#include "joints/direct_group.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One visit to all joints of the group together, that leaves nothing for another one. `velocities` are those
/// of its bodies, by node. Returns the greatest change of a velocity [m/s], or a negative number where no
/// solution was found; nothing has changed then.
real solveDirect(DirectGroup& group, std::vector<JointRows>& all, const Table<Motion>& motions,
                 std::vector<BodyMotion<real>>& velocities);

}  // namespace tamias2d::inline TAMIAS_PRECISION
