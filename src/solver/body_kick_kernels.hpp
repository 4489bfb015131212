// SPDX-License-Identifier: MIT
// The kernels over bodies for the two kicks of a tick.
#pragma once

#include "solver/body_runs.hpp"
#include "solver/integrate.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The constants of damping in a tick, for each of W bodies.
template <int W>
struct DampingOf {
    using Wide = DoubleLane<W>;
    LaneMask<W> damped;
    Wide keep = Wide(1.0), kickTime, excessTime, excessAccel;

    template <class Run>
    TAMIAS_INLINE DampingOf(Motion* motions, std::size_t offset, Lane<W> rate, const StepContext& context,
                            const Run& run)
        : damped(rate > Lane<W>(real(0))), kickTime(static_cast<double>(context.h) / 2)
    {
        if (!any(damped)) return;
        const FourDoubles<W> of = gatherDoubles<W>(run.groups(motions, offset));
        const DoubleMask<W> is = toDouble(damped);
        keep = select(is, of.x, keep);
        kickTime = select(is, of.y, kickTime);
        excessTime = select(is, of.z, excessTime);
        excessAccel = select(is, of.w, excessAccel);
    }

    Lane<W> wholeKeep() const { return toReal(keep * keep); }
    Lane<W> wholeTime() const { return toReal(kickTime * (Wide(1.0) + keep)); }
};

// Half a tick of those that carry no load.
template <int W, class Run>
TAMIAS_INLINE void kickFree(Motion* motions, FourLanes<W>& velocity, const FourLanes<W>& steady,
                            const FourLanes<W>& outside, const DampingOf<W>& way, const DampingOf<W>& turn,
                            LaneMask<W> loaded, const Run& run)
{
    const auto at = run.groups(motions, kFine);
    FourDoubles<W> fine = gatherDoubles<W>(at);
    FourDoubles<W> next = fine;
    FourLanes<W> v = velocity;
    kickHalf(v.x, next.x, outside.x, steady.x, way.keep, way.kickTime);
    kickHalf(v.y, next.y, outside.y, steady.y, way.keep, way.kickTime);
    kickHalf(v.z, next.z, outside.z, steady.z, turn.keep, turn.kickTime);
    velocity.x = select(loaded, velocity.x, v.x);
    velocity.y = select(loaded, velocity.y, v.y);
    velocity.z = select(loaded, velocity.z, v.z);
    const DoubleMask<W> keeps = toDouble(loaded);
    fine.x = select(keeps, fine.x, next.x);
    fine.y = select(keeps, fine.y, next.y);
    fine.z = select(keeps, fine.z, next.z);
    scatterDoubles<W>(fine, at);
}

template <int W, class Run>
TAMIAS_INLINE void keepExcess(Motion* motions, const FourLanes<W>& velocity, const FourLanes<W>& outside,
                              const DampingOf<W>& way, const DampingOf<W>& turn, LaneMask<W> loaded,
                              const Run& run)
{
    const DoubleMask<W> none = toDouble(loaded);
    const auto excess = [none](Lane<W> speed, Lane<W> acceleration, const DampingOf<W>& damping) {
        return select(none, DoubleLane<W>(0.0),
                      excessOf(speed, acceleration, damping.excessTime, damping.excessAccel));
    };
    scatterDoubles<W>({excess(velocity.x, outside.x, way), excess(velocity.y, outside.y, way),
                       excess(velocity.z, outside.z, turn), DoubleLane<W>(0.0)},
                      run.groups(motions, kExcess));
}

template <int W>
void kick(const BodyRows& bodies, const StepContext& context, bool kicked)
{
    using Wide = Lane<W>;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0));
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> velocity = load<W>(motions, kVelocity, run);
        const FourLanes<W> steady = load<W>(motions, kSteady, run);
        const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
        const FourLanes<W> rates = load<W>(motions, kRotation, run);
        const DampingOf<W> way(motions, kDampedTick, rates.z, context, run);
        const DampingOf<W> turn(motions, kDampedTurn, rates.w, context, run);
        const LaneMask<W> loaded = steady.w > zero;
        if (any(way.damped | turn.damped)) keepExcess(motions, velocity, outside, way, turn, loaded, run);

        const FourLanes<W> before = velocity;
        if (any(loaded)) {
            const Wide keep = way.wholeKeep(), time = way.wholeTime();
            velocity.x = kickWhole(before.x, outside.x, steady.x, keep, time);
            velocity.y = kickWhole(before.y, outside.y, steady.y, keep, time);
            velocity.z = kickWhole(before.z, outside.z, steady.z, turn.wholeKeep(), turn.wholeTime());
        }
        if (any(!loaded)) {
            velocity.x = select(loaded, velocity.x, before.x);
            velocity.y = select(loaded, velocity.y, before.y);
            velocity.z = select(loaded, velocity.z, before.z);
            kickFree(motions, velocity, steady, outside, way, turn, loaded, run);
        }
        if (kicked) {
            const FourLanes<W> hit = load<W>(rows.kicks.data(), offsetof(ImpactKick, before), run);
            velocity.x += hit.x, velocity.y += hit.y, velocity.z += hit.z;
        } else {
            velocity.x += zero, velocity.y += zero, velocity.z += zero;  // makes 0 of -0, as a kick of 0 does
        }
        velocity.w = zero;
        store<W>(velocity, motions, kVelocity, run);
        store<W>(velocity, rows.velocities.data(), 0, run);
        store<W>({-velocity.x, -velocity.y, -velocity.z, zero}, rows.changes.data(), 0, run);
    });
}

