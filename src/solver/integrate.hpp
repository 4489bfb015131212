// SPDX-License-Identifier: MIT
// Kick-drift-kick: second order, exact for constant forces and for exponential damping with them. Formulas
// for W bodies at once. docs/theory/integration.md.
#pragma once

#include "math/double_lane.hpp"
#include "model/motion.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The constants of exponential damping over a tick of length h: docs/theory/integration.md, eq. 5-7.
Damping makeDamping(real rate, real h);
/// Those of a body, if it is damped.
void startDamping(Motion& m, real h);

/// Holds speed and spin below their bounds; returns whether it had to.
bool clampSpeed(Motion& m, real lengthUnit);

/// Bounds of clampSpeed.   [m/s], [rad/s]
real mostSpeed(real lengthUnit);
real mostSpin();

/// Half a tick of a velocity, from what it is the rounding of, if that still is so.
template <int W>
void kickHalf(Lane<W>& velocity, DoubleLane<W>& fine, Lane<W> acceleration, Lane<W> steady,
              DoubleLane<W> keep, DoubleLane<W> kickTime)
{
    fine = select(toDouble(isEqual(toReal(fine), velocity)), fine, toDouble(velocity));
    fine = keep * fine + kickTime * toDouble(acceleration) + DoubleLane<W>(0.5) * toDouble(steady);
    velocity = toReal(fine);
}

/// A whole tick of a velocity that carries a load; `keep` and `time` are those of the whole tick.
template <int W>
Lane<W> kickWhole(Lane<W> velocity, Lane<W> acceleration, Lane<W> steady, Lane<W> keep, Lane<W> time)
{
    return keep * velocity + time * acceleration + steady;
}

/// What damping adds to the drift of a tick.   [m] or [rad]
template <int W>
DoubleLane<W> excessOf(Lane<W> velocity, Lane<W> acceleration, DoubleLane<W> excessTime,
                       DoubleLane<W> excessAccel)
{
    return excessTime * toDouble(velocity) - excessAccel * toDouble(acceleration);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
