// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How long a stage of the last step took, on one thread. Spans of a thread nest or follow each other.
/// Other threads than the caller's have one span for each loop of a stage that they took part in.
struct ProfileSpan {
    const char* name = "";      ///< of the stage; stays valid
    std::uint32_t thread = 0;   ///< 0 is the one that called step()
    /// 0 is the whole step; a part of a stage is one deeper than the stage. Other threads have 0 only.
    std::uint32_t depth = 0;
    double begin = 0, end = 0;  ///< since profiling was switched on   [us]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
