// SPDX-License-Identifier: MIT
// What hinges are asked for, before the drift and after it: as aimRows and settleRows in joints/rows.cpp do
// it.
#pragma once

#include "joints/softness.hpp"
#include "solver/hinge_measure_kernel.hpp"
#include "solver/hinge_visit_kernel.hpp"

#include <tamias2d/model/joint_defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// By how much cosine and sine of a small angle t differ from 1 and from t: their series from there on, to
// the last digit of a double for |t| <= kSmallTurn.
constexpr real kSmallTurn = real(0.5);
template <class Wide>
struct CurveOf {
    Wide cosine, sine;
};
template <class Wide>
TAMIAS_INLINE CurveOf<Wide> curveOf(Wide t)
{
    const auto share = [](double of) { return Wide(static_cast<real>(1 / of)); };
    const Wide one(real(1)), s = t * t;
    Wide cosine = one, sine = one;
    for (const double n : {14.0, 12.0, 10.0, 8.0, 6.0, 4.0}) cosine = one - share(n * (n - 1)) * s * cosine;
    for (const double n : {15.0, 13.0, 11.0, 9.0, 7.0, 5.0}) sine = one - share(n * (n - 1)) * s * sine;
    return {-(share(2) * s * cosine), -(share(6) * s * t * sine)};
}

// What the point of each is asked for, with its bodies turning so: see `turns`.
template <int W>
TAMIAS_INLINE BasicVec2<Lane<W>> biasOf(const HingeBlock<W>& block, const LaneRow* turns)
{
    const FourLanes<W> a = gatherRows<W>(turns, block.rowA), b = gatherRows<W>(turns, block.rowB);
    const BasicVec2<Lane<W>>&r = block.armA, &s = block.armB;
    return {block.goal.x + (b.x * s.x - b.y * s.y) - (a.x * r.x - a.y * r.y),
            block.goal.y + (b.x * s.y + b.y * s.x) - (a.x * r.y + a.y * r.x)};
}

template <class Wide>
BasicVec2<Wide> scaled(const BasicVec2<Wide>& from, Wide factor)
{
    return {factor * from.x, factor * from.y};
}
template <class Wide>
AngleImpulses<Wide> scaled(const AngleImpulses<Wide>& from, Wide factor)
{
    return {factor * from.spring, factor * from.motor, {factor * from.limits[0], factor * from.limits[1]}};
}

// What the rows about the angle are asked for as the visits of a tick begin.
template <int W>
TAMIAS_INLINE void startAngle(HingeAngle<W>& angle, LaneMask<W> whole, Lane<W> excess,
                              const StepContext& context)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), one(real(1)), half(real(0.5)), h(context.h), invH(context.invH);
    const Wide most(kReturn), fade(Softness::kFade), firm(Softness::kFirm), loose(Softness::kLoose);
    const Wide part = select(whole, one, half), time = part * h;
    angle.first = scaled(angle.carried, part);
    setImpulses(angle, maskOf<W>(~0u), angle.first);

    // A spring [7-9].
    const LaneMask<W> fast = angle.stiffness * angle.massTurn * h * h > Wide(kFastSpring * kFastSpring);
    const Wide when = select(fast, h, select(whole, zero, half * h));
    angle.push = time * angle.stiffness * (angle.springError + when * excess);
    angle.give = time * (angle.damping + angle.stiffness * when);

    angle.most = select(maskOf<W>(angle.motors), angle.strength * time, zero);
    for (const int side : {0, 1}) {
        HingeLimit<Wide>& limit = angle.limits[side];
        const Wide error = angle.limitError[side];
        const LaneMask<W> has = maskOf<W>(angle.limited[side]), open = error > zero;
        const Wide curve = side == 0 ? excess : -excess;
        const Wide closing = select(open, error * invH, clamp(fade * error * invH, -most, most));
        limit.bias = select(has, curve + closing, zero);
        limit.firm = select(open, one, firm);
        limit.loose = select(open, zero, loose);
        limit.low = zero;
        limit.high = select(has, Wide(kUnlimited), zero);
    }
}

// Impulses, bounds and aims as the visits of a tick begin.
template <int W>
TAMIAS_INLINE void startHinges(HingeBlock<W>& block, HingeSource<W>& source, HingeAngle<W>* angle,
                               const HingeStart& with, const StepContext& context)
{
    using Wide = Lane<W>;
    const Wide one(real(1)), half(real(0.5)), invH(context.invH);
    const Wide fade(Softness::kFade), mostWay(kReturn * context.lengthUnit);
    source.lost = 0;
    source.whole = lanesOf(block, with.wholeGroups);
    const LaneMask<W> whole = maskOf<W>(source.whole);
    if (!with.prepared) prepareHinges(block, angle, with.motions);
    source.first = scaled(source.carried, select(whole, one, half));
    block.impulse = source.first;

    BasicVec2<Wide> excess;
    Wide excessTurn;
    if (source.damped != 0) {
        const auto a = gatherDoubles<W>(groupsOf(with.motions, kExcess, block.rowA));
        const auto b = gatherDoubles<W>(groupsOf(with.motions, kExcess, block.rowB));
        const DoubleLane<W> perTime(static_cast<double>(context.invH));
        excess = {toReal(perTime * (b.x - a.x)), toReal(perTime * (b.y - a.y))};
        excessTurn = toReal(perTime * (b.z - a.z));
    }
    block.goal = {excess.x + clamp(fade * source.error.x * invH, -mostWay, mostWay),
                  excess.y + clamp(fade * source.error.y * invH, -mostWay, mostWay)};
    block.bias = biasOf(block, with.turns);
    if (angle != nullptr) startAngle(*angle, whole, excessTurn, context);
}

// What the rows about the angle are asked for after the drift.
template <int W>
TAMIAS_INLINE void settleAngle(HingeAngle<W>& angle, LaneMask<W> whole, LaneMask<W> gone,
                               const StepContext& context)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), one(real(1)), h(context.h), half(real(0.5) * context.h);
    const Wide unlimited(kUnlimited);
    angle.first = impulsesOf(angle);
    setImpulses(angle, gone, {});
    const LaneMask<W> fast = angle.stiffness * angle.massTurn * h * h > Wide(kFastSpring * kFastSpring);
    const Wide push = select(fast, half * angle.stiffness * angle.springError, -angle.first.spring);
    const Wide give = select(fast, half * (angle.damping + angle.stiffness * h), zero);
    angle.push = select(whole, zero, push);
    angle.give = select(whole, zero, give);
    angle.most = select(whole, zero, angle.most);
    for (const int side : {0, 1}) {
        HingeLimit<Wide>& limit = angle.limits[side];
        const Wide first = angle.first.limits[side];
        const LaneMask<W> bears = first > zero;
        limit.bias = zero;
        limit.firm = one;
        limit.loose = zero;
        limit.low = select(whole & bears, -first, zero);
        limit.high = select(bears, unlimited, zero);  // not reached: it may not push
    }
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
