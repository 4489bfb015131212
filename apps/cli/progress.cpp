// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace tamias2d::cli {

namespace {

bool isTerminal()
{
#if defined(_WIN32)
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(fileno(stderr)) != 0;
#endif
}

}  // namespace

Progress::Progress() : next_(start_ + std::chrono::seconds(1)), isTerminal_(isTerminal()) {}

Progress::~Progress()
{
    if (isDrawn_) fmt::print(stderr, "\r\x1b[K");
}

double Progress::seconds() const
{
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::show(std::int64_t done, std::int64_t total)
{
    if (!isTerminal_) return;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(100);

    constexpr int kWidth = 40;
    const double part = static_cast<double>(done) / static_cast<double>(total);
    const auto filled = static_cast<std::size_t>(part * kWidth);
    const double left = seconds() * (1 - part) / part;
    fmt::print(stderr, "\r[{}{}] {:3.0f} %, step {} of {}, {:.0f} s left\x1b[K", std::string(filled, '#'),
               std::string(kWidth - filled, '.'), 100 * part, done, total, left);
    std::fflush(stderr);
    isDrawn_ = true;
}

}  // namespace tamias2d::cli
