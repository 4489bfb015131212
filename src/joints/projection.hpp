// SPDX-License-Identifier: MIT
// Where bodies that joints tie may be at the end of a tick: docs/theory/joints.md, section 9.
#pragma once

#include "joints/tick.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Can the group be projected? Not with joints of one's own, nor where contacts touch it: they would have
/// answered to loads that it does not have then.
bool mayBeProjected(const JointSystem& system, const DirectGroup& group);

/// Brings the bodies of a group, measured by their masses, to the nearest place at the end of the tick where
/// its joints hold [eq. 15]. `velocities` are those that they would have without these, by node, and then
/// those that lead there. False if no such place was found, or if the way there would make energy: nothing
/// has changed then.
bool projectGroup(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                  const StepContext& context, JointSystem& system, DirectGroup& group,
                  std::vector<BodyMotion<real>>& velocities);

}  // namespace tamias2d::inline TAMIAS_PRECISION
