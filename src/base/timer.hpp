// SPDX-License-Identifier: MIT
// Wall-clock time. It goes into reports and profiles only, never into results.
#pragma once

#include <tamias2d/base/profile.hpp>

#include <chrono>
#include <span>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Adds up the wall-clock time of stages.
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

/// The spans of one step, in order of their begins; the memory is kept. While it is off, a scope costs a
/// comparison and reads no clock.
class Profile {
public:
    void setOn(bool on);
    bool isOn() const { return on_; }
    void clear()
    {
        spans_.clear();
        depth_ = 0;
    }
    std::size_t open(const char* name);
    void close(std::size_t span);
    /// Adds a span of another thread, with the name of the innermost one that is open.
    void add(std::uint32_t thread, double begin, double end);
    /// Since it was switched on; any thread may ask.   [us]
    double now() const;
    std::span<const ProfileSpan> spans() const { return spans_; }

private:
    bool on_ = false;
    std::uint32_t depth_ = 0;   // of the next span
    std::chrono::steady_clock::time_point start_;
    std::vector<ProfileSpan> spans_;
};

/// A span from here to the end of the block, or to the next() one.
class ProfileScope {
public:
    ProfileScope(Profile& profile, const char* name) : profile_(profile.isOn() ? &profile : nullptr)
    {
        if (profile_) span_ = profile_->open(name);
    }
    ~ProfileScope()
    {
        if (profile_) profile_->close(span_);
    }
    ProfileScope(ProfileScope&&) = delete;

    /// Ends the span and begins another beside it.
    void next(const char* name)
    {
        if (!profile_) return;
        profile_->close(span_);
        span_ = profile_->open(name);
    }

private:
    Profile* profile_;
    std::size_t span_ = 0;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
