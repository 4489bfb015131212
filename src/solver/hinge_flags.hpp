// SPDX-License-Identifier: MIT
// Hinges in lanes: what is known of their bodies, islands and groups, and what is said of these.
#pragma once

#include "solver/hinge_kernels.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Others may set the same at the same time.
inline void markFlag(std::uint8_t& flag)
{
    __atomic_store_n(&flag, std::uint8_t{1}, __ATOMIC_RELAXED);
}

template <int W>
ScatteredRows<std::byte> groupsOf(Motion* motions, std::size_t offset, const std::uint32_t (&rows)[W])
{
    return {reinterpret_cast<std::byte*>(motions) + offset, sizeof(Motion), rows};
}
template <int W>
ScatteredRows<const std::byte> groupsOf(const Motion* motions, std::size_t offset,
                                        const std::uint32_t (&rows)[W])
{
    return {reinterpret_cast<const std::byte*>(motions) + offset, sizeof(Motion), rows};
}

template <int W>
TAMIAS_INLINE std::uint32_t lanesOf(const HingeBlock<W>& block, const std::uint32_t (&of)[W], bool same,
                                    const std::uint8_t* flags)
{
    if (same) return flags[of[0]] != 0 ? block.active : 0;
    std::uint32_t lanes = 0;
    for (int lane = 0; lane < W; ++lane)
        if (flags[of[lane]] != 0) lanes |= 1u << lane;
    return lanes & block.active;
}
// Of the groups that are flagged.
template <int W>
TAMIAS_INLINE std::uint32_t lanesOf(const HingeBlock<W>& block, const std::uint8_t* groups)
{
    return lanesOf(block, block.group, block.oneGroup, groups);
}
template <int W>
TAMIAS_INLINE void markFlags(std::uint32_t lanes, const std::uint32_t (&of)[W], bool same,
                             std::uint8_t* flags)
{
    if (lanes == 0) return;
    if (same) return markFlag(flags[of[0]]);
    for (; lanes != 0; lanes &= lanes - 1) markFlag(flags[of[__builtin_ctz(lanes)]]);
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
