// SPDX-License-Identifier: MIT
#include "math/angle.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {

double angleBetween(DVec2 from, DVec2 to) noexcept
{
    // The direction of `to` as seen from `from`, as a point of the unit circle.
    DVec2 u = {dot(from, to), cross(from, to)};
    const double size = length(u);
    u = (1 / size) * u;

    // A guess within 0.1 rad: a quarter turn is nearly even in the part of |x| + |y| covered.
    const double part = absolute(u.y) / (absolute(u.x) + absolute(u.y));
    double angle = u.x < 0 ? kPi - part * (kPi / 2) : part * (kPi / 2);
    if (u.y < 0) angle = -angle;

    // What is left is the angle whose sine is e; e + e^3 / 6 leaves e^5, so three rounds are plenty.
    for (int round = 0; round < 3; ++round) {
        const SinCos guess = sinCos(angle);
        const double e = guess.cos * u.y - guess.sin * u.x;
        angle += e + e * e * e * (1.0 / 6.0);
    }
    return wrapAngle(angle);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
