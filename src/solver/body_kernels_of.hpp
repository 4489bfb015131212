// SPDX-License-Identifier: MIT
// The kernels over bodies, for one width: included once for each instruction set, by a file that is compiled
// with the switches of that set.
#pragma once

#include "math/turn_kernel.hpp"
#include "solver/body_kernels.hpp"
#include "solver/integrate.hpp"

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// W rows one after the other.
template <int W>
struct WholeRun {
    std::uint32_t first;
    static constexpr std::uint32_t kValid = (1u << W) - 1;   // lanes, as bits

    std::uint32_t valid() const { return kValid; }
    std::uint32_t row(int lane) const { return first + static_cast<std::uint32_t>(lane); }
    template <class Row>
    TAMIAS_INLINE auto groups(Row* rows, std::size_t offset) const
    {
        return ConsecutiveRows<std::byte, sizeof(Row)>{reinterpret_cast<std::byte*>(rows + first) + offset};
    }
};

// Any W rows. If one stands for several lanes, what is written twice is the same.
template <int W>
struct AnyRun {
    std::uint32_t at[W];
    std::uint32_t count = W;

    std::uint32_t valid() const { return (std::uint64_t{1} << count) - 1; }
    std::uint32_t row(int lane) const { return at[lane]; }
    template <class Row>
    TAMIAS_INLINE auto groups(Row* rows, std::size_t offset) const
    {
        return ScatteredRows<std::byte>{reinterpret_cast<std::byte*>(rows) + offset, sizeof(Row), at};
    }
};

// One row in all lanes; to be read.
struct SameRow {
    std::uint32_t row;

    template <class Row>
    TAMIAS_INLINE auto groups(Row* rows, std::size_t offset) const
    {
        return ConsecutiveRows<std::byte, 0>{reinterpret_cast<std::byte*>(rows + row) + offset};
    }
};

// The last of a range, fewer than W: the last one stands in for those that are missing.
template <int W>
AnyRun<W> lastRun(std::uint32_t first, std::uint32_t end)
{
    AnyRun<W> run;
    run.count = end - first;
    for (std::uint32_t i = 0; i < W; ++i) run.at[i] = i < run.count ? first + i : end - 1;
    return run;
}

template <int W, class Visit>
TAMIAS_INLINE void eachRun(const BodyRows& bodies, Visit visit)
{
    std::uint32_t first = bodies.begin;
    for (; first + W <= bodies.end; first += W) visit(WholeRun<W>{first});
    if (first < bodies.end) visit(lastRun<W>(first, bodies.end));
}

template <int W, class Row, class Run>
TAMIAS_INLINE FourLanes<W> load(Row* rows, std::size_t offset, const Run& run)
{
    return gatherRows<W>(run.groups(rows, offset));
}
template <int W, class Row, class Run>
TAMIAS_INLINE void store(const FourLanes<W>& lanes, Row* rows, std::size_t offset, const Run& run)
{
    scatterRows<W>(lanes, run.groups(rows, offset), ~0u);
}

constexpr std::size_t kPlace = 0, kMasses = offsetof(Motion, invMass), kRotation = offsetof(Motion, rotation),
                      kVelocity = offsetof(Motion, velocity), kSteady = offsetof(Motion, steady),
                      kAcceleration = offsetof(Motion, acceleration), kFine = offsetof(Motion, fineVelocity),
                      kExcess = offsetof(Motion, excess), kDampedTick = offsetof(Motion, dampedTick),
                      kDampedTurn = offsetof(Motion, dampedTurn);

template <int W>
Lane<W> sumOf(Lane<W> x, Lane<W> y)  // of the absolute values: at least the length
{
    return absolute(x) + absolute(y);
}

template <int W>
LaneMask<W> isMovable(const FourLanes<W>& masses)
{
    const Lane<W> zero(real(0));
    return (masses.x + masses.y > zero) | (masses.z > zero);
}

