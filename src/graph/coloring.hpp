// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Two rows that a constraint ties together.
struct RowPair {
    std::uint32_t a, b;
};

/// What coloring works with; it keeps its memory from step to step.
struct ColorScratch {
    std::vector<std::uint64_t> used;      // by row: a bit for each color that a constraint of it has
    std::vector<std::uint8_t> colors;     // by constraint
};

/// Gives every constraint the lowest color that no other constraint of either of its movable
/// rows has, and returns the constraints sorted by color, then by index. A color may be solved side by side;
/// beyond 63 colors the last one is solved in order. `ends` are where each of the 64 colors ends.
void colorConstraints(const std::vector<RowPair>& constraints, const std::vector<bool>& movable,
                      std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& ends,
                      ColorScratch& scratch);

}  // namespace tamias2d::inline TAMIAS_PRECISION
