// SPDX-License-Identifier: MIT
// Kick-drift-kick: second order, exact for constant forces and for exponential damping with them.
// docs/theory/integration.md.

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

// Half a tick of a velocity, from what it is the rounding of, if that still is so.
void kickHalf(real& velocity, double& fine, real acceleration, real steady, const Damping& d)
{
    if (static_cast<real>(fine) != velocity) fine = static_cast<double>(velocity);
    fine = d.keep * fine + d.kickTime * static_cast<double>(acceleration) + 0.5 * static_cast<double>(steady);
    velocity = static_cast<real>(fine);
}

void kickHalf(Motion& m)
{
    kickHalf(m.velocity.x, m.fineVelocity.x, m.acceleration.x, m.steady.x, m.damping);
    kickHalf(m.velocity.y, m.fineVelocity.y, m.acceleration.y, m.steady.y, m.damping);
    kickHalf(m.spin, m.fineSpin, m.spinRate, m.steadySpin, m.spinDamping);
}

real kickWhole(real velocity, real acceleration, real steady, const Damping& d)
{
    return static_cast<real>(d.keep * d.keep) * velocity +
           static_cast<real>(d.kickTime * (1 + d.keep)) * acceleration + steady;
}

double excessOf(real velocity, real acceleration, const Damping& d)
{
    return d.excessTime * static_cast<double>(velocity) - d.excessAccel * static_cast<double>(acceleration);
}

}  // namespace

Damping makeDamping(real rate, real h)
{
    Damping damping;
    damping.rate = rate;
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

void kickFirst(Motion& m, const ImpactKick& kick)
{
    if (m.loaded) {
        m.velocity = {kickWhole(m.velocity.x, m.acceleration.x, m.steady.x, m.damping),
                      kickWhole(m.velocity.y, m.acceleration.y, m.steady.y, m.damping)};
        m.spin = kickWhole(m.spin, m.spinRate, m.steadySpin, m.spinDamping);
        m.excess = {};
        m.excessTurn = 0;
    } else {
        m.excess = {excessOf(m.velocity.x, m.acceleration.x, m.damping),
                    excessOf(m.velocity.y, m.acceleration.y, m.damping)};
        m.excessTurn = excessOf(m.spin, m.spinRate, m.spinDamping);
        kickHalf(m);
    }
    m.velocity += kick.before;
    m.spin += kick.spinBefore;
}

Way drift(Motion& m, const BodyMotion<real>& push, real h)
{
    const double time = static_cast<double>(h);
    const DVec2 shift = time * toDVec2(m.velocity + push.velocity) + m.excess;
    m.center = m.center + shift;
    const double turn = time * static_cast<double>(m.spin + push.spin) + m.excessTurn;
    if (turn != 0) {
        m.angle = wrapAngle(m.angle + turn);
        m.rotation = Rot::ofAngle(m.angle);
    }
    return {toVec2(shift), m.extent * absolute(static_cast<real>(turn))};
}

void kickSecond(Motion& m, const ImpactKick& kick)
{
    if (!m.loaded) kickHalf(m);
    m.velocity += kick.after;
    m.spin += kick.spinAfter;
}

void repayImpact(Motion& m, const ImpactKick& kick, Vec2 solved, real h)
{
    const bool hit = kick.after.x != 0 || kick.after.y != 0;
    if (!hit || !(m.invInertia > 0) || !m.isFree()) return;
    const Vec2 early = m.loaded ? solved + real(0.5) * (m.steady + h * m.acceleration) : solved;
    m.spin -= m.invInertia * h / m.invMass.x * cross(early, kick.after);
}

bool clampSpeed(Motion& m, real lengthUnit)
{
    const real most = static_cast<real>(kMaxSpeed) * lengthUnit, mostSpin = static_cast<real>(kMaxSpin);
    bool clamped = false;
    if (dot(m.velocity, m.velocity) > most * most) {
        m.velocity = (most / length(m.velocity)) * m.velocity;
        clamped = true;
    }
    if (absolute(m.spin) > mostSpin) {
        m.spin = clamp(m.spin, -mostSpin, mostSpin);
        clamped = true;
    }
    return clamped;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