// Loads of a heavy body would throw it out of the world, and infinities into its neighbors, when its mass has
// just been set to a tiny one. Of two infinite loads: no number.
template <int W>
bool limitSteady(FourLanes<W>& steady, const StepContext& context)
{
    const Lane<W> zero(real(0)), most(context.mostSteady), mostSpin(context.mostSteadySpin);
    const auto isWithin = [](Lane<W> change, Lane<W> bound) {
        return (change >= -bound) & (bound >= change);
    };
    const LaneMask<W> within =
        isWithin(steady.x, most) & isWithin(steady.y, most) & isWithin(steady.z, mostSpin);
    if (!any(!within)) return false;
    const auto limited = [zero](Lane<W> change, Lane<W> bound) {
        return select(change == change, clamp(change, -bound, bound), zero);
    };
    steady.x = limited(steady.x, most);
    steady.y = limited(steady.y, most);
    steady.z = limited(steady.z, mostSpin);
    return true;
}

// Has the body left the way its box was made for, or will it? Impacts turn it out of it, and so do the passes
// over contacts.
template <int W>
LaneMask<W> straysOf(const FourLanes<W>& pose, const FourLanes<W>& velocity, Lane<W> extent,
                     const FourLanes<W>& start, const FourLanes<W>& offset, FourLanes<W>& way, Lane<W> t,
                     Lane<W> rest, Lane<W> h)
{
    const Lane<W> half = t * t / Lane<W>(real(2));
    const Lane<W> off =
        sumOf(pose.x - offset.x - t * start.x - half * way.x, pose.y - offset.y - t * start.y - half * way.y);
    const Lane<W> change = sumOf(velocity.x - start.x - t * way.x, velocity.y - start.y - t * way.y);
    const Lane<W> turn = extent * absolute(velocity.z - start.z - t * way.z);
    way.w += h * turn;
    return off + rest * (change + turn) + way.w > start.w;
}

// Accelerations of a flight, and a bound on the speed of all points.
template <int W>
FourLanes<W> flightOf(const FourLanes<W>& velocity, const FourLanes<W>& steady, const FourLanes<W>& outside,
                      const FourLanes<W>& masses, const FourLanes<W>& rotation, const StepContext& context)
{
    const Lane<W> zero(real(0)), h(context.h), invH(context.invH);
    const LaneMask<W> moves = isMovable(masses);
    const auto expected = [&](Lane<W> from, Lane<W> damping, Lane<W> speed, Lane<W> carried) {
        return select(moves, expectedRate(from, damping, speed, carried, invH), zero);
    };
    const Lane<W> x = expected(outside.x, rotation.z, velocity.x, steady.x);
    const Lane<W> y = expected(outside.y, rotation.z, velocity.y, steady.y);
    const Lane<W> turn = expected(outside.z, rotation.w, velocity.z, steady.z);
    return {x, y, turn,
            fastestPoint<Lane<W>>({velocity.x, velocity.y}, velocity.z, {x, y}, turn, masses.w, h)};
}

template <int W>
void boundSpeeds(const BodyRows& bodies, const StepContext& context)
{
    Motion* const motions = bodies.motions;
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> way = load<W>(bodies.rows.ways.data(), 0, run);
        way.w = flightOf(load<W>(motions, kVelocity, run), load<W>(motions, kSteady, run),
                         load<W>(motions, kAcceleration, run), load<W>(motions, kMasses, run),
                         load<W>(motions, kRotation, run), context)
                    .w;
        store<W>(way, bodies.rows.ways.data(), 0, run);
    });
}

