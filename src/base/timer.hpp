// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <chrono>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Adds up the wall-clock time of stages. Times go into reports only, never into results.
class Stopwatch {
public:
    /// Milliseconds since the last lap (or since construction).
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
        return ms;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
