// SPDX-License-Identifier: MIT
#pragma once

#include "model/step_context.hpp"
#include "solver/contact_block.hpp"
#include "solver/tick_rows.hpp"

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where the end of a step is told, by contact.
struct ContactEnds {
    Nearness* nearness;
    ContactLoad* loads;
};
/// What some contacts have come to at the end of a step.
struct ContactEndCounts {
    std::uint32_t touching = 0;
    std::size_t changed = 0;   // touch and did not, or the reverse
    real deepest = 0;          // overlap   [m]
};

/// Where a pass notes what it changed, by island.
struct UnrestNotes {
    std::uint8_t* flags;     // 1 where it changed anything
    std::uint32_t* changes;  // at how many contacts more; null: nobody asks
};

/// What is done with runs of blocks. Compiled for each width with the instructions that have it: all that
/// these functions use is inline and depends on W, so that no code for one instruction set can stand in for
/// that of another. They therefore call nothing of the standard library that is not inline too.
template <int W>
struct ContactKernels {
    using Wide = Lane<W>;
    using Block = ContactBlock<W>;
    using Source = ContactSource<W>;

    /// Arms, gaps and masses at the poses of `rows`; adds the velocity changes of what the contacts carry to
    /// rows.steady. Contacts that may bounce and carry nothing are left out of that and listed in `open`,
    /// which has room for all; returns how many.
    static std::size_t prepare(Block* blocks, Source* sources, std::size_t count, TickRows& rows,
                               const StepContext& context, std::uint32_t* open);
    /// Lists the contacts that an impact may end in this tick in `list`, which has room for all; returns how
    /// many. No body has a point that is faster than `fastest` [m/s].
    static std::size_t findApproaching(const Block* blocks, const Source* sources, std::size_t count,
                                       const TickRows& rows, const StepContext& context, real fastest,
                                       std::uint32_t* list);
    /// Lists the contacts of which a point carries something that carried nothing as the tick began in
    /// `list`, which has room for all; returns how many.
    static std::size_t findNewlyLoaded(const Block* blocks, const Source* sources, std::size_t count,
                                       std::uint32_t* list);
    /// One pass, in the islands that are `visited`, or in all if that is null; notes in `unrest` where
    /// it changed a speed by more than `restless` [m/s]: one along a normal, or `ofAny`.
    static void pass(Block* blocks, std::size_t count, TickRows& rows, const std::uint8_t* visited,
                     const UnrestNotes& unrest, real restless, bool ofAny);
    /// The pass that undoes overlaps; returns how many points it held back to the fastest push.
    static std::uint32_t push(const Block* blocks, Source* sources, std::size_t count, TickRows& rows,
                              const StepContext& context);
    /// A tick that stands for many begins, and ends: see ContactLanes. `quiet` is by row.
    static void beginWhole(Block* blocks, std::size_t count, const std::uint8_t* quiet, real ticks);
    static void endWhole(Block* blocks, Source* sources, std::size_t count, real ticks);
    static void repay(const Block* blocks, Source* sources, std::size_t count, TickRows& rows,
                      const StepContext& context);
    /// The end of a step: arms, gaps and masses at the poses of `rows`, all that was done added to the sums.
    /// Lists the contacts that touch and did not before, or the reverse, in `changed`, which has room for
    /// all.
    static ContactEndCounts conclude(Block* blocks, Source* sources, std::size_t count, const TickRows& rows,
                                     const StepContext& context, const ContactEnds& ends,
                                     std::uint32_t* changed);
};

extern template struct ContactKernels<1>;
extern template struct ContactKernels<kLanes16>;
extern template struct ContactKernels<kLanes32>;
extern template struct ContactKernels<kLanes64>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
