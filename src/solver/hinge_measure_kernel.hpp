// SPDX-License-Identifier: MIT
// Where hinges are, and how an impulse moves them there: arms, errors, effective masses.
#pragma once

#include "math/double_lane.hpp"
#include "solver/hinge_flags.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Arms, errors and angles at the poses of `rows`.
template <int W>
TAMIAS_INLINE void measureHinges(HingeBlock<W>& block, HingeSource<W>& source, HingeAngle<W>* angle,
                                 const Motion* motions, const TickRows& rows)
{
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;
    constexpr double kShift = 0x1.8p+52;  // added and taken away it leaves a whole number
    const FourLanes<W> a = gatherRows<W>(rows.poses.data(), block.rowA);
    const FourLanes<W> b = gatherRows<W>(rows.poses.data(), block.rowB);
    const auto rotated = [](const FourLanes<W>& pose, BasicVec2<Wide> v) {
        return BasicVec2<Wide>{pose.z * v.x - pose.w * v.y, pose.w * v.x + pose.z * v.y};
    };
    block.armA = rotated(a, source.localA);
    block.armB = rotated(b, source.localB);
    source.error = {source.start.x + (b.x - a.x) + (block.armB.x - block.armA.x),
                    source.start.y + (b.y - a.y) + (block.armB.y - block.armA.y)};
    // The angle nearest to the one before, as countTurns does it.
    const Double between = gatherDoubles<W>(groupsOf(motions, kPlace, block.rowB)).z -
                           gatherDoubles<W>(groupsOf(motions, kPlace, block.rowA)).z;
    const Double whole = (source.angle - between) * Double(1 / kTwoPi) + Double(kShift) - Double(kShift);
    source.angle = between + Double(kTwoPi) * whole;
    if (angle == nullptr) return;
    angle->springError = toReal(source.angle - angle->zero);
    angle->limitError[0] = toReal(source.angle - angle->rest[0]);
    angle->limitError[1] = toReal(angle->rest[1] - source.angle);
}

// Effective masses for the arms at hand: see prepareRows.
template <int W>
TAMIAS_INLINE void prepareHinges(HingeBlock<W>& block, HingeAngle<W>* angle, const Motion* motions)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), one(real(1)), least(real(1e-5));
    const FourLanes<W> a = gatherRows<W>(groupsOf(motions, kMasses, block.rowA));
    const FourLanes<W> b = gatherRows<W>(groupsOf(motions, kMasses, block.rowB));
    const LaneMask<W> full = maskOf<W>(block.active);
    const auto of = [&](Wide v) { return select(full, v, zero); };
    block.invMassA = {of(a.x), of(a.y)};
    block.invMassB = {of(b.x), of(b.y)};
    block.invInertiaA = of(a.z);
    block.invInertiaB = of(b.z);
    const BasicVec2<Wide>&r = block.armA, &s = block.armB;
    const Wide turnA = block.invInertiaA, turnB = block.invInertiaB;
    block.massX = block.invMassA.x + turnA * r.y * r.y + block.invMassB.x + turnB * s.y * s.y;
    block.massY = block.invMassA.y + turnA * r.x * r.x + block.invMassB.y + turnB * s.x * s.x;
    const Wide between = -(turnA * r.x * r.y) - turnB * s.x * s.y;
    // A row that nothing moves, or that the other already settles, gets no impulse.
    const LaneMask<W> first = block.massX > zero;
    const Wide lower = select(first, between / block.massX, zero);
    const Wide rest = block.massY - lower * lower * block.massX;
    const Wide inverse = select(rest > least * block.massY, one / rest, zero);
    block.inverseYY = inverse;
    block.inverseXY = -(lower * inverse);
    block.inverseXX = select(first, one / block.massX, zero) + lower * lower * inverse;
    if (angle == nullptr) return;
    angle->massTurn = turnA + turnB;
    angle->reach = maximum(a.w, b.w);
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
