// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How many bytes of numbers the solver reckons with at once. The results have the same bits with each
/// [ADR6].
enum class LaneWidth : std::uint8_t {
    Best,  ///< the fastest of those this machine has: wide for many bodies in a step, narrow for few; the
           ///< environment variable TAMIAS_LANES (scalar, 16, 32 or 64), read as a world is made, overrides
    Scalar,  ///< one number
    Bytes16,  ///< SSE2, NEON, wasm SIMD: always there
    Bytes32,  ///< AVX2
    Bytes64,  ///< AVX-512 (F, DQ, VL)
};

/// Has this machine the instructions for it? True for Best.
bool hasLanes(LaneWidth width) noexcept;

/// What Best is on this machine for many bodies, now.
LaneWidth bestLanes() noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
