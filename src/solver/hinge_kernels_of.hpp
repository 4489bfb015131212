// SPDX-License-Identifier: MIT
// The kernels over blocks of hinges, for one width: included once for each instruction set, by a file that is
// compiled with the switches of that set.
#pragma once

#include "joints/softness.hpp"
#include "math/turn_kernel.hpp"
#include "solver/body_runs.hpp"
#include "solver/hinge_visit_kernel.hpp"

#include <tamias2d/model/joint_defs.hpp>

#include <utility>

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

// Effective masses for the arms at hand: see prepareRows.
template <int W>
TAMIAS_INLINE void prepareHinges(HingeBlock<W>& block, HingeAngle<W>* angle, const Motion* motions)
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

// Adds the velocity changes of impulses to `steady`, by row; `turning` are those about the angle, if any.
template <int W>
TAMIAS_INLINE void addToSteady(const HingeBlock<W>& block, const BasicVec2<Lane<W>>& impulse,
                               const AngleImpulses<Lane<W>>* turning, std::uint32_t lanes, LaneRow* steady)
{
    HingeMotion<W> v{gatherRows<W>(steady, block.rowA), gatherRows<W>(steady, block.rowB)};
    if (turning != nullptr)
        turnHinge(block, turning->spring + turning->motor + turning->limits[0] - turning->limits[1], v);
    pushHinge(block, impulse, v);
    scatterRows<W>(v.a, steady, block.rowA, lanes & block.movesA);
    scatterRows<W>(v.b, steady, block.rowB, lanes & block.movesB);
}

