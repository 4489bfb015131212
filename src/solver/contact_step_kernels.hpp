// SPDX-License-Identifier: MIT
// The kernels over blocks of contacts at the beginning and the end of ticks that stand for many, and at the
// end of a step, for one width: included once for each instruction set.
#pragma once

#include "solver/contact_prepare_kernel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Of those that take part.
template <int W>
void scaleImpulses(ContactBlock<W>& block, real factor)
{
    const Lane<W> by = select(maskOf<W>(block.active), Lane<W>(factor), Lane<W>(real(1)));
    for (int k = 0; k < block.points(); ++k) {
        block.row.points[k].normalImpulse = by * block.row.points[k].normalImpulse;
        block.row.points[k].tangentImpulse = by * block.row.points[k].tangentImpulse;
    }
}

}  // namespace

template <int W>
void ContactKernels<W>::beginWhole(Block* blocks, std::size_t count, const std::uint8_t* quiet, real ticks)
{
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        const std::uint32_t all = block.active | block.out;
        block.active = 0;
        for (int lane = 0; lane < W; ++lane)
            block.active |= static_cast<std::uint32_t>(quiet[block.rowA[lane]] & quiet[block.rowB[lane]])
                            << lane;
        block.active &= all;
        block.out = all & ~block.active;
        if (block.active != 0) scaleImpulses(block, ticks);
    }
}

template <int W>
void ContactKernels<W>::endWhole(Block* blocks, Source* sources, std::size_t count, real ticks)
{
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        if (block.active != 0) {
            addUp(block, sources[at]);
            sources[at].counted = maskOf<W>(0);
            scaleImpulses(block, 1 / ticks);
        }
        const std::uint32_t done = block.active;
        block.active = block.out;
        block.out = done;
    }
}

template <int W>
ContactEndCounts ContactKernels<W>::conclude(Block* blocks, Source* sources, std::size_t count,
                                             const TickRows& rows, const StepContext& context,
                                             const ContactEnds& ends, std::uint32_t* changed)
{
    ContactEndCounts counts;
    const Wide zero(real(0)), touchingGap(context.tuning.touchingFactor - 1);
    Wide deepest(real(0));
    auto* const loads = reinterpret_cast<std::byte*>(ends.loads);
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        Source& source = sources[at];
        if (block.active == 0) continue;
        addUp(block, source);
        source.counted = maskOf<W>(0);
        prepareAt(block, source, rows, context.invH);

        auto touches = maskOf<W>(0), loaded = touches;
        const int points = block.points();
        for (int k = 0; k < points; ++k) {
            const Wide gap = source.gap[k];
            touches = touches | (source.present[k] & (touchingGap * source.restGap >= gap));
            loaded = loaded | (block.row.points[k].normalImpulse > zero);
            const Wide overlap = select(source.present[k], -(gap + source.restGap), zero);
            deepest = select(overlap > deepest, overlap, deepest);
        }
        const std::uint32_t touching = bitsOf(touches) & block.active;
        const std::uint32_t linked = touching | (bitsOf(loaded) & block.active);
        const std::uint32_t other = touching ^ source.touching;
        source.touching = touching;
        const BasicContactLoad<Wide> carried = carriedBy(block.row, points);
        const FourLanes<W> load{carried.impulse.x, carried.impulse.y, carried.momentA, carried.momentB};
        scatterRows<W>(load, ScatteredRows<std::byte>{loads, sizeof(ContactLoad), source.contact},
                       block.active);
        for (int lane = 0; lane < W; ++lane) {
            if ((block.active >> lane & 1u) == 0) continue;
            ends.nearness[source.contact[lane]] =
                (linked >> lane & 1u) != 0 ? Nearness::Linked : Nearness::Near;
            counts.touching += touching >> lane & 1u;
            if ((other >> lane & 1u) != 0) changed[counts.changed++] = source.contact[lane];
        }
    }
    for (int lane = 0; lane < W; ++lane)
        counts.deepest = deepest.v[lane] > counts.deepest ? deepest.v[lane] : counts.deepest;
    return counts;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
