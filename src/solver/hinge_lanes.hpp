// SPDX-License-Identifier: MIT
#pragma once

#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "model/step_context.hpp"
#include "solver/body_kernels.hpp"
#include "solver/tick_rows.hpp"
#include "tasks/parallel.hpp"

#include <tamias2d/base/lane_width.hpp>

#include <memory>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The hinges of a step that JointSystem::hinges leaves to lanes, several side by side, as ContactLanes has
/// contacts: no two of one block share a body that moves. Within a step what they carry, their angles and
/// sums are here and those of the JointTable are of before; after it the table knows all, and they stay for
/// the next one, as long as the listing does. One object for each width; all give the same bits.
class HingeLanes {
public:
    virtual ~HingeLanes() = default;

    /// Takes them over, with the bodies where rows.poses has them. What is here already of the same listing
    /// stays in its lanes.
    virtual void take(const JointSystem& system, const JointTable& joints, const BodyTable& bodies,
                      const MotionTable& motions, const Islands& islands, const TickRows& rows) = 0;
    /// Tells the table what is here.
    virtual void store(const JointSystem& system, JointTable& joints) = 0;
    /// Is empty; what was not stored is gone.
    virtual void clear() = 0;
    virtual bool empty() const = 0;

    // The stages of a tick, in order. See joints/tick.hpp for those of the same names.
    virtual void addPull(std::vector<real>& pull) = 0;
    /// `inertiasAreSame`: are those of the bodies what they were when the tick before ended?
    virtual void addSteady(const Table<Motion>& motions, TickRows& rows, bool inertiasAreSame) = 0;
    /// Starts them, and one pass. Marks islands whose speeds it changes by more than `restless` [m/s].
    virtual void firstPass(Table<Motion>& motions, TickRows& rows,
                           const std::vector<std::uint8_t>& wholeGroups, std::uint8_t* unrest, real restless,
                           const StepContext& context) = 0;
    /// One pass more, in the islands that are `visited`, which aim anew.
    virtual void pass(Table<Motion>& motions, TickRows& rows, const std::uint8_t* visited,
                      std::uint8_t* unrest, real restless, const StepContext& context) = 0;
    /// Marks groups of which something aims elsewhere now than in the passes.
    virtual void findLost(Table<Motion>& motions, TickRows& rows, std::vector<std::uint8_t>& lost,
                          real trusted, const StepContext& context) = 0;
    virtual void flatten(const std::vector<std::uint8_t>& lost, TickRows& rows,
                         const StepContext& context) = 0;
    /// After the drift: measures, and turns what they carry, in rows.turned.
    virtual void settle(const Table<Motion>& motions, TickRows& rows, const StepContext& context) = 0;
    /// One pass after the second kick, at rows.velocities, over the groups that are `visited`, or all if that
    /// is null. Adds to `changed`, by group, how many of them change a speed by more than `restless` [m/s].
    virtual void settlingPass(TickRows& rows, const std::uint8_t* visited, std::uint32_t* changed,
                              real restless) = 0;
    /// Nobody was hit if `hit` is null.
    virtual void keep(const std::uint8_t* hit, const TickRows& rows, const StepContext& context) = 0;
};

/// For the width, which the machine must have.
std::unique_ptr<HingeLanes> makeHingeLanes(LaneWidth width, Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
