// SPDX-License-Identifier: MIT
#include "solver/integrate.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/model/defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// sinh(x)/x - 1 for 0 <= x < 1, where the closed form cancels; what is left out is below 2^-53 of it.
double sinhExcess(double x)
{
    const double z = x * x;
    double sum = 1;
    for (const double next : {272.0, 210.0, 156.0, 110.0, 72.0, 42.0, 20.0}) sum = 1 + z / next * sum;
    return z / 6 * sum;
}

}  // namespace

Damping makeDamping(real rate, real h)
{
    Damping damping;
    const double c = static_cast<double>(rate), step = static_cast<double>(h);
    damping.kickTime = step / 2;
    if (!(rate > 0)) return damping;

    const double x = c * step / 2;
    damping.keep = exponential(-x);
    if (x < 1) {
        damping.kickTime = step / 2 * exponential(-x / 2) * (1 + sinhExcess(x / 2));
        damping.excessTime = step * damping.keep * sinhExcess(x);
    } else {
        damping.kickTime = (1 - damping.keep) / c;
        damping.excessTime = (1 - damping.keep * damping.keep) / c - step * damping.keep;
    }
    damping.excessAccel = damping.excessTime / c;
    return damping;
}

void startDamping(Motion& m, real h)
{
    if (!m.isDamped()) return;
    m.dampedTick = makeDamping(m.damping, h);
    m.dampedTurn = makeDamping(m.spinDamping, h);
}

real mostSpeed(real lengthUnit)
{
    return static_cast<real>(kMaxSpeed) * lengthUnit;
}

real mostSpin()
{
    return static_cast<real>(kMaxSpin);
}

bool clampSpeed(Motion& m, real lengthUnit)
{
    const real most = mostSpeed(lengthUnit), turn = mostSpin();
    bool clamped = false;
    if (dot(m.velocity, m.velocity) > most * most) {
        m.velocity = (most / length(m.velocity)) * m.velocity;
        clamped = true;
    }
    if (absolute(m.spin) > turn) {
        m.spin = clamp(m.spin, -turn, turn);
        clamped = true;
    }
    return clamped;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
