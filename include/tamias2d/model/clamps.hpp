// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How often the solver had to limit something in the step. All zero in an ordinary scene: no
/// limit is ever silent.
struct ClampCounts {
    std::uint32_t speed = 0;  ///< bodies held at kMaxSpeed or kMaxSpin, or, tied by joints and whirled into a
                              ///< ground, slowed so that they neither cross it nor tear, in each tick
    std::uint32_t position = 0;  ///< bodies stopped at kMaxPosition
    std::uint32_t push = 0;  ///< contact points whose overlap asked for more than Tuning::pushSpeed
    std::uint32_t impactsPerContact =
        0;  ///< contacts that used all of Tuning::impactsPerContact, in each tick
    std::uint32_t advancement = 0;  ///< swept tests that ran out of iterations (taken as a hit)
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
