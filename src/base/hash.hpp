// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <bit>
#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A 64-bit hash of a sequence of values, the same on every platform (FNV-1a over 64-bit words,
/// with a final avalanche after splitmix64).
class Hasher {
public:
    void add(std::uint64_t word) { state_ = (state_ ^ word) * 0x100000001b3ull, state_ ^= state_ >> 29; }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(float value) { add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value))); }

    std::uint64_t value() const
    {
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }

private:
    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
