// SPDX-License-Identifier: MIT
// The kernels over bodies, for one width: included once for each instruction set, by a file that is compiled
// with the switches of that set.
#pragma once

#include "solver/body_flight_kernel.hpp"
#include "solver/body_start_kernels.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// How far what joints tie is turned in a tick by that at most.   [rad]
inline constexpr real kMostRepaid = real(0.05);

// The spin that takes back the angular momentum which a body gains when contacts change its way by `solved`
// [m/s] in a tick in which impacts had reckoned with another: their second kicks act a little off their
// places [GD1].
template <int W, class Run>
TAMIAS_INLINE Lane<W> repaidSpin(const BodyRows& bodies, const FourLanes<W>& masses,
                                 const FourLanes<W>& steady, BasicVec2<Lane<W>> solved,
                                 const StepContext& context, const Run& run)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), half(real(0.5)), h(context.h);
    const FourLanes<W> after = load<W>(bodies.rows.kicks.data(), offsetof(ImpactKick, after), run);
    const FourLanes<W> outside = load<W>(bodies.motions, kAcceleration, run);
    const LaneMask<W> hit = !(isEqual(after.x, zero) & isEqual(after.y, zero));
    const LaneMask<W> owes = hit & (masses.z > zero) & (masses.x > zero) & isEqual(masses.x, masses.y);
    const LaneMask<W> loaded = steady.w > zero;
    const Wide earlyX = select(loaded, solved.x + half * (steady.x + h * outside.x), solved.x);
    const Wide earlyY = select(loaded, solved.y + half * (steady.y + h * outside.y), solved.y);
    const Wide turn = earlyX * after.y - earlyY * after.x;
    return select(owes, masses.z * h / masses.x * turn, zero);
}

// Joints have reckoned with the spin that a body had after the passes: what they tie is turned by that but a
// little.
template <int W, class Run>
TAMIAS_INLINE Lane<W> repaidOfTied(Lane<W> repaid, TickRows& rows, const StepContext& context, const Run& run)
{
    const Lane<W> most(kMostRepaid * context.invH);
    const LaneMask<W> tied = load<W>(rows.turned.data(), 0, run).w > Lane<W>(real(0));
    return select(tied, clamp(repaid, -most, most), repaid);
}

// No body goes farther in a tick than the fastest may, whatever contacts and joints have asked of it: what
// reckons with longer ways ends in values that are no numbers. Motion::velocity is clamped after the
// tick.
template <int W>
TAMIAS_INLINE void holdBack(FourLanes<W>& velocity, Lane<W> most, Lane<W> mostTurn)
{
    const LaneMask<W> fast =
        (absolute(velocity.x) > most) | (absolute(velocity.y) > most) | (absolute(velocity.z) > mostTurn);
    if (!any(fast)) return;
    velocity.x = select(fast, clamp(velocity.x, -most, most), velocity.x);
    velocity.y = select(fast, clamp(velocity.y, -most, most), velocity.y);
    velocity.z = select(fast, clamp(velocity.z, -mostTurn, mostTurn), velocity.z);
}

// Moves W bodies on, by a shift of the center [m] and a turn [rad].
template <int W, class Run>
TAMIAS_INLINE void moveOn(const BodyRows& bodies, FourLanes<W>& rotation, Lane<W> extent,
                          const FourDoubles<W>& shift, const Run& run)
{
    using Double = DoubleLane<W>;
    FourDoubles<W> place = gatherDoubles<W>(run.groups(bodies.motions, kPlace));
    place.x += shift.x;
    place.y += shift.y;
    const DoubleMask<W> turned = !isEqual(shift.z, Double(0.0));
    if (any(turned)) {
        const Double angle = wrapped(place.z + shift.z);
        const SineCosine<Double> to = sineCosineOf(reduceShort(angle));
        const LaneMask<W> anew = toReal(turned);
        place.z = select(turned, angle, place.z);
        rotation.x = select(anew, toReal(to.cosine), rotation.x);
        rotation.y = select(anew, toReal(to.sine), rotation.y);
        store<W>(rotation, bodies.motions, kRotation, run);
    }
    scatterDoubles<W>(place, run.groups(bodies.motions, kPlace));

    const FourDoubles<W> origin = gatherDoubles<W>(run.groups(bodies.rows.origins.data(), 0));
    store<W>({toReal(place.x - origin.x), toReal(place.y - origin.y), rotation.x, rotation.y},
             bodies.rows.poses.data(), 0, run);
    store<W>({toReal(shift.x), toReal(shift.y), extent * absolute(toReal(shift.z)), Lane<W>(real(0))},
             bodies.rows.ways.data(), 0, run);
}

