// SPDX-License-Identifier: MIT
// Visits to joints, as part of the passes over contacts, and after the drift.
#pragma once

#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "solver/calm.hpp"
#include "solver/hinge_lanes.hpp"
#include "solver/tick_energy.hpp"
#include "solver/tick_rows.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What visits to joints need to know.
struct JointWorld {
    const JointTable& joints;
    const BodyTable& bodies;
    MotionTable& motions;
    const Islands& islands;
    const StepContext& context;
    HingeLanes& hinges;
    TickRows& rows;
    std::vector<TickEnergy>& energies;  // by island, scratch
};

/// One visit to a joint; returns the greatest change of speed it made.   [m/s]
real visitJoint(JointRows& joint, const Table<Motion>& motions, Table<LaneRow>& velocities);

/// One visit to a group at once; where that finds no solution, to its joints one by one.
real visitGroup(DirectGroup& group, JointSystem& system, const Table<Motion>& motions,
                Table<LaneRow>& velocities);

/// What a joint aims at, at these velocities; returns by how much that changed.   [m/s]
real aimJoint(const JointWorld& world, const Table<LaneRow>& velocities, JointRows& joint);

/// One pass over the joints, in the islands that `visited` says, which aim anew; over all if it is null. Sets
/// `unrest` of islands of which a speed was changed by more than `restless` [m/s].
void passOverJoints(const JointWorld& world, JointSystem& system, real restless, const std::uint8_t* visited,
                    Table<LaneRow>& velocities, std::vector<std::uint8_t>& unrest);

/// After the passes: groups in which these did not find where they go, as bodies turn too fast for them or a
/// load came up that they did not reckon with, are brought to where their joints hold. Where that cannot be
/// found joints are asked to move nothing apart instead. What they did is not carried on. `before` are the
/// velocities of all rows before the passes.
void settleLost(const JointWorld& world, JointSystem& system, const Table<LaneRow>& before,
                Table<LaneRow>& velocities);

/// Projects a group, from velocities around the passes of a tick, or leaves it as if it had no joints.
bool project(const JointWorld& world, JointSystem& system, DirectGroup& group, const Table<LaneRow>& before,
             Table<LaneRow>& velocities);

/// After the second kick: what is tied together does not go on moving apart. Changes lanes.velocities.
void settleJoints(JointSystem& system, HingeLanes& hinges, const Table<Motion>& rows, TickRows& lanes,
                  const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
