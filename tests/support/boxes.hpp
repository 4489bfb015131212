// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/sweep.hpp"

#include <random>

namespace tamias2d {

/// Boxes of all sizes near the origin, two shapes a body; every third does not move, every 17th is wide.
inline Table<SweepBox> randomBoxes(std::uint32_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-20, 20), size(0, 3);
    Table<SweepBox> boxes;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Position lower{place(random), place(random)};
        const DVec2 extent{i % 17 == 0 ? 40.0 : size(random), size(random)};
        boxes.push_back({{lower, lower + extent}, i, i / 2, i % 3 != 0});  // two shapes a body
    }
    return boxes;
}

}  // namespace tamias2d
