// SPDX-License-Identifier: MIT
#pragma once

#include "base/disjoint_sets.hpp"

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A link between two rows; grounds (rows that nothing pushes) connect nothing.
struct Link {
    std::uint32_t a, b;
};

/// Which rows belong together, and what they stand on.
struct Islands {
    static constexpr std::uint32_t kNone = 0xffffffffu;      // no ground
    static constexpr std::uint32_t kSeveral = 0xfffffffeu;   // grounds that move differently

    std::vector<std::uint32_t> islandOf;  // by row; kNone for a ground
    std::vector<std::uint32_t> groundOf;  // by island: a row, kNone or kSeveral
    std::vector<std::uint32_t> sizeOf;    // by island: rows in it
    std::vector<std::uint32_t> parent;    // by row: what linking works with
    std::uint32_t count() const { return static_cast<std::uint32_t>(groundOf.size()); }
};

/// Groups the pushable rows by links. Islands are numbered in order of their lowest row.
/// `sameMotion(g1, g2)` says whether two grounds move as one. The memory of `islands` is used again.
template <class SameMotion>
void linkIslands(const std::vector<Link>& links, const std::vector<bool>& pushable, SameMotion sameMotion,
                 Islands& islands)
{
    const auto rows = static_cast<std::uint32_t>(pushable.size());
    DisjointSets sets(islands.parent);
    sets.reset(rows);
    for (const Link& link : links)
        if (pushable[link.a] && pushable[link.b]) sets.join(link.a, link.b);

    islands.islandOf.assign(rows, Islands::kNone);
    islands.groundOf.clear();
    islands.sizeOf.clear();
    for (std::uint32_t i = 0; i < rows; ++i) {
        if (!pushable[i]) continue;
        const std::uint32_t leader = sets.leader(i);
        if (leader == i) {
            islands.islandOf[i] = islands.count();
            islands.groundOf.push_back(Islands::kNone);
            islands.sizeOf.push_back(1);
        } else {
            islands.islandOf[i] = islands.islandOf[leader];
            ++islands.sizeOf[islands.islandOf[i]];
        }
    }
    for (const Link& link : links) {
        if (pushable[link.a] == pushable[link.b]) continue;
        const std::uint32_t ground = pushable[link.a] ? link.b : link.a;
        std::uint32_t& known = islands.groundOf[islands.islandOf[pushable[link.a] ? link.a : link.b]];
        if (known == Islands::kNone)
            known = ground;
        else if (known != Islands::kSeveral && known != ground && !sameMotion(known, ground))
            known = Islands::kSeveral;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
