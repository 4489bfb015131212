// SPDX-License-Identifier: MIT
// The kernels over blocks of hinges, for one width: included once for each instruction set, by a file that is
// compiled with the switches of that set.
#pragma once

#include "joints/softness.hpp"
#include "math/turn_kernel.hpp"
#include "solver/body_runs.hpp"
#include "solver/hinge_visit_kernel.hpp"

#include <tamias2d/model/joint_defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Others may set the same at the same time.
inline void markFlag(std::uint8_t& flag)
{
    __atomic_store_n(&flag, std::uint8_t{1}, __ATOMIC_RELAXED);
}

template <int W>
ScatteredRows<std::byte> groupsOf(Motion* motions, std::size_t offset, const std::uint32_t (&rows)[W])
{
    return {reinterpret_cast<std::byte*>(motions) + offset, sizeof(Motion), rows};
}
template <int W>
ScatteredRows<const std::byte> groupsOf(const Motion* motions, std::size_t offset,
                                        const std::uint32_t (&rows)[W])
{
    return {reinterpret_cast<const std::byte*>(motions) + offset, sizeof(Motion), rows};
}

template <int W>
LaneMask<W> lanesIn(std::uint32_t bits)
{
    return maskOf<W>(bits);
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

// Effective masses for the arms at hand: see prepareRows.
template <int W>
TAMIAS_INLINE void prepareHinges(HingeBlock<W>& block, const Motion* motions)
{
    using Wide = Lane<W>;
    const Wide zero(real(0)), one(real(1)), least(real(1e-5));
    const FourLanes<W> a = gatherRows<W>(groupsOf(motions, kMasses, block.rowA));
    const FourLanes<W> b = gatherRows<W>(groupsOf(motions, kMasses, block.rowB));
    const LaneMask<W> full = lanesIn<W>(block.active);
    const auto of = [&](Wide v) { return select(full, v, zero); };
    block.invMassA = {of(a.x), of(a.y)};
    block.invMassB = {of(b.x), of(b.y)};
    block.invInertiaA = of(a.z);
    block.invInertiaB = of(b.z);
    block.reach = maximum(a.w, b.w);
    const BasicVec2<Wide>&r = block.armA, &s = block.armB;
    const Wide turnA = block.invInertiaA, turnB = block.invInertiaB;
    block.massTurn = turnA + turnB;
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
}

template <int W>
TAMIAS_INLINE void addToSteady(const HingeBlock<W>& block, const HingeImpulses<Lane<W>>& impulses,
                               std::uint32_t lanes, Motion* motions)
{
    const auto ofA = groupsOf(motions, kSteady, block.rowA), ofB = groupsOf(motions, kSteady, block.rowB);
    HingeMotion<W> v{gatherRows<W>(ofA), gatherRows<W>(ofB)};
    if (block.turns)
        turnHinge(block, impulses.spring + impulses.motor + impulses.limits[0] - impulses.limits[1], v);
    pushHinge(block, impulses.point, v);
    scatterRows<W>(v.a, ofA, lanes & block.movesA);
    scatterRows<W>(v.b, ofB, lanes & block.movesB);
}

template <int W>
std::uint32_t lanesOf(const HingeBlock<W>& block, const std::uint32_t (&of)[W], const std::uint8_t* flags)
{
    std::uint32_t lanes = 0;
    for (int lane = 0; lane < W; ++lane)
        if (flags[of[lane]] != 0) lanes |= 1u << lane;
    return lanes & block.active;
}

template <int W>
void setForms(HingeImpulses<Lane<W>>& to, const HingeImpulses<Lane<W>>& from, Lane<W> factor)
{
    to = {{factor * from.point.x, factor * from.point.y},
          factor * from.spring,
          factor * from.motor,
          {factor * from.limits[0], factor * from.limits[1]}};
}

}  // namespace

