// SPDX-License-Identifier: MIT
// What is done with all blocks of lanes, shared out to threads, and what it lists.
#pragma once

#include "solver/contact_lanes_of.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The chunks of the blocks from `first` on have listed counts_ contacts, each chunk where its lanes begin:
// they move up behind the `end` that are there. Returns how many that makes.
template <int W>
std::size_t ContactLanesOf<W>::closeUp(std::uint32_t* list, std::size_t first, std::size_t end) const
{
    for (std::size_t chunk = 0; chunk < counts_.size(); ++chunk) {
        const std::uint32_t* const from = list + W * (first + chunk * kGrain);
        end = static_cast<std::size_t>(std::copy(from, from + counts_[chunk], list + end) - list);
    }
    return end;
}

// What find(first block, blocks, list) lists of each chunk of all blocks, in their order.
template <int W>
template <class Find>
void ContactLanesOf<W>::listAll(Find find, std::vector<std::uint32_t>& found) const
{
    if (room_.size() < W * blocks_.size()) room_.resize(blocks_.capacity() * W);
    counts_.assign(Parallel::chunksOf(blocks_.size(), kGrain), 0);
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        counts_[chunk.index] = find(chunk.begin, chunk.end - chunk.begin, room_.data() + W * chunk.begin);
    });
    found.assign(room_.data(), room_.data() + closeUp(room_.data(), 0, 0));
}

template <int W>
void ContactLanesOf<W>::prepare(TickRows& rows, const StepContext& context, std::vector<std::uint32_t>& open)
{
    solved_ = false;
    const std::size_t before = open.size();
    std::size_t end = 0;
    open.reserve(before + slots_.capacity());
    open.resize(before + W * blocks_.size());
    for (int color = 0; color < colors(); ++color) {
        counts_.assign(Parallel::chunksOf(countOf(color), kGrain), 0);
        std::uint32_t* const room = open.data() + before;
        eachChunk(color, [&](std::size_t first, std::size_t count, std::size_t chunk) {
            counts_[chunk] = Kernels::prepare(blocks_.data() + first, sources_.data() + first, count, rows,
                                              context, room + W * first);
        });
        end = closeUp(room, firstOf(color), end);
    }
    open.resize(before + end);
}

template <int W>
void ContactLanesOf<W>::findApproaching(const TickRows& rows, const StepContext& context, real fastest,
                                        std::vector<std::uint32_t>& found) const
{
    listAll(
        [&](std::size_t first, std::size_t count, std::uint32_t* list) {
            return Kernels::findApproaching(blocks_.data() + first, sources_.data() + first, count, rows,
                                            context, fastest, list);
        },
        found);
}

template <int W>
void ContactLanesOf<W>::findNewlyLoaded(std::vector<std::uint32_t>& found) const
{
    listAll(
        [&](std::size_t first, std::size_t count, std::uint32_t* list) {
            return Kernels::findNewlyLoaded(blocks_.data() + first, sources_.data() + first, count, list);
        },
        found);
}

template <int W>
void ContactLanesOf<W>::beginWhole(const std::vector<std::uint8_t>& quiet, real ticks)
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        Kernels::beginWhole(blocks_.data() + chunk.begin, chunk.end - chunk.begin, quiet.data(), ticks);
    });
}

template <int W>
void ContactLanesOf<W>::endWhole(real ticks)
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        Kernels::endWhole(blocks_.data() + chunk.begin, sources_.data() + chunk.begin,
                          chunk.end - chunk.begin, ticks);
    });
}

template <int W>
void ContactLanesOf<W>::comeIn()
{
    for (Block& b : blocks_) {
        b.active |= b.out;
        b.out = 0;
    }
}

template <int W>
ContactEndCounts ContactLanesOf<W>::conclude(const TickRows& rows, const StepContext& context,
                                             ContactTable& contacts, std::vector<std::uint32_t>& changed)
{
    const ContactEnds ends{contacts.nearness.data(), contacts.loads.data()};
    ends_.assign(Parallel::chunksOf(blocks_.size(), kGrain), {});
    listAll(
        [&](std::size_t first, std::size_t count, std::uint32_t* list) {
            ContactEndCounts& of = ends_[first / kGrain];
            of = Kernels::conclude(blocks_.data() + first, sources_.data() + first, count, rows, context,
                                   ends, list);
            return of.changed;
        },
        changed);
    ContactEndCounts sum;
    for (const ContactEndCounts& of : ends_) {
        sum.touching += of.touching;
        sum.deepest = maximum(sum.deepest, of.deepest);
    }
    return sum;
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
