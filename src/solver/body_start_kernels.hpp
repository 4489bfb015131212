// SPDX-License-Identifier: MIT
// The kernels over bodies with which a step and its ticks begin: what is carried, how far, how fast, who
// strays.
#pragma once

#include "contacts/row_kernel.hpp"
#include "solver/body_runs.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// As that of contacts/rows.hpp; returns whether it had to.
template <int W>
bool limitSteady(FourLanes<W>& steady, const StepContext& context)
{
    const Lane<W> most(context.mostSteady), mostSpin(context.mostSteadySpin);
    const auto isWithin = [](Lane<W> change, Lane<W> bound) {
        return (change >= -bound) & (bound >= change);
    };
    const LaneMask<W> within =
        isWithin(steady.x, most) & isWithin(steady.y, most) & isWithin(steady.z, mostSpin);
    if (!any(!within)) return false;
    steady.x = limitedChange(steady.x, most);
    steady.y = limitedChange(steady.y, most);
    steady.z = limitedChange(steady.z, mostSpin);
    return true;
}

// Has the body left the way its box was made for, or will it? Impacts turn it out of it, and so do the passes
// over contacts.
template <int W>
LaneMask<W> straysOf(const FourLanes<W>& pose, const FourLanes<W>& velocity, Lane<W> extent,
                     const FourLanes<W>& start, const FourLanes<W>& offset, FourLanes<W>& way,
                     const TickTime& time, Lane<W> h)
{
    const Lane<W> t(time.start), rest(time.rest);
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
void expect(const BodyRows& bodies, CenterWay* centers, const StepContext& context)
{
    using Wide = Lane<W>;
    Motion* const motions = bodies.motions;
    const Wide h(context.h), invH(context.invH), dt(static_cast<real>(context.dt));
    const Wide ticks(static_cast<real>(context.ticks));
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> steady = load<W>(motions, kSteady, run);
        if (limitSteady(steady, context)) store<W>(steady, motions, kSteady, run);
        const FourLanes<W> velocity = load<W>(motions, kVelocity, run);
        const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
        const FourLanes<W> damping = load<W>(motions, kRotation, run);
        const Wide extent = load<W>(motions, kMasses, run).w;
        const BasicVec2<Wide> v{velocity.x, velocity.y};
        const BasicVec2<Wide> glide = dt * v;
        const BasicVec2<Wide> bend =
            dt * (dt * BasicVec2<Wide>{expectedRate(outside.x, damping.z, velocity.x, steady.x, invH),
                                       expectedRate(outside.y, damping.z, velocity.y, steady.y, invH)});
        const Wide rate = expectedRate(outside.z, damping.w, velocity.z, steady.z, invH);
        const Wide turn = dt * extent * (absolute(velocity.z) + dt * absolute(rate));
        const Wide speed =
            fastestPoint<Wide>(v, velocity.z, {steady.x + h * outside.x, steady.y + h * outside.y},
                               steady.z + h * outside.z, extent, ticks);
        store<W>({glide.x, glide.y, bend.x, bend.y}, centers, offsetof(CenterWay, glide), run);
        store<W>({turn, travelBy(glide, bend) + turn, dt * speed, Wide(real(0))}, bodies.rows.travels.data(),
                 0, run);
    });
}

template <int W>
void boundSpeeds(const BodyRows& bodies, const StepContext& context)
{
    Motion* const motions = bodies.motions;
    const Lane<W> h(context.h);
    eachRun<W>(bodies, [&](const auto& run) {
        const FourLanes<W> velocity = load<W>(motions, kVelocity, run),
                           masses = load<W>(motions, kMasses, run);
        const FourLanes<W> flight =
            flightOf(velocity, load<W>(motions, kSteady, run), load<W>(motions, kAcceleration, run), masses,
                     load<W>(motions, kRotation, run), context);
        FourLanes<W> way = load<W>(bodies.rows.ways.data(), 0, run);
        way.w = masses.w * (absolute(velocity.z) + h * absolute(flight.z));
        store<W>(way, bodies.rows.ways.data(), 0, run);
        store<W>({velocity.x, velocity.y, velocity.x + h * flight.x, velocity.y + h * flight.y},
                 bodies.rows.spans.data(), 0, run);
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

        const FourLanes<W> velocity = load<W>(motions, kVelocity, run),
                           masses = load<W>(motions, kMasses, run);
        const LaneMask<W> moves = isMovable(masses);
        steady.w = select(moves, steady.w, Wide(real(1)));  // kicks go the short way for what does not move
        store<W>(steady, motions, kSteady, run);
        const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
        const FourLanes<W> damping = load<W>(motions, kRotation, run);
        store<W>({velocity.x, velocity.y, velocity.z, zero}, rows.starts.data(), 0, run);
        store<W>({steady.x, steady.y, outside.x, outside.y}, rows.loads.data(), 0, run);
        const FourLanes<W> flight = flightOf(velocity, steady, outside, masses, damping, context);
        store<W>(flight, rows.expected.data(), 0, run);
        fastest = maximum(flight.w, fastest);
        if (time.number == 0) return;

        constexpr std::size_t kWay = offsetof(PredictedWay, acceleration);
        FourLanes<W> way = load<W>(rows.predicted.data(), kWay, run);
        const LaneMask<W> leave = straysOf(
            load<W>(rows.poses.data(), 0, run), velocity, masses.w, load<W>(rows.predicted.data(), 0, run),
            load<W>(rows.predicted.data(), offsetof(PredictedWay, offset), run), way, time, h);
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

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
