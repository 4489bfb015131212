// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace tamias2d::test {

/// Numbers that look random and are the same on every platform (a 32-bit xorshift).
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(seed * 2654435761u + 1) {}

    /// Evenly between `low` and `high`.
    double between(double low, double high) { return low + (high - low) * (next() / 4294967296.0); }

private:
    std::uint32_t next()
    {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 17;
        return state_ ^= state_ << 5;
    }

    std::uint32_t state_;
};

}  // namespace tamias2d::test
