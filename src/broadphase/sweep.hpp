// SPDX-License-Identifier: MIT
#pragma once

#include "base/pages.hpp"
#include "tasks/chunk_lists.hpp"
#include "tasks/parallel.hpp"

#include <tamias2d/geometry/aabb.hpp>

#include <cstdint>
#include <span>
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

/// What the sweep works with; it keeps its memory from step to step.
struct SweepScratch {
    /// A box in a strip, its bounds rounded outwards.
    struct Entry {
        float left, right, bottom, top;
        std::uint32_t box;      // index
        std::int64_t strip;
    };
    std::vector<Entry> entries;               // by bucket, then by left edge
    std::vector<Entry> unsorted;
    std::vector<std::uint32_t> bucketEnds;
    std::vector<std::uint32_t> huge;          // boxes that would lie in too many strips
    ChunkLists<ShapePair> ofChunks;           // pairs that chunks of buckets find
    std::vector<ShapePair> found;             // all pairs before they are sorted
    std::vector<std::uint32_t> pairEnds;      // by first shape
};

/// All pairs of overlapping boxes of which one moves, and the pairs in `more`, sorted by shape. The boxes are
/// laid out in strips along x and swept strip by strip from left to right.
void sweepPairs(const Table<SweepBox>& boxes, std::span<const ShapePair> more, std::vector<ShapePair>& pairs,
                SweepScratch& scratch, Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
