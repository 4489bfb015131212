// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/geometry/aabb.hpp>

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A box to be paired.
struct SweepBox {
    Aabb box;
    std::uint32_t shape;   // slot
    std::uint32_t body;    // slot: shapes of one body are no pair
    bool moves;            // two that do not move are no pair
};

struct ShapePair {
    std::uint32_t a, b;    // slots, a < b

    friend constexpr auto operator<=>(const ShapePair&, const ShapePair&) noexcept = default;
};

/// Sorts the boxes by their left edges and returns all overlapping pairs, sorted by shape.
void sweepPairs(std::vector<SweepBox>& boxes, std::vector<ShapePair>& pairs);

}  // namespace tamias2d::inline TAMIAS_PRECISION
