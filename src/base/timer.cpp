// SPDX-License-Identifier: MIT
#include "base/timer.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

void Profile::setOn(bool on)
{
    if (on && !on_) start_ = std::chrono::steady_clock::now();
    on_ = on;
    clear();
}

double Profile::now() const
{
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_).count();
}

std::size_t Profile::open(const char* name)
{
    const double begin = now();
    spans_.push_back({name, 0, depth_++, begin, begin});
    return spans_.size() - 1;
}

void Profile::add(std::uint32_t thread, double begin, double end)
{
    const char* name = "";
    for (std::size_t i = spans_.size(); i > 0 && *name == 0; --i) {
        const ProfileSpan& span = spans_[i - 1];
        if (span.thread == 0 && span.depth + 1 == depth_) name = span.name;
    }
    spans_.push_back({name, thread, 0, begin, end});
}

void Profile::close(std::size_t span)
{
    spans_[span].end = now();
    --depth_;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