template <int W>
void HingeKernels<W>::turns(const BodyRows& bodies, LaneRow* turns, const StepContext& context)
{
    using Double = DoubleLane<W>;
    const Double h(static_cast<double>(context.h)), invH(static_cast<double>(context.invH));
    const Double most(1e4), one(1.0);
    const Wide zero(real(0));
    eachRun<W>(bodies, [&](const auto& run) {
        const Double way = h * toDouble(load<W>(bodies.rows.velocities.data(), 0, run).z);
        Double turn = way + gatherDoubles<W>(run.groups(bodies.motions, kExcess)).z;
        turn = select(turn > most, most, select(turn < -most, -most, turn));
        const SineCosine<Double> to = sineCosineOf(reduceShort(turn));
        store<W>({toReal(invH * (to.cosine - one)), toReal(invH * (to.sine - way)), zero, zero}, turns, 0,
                 run);
    });
}

template <int W>
void HingeKernels<W>::measure(Block* blocks, Source* sources, std::size_t count, const Motion* motions,
                              const TickRows& rows)
{
    using Double = DoubleLane<W>;
    constexpr double kShift = 0x1.8p+52;  // added and taken away it leaves a whole number
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        Source& source = sources[at];
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
        if (!block.turns) continue;
        source.springError = toReal(source.angle - source.zero);
        source.limitError[0] = toReal(source.angle - source.rest[0]);
        source.limitError[1] = toReal(source.rest[1] - source.angle);
    }
}

template <int W>
void HingeKernels<W>::addPull(const Block* blocks, const Source* sources, std::size_t count, real* pull)
{
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        const BasicVec2<Wide> on = sources[at].carried.point;
        const auto lengthOf = [](BasicVec2<Wide> v) { return squareRoot(v.x * v.x + v.y * v.y); };
        const Wide tension = lengthOf(on);
        const Wide a = lengthOf(block.armA) * tension, b = lengthOf(block.armB) * tension;
        for (int lane = 0; lane < W; ++lane) {
            if ((block.active >> lane & 1u) == 0) continue;
            pull[block.rowA[lane]] += a.v[lane];
            pull[block.rowB[lane]] += b.v[lane];
        }
    }
}

template <int W>
void HingeKernels<W>::addSteady(Block* blocks, const Source* sources, std::size_t count, Motion* motions)
{
    for (std::size_t at = 0; at < count; ++at) {
        prepareHinges(blocks[at], motions);
        addToSteady(blocks[at], sources[at].carried, blocks[at].active, motions);
    }
}

template <int W>
void HingeKernels<W>::start(Block* blocks, Source* sources, std::size_t count, const Motion* motions,
                            const LaneRow* turns, const std::uint8_t* wholeGroups, const StepContext& context)
{
    const Wide zero(real(0)), one(real(1)), half(real(0.5)), h(context.h), invH(context.invH);
    const Wide most(kReturn), mostWay(kReturn * context.lengthUnit);
    const Wide fade(Softness::kFade), firm(Softness::kFirm), loose(Softness::kLoose);
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        Source& source = sources[at];
        source.lost = 0;
        source.whole = lanesOf(block, block.group, wholeGroups);
        const LaneMask<W> whole = lanesIn<W>(source.whole);
        const Wide part = select(whole, one, half), time = part * h;
        prepareHinges(block, motions);
        setForms(source.first, source.carried, part);
        setImpulses(block, lanesIn<W>(~0u), source.first);

        BasicVec2<Wide> excess;
        Wide excessTurn;
        if (source.damped != 0) {
            const auto a = gatherDoubles<W>(groupsOf(motions, kExcess, block.rowA));
            const auto b = gatherDoubles<W>(groupsOf(motions, kExcess, block.rowB));
            const DoubleLane<W> perTime(static_cast<double>(context.invH));
            excess = {toReal(perTime * (b.x - a.x)), toReal(perTime * (b.y - a.y))};
            excessTurn = toReal(perTime * (b.z - a.z));
        }
        block.goal = {excess.x + clamp(fade * source.error.x * invH, -mostWay, mostWay),
                      excess.y + clamp(fade * source.error.y * invH, -mostWay, mostWay)};
        block.bias = biasOf(block, turns);
        if (!block.turns) continue;

        // A spring [7-9].
        const LaneMask<W> fast = source.stiffness * block.massTurn * h * h > Wide(kFastSpring * kFastSpring);
        const Wide when = select(fast, h, select(whole, zero, half * h));
        block.push = time * source.stiffness * (source.springError + when * excessTurn);
        block.give = time * (source.damping + source.stiffness * when);

        block.speed = source.speed;
        block.most = select(lanesIn<W>(source.motors), source.strength * time, zero);
        for (const int side : {0, 1}) {
            HingeLimit<Wide>& limit = block.limits[side];
            const Wide error = source.limitError[side];
            const LaneMask<W> has = lanesIn<W>(source.limited[side]), open = error > zero;
            const Wide curve = side == 0 ? excessTurn : -excessTurn;
            const Wide closing = select(open, error * invH, clamp(fade * error * invH, -most, most));
            limit.bias = select(has, curve + closing, zero);
            limit.firm = select(open, one, firm);
            limit.loose = select(open, zero, loose);
            limit.low = zero;
            limit.high = select(has, Wide(kUnlimited), zero);
        }
    }
}

