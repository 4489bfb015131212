// SPDX-License-Identifier: MIT
// One visit to W hinges: as solveRows in joints/rows.cpp does it, all rows at once.
#pragma once

#include "joints/softness.hpp"
#include "solver/hinge_kernels.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
struct HingeMotion {
    FourLanes<W> a, b;   // velocity and spin
};

template <int W>
TAMIAS_INLINE void turnHinge(const HingeBlock<W>& block, Lane<W> impulse, HingeMotion<W>& v)
{
    v.a.z -= block.invInertiaA * impulse;
    v.b.z += block.invInertiaB * impulse;
}

template <int W>
TAMIAS_INLINE void pushHinge(const HingeBlock<W>& block, BasicVec2<Lane<W>> impulse, HingeMotion<W>& v)
{
    v.a.x -= block.invMassA.x * impulse.x;
    v.a.y -= block.invMassA.y * impulse.y;
    v.a.z -= block.invInertiaA * (block.armA.x * impulse.y - block.armA.y * impulse.x);
    v.b.x += block.invMassB.x * impulse.x;
    v.b.y += block.invMassB.y * impulse.y;
    v.b.z += block.invInertiaB * (block.armB.x * impulse.y - block.armB.y * impulse.x);
}

// The speed with which the anchors part.
template <int W>
TAMIAS_INLINE BasicVec2<Lane<W>> partingOf(const HingeBlock<W>& block, const HingeMotion<W>& v)
{
    return {(v.b.x - v.b.z * block.armB.y) - (v.a.x - v.a.z * block.armA.y),
            (v.b.y + v.b.z * block.armB.x) - (v.a.y + v.a.z * block.armA.x)};
}

// The rows about the angle, one after the other; returns the greatest change of speed.
template <int W>
TAMIAS_INLINE Lane<W> visitTurn(HingeBlock<W>& block, HingeMotion<W>& v)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), one(real(1)), mass = block.massTurn;
    const LaneMask<W> moves = mass > zero;
    const Wide speed = v.b.z - v.a.z;
    const Wide spring =
        (-block.push - block.give * (speed - mass * block.spring)) / (one + block.give * mass);
    Wide change = spring - block.spring, most = absolute(change);
    block.spring = spring;
    turnHinge(block, change, v);

    const Wide wanted = block.motor - ((v.b.z - v.a.z) - block.speed) / mass;
    const Wide motor = clamp(select(moves, wanted, block.motor), -block.most, block.most);
    change = motor - block.motor;
    most = maximum(most, absolute(change));
    block.motor = motor;
    turnHinge(block, change, v);

    for (const int side : {0, 1}) {
        HingeLimit<Wide>& limit = block.limits[side];
        const Wide closing = side == 0 ? v.b.z - v.a.z : v.a.z - v.b.z;
        const Wide asked =
            limit.impulse - limit.loose * limit.impulse - limit.firm * (closing + limit.bias) / mass;
        const Wide total = clamp(select(moves, asked, limit.impulse), limit.low, limit.high);
        change = total - limit.impulse;
        most = maximum(most, absolute(change));
        limit.impulse = total;
        turnHinge(block, side == 0 ? change : -change, v);
    }
    return most * mass * block.reach;
}

// The point comes last: it is to hold.
template <int W>
TAMIAS_INLINE Lane<W> visitPoint(HingeBlock<W>& block, bool soft, HingeMotion<W>& v)
{
    using Wide = Lane<W>;
    const Wide firm(soft ? Softness::kFirm : real(1)), loose(soft ? Softness::kLoose : real(0));
    const BasicVec2<Wide> parting = partingOf(block, v);
    const BasicVec2<Wide> wrong{firm * (parting.x + block.bias.x), firm * (parting.y + block.bias.y)};
    const BasicVec2<Wide> kept{loose * block.impulse.x, loose * block.impulse.y};
    const Wide most =
        maximum(absolute(wrong.x + kept.x * block.massX), absolute(wrong.y + kept.y * block.massY));
    const BasicVec2<Wide> change{-(block.inverseXX * wrong.x + block.inverseXY * wrong.y) - kept.x,
                                 -(block.inverseXY * wrong.x + block.inverseYY * wrong.y) - kept.y};
    pushHinge(block, change, v);
    block.impulse.x += change.x;
    block.impulse.y += change.y;
    return most;
}

template <int W>
TAMIAS_INLINE void setImpulses(HingeBlock<W>& block, LaneMask<W> mask, const HingeImpulses<Lane<W>>& to)
{
    block.impulse.x = select(mask, to.point.x, block.impulse.x);
    block.impulse.y = select(mask, to.point.y, block.impulse.y);
    block.spring = select(mask, to.spring, block.spring);
    block.motor = select(mask, to.motor, block.motor);
    for (const int side : {0, 1})
        block.limits[side].impulse = select(mask, to.limits[side], block.limits[side].impulse);
}

template <int W>
TAMIAS_INLINE HingeImpulses<Lane<W>> impulsesOf(const HingeBlock<W>& block)
{
    return {block.impulse, block.spring, block.motor, {block.limits[0].impulse, block.limits[1].impulse}};
}

// Visits the given lanes, which are some of the active ones; returns the greatest change of speed.
template <int W>
TAMIAS_INLINE Lane<W> visitHinges(HingeBlock<W>& block, std::uint32_t lanes, bool soft,
                                  const VelocityRows& rows)
{
    using Wide = Lane<W>;
    const ScatteredRows<std::byte> ofA{rows.first, rows.stride, block.rowA};
    const ScatteredRows<std::byte> ofB{rows.first, rows.stride, block.rowB};
    const HingeMotion<W> before{gatherRows<W>(ofA), gatherRows<W>(ofB)};
    HingeMotion<W> v = before;
    const std::uint32_t others = block.active & ~lanes;
    HingeImpulses<Wide> old;
    if (others != 0) old = impulsesOf(block);
    Wide most;
    if (block.turns) most = visitTurn(block, v);
    most = maximum(most, visitPoint(block, soft, v));

    // Beyond all numbers: the joint lets go for this visit.
    const Wide sum = v.a.x + v.a.y + v.a.z + v.b.x + v.b.y + v.b.z;
    const LaneMask<W> wild = !isEqual(sum - sum, Wide(real(0)));
    if (any(wild)) {
        setImpulses(block, wild, HingeImpulses<Wide>{});
        most = select(wild, Wide(real(0)), most);
        lanes &= ~bitsOf(wild);
    }
    if (others != 0) setImpulses(block, maskOf<W>(others), old);
    scatterRows<W>(v.a, ofA, lanes & block.movesA);
    scatterRows<W>(v.b, ofB, lanes & block.movesB);
    return most;
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
