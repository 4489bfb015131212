// SPDX-License-Identifier: MIT
// Do the passes of a tick make energy? docs/theory/joints.md, section 9.
#pragma once

#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "model/contacts.hpp"
#include "solver/tick_rows.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Kinetic energy of some bodies in a tick, twice [J], and what may add to it.
struct TickEnergy {
    double begun = 0;  // after the first kick, without what contacts and joints carry
    double ended = 0;  // after passes
    double mass = 0;   // of what errors that come back move   [kg]
    real drive = 0;    // what motors, springs and moving grounds may add to a speed   [m/s]
    real turn = 0;     // the fastest in the tick   [rad]

    /// One more body, with its velocity after the passes.
    void add(const TickRows& lanes, const Motion& motion, std::uint32_t row, const BodyMotion<real>& after);
    /// It may rise by what errors give that come back, and by what turns in mid-tick, as in half of eq. 3; by
    /// more than that where no loops are.   [eq. 20]
    bool isMade(const StepContext& context, bool inLoops) const;
};

/// Of all bodies of each island, after passes over `lanes`.velocities; `drive` is that of what is not a
/// joint.
void tallyEnergies(const JointTable& joints, const Table<Motion>& motions, const Islands& islands,
                   const JointSystem& system, const TickRows& lanes, real drive,
                   std::vector<TickEnergy>& byIsland);

/// What motors and springs of a joint, or of a group, may add to speeds at most.   [m/s]
real driveOf(const JointRows& joint);
real driveOf(const JointSystem& system, const DirectGroup& group);
/// The fastest point of bodies that nothing can push.   [m/s]
real drivenSpeed(const Table<Motion>& motions);
/// How fast surfaces of contacts run at most.   [m/s]
real fastestSurface(const ContactTable& contacts);

}  // namespace tamias2d::inline TAMIAS_PRECISION