template <int W>
void HingeKernels<W>::pass(Block* blocks, std::size_t count, const HingePass& with)
{
    const Wide limit(with.restless);
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        const std::uint32_t (&of)[W] = with.byGroup ? block.group : block.island;
        const std::uint32_t lanes = with.visited == nullptr ? block.active : lanesOf(block, of, with.visited);
        if (lanes == 0) continue;
        if (with.turns != nullptr) block.bias = biasOf(block, with.turns);
        const Wide change = visitHinges(block, lanes, with.soft, with.velocities);
        std::uint32_t changed = bitsOf(change > limit) & lanes;
        for (; changed != 0; changed &= changed - 1) markFlag(with.unrest[of[__builtin_ctz(changed)]]);
    }
}

template <int W>
void HingeKernels<W>::findLost(const Block* blocks, std::size_t count, const LaneRow* turns, real trusted,
                               std::uint8_t* lost)
{
    const Wide limit(trusted);
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        const BasicVec2<Wide> bias = biasOf(block, turns);
        const auto same =
            (limit >= absolute(bias.x - block.bias.x)) & (limit >= absolute(bias.y - block.bias.y));
        for (std::uint32_t bits = bitsOf(!same) & block.active; bits != 0; bits &= bits - 1)
            markFlag(lost[block.group[__builtin_ctz(bits)]]);
    }
}

template <int W>
void HingeKernels<W>::flatten(Block* blocks, Source* sources, std::size_t count, const std::uint8_t* lost,
                              const HingePass& with, const StepContext& context)
{
    const Wide zero(real(0)), invH(context.invH);
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        Source& source = sources[at];
        source.lost = lanesOf(block, block.group, lost);
        if (source.lost == 0) continue;
        const LaneMask<W> is = lanesIn<W>(source.lost);
        block.bias = {select(is, zero, block.bias.x), select(is, zero, block.bias.y)};
        for (const int side : {0, 1}) {
            HingeLimit<Wide>& limit = block.limits[side];
            const Wide error = source.limitError[side];
            limit.bias = select(is, select(error > zero, error * invH, zero), limit.bias);
        }
        visitHinges(block, source.lost, with.soft, with.velocities);
    }
}

template <int W>
void HingeKernels<W>::tally(const Block* blocks, Source* sources, std::size_t count, const Motion* motions)
{
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        Source& source = sources[at];
        source.sums.point += block.impulse;
        if (!block.turns) continue;
        source.sums.spring += block.spring;
        source.sums.motor += block.motor;
        for (const int side : {0, 1}) source.sums.limits[side] += block.limits[side].impulse;
        for (std::uint32_t bits = source.motors; bits != 0; bits &= bits - 1) {
            const int lane = __builtin_ctz(bits);
            const real speed = motions[block.rowB[lane]].spin - motions[block.rowA[lane]].spin;
            source.work[lane] += static_cast<double>(block.motor.v[lane]) * static_cast<double>(speed);
        }
    }
}

