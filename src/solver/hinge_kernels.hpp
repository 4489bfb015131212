// SPDX-License-Identifier: MIT
#pragma once

#include "model/step_context.hpp"
#include "solver/body_kernels.hpp"
#include "solver/hinge_block.hpp"

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where the velocities that visits change are: groups of four numbers, by row.
struct VelocityRows {
    std::byte* first;
    std::size_t stride;
};

/// One pass over hinges. Those are visited whose island, or group, says so in `visited`, or all if that is
/// null; marked in `unrest` is where speeds change by more than `restless` [m/s].
struct HingePass {
    VelocityRows velocities;
    const LaneRow* turns;         // by row: aim anew by these; null: aims stay
    const std::uint8_t* visited;
    std::uint8_t* unrest;
    bool byGroup;
    bool soft;                    // points give way a little
    real restless;
};

/// What is done with runs of blocks of hinges; compiled as ContactKernels are, and with the same care. The
/// equations are those of joints/rows.cpp, of which [n] is in docs/theory/joints.md.
template <int W>
struct HingeKernels {
    using Wide = Lane<W>;
    using Block = HingeBlock<W>;
    using Source = HingeSource<W>;

    /// How bodies turn within a tick at rows.velocities, by row: ((cos t - 1)/h, (sin t - h w)/h), with t
    /// the angle of the drift.
    static void turns(const BodyRows& bodies, LaneRow* turns, const StepContext& context);
    /// Arms, errors and angles at the poses of `rows`.
    static void measure(Block* blocks, Source* sources, std::size_t count, const Motion* motions,
                        const TickRows& rows);
    /// Adds tension times arm, by row.
    static void addPull(const Block* blocks, const Source* sources, std::size_t count, real* pull);
    /// Adds the velocity changes of what they carry to Motion::steady.
    static void addSteady(Block* blocks, const Source* sources, std::size_t count, Motion* motions);
    /// Impulses, bounds and aims as the visits of a tick begin.
    static void start(Block* blocks, Source* sources, std::size_t count, const Motion* motions,
                      const LaneRow* turns, const std::uint8_t* wholeGroups, const StepContext& context);
    static void pass(Block* blocks, std::size_t count, const HingePass& with);
    /// Marks the groups of which a point aims elsewhere by more than `trusted` [m/s].
    static void findLost(const Block* blocks, std::size_t count, const LaneRow* turns, real trusted,
                         std::uint8_t* lost);
    /// Those of lost groups ask for J v = 0, and are visited.
    static void flatten(Block* blocks, Source* sources, std::size_t count, const std::uint8_t* lost,
                        const HingePass& with, const StepContext& context);
    /// Adds what they did to the sums of the step.
    static void tally(const Block* blocks, Source* sources, std::size_t count, const Motion* motions);
    /// After the drift, measured there: what the visits of the second half ask for; adds the velocity
    /// changes of the second half of what is carried to Motion::steady.
    static void settle(Block* blocks, Source* sources, std::size_t count, Motion* motions,
                       const StepContext& context);
    /// After the tick: what they carry on, but for those of bodies that were `hit`.
    static void keep(const Block* blocks, Source* sources, std::size_t count, const std::uint8_t* hit,
                     const StepContext& context);
};

extern template struct HingeKernels<1>;
extern template struct HingeKernels<kLanes16>;
extern template struct HingeKernels<kLanes32>;
extern template struct HingeKernels<kLanes64>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
