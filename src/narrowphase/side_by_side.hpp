// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/swept.hpp"

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

/// How each of up to kLanes pairs of a kind meets between 0 and the time of their ways: as collideSwept, or
/// false in `decided` where that must be asked.
void collideInLanes(LaneKind kind, const PairOnWay* pairs, int count, SweptResult* results, bool* decided);

}  // namespace tamias2d::inline TAMIAS_PRECISION