template <int W>
void HingeKernels<W>::settle(Block* blocks, Source* sources, std::size_t count, Motion* motions,
                             const StepContext& context)
{
    const Wide zero(real(0)), two(real(2)), one(real(1)), h(context.h), half(real(0.5) * context.h);
    const Wide unlimited(kUnlimited);
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        Source& source = sources[at];
        const LaneMask<W> whole = lanesIn<W>(source.whole);
        prepareHinges(block, motions);
        source.first = impulsesOf(block);
        // Of whole ones all has acted; of lost ones nothing is carried on.
        setImpulses(block, lanesIn<W>(source.whole | source.lost), HingeImpulses<Wide>{});
        block.bias = {};
        if (block.turns) {
            const LaneMask<W> fast =
                source.stiffness * block.massTurn * h * h > Wide(kFastSpring * kFastSpring);
            const Wide push =
                select(fast, half * source.stiffness * source.springError, -source.first.spring);
            const Wide give = select(fast, half * (source.damping + source.stiffness * h), zero);
            block.push = select(whole, zero, push);
            block.give = select(whole, zero, give);
            block.most = select(whole, zero, block.most);
            for (const int side : {0, 1}) {
                HingeLimit<Wide>& limit = block.limits[side];
                const Wide first = source.first.limits[side];
                const LaneMask<W> bears = first > zero;
                limit.bias = zero;
                limit.firm = one;
                limit.loose = zero;
                limit.low = select(whole & bears, -first, zero);
                limit.high = select(bears, unlimited, zero);  // not reached: it may not push
            }
        }
        const std::uint32_t halved = block.active & ~source.whole;
        if (halved == 0) continue;
        HingeImpulses<Wide> carried;
        setForms(carried, impulsesOf(block), two);
        addToSteady(block, carried, halved, motions);
    }
}

template <int W>
void HingeKernels<W>::keep(const Block* blocks, Source* sources, std::size_t count, const std::uint8_t* hit,
                           const StepContext& context)
{
    const Wide zero(real(0)), h(context.h), part(kMostGive);
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        Source& source = sources[at];
        const std::uint32_t kept =
            block.active & ~(lanesOf(block, block.rowA, hit) | lanesOf(block, block.rowB, hit));
        const LaneMask<W> keeps = lanesIn<W>(kept), found = lanesIn<W>(~source.lost);
        const auto carriedOf = [&](Wide first, Wide impulse) {
            const Wide sum = first + impulse;
            return select(found & isEqual(sum - sum, zero), sum, zero);
        };
        const auto keepIn = [&](Wide& old, Wide value) { old = select(keeps, value, old); };
        const BasicVec2<Wide> point{carriedOf(source.first.point.x, block.impulse.x),
                                    carriedOf(source.first.point.y, block.impulse.y)};
        const auto lengthOf = [](BasicVec2<Wide> v) { return squareRoot(v.x * v.x + v.y * v.y); };
        const Wide most = part * (lengthOf(block.armA) + lengthOf(block.armB));
        const std::uint32_t strained = bitsOf((giveOf(block.massX, absolute(point.x), h) > most) |
                                              (giveOf(block.massY, absolute(point.y), h) > most));
        for (int lane = 0; lane < W; ++lane) {
            if ((kept >> lane & 1u) == 0) continue;
            source.strained[lane] = (strained >> lane & 1u) != 0 ? source.strained[lane] + 1 : 0;
            if (source.strained[lane] >= kLasting) source.stiffened |= 1u << lane;
        }
        keepIn(source.carried.point.x, point.x);
        keepIn(source.carried.point.y, point.y);
        if (!block.turns) continue;
        keepIn(source.carried.spring, carriedOf(source.first.spring, block.spring));
        keepIn(source.carried.motor, carriedOf(source.first.motor, block.motor));
        for (const int side : {0, 1}) {
            // The blow with which a limit is met is not a load it will bear.
            const Wide carried = carriedOf(source.first.limits[side], block.limits[side].impulse);
            keepIn(source.carried.limits[side], select(lanesIn<W>(source.held[side]), carried, zero));
            source.held[side] = (source.held[side] & ~kept) | (bitsOf(carried > zero) & kept);
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
