// SPDX-License-Identifier: MIT
#pragma once

#include "contacts/rows.hpp"
#include "model/motion.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The share of an impact's velocity change that comes before the drift of its tick, and after it:
/// so placed, the position at the end is that of a body hit at the right time.
struct ImpactKick {
    Vec2 before, after;                   // [m/s]
    real spinBefore = 0, spinAfter = 0;   // [rad/s]
};

/// The constants of exponential damping over a tick of length h: docs/theory/integration.md, eq. 5-7.
Damping makeDamping(real rate, real h);

/// First kick of a tick. A free body gets half of what acts on it, a loaded one all of it: what
/// rests on something is solved once, with its whole load.
void kickFirst(Motion& m, const ImpactKick& kick);

/// How a body went: the way of its center, and at most how much more any point of it by turning.   [m]
struct Way {
    Vec2 shift;
    real turn = 0;
};

/// Moves the body along its velocity and the push, and by what damping adds to that.
Way drift(Motion& m, const BodyMotion<real>& push, real h);

/// The rest of the kick, with the acceleration at the new place.
void kickSecond(Motion& m, const ImpactKick& kick);

/// Takes back the angular momentum that a body gains when contacts change its way by `solved` [m/s] in a
/// tick in which impacts had reckoned with another: their second kicks act a little off their places [GD1].
void repayImpact(Motion& m, const ImpactKick& kick, Vec2 solved, real h);

/// Holds speed and spin below their bounds; returns whether it had to.
bool clampSpeed(Motion& m, real lengthUnit);

}  // namespace tamias2d::inline TAMIAS_PRECISION
