// SPDX-License-Identifier: MIT
#pragma once

#include "model/step_context.hpp"
#include "solver/body_kernels.hpp"
#include "solver/hinge_block.hpp"

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One pass over hinges before the drift. After the first of a tick those are visited whose island says so in
/// `visited`; marked in `unrest` is where speeds change by more than `restless` [m/s].
struct HingePass {
    LaneRow* velocities;
    const LaneRow* turns;  // by row: what they aim anew by
    const std::uint8_t* visited;
    std::uint8_t* unrest;
    real restless;
};

/// What the visits of a tick begin with.
struct HingeStart {
    const Motion* motions;
    const LaneRow* turns;  // by row
    const std::uint8_t* wholeGroups;
    bool prepared;  // are the effective masses those of now?
};

/// What is done with runs of blocks of hinges; compiled as ContactKernels are, and with the same care. The
/// equations are those of joints/rows.hpp, of which [n] is in docs/theory/joints.md. Blocks are walked as
/// seldom as the order of a tick allows: they are more than a cache holds.
template <int W>
struct HingeKernels {
    using Wide = Lane<W>;
    using Block = HingeBlock<W>;
    using Source = HingeSource<W>;
    using Angle = HingeAngle<W>;
    using Run = HingeRun<W>;

    /// How bodies turn within a tick at rows.velocities, by row: ((cos t - 1)/h, (sin t - h w)/h), with t
    /// the angle of the drift.
    static void turns(const BodyRows& bodies, LaneRow* turns, const StepContext& context);
    /// Arms, errors and angles at the poses of `rows`.
    static void measure(const Run& run, const Motion* motions, const TickRows& rows);
    /// Adds tension times arm, by row.
    static void addPull(const Run& run, real* pull);
    /// Adds the velocity changes of what they carry to `steady`. Effective masses first, if they are not
    /// `prepared`.
    static void addSteady(const Run& run, const Motion* motions, bool prepared, LaneRow* steady);
    /// Impulses, bounds and aims as the visits of a tick begin, and the first pass of it.
    static void firstPass(const Run& run, const HingeStart& start, const HingePass& with,
                          const StepContext& context);
    /// One more before the drift: points give way a little.
    static void pass(const Run& run, const HingePass& with);
    /// One after it, in the groups that are `visited`, or in all if that is null. Counts in `changed`, by
    /// group, the hinges that change a speed by more than `restless` [m/s].
    static void settlingPass(const Run& run, LaneRow* velocities, const std::uint8_t* visited,
                             std::uint32_t* changed, real restless);
    /// Marks the groups of which a point aims elsewhere by more than `trusted` [m/s].
    static void findLost(const Run& run, const LaneRow* turns, real trusted, std::uint8_t* lost);
    /// Those of lost groups ask for J v = 0, and are visited.
    static void flatten(const Run& run, const std::uint8_t* lost, LaneRow* velocities,
                        const StepContext& context);
    /// After the drift: adds what they did before it to the sums of the step; measures, and says what the
    /// visits of the second half ask for; adds the velocity changes of the second half of what is carried to
    /// `turned`.
    static void settle(const Run& run, const Motion* motions, const TickRows& rows, LaneRow* turned,
                       const StepContext& context);
    /// After the tick: adds what they did to the sums of the step; what they carry on, but for those of
    /// bodies that were `hit`, if any.
    static void keep(const Run& run, const std::uint8_t* hit, const LaneRow* velocities,
                     const StepContext& context);
};

extern template struct HingeKernels<1>;
extern template struct HingeKernels<kLanes16>;
extern template struct HingeKernels<kLanes32>;
extern template struct HingeKernels<kLanes64>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
