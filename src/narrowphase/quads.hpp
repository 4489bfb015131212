// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/swept.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// How a body goes from time 0 to another, as lanes read it: the same for all pairs of the body.
struct alignas(16) SpanOfWay {
    Rot start, end;
    Vec2 byVelocity, byAcceleration;   ///< the parts of its way   [m]
    real turn = 0;                     ///< absolute   [rad]
    real unused[3] = {};

    SpanOfWay() = default;
    SpanOfWay(const Trajectory& path, real to);   ///< `path` must have looked ahead to that time
};

/// May lanes try this shape? Sharp quadrilaterals: boxes, above all.
inline bool isQuad(const Convex& shape)
{
    return shape.count == 4 && shape.radius <= 0;
}

/// Two quadrilaterals for collideQuads.
struct QuadPair {
    const Convex *a, *b;
    const SpanOfWay *wayA, *wayB;
    Vec2 positionA, positionB;   ///< of the centers of mass at time 0, from a place near both   [m]
    real restGap;                ///< [m]
};

/// How each of up to kLanes pairs meets between 0 and the time of their ways: as collideSwept, or false in
/// `decided` where that must be asked.
void collideQuads(const QuadPair* pairs, int count, SweptResult* results, bool* decided);

}  // namespace tamias2d::inline TAMIAS_PRECISION
