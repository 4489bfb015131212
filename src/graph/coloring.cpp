// SPDX-License-Identifier: MIT
#include "graph/coloring.hpp"

#include <bit>

namespace tamias2d::inline TAMIAS_PRECISION {

void colorConstraints(const std::vector<RowPair>& constraints, const std::vector<bool>& movable,
                      std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& ends,
                      ColorScratch& scratch)
{
    constexpr std::uint32_t kColors = 64;
    std::vector<std::uint64_t>& used = scratch.used;
    std::vector<std::uint8_t>& colors = scratch.colors;
    used.assign(movable.size(), 0);
    colors.resize(constraints.size());
    std::uint32_t sizes[kColors + 1] = {};

    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const auto [a, b] = constraints[i];
        const std::uint64_t taken = (movable[a] ? used[a] : 0) | (movable[b] ? used[b] : 0);
        const auto color =
            static_cast<std::uint32_t>(std::countr_one(taken & ~(std::uint64_t{1} << (kColors - 1))));
        const std::uint64_t bit = std::uint64_t{1} << color;
        used[a] |= bit;
        used[b] |= bit;
        colors[i] = static_cast<std::uint8_t>(color);
        ++sizes[color + 1];
    }

    for (std::uint32_t c = 0; c < kColors; ++c) sizes[c + 1] += sizes[c];
    ends.assign(sizes + 1, sizes + kColors + 1);
    order.resize(constraints.size());
    for (std::uint32_t i = 0; i < constraints.size(); ++i) order[sizes[colors[i]]++] = i;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