// With the second kick, if `kicks`.
template <int W, bool kicks>
std::uint32_t driftAnd(const BodyRows& bodies, const StepContext& context, bool kicked, bool pushed,
                       bool jointed)
{
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0)), most(mostSpeed(context.lengthUnit)), mostTurn(mostSpin());
    const Double time(static_cast<double>(context.h));
    std::uint32_t clamped = 0;
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> velocity = load<W>(rows.velocities.data(), 0, run);
        FourLanes<W> change = load<W>(rows.changes.data(), 0, run);
        const FourLanes<W> steady = load<W>(motions, kSteady, run), masses = load<W>(motions, kMasses, run);
        const BasicVec2<Wide> solved{change.x + velocity.x, change.y + velocity.y};
        change = {solved.x + steady.x, solved.y + steady.y, change.z + (velocity.z + steady.z), zero};
        if (!kicks) store<W>(change, rows.changes.data(), 0, run);
        if (kicked) {
            const Wide repaid = repaidSpin(bodies, masses, steady, solved, context, run);
            velocity.z -= jointed ? repaidOfTied(repaid, rows, context, run) : repaid;
        }
        holdBack(velocity, most, mostTurn);
        velocity.w = zero;
        if (!kicks) store<W>(velocity, motions, kVelocity, run);

        FourLanes<W> way{velocity.x + zero, velocity.y + zero, velocity.z + zero, zero};
        if (pushed) {
            const FourLanes<W> push = load<W>(rows.pushes.data(), 0, run);
            way.x = velocity.x + push.x, way.y = velocity.y + push.y, way.z = velocity.z + push.z;
        }
        FourLanes<W> rotation = load<W>(motions, kRotation, run);
        FourDoubles<W> excess;
        if (any((rotation.z > zero) | (rotation.w > zero)))
            excess = gatherDoubles<W>(run.groups(motions, kExcess));
        const FourDoubles<W> shift{time * toDouble(way.x) + excess.x, time * toDouble(way.y) + excess.y,
                                   time * toDouble(way.z) + excess.z, Double(0.0)};
        moveOn(bodies, rotation, masses.w, shift, run);
        if (kicks)
            clamped += kickAfterDrift(bodies, context, kicked, false,
                                      Drifted<W>{velocity, steady, change, rotation}, run);
    });
    return clamped;
}

template <int W>
void drift(const BodyRows& bodies, const StepContext& context, bool kicked, bool pushed, bool jointed)
{
    driftAnd<W, false>(bodies, context, kicked, pushed, jointed);
}

template <int W>
std::uint32_t driftAndKick(const BodyRows& bodies, const StepContext& context, bool kicked, bool pushed)
{
    return driftAnd<W, true>(bodies, context, kicked, pushed, false);
}

// Motion against the grounds, and whether its kinetic energy rises.
template <int W, class Rows, class Grounds>
TAMIAS_INLINE void calmRun(Motion* motions, const Rows& run, const Grounds& ground, TickRows& rows,
                           const StepContext& context)
{
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;
    const Wide zero(real(0)), one(real(1)), rate(context.tuning.calmRate), slow(context.calmSpeed());
    const Double none(0.0), unit(1.0);
    const LaneMask<W> loaded = load<W>(motions, kSteady, run).w > zero;
    if (!any(loaded)) return;
    FourLanes<W> v = load<W>(motions, kVelocity, run);
    const FourLanes<W> masses = load<W>(motions, kMasses, run);
    const FourLanes<W> g = load<W>(motions, kVelocity, ground);
    const FourLanes<W> change = load<W>(rows.changes.data(), 0, run);
    const FourDoubles<W> place = gatherDoubles<W>(run.groups(motions, kPlace));
    const FourDoubles<W> from = gatherDoubles<W>(ground.groups(motions, kPlace));

    const Wide rx = toReal(place.x - from.x), ry = toReal(place.y - from.y);
    const Wide ux = v.x - g.x + g.z * ry, uy = v.y - g.y - g.z * rx;
    const Wide w = v.z - g.z;
    const Wide inverse = maximum(masses.x, masses.y);
    const Double mass = select(toDouble(inverse > zero), unit / toDouble(inverse), none);
    const Double inertia = select(toDouble(masses.z > zero), unit / toDouble(masses.z), none);
    const Double power = mass * toDouble(ux * change.x + uy * change.y) + inertia * toDouble(w * change.z);
    const Wide speed = (squareRoot(ux * ux + uy * uy) + absolute(w) * masses.w) / slow;
    const LaneMask<W> calms = loaded & !(toReal(power > none) | (speed >= one));

    const Wide part = rate * (one - speed * speed);
    v.x = select(calms & (masses.x > zero), v.x - part * ux, v.x);
    v.y = select(calms & (masses.y > zero), v.y - part * uy, v.y);
    v.z = select(calms & (masses.z > zero), v.z - part * w, v.z);
    store<W>(v, motions, kVelocity, run);
}

template <int W>
void calm(Motion* motions, const CalmPair* pairs, std::size_t count, TickRows& rows,
          const StepContext& context)
{
    std::size_t first = 0;
    const auto isOneGround = [pairs](std::size_t from) {
        for (std::size_t i = 0; i < W; ++i)
            if (pairs[from + i].ground != pairs[from].ground || pairs[from + i].row != pairs[from].row + i)
                return false;
        return true;
    };
    for (; first < count; first += W) {
        if (first + W <= count && isOneGround(first)) {
            calmRun<W>(motions, WholeRun<W>{pairs[first].row}, SameRow{pairs[first].ground}, rows, context);
            continue;
        }
        AnyRun<W> run, grounds;
        for (std::size_t i = 0; i < W; ++i) {
            const CalmPair& pair = pairs[first + i < count ? first + i : count - 1];
            run.at[i] = pair.row;
            grounds.at[i] = pair.ground;
        }
        calmRun<W>(motions, run, grounds, rows, context);
    }
}

}  // namespace

template <int W>
const BodyKernels BodyKernelsOf<W>::kTable = {
    expect<W>,         boundSpeeds<W>, startTick<W>,    kick<W>, drift<W>,
    kickAfterDrift<W>, takeSettled<W>, driftAndKick<W>, calm<W>, fly<W>};

}  // namespace tamias2d::inline TAMIAS_PRECISION
