// SPDX-License-Identifier: MIT
#pragma once

#include "math/lane.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"
#include "solver/tick_rows.hpp"
#include "tasks/parallel.hpp"

#include <tamias2d/base/lane_width.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A run of rows of the MotionTable, and what stands beside them.
struct BodyRows {
    Motion* motions;
    TickRows& rows;
    std::uint32_t begin, end;
};

/// Bodies that a loop over several kernels takes at a time, by any thread: so many stay in the cache from one
/// kernel to the next.
inline constexpr std::size_t kBodyGrain = 128;

inline BodyRows bodiesOf(const Chunk& chunk, Table<Motion>& motions, TickRows& rows)
{
    return {motions.data(), rows, static_cast<std::uint32_t>(chunk.begin),
            static_cast<std::uint32_t>(chunk.end)};
}

/// When a tick is within its step.
struct TickTime {
    int number = 0;
    real start = 0, rest = 0;  // from the start of the step; to its end   [s]
};

inline TickTime timeOf(int tick, const StepContext& context)
{
    const real start = static_cast<real>(tick) * context.h;
    return {tick, start, static_cast<real>(context.dt) - start};
}

/// Rows that leave their boxes in a tick: a list with room for all, and how many.
struct StrayList {
    std::uint32_t* rows;
    std::size_t count;
};

/// A body, and the one it comes to rest against, by their rows.
struct CalmPair {
    std::uint32_t row, ground;
};

/// What is done with all bodies in a tick, several at once. Compiled for each width, as ContactKernels are,
/// and with the same care; all widths give the same bits. Ranges may be cut in any way.
struct BodyKernels {
    /// What contacts carry, in Motion::steady, held to what forces may do; and where that and all else takes
    /// bodies in the step, in `centers`, by row, and in rows.travels.
    void (*expect)(const BodyRows& bodies, CenterWay* centers, const StepContext& context);
    /// How bodies go in the tick that begins: bounds on how fast their points turn, in rows.ways, and the
    /// velocities at both its ends, in rows.spans.
    void (*boundSpeeds)(const BodyRows& bodies, const StepContext& context);
    /// Starts a tick: what the contacts carry, from rows.steady, held to what forces may do; how fast bodies
    /// may become; who leaves the box of the broad phase. Returns a bound on the speed of all points [m/s].
    real (*startTick)(const BodyRows& bodies, const StepContext& context, const TickTime& time,
                      StrayList& strays);
    /// First kick. A free body gets half of what acts on it, a loaded one all of it: what rests on something
    /// is solved once, with its whole load. `kicked`: rows.kicks say something.
    void (*kick)(const BodyRows& bodies, const StepContext& context, bool kicked);
    /// From the passes to the end of the drift: moves bodies along their velocities and pushes, and by what
    /// damping adds to that. `pushed`: rows.pushes say something; `jointed`: rows.turned do.
    void (*drift)(const BodyRows& bodies, const StepContext& context, bool kicked, bool pushed, bool jointed);
    /// The rest of the kick, at the new place. What contacts have done becomes the expectation for the next
    /// tick. Bounds of speed; returns how many bodies had to be slowed. `jointed`: rows.turned say something,
    /// and are ready for the next tick; rows.velocities are those of now.
    std::uint32_t (*kickAfterDrift)(const BodyRows& bodies, const StepContext& context, bool kicked,
                                    bool jointed);
    /// What joints have made of rows.velocities since then, for those that they tie.
    void (*takeSettled)(const BodyRows& bodies);
    /// drift and kickAfterDrift where no joint is at work, with the same bits.
    std::uint32_t (*driftAndKick)(const BodyRows& bodies, const StepContext& context, bool kicked,
                                  bool pushed);
    /// Slows loaded bodies that are already slow and not speeding up, against their grounds:
    /// docs/theory/calm.md.
    void (*calm)(Motion* motions, const CalmPair* pairs, std::size_t count, TickRows& rows,
                 const StepContext& context);
    /// Does what kick, drift and kickAfterDrift do in so many ticks, to bodies that have no load, damping,
    /// steady change, impacts or pushes and that no bound of speed slows; with the same bits.
    void (*fly)(const BodyRows& bodies, const StepContext& context, int ticks);
};

/// Those of a width that this machine has; not Best.
const BodyKernels& bodyKernels(LaneWidth width);

/// The same for one width; defined in a file that is compiled with its instructions.
template <int W>
struct BodyKernelsOf {
    static const BodyKernels kTable;
};

extern template struct BodyKernelsOf<1>;
extern template struct BodyKernelsOf<kLanes16>;
extern template struct BodyKernelsOf<kLanes32>;
extern template struct BodyKernelsOf<kLanes64>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
