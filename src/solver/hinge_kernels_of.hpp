// SPDX-License-Identifier: MIT
// The kernels over blocks of hinges, for one width: included once for each instruction set, by a file that is
// compiled with the switches of that set.
#pragma once

#include "joints/softness.hpp"
#include "math/turn_kernel.hpp"
#include "solver/body_runs.hpp"
#include "solver/hinge_aim_kernel.hpp"
#include "solver/hinge_visit_kernel.hpp"

#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

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

template <class Wide>
TAMIAS_INLINE Wide lengthOf(const BasicVec2<Wide>& v)
{
    return squareRoot(v.x * v.x + v.y * v.y);
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
        const LaneMask<W> is = maskOf<W>(lanes);
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
        const LaneMask<W> gone = maskOf<W>(source.whole | source.lost);
        source.first = block.impulse;
        setImpulse(block, gone, {});
        block.bias = {};
        AngleImpulses<Wide> turning;
        if (angle != nullptr) {
            settleAngle(*angle, maskOf<W>(source.whole), gone, context);
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
        const LaneMask<W> keeps = maskOf<W>(kept), found = maskOf<W>(~source.lost);
        const auto carriedOf = [&](Wide first, Wide impulse) {
            const Wide sum = first + impulse;
            return select(found & isEqual(sum - sum, zero), sum, zero);
        };
        const auto keepIn = [&](Wide& old, Wide value) { old = select(keeps, value, old); };
        const BasicVec2<Wide> point{carriedOf(source.first.x, block.impulse.x),
                                    carriedOf(source.first.y, block.impulse.y)};
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
            keepIn(angle->carried.limits[side], select(maskOf<W>(angle->held[side]), carried, zero));
            angle->held[side] = (angle->held[side] & ~kept) | (bitsOf(carried > zero) & kept);
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
