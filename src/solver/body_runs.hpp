// SPDX-License-Identifier: MIT
// Runs of W bodies: their rows as lanes, and back. Only for the kernels over bodies.
#pragma once

#include "math/double_lane.hpp"
#include "solver/body_kernels.hpp"

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// W rows one after the other.
template <int W>
struct WholeRun {
    std::uint32_t first;
    static constexpr std::uint32_t kValid = (1u << W) - 1;   // lanes, as bits

    std::uint32_t valid() const { return kValid; }
    std::uint32_t row(int lane) const { return first + static_cast<std::uint32_t>(lane); }
    template <class Row>
    TAMIAS_INLINE auto groups(Row* rows, std::size_t offset) const
    {
        return ConsecutiveRows<std::byte, sizeof(Row)>{reinterpret_cast<std::byte*>(rows + first) + offset};
    }
};

// Any W rows. If one stands for several lanes, what is written twice is the same.
template <int W>
struct AnyRun {
    std::uint32_t at[W];
    std::uint32_t count = W;

    std::uint32_t valid() const { return (std::uint64_t{1} << count) - 1; }
    std::uint32_t row(int lane) const { return at[lane]; }
    template <class Row>
    TAMIAS_INLINE auto groups(Row* rows, std::size_t offset) const
    {
        return ScatteredRows<std::byte>{reinterpret_cast<std::byte*>(rows) + offset, sizeof(Row), at};
    }
};

// One row in all lanes; to be read.
struct SameRow {
    std::uint32_t row;

    template <class Row>
    TAMIAS_INLINE auto groups(Row* rows, std::size_t offset) const
    {
        return ConsecutiveRows<std::byte, 0>{reinterpret_cast<std::byte*>(rows + row) + offset};
    }
};

// The last of a range, fewer than W: the last one stands in for those that are missing.
template <int W>
AnyRun<W> lastRun(std::uint32_t first, std::uint32_t end)
{
    AnyRun<W> run;
    run.count = end - first;
    for (std::uint32_t i = 0; i < W; ++i) run.at[i] = i < run.count ? first + i : end - 1;
    return run;
}

template <int W, class Visit>
TAMIAS_INLINE void eachRun(const BodyRows& bodies, Visit visit)
{
    std::uint32_t first = bodies.begin;
    for (; first + W <= bodies.end; first += W) visit(WholeRun<W>{first});
    if (first < bodies.end) visit(lastRun<W>(first, bodies.end));
}

template <int W, class Row, class Run>
TAMIAS_INLINE FourLanes<W> load(Row* rows, std::size_t offset, const Run& run)
{
    return gatherRows<W>(run.groups(rows, offset));
}
template <int W, class Row, class Run>
TAMIAS_INLINE void store(const FourLanes<W>& lanes, Row* rows, std::size_t offset, const Run& run)
{
    scatterRows<W>(lanes, run.groups(rows, offset), ~0u);
}

constexpr std::size_t kPlace = 0, kMasses = offsetof(Motion, invMass), kRotation = offsetof(Motion, rotation),
                      kVelocity = offsetof(Motion, velocity), kSteady = offsetof(Motion, steady),
                      kAcceleration = offsetof(Motion, acceleration), kFine = offsetof(Motion, fineVelocity),
                      kExcess = offsetof(Motion, excess), kDampedTick = offsetof(Motion, dampedTick),
                      kDampedTurn = offsetof(Motion, dampedTurn);

template <int W>
Lane<W> sumOf(Lane<W> x, Lane<W> y)  // of the absolute values: at least the length
{
    return absolute(x) + absolute(y);
}

template <int W>
LaneMask<W> isMovable(const FourLanes<W>& masses)
{
    const Lane<W> zero(real(0));
    return (masses.x + masses.y > zero) | (masses.z > zero);
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
