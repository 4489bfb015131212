// SPDX-License-Identifier: MIT
#include "base/lane_choice.hpp"

#include <tamias2d/base/config.hpp>

#include <cstdlib>
#include <limits>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// As the environment asks for, if it does and the machine can.
LaneWidth requested() noexcept
{
    // Worlds are made by one thread at a time with whatever changes the environment.
    const char* const text = std::getenv("TAMIAS_LANES");  // NOLINT(concurrency-mt-unsafe)
    if (text == nullptr) return LaneWidth::Best;
    const std::string_view name(text);
    const LaneWidth width = name == "scalar" ? LaneWidth::Scalar
                            : name == "16"   ? LaneWidth::Bytes16
                            : name == "32"   ? LaneWidth::Bytes32
                            : name == "64"   ? LaneWidth::Bytes64
                                             : LaneWidth::Best;
    return hasLanes(width) ? width : LaneWidth::Best;
}

}  // namespace

bool hasLanes(LaneWidth width) noexcept
{
    switch (width) {
    case LaneWidth::Best:
    case LaneWidth::Scalar:
    case LaneWidth::Bytes16:
        return true;
#if defined(__x86_64__) || defined(__i386__)
    case LaneWidth::Bytes32:
        return __builtin_cpu_supports("avx2") != 0;
    case LaneWidth::Bytes64:
        return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
               __builtin_cpu_supports("avx512vl") != 0;
#else
    case LaneWidth::Bytes32:
    case LaneWidth::Bytes64:
        return false;
#endif
    }
    return false;
}

LaneWidth askedLanes(LaneWidth ofWorld) noexcept
{
    return ofWorld == LaneWidth::Best ? requested() : ofWorld;
}

LaneWidth suitedLanes(LaneWidth asked, std::size_t bodies) noexcept
{
    // Found by measuring worlds of resting boxes, in float: ./dev bench awake_10 awake_30 awake_100.
    constexpr std::size_t kFloats = sizeof(real) / 4;
    constexpr std::size_t kEnoughFor32 = 16 / kFloats, kEnoughFor64 = 128 / kFloats;
    if (asked != LaneWidth::Best) return asked;
    if (bodies >= kEnoughFor64 && hasLanes(LaneWidth::Bytes64)) return LaneWidth::Bytes64;
    return bodies >= kEnoughFor32 && hasLanes(LaneWidth::Bytes32) ? LaneWidth::Bytes32 : LaneWidth::Bytes16;
}

LaneWidth bestLanes() noexcept
{
    return suitedLanes(requested(), std::numeric_limits<std::size_t>::max());
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
