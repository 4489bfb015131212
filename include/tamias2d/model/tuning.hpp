// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The constants of the contact model. The defaults suit any scene; lengths among them are given
/// for lengthUnit = 1 and scale with it. docs/theory/contacts.md derives each.
struct Tuning {
    real restGap = real(0.001);        ///< gap at which bodies rest, over the smaller width  [1]   in (0, 0.1]
    real touchingFactor = real(1.1);   ///< touching means gap <= this x the rest gap         [1]   in [1, 3]
    real pushRate = real(0.15);        ///< part of an overlap undone in one step             [1]   in [0, 1]
    real pushSpeed = 1;                ///< and no faster than this                  [lengthUnit/s] > 0
    real pushSlack = real(0.1);        ///< rest gaps pushed beyond the rest gap              [1]   in [0, 1]
    real calmRate = real(0.1);         ///< part of the speed a calm loaded body loses in a sub-step  [1] in [0, 1)
    real calmSpeed = real(0.05);       ///< above which nothing is calmed            [lengthUnit/s] > 0
    real impactThreshold = 1;          ///< slowest impact, over what steady forces do in a sub-step  [1] in [0.1, 10]
    int impactsPerContact = 32;        ///< in one sub-step; plastic after half of them       [1]   in [2, 1000]
    int impactSweeps = 50;             ///< over all contacts, in one sub-step                [1]   in [1, 1000]

    friend constexpr bool operator==(const Tuning&, const Tuning&) noexcept = default;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
