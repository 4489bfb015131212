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
/// contacts: no two of one block share a body that moves. While they are here, what they carry, their angles
/// and sums are here and those of the JointTable are of before. One object for each width; all give the same
/// bits.
class HingeLanes {
public:
    virtual ~HingeLanes() = default;

    /// Takes them over, with the bodies where rows.poses has them.
    virtual void build(const JointSystem& system, const JointTable& joints, const BodyTable& bodies,
                       const MotionTable& motions, const Islands& islands, const TickRows& rows) = 0;
    /// Gives back what is here, and is empty.
    virtual void storeAll(JointTable& joints) = 0;
    virtual bool empty() const = 0;

    // The stages of a tick, in order. See joints/tick.hpp for those of the same names.
    virtual void addPull(std::vector<real>& pull) const = 0;
    virtual void addSteady(Table<Motion>& motions) = 0;
    virtual void start(Table<Motion>& motions, TickRows& rows, const std::vector<std::uint8_t>& wholeGroups,
                       const StepContext& context) = 0;
    /// One pass, in the islands that are `visited`, which aim anew; over all if that is null. Marks islands
    /// whose speeds it changes by more than `restless` [m/s].
    virtual void pass(Table<Motion>& motions, TickRows& rows, const std::uint8_t* visited,
                      std::uint8_t* unrest, real restless, const StepContext& context) = 0;
    /// Marks groups of which something aims elsewhere now than in the passes.
    virtual void findLost(Table<Motion>& motions, TickRows& rows, std::vector<std::uint8_t>& lost,
                          real trusted, const StepContext& context) = 0;
    virtual void flatten(const std::vector<std::uint8_t>& lost, TickRows& rows,
                         const StepContext& context) = 0;
    virtual void tally(const Table<Motion>& motions) = 0;
    virtual void measure(const Table<Motion>& motions, const TickRows& rows) = 0;
    virtual void settle(Table<Motion>& motions, const StepContext& context) = 0;
    /// One pass after the drift, over the groups that are `visited`, or all if that is null.
    virtual void settlingPass(Table<Motion>& motions, const std::uint8_t* visited, std::uint8_t* unrest,
                              real restless) = 0;
    virtual void keep(const std::vector<std::uint8_t>& hit, const StepContext& context) = 0;
};

/// For the width, which the machine must have.
std::unique_ptr<HingeLanes> makeHingeLanes(LaneWidth width, Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