template <int W>
real startTick(const BodyRows& bodies, const StepContext& context, const TickTime& time, StrayList& strays)
{
    using Wide = Lane<W>;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0)), h(context.h);
    Wide fastest = zero;
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> steady = load<W>(rows.steady.data(), 0, run);
        if (limitSteady(steady, context)) store<W>(steady, rows.steady.data(), 0, run);
        store<W>(steady, motions, kSteady, run);

        const FourLanes<W> velocity = load<W>(motions, kVelocity, run),
                           masses = load<W>(motions, kMasses, run);
        const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
        const FourLanes<W> damping = load<W>(motions, kRotation, run);
        store<W>({velocity.x, velocity.y, velocity.z, zero}, rows.velocities.data(), 0, run);
        store<W>({outside.x, outside.y, zero, zero}, rows.outside.data(), 0, run);
        const FourLanes<W> flight = flightOf(velocity, steady, outside, masses, damping, context);
        store<W>(flight, rows.expected.data(), 0, run);
        fastest = maximum(flight.w, fastest);
        if (time.number == 0) return;

        constexpr std::size_t kWay = offsetof(PredictedWay, acceleration);
        FourLanes<W> way = load<W>(rows.predicted.data(), kWay, run);
        const LaneMask<W> moves = isMovable(masses);
        const LaneMask<W> leave = straysOf(
            load<W>(rows.poses.data(), 0, run), velocity, masses.w, load<W>(rows.predicted.data(), 0, run),
            load<W>(rows.predicted.data(), offsetof(PredictedWay, offset), run), way, Wide(time.start),
            Wide(time.rest), h);
        store<W>(way, rows.predicted.data(), kWay, run);
        if (!any(leave & moves)) return;
        const std::uint32_t found = bitsOf(leave & moves) & run.valid();
        for (int lane = 0; lane < W; ++lane)
            if ((found >> lane & 1u) != 0) strays.rows[strays.count++] = run.row(lane);
    });
    real most = 0;
    for (int lane = 0; lane < W; ++lane)
        if (fastest.v[lane] > most) most = fastest.v[lane];
    return most;
}

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
    const LaneMask<W> hit = !((after.x == zero) & (after.y == zero));
    const LaneMask<W> owes = hit & (masses.z > zero) & (masses.x > zero) & (masses.x == masses.y);
    const LaneMask<W> loaded = steady.w > zero;
    const Wide earlyX = select(loaded, solved.x + half * (steady.x + h * outside.x), solved.x);
    const Wide earlyY = select(loaded, solved.y + half * (steady.y + h * outside.y), solved.y);
    const Wide turn = earlyX * after.y - earlyY * after.x;
    return select(owes, masses.z * h / masses.x * turn, zero);
}

template <int W>
DoubleLane<W> wrapped(DoubleLane<W> angle)
{
    const DoubleMask<W> within = isWrapped(angle);
    const DoubleLane<W> plain = angle + DoubleLane<W>(0.0);  // makes 0 of -0
    if (!any(!within)) return plain;
    DoubleLane<W> result = select(within, plain, wrappedOf(reduceShort(angle)));
    const DoubleLane<W> bound(kMostShortAngle);
    if (any(!((angle < bound) & (angle > -bound)))) {
        if constexpr (W == 1) {
            result.v = wrapAngle(angle.v);
        } else {
            for (int i = 0; i < DoubleLane<W>::kVectors; ++i)
                for (int k = 0; k < DoubleLane<W>::kWidth; ++k) result.v[i][k] = wrapAngle(angle.v[i][k]);
        }
    }
    return result;
}