template <int W>
TAMIAS_INLINE std::uint32_t lanesOf(const HingeBlock<W>& block, const std::uint32_t (&of)[W], bool same,
                                    const std::uint8_t* flags)
{
    if (same) return flags[of[0]] != 0 ? block.active : 0;
    std::uint32_t lanes = 0;
    for (int lane = 0; lane < W; ++lane)
        if (flags[of[lane]] != 0) lanes |= 1u << lane;
    return lanes & block.active;
}
// Of the groups that are flagged.
template <int W>
TAMIAS_INLINE std::uint32_t lanesOf(const HingeBlock<W>& block, const std::uint8_t* groups)
{
    return lanesOf(block, block.group, block.oneGroup, groups);
}
template <int W>
TAMIAS_INLINE void markFlags(std::uint32_t lanes, const std::uint32_t (&of)[W], bool same,
                             std::uint8_t* flags)
{
    if (lanes == 0) return;
    if (same) return markFlag(flags[of[0]]);
    for (; lanes != 0; lanes &= lanes - 1) markFlag(flags[of[__builtin_ctz(lanes)]]);
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

// Adds what they did to the sums of the step.
template <int W>
TAMIAS_INLINE void tallyHinges(const HingeBlock<W>& block, HingeSource<W>& source, HingeAngle<W>* angle,
                               const LaneRow* velocities)
{
    source.sums += block.impulse;
    if (angle == nullptr) return;
    angle->sums.spring += angle->spring;
    angle->sums.motor += angle->motor;
    for (const int side : {0, 1}) angle->sums.limits[side] += angle->limits[side].impulse;
    for (std::uint32_t bits = angle->motors; bits != 0; bits &= bits - 1) {
        const int lane = __builtin_ctz(bits);
        const real speed = velocities[block.rowB[lane]].z - velocities[block.rowA[lane]].z;
        angle->work[lane] += static_cast<double>(angle->motor.v[lane]) * static_cast<double>(speed);
    }
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
    setImpulses(angle, lanesIn<W>(~0u), angle.first);

    // A spring [7-9].
    const LaneMask<W> fast = angle.stiffness * angle.massTurn * h * h > Wide(kFastSpring * kFastSpring);
    const Wide when = select(fast, h, select(whole, zero, half * h));
    angle.push = time * angle.stiffness * (angle.springError + when * excess);
    angle.give = time * (angle.damping + angle.stiffness * when);

    angle.most = select(lanesIn<W>(angle.motors), angle.strength * time, zero);
    for (const int side : {0, 1}) {
        HingeLimit<Wide>& limit = angle.limits[side];
        const Wide error = angle.limitError[side];
        const LaneMask<W> has = lanesIn<W>(angle.limited[side]), open = error > zero;
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
    const LaneMask<W> whole = lanesIn<W>(source.whole);
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

template <int W>
void HingeKernels<W>::turns(const BodyRows& bodies, LaneRow* turns, const StepContext& context)
{
    using Double = DoubleLane<W>;
    const Wide zero(real(0)), h(context.h), invH(context.invH), small(kSmallTurn);
    eachRun<W>(bodies, [&](const auto& run) {
        const Wide spin = load<W>(bodies.rows.velocities.data(), 0, run).z;
        const Double excess = gatherDoubles<W>(run.groups(bodies.motions, kExcess)).z;
        const Wide beyond = toReal(excess), t = h * spin + beyond;
        if (!any(!(small >= absolute(t)))) {
            const CurveOf<Wide> curve = curveOf(t);
            store<W>({invH * curve.cosine, invH * (beyond + curve.sine), zero, zero}, turns, 0, run);
            return;
        }
        const Double time(static_cast<double>(context.h)), perTime(static_cast<double>(context.invH));
        const Double most(1e4), one(1.0), way = time * toDouble(spin);
        Double turn = way + excess;
        turn = select(turn > most, most, select(turn < -most, -most, turn));
        const SineCosine<Double> to = sineCosineOf(reduceShort(turn));
        store<W>({toReal(perTime * (to.cosine - one)), toReal(perTime * (to.sine - way)), zero, zero}, turns,
                 0, run);
    });
}

template <int W>
void HingeKernels<W>::measure(const Run& run, const Motion* motions, const TickRows& rows)
{
    for (std::size_t at = 0; at < run.count; ++at)
        measureHinges(run.blocks[at], run.sources[at], run.angleOf(run.blocks[at]), motions, rows);
}

template <int W>
void HingeKernels<W>::addPull(const Run& run, real* pull)
{
    for (std::size_t at = 0; at < run.count; ++at) {
        const Block& block = run.blocks[at];
        const BasicVec2<Wide> on = run.sources[at].carried;
        const auto lengthOf = [](BasicVec2<Wide> v) { return squareRoot(v.x * v.x + v.y * v.y); };
        const Wide tension = lengthOf(on);
        const Wide a = lengthOf(block.armA) * tension, b = lengthOf(block.armB) * tension;
        for (std::uint32_t bits = block.movesA; bits != 0; bits &= bits - 1) {
            const int lane = __builtin_ctz(bits);
            pull[block.rowA[lane]] += a.v[lane];
        }
        for (std::uint32_t bits = block.movesB; bits != 0; bits &= bits - 1) {
            const int lane = __builtin_ctz(bits);
            pull[block.rowB[lane]] += b.v[lane];
        }
    }
}

template <int W>
void HingeKernels<W>::addSteady(const Run& run, const Motion* motions, bool prepared, LaneRow* steady)
{
    for (std::size_t at = 0; at < run.count; ++at) {
        Block& block = run.blocks[at];
        Angle* const angle = run.angleOf(block);
        if (!prepared) prepareHinges(block, angle, motions);
        addToSteady(block, run.sources[at].carried, angle != nullptr ? &angle->carried : nullptr,
                    block.active, steady);
    }
}

template <int W>
void HingeKernels<W>::firstPass(const Run& run, const HingeStart& start, const HingePass& with,
                                const StepContext& context)
{
    const Wide limit(with.restless);
    for (std::size_t at = 0; at < run.count; ++at) {
        Block& block = run.blocks[at];
        Angle* const angle = run.angleOf(block);
        startHinges(block, run.sources[at], angle, start, context);
        const Wide change = visitHinges(block, angle, block.active, true, with.velocities);
        markFlags(bitsOf(change > limit) & block.active, block.island, block.oneIsland, with.unrest);
    }
}

template <int W>
void HingeKernels<W>::pass(const Run& run, const HingePass& with)
{
    const Wide limit(with.restless);
    for (std::size_t at = 0; at < run.count; ++at) {
        Block& block = run.blocks[at];
        const std::uint32_t lanes = lanesOf(block, block.island, block.oneIsland, with.visited);
        if (lanes == 0) continue;
        block.bias = biasOf(block, with.turns);
        const Wide change = visitHinges(block, run.angleOf(block), lanes, true, with.velocities);
        markFlags(bitsOf(change > limit) & lanes, block.island, block.oneIsland, with.unrest);
    }
}

template <int W>
void HingeKernels<W>::settlingPass(const Run& run, LaneRow* velocities, const std::uint8_t* visited,
                                   std::uint32_t* changed, real restless)
{
    const Wide limit(restless);
    std::uint32_t group = 0, sum = 0;  // of blocks one after the other that are of one group
    const auto add = [changed](std::uint32_t of, std::uint32_t more) {
        if (more != 0) __atomic_fetch_add(&changed[of], more, __ATOMIC_RELAXED);
    };
    for (std::size_t at = 0; at < run.count; ++at) {
        Block& block = run.blocks[at];
        const std::uint32_t lanes = visited == nullptr ? block.active : lanesOf(block, visited);
        if (lanes == 0) continue;
        const Wide change = visitHinges(block, run.angleOf(block), lanes, false, velocities);
        std::uint32_t bits = bitsOf(change > limit) & lanes;
        if (block.oneGroup) {
            if (block.group[0] != group) add(group, std::exchange(sum, 0u));
            group = block.group[0];
            sum += static_cast<std::uint32_t>(__builtin_popcount(bits));
        } else {
            for (; bits != 0; bits &= bits - 1) add(block.group[__builtin_ctz(bits)], 1);
        }
    }
    add(group, sum);
}

template <int W>
void HingeKernels<W>::findLost(const Run& run, const LaneRow* turns, real trusted, std::uint8_t* lost)
{
    const Wide limit(trusted);
    for (std::size_t at = 0; at < run.count; ++at) {
        const Block& block = run.blocks[at];
        const BasicVec2<Wide> bias = biasOf(block, turns);
        const auto same =
            (limit >= absolute(bias.x - block.bias.x)) & (limit >= absolute(bias.y - block.bias.y));
        markFlags(bitsOf(!same) & block.active, block.group, block.oneGroup, lost);
    }
}

template <int W>
void HingeKernels<W>::flatten(const Run& run, const std::uint8_t* lost, LaneRow* velocities,
                              const StepContext& context)
{
    const Wide zero(real(0)), invH(context.invH);
    for (std::size_t at = 0; at < run.count; ++at) {
        Block& block = run.blocks[at];
        Angle* const angle = run.angleOf(block);
        const std::uint32_t lanes = lanesOf(block, lost);
        run.sources[at].lost = lanes;
        if (lanes == 0) continue;
        const LaneMask<W> is = lanesIn<W>(lanes);
        block.bias = {select(is, zero, block.bias.x), select(is, zero, block.bias.y)};
        for (int side = 0; angle != nullptr && side < 2; ++side) {
            HingeLimit<Wide>& limit = angle->limits[side];
            const Wide error = angle->limitError[side];
            limit.bias = select(is, select(error > zero, error * invH, zero), limit.bias);
        }
        visitHinges(block, angle, lanes, true, velocities);
    }
}

template <int W>
void HingeKernels<W>::settle(const Run& run, const Motion* motions, const TickRows& rows, LaneRow* turned,
                             const StepContext& context)
{
    const Wide two(real(2));
    for (std::size_t at = 0; at < run.count; ++at) {
        Block& block = run.blocks[at];
        Source& source = run.sources[at];
        Angle* const angle = run.angleOf(block);
        tallyHinges(block, source, angle, rows.velocities.data());
        measureHinges(block, source, angle, motions, rows);
        prepareHinges(block, angle, motions);
        // Of whole ones all has acted; of lost ones nothing is carried on.
        const LaneMask<W> gone = lanesIn<W>(source.whole | source.lost);
        source.first = block.impulse;
        setImpulse(block, gone, {});
        block.bias = {};
        AngleImpulses<Wide> turning;
        if (angle != nullptr) {
            settleAngle(*angle, lanesIn<W>(source.whole), gone, context);
            turning = scaled(impulsesOf(*angle), two);
        }
        const std::uint32_t halved = block.active & ~source.whole;
        if (halved == 0) continue;
        addToSteady(block, scaled(block.impulse, two), angle != nullptr ? &turning : nullptr, halved, turned);
    }
}

template <int W>
void HingeKernels<W>::keep(const Run& run, const std::uint8_t* hit, const LaneRow* velocities,
                           const StepContext& context)
{
    const Wide zero(real(0)), h(context.h), part(kMostGive);
    for (std::size_t at = 0; at < run.count; ++at) {
        const Block& block = run.blocks[at];
        Source& source = run.sources[at];
        Angle* const angle = run.angleOf(block);
        tallyHinges(block, source, angle, velocities);
        std::uint32_t kept = block.active;
        if (hit != nullptr)
            kept &= ~(lanesOf(block, block.rowA, false, hit) | lanesOf(block, block.rowB, false, hit));
        const LaneMask<W> keeps = lanesIn<W>(kept), found = lanesIn<W>(~source.lost);
        const auto carriedOf = [&](Wide first, Wide impulse) {
            const Wide sum = first + impulse;
            return select(found & isEqual(sum - sum, zero), sum, zero);
        };
        const auto keepIn = [&](Wide& old, Wide value) { old = select(keeps, value, old); };
        const BasicVec2<Wide> point{carriedOf(source.first.x, block.impulse.x),
                                    carriedOf(source.first.y, block.impulse.y)};
        const auto lengthOf = [](BasicVec2<Wide> v) { return squareRoot(v.x * v.x + v.y * v.y); };
        const Wide most = part * (lengthOf(block.armA) + lengthOf(block.armB));
        const std::uint32_t strained = bitsOf((giveOf(block.massX, absolute(point.x), h) > most) |
                                              (giveOf(block.massY, absolute(point.y), h) > most)) &
                                       kept;
        if (source.anyStrained || strained != 0) {
            source.anyStrained = false;
            for (int lane = 0; lane < W; ++lane) {
                int& ticks = source.strained[lane];
                if ((kept >> lane & 1u) != 0) ticks = (strained >> lane & 1u) != 0 ? ticks + 1 : 0;
                if ((kept >> lane & 1u) != 0 && ticks >= kLasting) source.stiffened |= 1u << lane;
                source.anyStrained = source.anyStrained || ticks != 0;
            }
        }
        keepIn(source.carried.x, point.x);
        keepIn(source.carried.y, point.y);
        if (angle == nullptr) continue;
        keepIn(angle->carried.spring, carriedOf(angle->first.spring, angle->spring));
        keepIn(angle->carried.motor, carriedOf(angle->first.motor, angle->motor));
        for (const int side : {0, 1}) {
            // The blow with which a limit is met is not a load it will bear.
            const Wide carried = carriedOf(angle->first.limits[side], angle->limits[side].impulse);
            keepIn(angle->carried.limits[side], select(lanesIn<W>(angle->held[side]), carried, zero));
            angle->held[side] = (angle->held[side] & ~kept) | (bitsOf(carried > zero) & kept);
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
