// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>

namespace tamias2d::cli {

/// A bar on the terminal for runs that last longer than a second; gone when it is destroyed. Where
/// the error output is no terminal it shows nothing.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::int64_t done, std::int64_t total);
    double seconds() const;  ///< since it was made   [s]

private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point start_ = Clock::now();
    Clock::time_point next_;  ///< when to draw again
    bool isTerminal_;
    bool isDrawn_ = false;
};

}  // namespace tamias2d::cli
