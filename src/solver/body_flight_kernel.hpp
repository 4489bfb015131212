// SPDX-License-Identifier: MIT
// The kernel over bodies for all ticks of those that nothing can meet.
#pragma once

#include "math/turn_kernel.hpp"
#include "solver/body_kick_kernels.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

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

// All stays in registers from tick to tick, and sine and cosine are those of the last angle alone.
template <int W>
void fly(const BodyRows& bodies, const StepContext& context, int ticks)
{
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;
    if (ticks == 0) return;
    Motion* const motions = bodies.motions;
    TickRows& rows = bodies.rows;
    const Wide zero(real(0)), h(context.h);
    const Double time(static_cast<double>(context.h)), half(static_cast<double>(context.h) / 2), whole(1.0);
    eachRun<W>(bodies, [&](const auto& run) {
        FourLanes<W> velocity = load<W>(motions, kVelocity, run), steady = load<W>(motions, kSteady, run);
        const FourLanes<W> outside = load<W>(motions, kAcceleration, run);
        FourDoubles<W> fine = gatherDoubles<W>(run.groups(motions, kFine));
        FourDoubles<W> place = gatherDoubles<W>(run.groups(motions, kPlace));
        const auto kickFree = [&] {
            kickHalf(velocity.x, fine.x, outside.x, zero, whole, half);
            kickHalf(velocity.y, fine.y, outside.y, zero, whole, half);
            kickHalf(velocity.z, fine.z, outside.z, zero, whole, half);
            velocity.x += zero, velocity.y += zero, velocity.z += zero;  // makes 0 of -0
        };
        FourLanes<W> way;
        Double shiftX, shiftY, turn;
        DoubleMask<W> turned = !isEqual(whole, whole);
        for (int tick = 0; tick < ticks; ++tick) {
            kickFree();
            way = velocity;
            shiftX = time * toDouble(way.x) + Double(0.0);
            shiftY = time * toDouble(way.y) + Double(0.0);
            turn = time * toDouble(way.z) + Double(0.0);
            place.x += shiftX;
            place.y += shiftY;
            const DoubleMask<W> turns = !isEqual(turn, Double(0.0));
            if (any(turns)) place.z = select(turns, wrapped(place.z + turn), place.z);
            turned = turned | turns;
            kickFree();
        }
        way.w = velocity.w = steady.x = steady.y = steady.z = zero;
        store<W>(velocity, motions, kVelocity, run);
        store<W>(steady, motions, kSteady, run);
        scatterDoubles<W>(fine, run.groups(motions, kFine));
        scatterDoubles<W>(place, run.groups(motions, kPlace));
        FourLanes<W> rotation = load<W>(motions, kRotation, run);
        if (any(turned)) {
            const SineCosine<Double> to = sineCosineOf(reduceShort(place.z));
            const LaneMask<W> anew = toReal(turned);
            rotation.x = select(anew, toReal(to.cosine), rotation.x);
            rotation.y = select(anew, toReal(to.sine), rotation.y);
            store<W>(rotation, motions, kRotation, run);
        }

        const FourDoubles<W> origin = gatherDoubles<W>(run.groups(rows.origins.data(), 0));
        const Wide extent = load<W>(motions, kMasses, run).w;
        store<W>({toReal(place.x - origin.x), toReal(place.y - origin.y), rotation.x, rotation.y},
                 rows.poses.data(), 0, run);
        store<W>({toReal(shiftX), toReal(shiftY), extent * absolute(toReal(turn)), zero}, rows.ways.data(), 0,
                 run);
        store<W>(way, rows.velocities.data(), 0, run);
        store<W>({h * outside.x, h * outside.y, h * outside.z, zero}, rows.changes.data(), 0, run);
    });
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
