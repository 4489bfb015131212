// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The constants of the contact model. The defaults suit any scene; lengths among them are given
/// for lengthUnit = 1 and scale with it. A tick is half a sub-step. docs/theory/contacts.md derives each.
struct Tuning {
    real restGap = real(0.001);  ///< gap at which bodies rest, over the smaller width  [1]   in (0, 0.1]
    real touchingFactor = real(1.1);  ///< touching means gap <= this x the rest gap         [1]   in [1, 3]
    real pushRate = real(0.075);  ///< part of an overlap undone in one step             [1]   in [0, 1]
    real pushSpeed = real(0.125);  ///< and no faster than this                  [lengthUnit/s] > 0
    real pushSlack =
        real(0.25);  ///< nothing is pushed while the gap is this much short of the rest gap  [1]  in [0, 1]
    int extraPasses = 4;  ///< over the contacts of a restless island, in a tick [1]   in [0, 100]
    int settlingPasses = 40;  ///< the same, of a large one that has nearly come to rest   [1]   in [0, 100]
    real restless = real(0.005);  ///< an island is: its last pass changed a speed by more  [lengthUnit/s] > 0
    real calmRate = real(0.3);  ///< part of the speed a calm loaded body loses in a tick  [1] in [0, 1)
    real calmSpeed = real(0.1);  ///< above which nothing is calmed            [lengthUnit/s] > 0
    real quiet =
        real(0.01);  ///< what goes less than this x the rest gap makes a step in a tick  [1]   in [0, 0.1]
    real impactThreshold = 1;  ///< slowest impact, over what steady forces do in a tick  [1] in [0.1, 10]
    int crowd = 8;  ///< so many bodies that meet leave slow impacts to the passes, if C_R < 1 [1] in [1, 1e6]
    int impactsPerContact =
        32;  ///< in a tick; plastic after half; a fourth if C_R = 0, or < 1 in a crowd [1] in [2, 1000]
    real sleepTime = real(0.5);  ///< so long all of a group must be still before they sleep [s] in [0, 1e6]
    real sleepSpeed = real(0.01);  ///< still: no point is faster, nor gets faster  [lengthUnit/s] > 0

    friend constexpr bool operator==(const Tuning&, const Tuning&) noexcept = default;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
