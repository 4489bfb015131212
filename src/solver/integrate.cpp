// SPDX-License-Identifier: MIT
// Kick-drift-kick: second order, exact for constant forces and for exponential damping with them.
// docs/theory/integration.md.

#include "solver/integrate.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/model/defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

Damping makeDamping(real rate, real h)
{
    Damping damping;
    damping.rate = rate;
    const double c = static_cast<double>(rate), step = static_cast<double>(h);
    damping.kickTime = h / 2;
    damping.driftTime = h;
    if (!(rate > 0)) return damping;

    const double x = c * step / 2;
    // Beyond 30 nothing is left of the velocity but 1e-13 of it, and 1 / keep stays a number.
    const double keep = exponential(-minimum(x, 30.0));
    damping.keep = static_cast<real>(keep);
    if (x < 0.05) {  // series, as the closed forms cancel
        damping.kickTime =
            static_cast<real>(step / 2 * (1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6))))));
        const double x2 = x * x;
        const double beyond = x2 / 6 * (1 + x2 / 20 * (1 + x2 / 42));  // sinh(x)/x - 1
        damping.driftTime = static_cast<real>(step * (1 + beyond));
        damping.driftAccel = static_cast<real>(-step * beyond / c);
    } else {
        const double sinh = (1 / keep - keep) / 2;
        damping.kickTime = static_cast<real>((1 - keep) / c);
        damping.driftTime = static_cast<real>(2 * sinh / c);
        damping.driftAccel = static_cast<real>((step - 2 * sinh / c) / c);
    }
    return damping;
}

void kickFirst(Motion& m, const ImpactKick& kick)
{
    const Damping &d = m.damping, &s = m.spinDamping;
    if (m.loaded) {
        m.velocity = d.keep * d.keep * m.velocity + d.kickTime * (1 + d.keep) * m.acceleration + m.steady;
        m.spin = s.keep * s.keep * m.spin + s.kickTime * (1 + s.keep) * m.spinRate + m.steadySpin;
    } else {
        m.velocity = d.keep * m.velocity + d.kickTime * m.acceleration + real(0.5) * m.steady;
        m.spin = s.keep * m.spin + s.kickTime * m.spinRate + real(0.5) * m.steadySpin;
    }
    m.velocity += kick.before;
    m.spin += kick.spinBefore;
}

void drift(Motion& m, const Push& push, real h)
{
    const double time = static_cast<double>(h);
    DVec2 shift = time * toDVec2(m.velocity + push.shift);
    double turn = time * static_cast<double>(m.spin + push.turn);
    if (!m.loaded) {
        shift += static_cast<double>(m.damping.driftTime - h) * toDVec2(m.velocity) +
                 static_cast<double>(m.damping.driftAccel) * toDVec2(m.acceleration);
        turn += static_cast<double>(m.spinDamping.driftTime - h) * static_cast<double>(m.spin) +
                static_cast<double>(m.spinDamping.driftAccel) * static_cast<double>(m.spinRate);
    }
    m.center = m.center + shift;
    if (turn != 0) {
        m.angle = wrapAngle(m.angle + turn);
        m.rotation = Rot::ofAngle(m.angle);
    }
}

void kickSecond(Motion& m, const ImpactKick& kick)
{
    if (!m.loaded) {
        const Damping &d = m.damping, &s = m.spinDamping;
        m.velocity = d.keep * m.velocity + d.kickTime * m.acceleration + real(0.5) * m.steady;
        m.spin = s.keep * m.spin + s.kickTime * m.spinRate + real(0.5) * m.steadySpin;
    }
    m.velocity += kick.after;
    m.spin += kick.spinAfter;
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
