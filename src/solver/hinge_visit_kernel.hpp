// SPDX-License-Identifier: MIT
// One visit to W hinges: as solveRows in joints/row_visits.cpp does it, all rows at once.
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
TAMIAS_INLINE Lane<W> visitTurn(const HingeBlock<W>& block, HingeAngle<W>& angle, HingeMotion<W>& v)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), one(real(1)), mass = angle.massTurn;
    const LaneMask<W> moves = mass > zero;
    const Wide speed = v.b.z - v.a.z;
    const Wide spring =
        (-angle.push - angle.give * (speed - mass * angle.spring)) / (one + angle.give * mass);
    Wide change = spring - angle.spring, most = absolute(change);
    angle.spring = spring;
    turnHinge(block, change, v);

    const Wide wanted = angle.motor - ((v.b.z - v.a.z) - angle.speed) / mass;
    const Wide motor = clamp(select(moves, wanted, angle.motor), -angle.most, angle.most);
    change = motor - angle.motor;
    most = maximum(most, absolute(change));
    angle.motor = motor;
    turnHinge(block, change, v);

    for (const int side : {0, 1}) {
        HingeLimit<Wide>& limit = angle.limits[side];
        const Wide closing = side == 0 ? v.b.z - v.a.z : v.a.z - v.b.z;
        const Wide asked =
            limit.impulse - limit.loose * limit.impulse - limit.firm * (closing + limit.bias) / mass;
        const Wide total = clamp(select(moves, asked, limit.impulse), limit.low, limit.high);
        change = total - limit.impulse;
        most = maximum(most, absolute(change));
        limit.impulse = total;
        turnHinge(block, side == 0 ? change : -change, v);
    }
    return most * mass * angle.reach;
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
TAMIAS_INLINE void setImpulse(HingeBlock<W>& block, LaneMask<W> mask, const BasicVec2<Lane<W>>& to)
{
    block.impulse.x = select(mask, to.x, block.impulse.x);
    block.impulse.y = select(mask, to.y, block.impulse.y);
}
template <int W>
TAMIAS_INLINE void setImpulses(HingeAngle<W>& angle, LaneMask<W> mask, const AngleImpulses<Lane<W>>& to)
{
    angle.spring = select(mask, to.spring, angle.spring);
    angle.motor = select(mask, to.motor, angle.motor);
    for (const int side : {0, 1})
        angle.limits[side].impulse = select(mask, to.limits[side], angle.limits[side].impulse);
}

template <int W>
TAMIAS_INLINE AngleImpulses<Lane<W>> impulsesOf(const HingeAngle<W>& angle)
{
    return {angle.spring, angle.motor, {angle.limits[0].impulse, angle.limits[1].impulse}};
}

// Visits the given lanes, which are some of the active ones; returns the greatest change of speed.
template <int W>
TAMIAS_INLINE Lane<W> visitHinges(HingeBlock<W>& block, HingeAngle<W>* angle, std::uint32_t lanes, bool soft,
                                  LaneRow* velocities)
{
    using Wide = Lane<W>;
    HingeMotion<W> v{gatherRows<W>(velocities, block.rowA), gatherRows<W>(velocities, block.rowB)};
    const std::uint32_t others = block.active & ~lanes;
    const BasicVec2<Wide> old = block.impulse;
    AngleImpulses<Wide> oldTurns;
    Wide most;
    if (angle != nullptr) {
        if (others != 0) oldTurns = impulsesOf(*angle);
        most = visitTurn(block, *angle, v);
    }
    most = maximum(most, visitPoint(block, soft, v));

    // Beyond all numbers: the joint lets go for this visit.
    const Wide sum = v.a.x + v.a.y + v.a.z + v.b.x + v.b.y + v.b.z;
    const LaneMask<W> wild = !isEqual(sum - sum, Wide(real(0)));
    if (any(wild)) {
        setImpulse(block, wild, {});
        if (angle != nullptr) setImpulses(*angle, wild, {});
        most = select(wild, Wide(real(0)), most);
        lanes &= ~bitsOf(wild);
    }
    if (others != 0) {
        setImpulse(block, maskOf<W>(others), old);
        if (angle != nullptr) setImpulses(*angle, maskOf<W>(others), oldTurns);
    }
    scatterRows<W>(v.a, velocities, block.rowA, lanes & block.movesA);
    scatterRows<W>(v.b, velocities, block.rowB, lanes & block.movesB);
    return most;
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