// What joints alone hold carries what they do along their directions of now: see rows.turned.
template <int W, class Run>
TAMIAS_INLINE void turnSteady(const BodyRows& bodies, FourLanes<W>& steady, FourLanes<W>& change,
                              const Run& run)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), half(real(0.5));
    FourLanes<W> turned = load<W>(bodies.rows.turned.data(), 0, run);
    const LaneMask<W> halved = (turned.w > zero) & !(steady.w > zero);
    if (!any(halved)) return;
    const auto turn = [&](Wide& was, Wide& total, Wide now) {
        total = select(halved, total - half * was + half * now, total);
        was = select(halved, now, was);
    };
    turn(steady.x, change.x, turned.x);
    turn(steady.y, change.y, turned.y);
    turn(steady.z, change.z, turned.z);
    store<W>({zero, zero, zero, turned.w}, bodies.rows.turned.data(), 0, run);
}

// What a drift leaves in registers.
template <int W>
struct Drifted {
    FourLanes<W> velocity, steady, change;
    FourLanes<W> rates;  // of damping: the third and the fourth
};

// The second kick. Returns how many bodies it slowed.
template <int W, class Run>
TAMIAS_INLINE std::uint32_t kickAfterDrift(const BodyRows& bodies, const StepContext& context, bool kicked,
                                           bool jointed, const Drifted<W>& drifted, const Run& run)
{
    using Wide = Lane<W>;
    FourLanes<W> velocity = drifted.velocity, steady = drifted.steady, change = drifted.change;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0)), h(context.h), most(mostSpeed(context.lengthUnit)), mostTurn(mostSpin());
    const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
    const LaneMask<W> loaded = steady.w > zero;
    if (jointed) turnSteady(bodies, steady, change, run);
    if (any(!loaded)) {
        const DampingOf<W> way(motions, kDampedTick, drifted.rates.z, context, run);
        const DampingOf<W> turn(motions, kDampedTurn, drifted.rates.w, context, run);
        kickFree(motions, velocity, steady, outside, way, turn, loaded, run);
    }
    if (kicked) {
        const FourLanes<W> hit = load<W>(rows.kicks.data(), offsetof(ImpactKick, after), run);
        velocity.x += hit.x, velocity.y += hit.y, velocity.z += hit.z;
    } else {
        velocity.x += zero, velocity.y += zero, velocity.z += zero;
    }
    velocity.w = zero;
    store<W>(velocity, motions, kVelocity, run);
    if (jointed) store<W>(velocity, rows.velocities.data(), 0, run);

    steady.x = change.x, steady.y = change.y, steady.z = change.z;
    store<W>(steady, motions, kSteady, run);
    change.x += h * outside.x;
    change.y += h * outside.y;
    change.z += h * outside.z;
    store<W>(change, rows.changes.data(), 0, run);

    const LaneMask<W> fast =
        (velocity.x * velocity.x + velocity.y * velocity.y > most * most) | (absolute(velocity.z) > mostTurn);
    if (!any(fast)) return 0;
    const std::uint32_t found = bitsOf(fast & isMovable(load<W>(motions, kMasses, run))) & run.valid();
    std::uint32_t clamped = 0;
    for (int lane = 0; lane < W; ++lane) {
        const std::uint32_t row = run.row(lane);
        if ((found >> lane & 1u) == 0 || !clampSpeed(motions[row], context.lengthUnit)) continue;
        ++clamped;
        if (jointed) rows.velocities[row] = laneRow(velocityOf(motions[row]));
    }
    return clamped;
}

template <int W>
std::uint32_t kickAfterDrift(const BodyRows& bodies, const StepContext& context, bool kicked, bool jointed)
{
    Motion* const motions = bodies.motions;
    std::uint32_t clamped = 0;
    eachRun<W>(bodies, [&](const auto& run) {
        const Drifted<W> drifted{load<W>(motions, kVelocity, run), load<W>(motions, kSteady, run),
                                 load<W>(bodies.rows.changes.data(), 0, run),
                                 load<W>(motions, kRotation, run)};
        clamped += kickAfterDrift(bodies, context, kicked, jointed, drifted, run);
    });
    return clamped;
}

template <int W>
void takeSettled(const BodyRows& bodies)
{
    using Wide = Lane<W>;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0));
    eachRun<W>(bodies, [&](const auto& run) {
        const LaneMask<W> tied = load<W>(rows.turned.data(), 0, run).w > zero;
        if (!any(tied)) return;
        FourLanes<W> velocity = load<W>(rows.velocities.data(), 0, run);
        const FourLanes<W> before = load<W>(motions, kVelocity, run);
        FourLanes<W> change = load<W>(rows.changes.data(), 0, run);
        FourLanes<W> steady = load<W>(motions, kSteady, run);
        const auto take = [&](Wide& total, Wide& carried, Wide by) {
            total = select(tied, total + by, total);
            carried = select(tied, carried + by, carried);
        };
        take(change.x, steady.x, velocity.x - before.x);
        take(change.y, steady.y, velocity.y - before.y);
        take(change.z, steady.z, velocity.z - before.z);
        store<W>(change, rows.changes.data(), 0, run);
        store<W>(steady, motions, kSteady, run);
        velocity.w = before.w;
        store<W>(velocity, motions, kVelocity, run);
    });
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
