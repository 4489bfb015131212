// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <compare>
#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Names one thing of one World: a slot, how often the slot has been used, and the world.
/// Safe to store and compare; a dead or foreign id is always detected. The default is null.
template <class Tag>
struct Id {
    std::uint32_t index = 0xffffffffu;  ///< slot in its table
    std::uint32_t generation = 0;       ///< of the slot; 0 only in a null id
    std::uint32_t world = 0;            ///< which World made it

    constexpr bool isNull() const noexcept { return generation == 0; }
    constexpr explicit operator bool() const noexcept { return !isNull(); }
    friend constexpr auto operator<=>(const Id&, const Id&) noexcept = default;
};

using BodyId = Id<struct BodyTag>;
using ShapeId = Id<struct ShapeTag>;
using JointId = Id<struct JointTag>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
