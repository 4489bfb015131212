// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/swept.hpp"

#include <tamias2d/base/lane_width.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How a body goes from time 0 to another, as lanes read it: the same for all pairs of the body.
struct alignas(16) SpanOfWay {
    Rot start, end;                    ///< `end` counts only if the path has looked ahead to that time
    Vec2 byVelocity, byAcceleration;   ///< the parts of its way   [m]
    real turn = 0;                     ///< absolute   [rad]
    real unused[3] = {};

    SpanOfWay() = default;
    SpanOfWay(const Trajectory& path, real to);
};

/// Two shapes on their ways, as lanes read them.
struct PairOnWay {
    const Convex *a, *b;
    const SpanOfWay *wayA, *wayB;
    Vec2 positionA, positionB;   ///< of the centers of mass at time 0, from a place near both   [m]
    real restGap;                ///< [m]
};

/// What lanes may try: two sharp polygons of up to so many corners, or one and a line; or two discs.
enum class LaneKind { Corners4, Corners6, Corners8, Discs, None };
inline constexpr int kLaneKinds = 4;   // but for None
LaneKind laneKindOf(const Convex& a, const Convex& b);

/// Pairs of a kind, several at once. Compiled for each width, as the kernels of the solver are, and with the
/// same care; all widths give the same bits.
struct PairKernels {
    int lanes;
    /// How each of up to `lanes` pairs meets between 0 and the time of their ways, as collideSwept says.
    /// Returns, as bits, for which of them that is so; collideSwept must be asked for the others.
    std::uint32_t (*collide)(LaneKind kind, const PairOnWay* pairs, int count, SweptResult* const* results);
};
inline constexpr int kMostPairLanes = kLanes64;

/// Those of a width that this machine has, not Best; for one lane, those of 16 bytes.
const PairKernels& pairKernels(LaneWidth width);

/// The same for one width; defined in a file that is compiled with its instructions.
template <int W>
struct PairKernelsOf {
    static const PairKernels kTable;
};

extern template struct PairKernelsOf<kLanes16>;
extern template struct PairKernelsOf<kLanes32>;
extern template struct PairKernelsOf<kLanes64>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