template <int W>
void drift(const BodyRows& bodies, const StepContext& context, bool kicked)
{
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0));
    const Double time(static_cast<double>(context.h));
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> velocity = load<W>(rows.velocities.data(), 0, run);
        FourLanes<W> change = load<W>(rows.changes.data(), 0, run);
        const FourLanes<W> steady = load<W>(motions, kSteady, run), masses = load<W>(motions, kMasses, run);
        const BasicVec2<Wide> solved{change.x + velocity.x, change.y + velocity.y};
        change = {solved.x + steady.x, solved.y + steady.y, change.z + (velocity.z + steady.z), zero};
        store<W>(change, rows.changes.data(), 0, run);
        if (kicked) velocity.z -= repaidSpin(bodies, masses, steady, solved, context, run);
        velocity.w = zero;
        store<W>(velocity, motions, kVelocity, run);

        const FourLanes<W> push = load<W>(rows.pushes.data(), 0, run);
        FourLanes<W> rotation = load<W>(motions, kRotation, run);
        FourDoubles<W> excess;
        if (any((rotation.z > zero) | (rotation.w > zero)))
            excess = gatherDoubles<W>(run.groups(motions, kExcess));
        FourDoubles<W> place = gatherDoubles<W>(run.groups(motions, kPlace));
        const Double shiftX = time * toDouble(velocity.x + push.x) + excess.x;
        const Double shiftY = time * toDouble(velocity.y + push.y) + excess.y;
        const Double turn = time * toDouble(velocity.z + push.z) + excess.z;
        place.x += shiftX;
        place.y += shiftY;
        const DoubleMask<W> turned = !(turn == Double(0.0));
        if (any(turned)) {
            const Double angle = wrapped(place.z + turn);
            const SineCosine<Double> to = sineCosineOf(reduceShort(angle));
            const LaneMask<W> anew = toReal(turned);
            place.z = select(turned, angle, place.z);
            rotation.x = select(anew, toReal(to.cosine), rotation.x);
            rotation.y = select(anew, toReal(to.sine), rotation.y);
            store<W>(rotation, motions, kRotation, run);
        }
        scatterDoubles<W>(place, run.groups(motions, kPlace));

        const FourDoubles<W> origin = gatherDoubles<W>(run.groups(rows.origins.data(), 0));
        store<W>({toReal(place.x - origin.x), toReal(place.y - origin.y), rotation.x, rotation.y},
                 rows.poses.data(), 0, run);
        store<W>({toReal(shiftX), toReal(shiftY), masses.w * absolute(toReal(turn)), zero}, rows.ways.data(),
                 0, run);
    });
}

template <int W>
std::uint32_t kickAfterDrift(const BodyRows& bodies, const StepContext& context, bool kicked)
{
    using Wide = Lane<W>;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0)), h(context.h), most(mostSpeed(context.lengthUnit)), mostTurn(mostSpin());
    std::uint32_t clamped = 0;
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> velocity = load<W>(motions, kVelocity, run), steady = load<W>(motions, kSteady, run);
        const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
        const LaneMask<W> loaded = steady.w > zero;
        if (any(!loaded)) {
            const FourLanes<W> rates = load<W>(motions, kRotation, run);
            const DampingOf<W> way(motions, kDampedTick, rates.z, context, run);
            const DampingOf<W> turn(motions, kDampedTurn, rates.w, context, run);
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

        FourLanes<W> change = load<W>(rows.changes.data(), 0, run);
        steady.x = change.x, steady.y = change.y, steady.z = change.z;
        store<W>(steady, motions, kSteady, run);
        change.x += h * outside.x;
        change.y += h * outside.y;
        change.z += h * outside.z;
        store<W>(change, rows.changes.data(), 0, run);

        const LaneMask<W> fast = (velocity.x * velocity.x + velocity.y * velocity.y > most * most) |
                                 (absolute(velocity.z) > mostTurn);
        if (!any(fast)) return;
        const std::uint32_t found = bitsOf(fast & isMovable(load<W>(motions, kMasses, run))) & run.valid();
        for (int lane = 0; lane < W; ++lane)
            if ((found >> lane & 1u) != 0 && clampSpeed(motions[run.row(lane)], context.lengthUnit))
                ++clamped;
    });
    return clamped;
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
const BodyKernels BodyKernelsOf<W>::kTable = {boundSpeeds<W>, startTick<W>,      kick<W>,
                                              drift<W>,       kickAfterDrift<W>, calm<W>};

}  // namespace tamias2d::inline TAMIAS_PRECISION
