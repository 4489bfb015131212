// SPDX-License-Identifier: MIT
// The kernels over blocks of contacts, for one width: included once for each instruction set, by a file that
// is compiled with the switches of that set.
#pragma once

#include "solver/contact_kernels.hpp"
#include "solver/contact_prepare_kernel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Others may mark and count the same at the same time.
inline void note(const UnrestNotes& unrest, std::uint32_t island, int contacts)
{
    __atomic_store_n(unrest.flags + island, std::uint8_t{1}, __ATOMIC_RELAXED);
    if (unrest.changes != nullptr)
        __atomic_fetch_add(unrest.changes + island, static_cast<std::uint32_t>(contacts), __ATOMIC_RELAXED);
}

}  // namespace

template <int W>
std::size_t ContactKernels<W>::prepare(Block* blocks, Source* sources, std::size_t count, TickRows& rows,
                                       const StepContext& context, std::uint32_t* open)
{
    std::size_t opened = 0;
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        Source& source = sources[at];
        if (block.active == 0) continue;
        addUp(block, source);
        prepareAt(block, source, rows, context.invH);
        source.counted = maskOf<W>(block.active);

        // Which of them carry a load, which of them may bounce.
        const Wide zero(real(0)), one(real(1));
        const int points = block.points();
        const PointRow<Wide>&p = block.row.points[0], &q = block.row.points[1];
        auto loaded = p.normalImpulse > zero;
        block.unloaded[0] = block.active & ~bitsOf(loaded);
        block.unloaded[1] = 0;
        if (points == 2) {
            const auto secondLoaded = q.normalImpulse > zero;
            block.unloaded[1] = block.active & block.two & ~bitsOf(secondLoaded);
            loaded = loaded | secondLoaded;
        }
        std::uint32_t closed = block.active;
        const std::uint32_t bounces = source.elastic & (block.unloaded[0] | block.unloaded[1]);
        if (bounces != 0) {
            for (int lane = 0; lane < W; ++lane)
                if ((bounces >> lane & 1u) != 0) open[opened++] = source.contact[lane];
            closed &= ~bounces;
        }
        if (!any(loaded)) continue;

        FourLanes<W> a = gatherRows<W>(rows.steady.data(), block.rowA);
        FourLanes<W> b = gatherRows<W>(rows.steady.data(), block.rowB);
        BodyMotion<Wide> steadyA = motionOf(a), steadyB = motionOf(b);
        addCarried(block.row, points, steadyA, steadyB);
        setMotion(a, steadyA);
        setMotion(b, steadyB);
        a.w = select(loaded, one, a.w);
        b.w = select(loaded, one, b.w);
        scatterRows<W>(a, rows.steady.data(), block.rowA, closed & block.movesA);
        scatterRows<W>(b, rows.steady.data(), block.rowB, closed & block.movesB);
    }
    return opened;
}

// The approach that parabolaTime looks for, at the earlier and the later end of the tick. What is rounded
// here in another way than there must not lose a contact: hence the margins.
template <int W>
std::size_t ContactKernels<W>::findApproaching(const Block* blocks, const Source* sources, std::size_t count,
                                               const TickRows& rows, const StepContext& context, real fastest,
                                               std::uint32_t* list)
{
    std::size_t found = 0;
    const Wide zero(real(0)), h(context.h), factor(context.tuning.impactThreshold * real(0.9));
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        const Source& source = sources[at];
        if (block.active == 0) continue;
        const auto canReach = Wide(2 * fastest) >= source.slowest;
        if ((bitsOf(canReach) & block.active) == 0) continue;

        const BasicVec2<Wide> n = block.row.normal;
        const FourLanes<W> vA = gatherRows<W>(rows.starts.data(), block.rowA);
        const FourLanes<W> vB = gatherRows<W>(rows.starts.data(), block.rowB);
        const FourLanes<W> eA = gatherRows<W>(rows.expected.data(), block.rowA);
        const FourLanes<W> eB = gatherRows<W>(rows.expected.data(), block.rowB);
        const FourLanes<W> lA = gatherRows<W>(rows.loads.data(), block.rowA);
        const FourLanes<W> lB = gatherRows<W>(rows.loads.data(), block.rowB);
        const auto along = [n](const FourLanes<W>& row) { return n.x * row.x + n.y * row.y; };
        const SteadyForces<Wide> onA{{lA.x, lA.y}, {lA.z, lA.w}}, onB{{lB.x, lB.y}, {lB.z, lB.w}};
        const Wide threshold = maximum(factor * steadyApproach(n, onA, onB, h), source.slowest);
        const Wide reach = eA.w + eB.w, most = Wide(real(2e-5)) * reach - threshold;
        const Wide speed = along(vB) - along(vA), push = along(eB) - along(eA);
        std::uint32_t near = 0;
        for (int k = 0; k < block.points(); ++k) {
            const PointRow<Wide>& p = block.row.points[k];
            const Wide start = speed + p.turnB * vB.z - p.turnA * vA.z;
            const Wide change = h * (push + p.turnB * eB.z - p.turnA * eA.z);
            const auto parts = (start > most) & (start + change > most);
            const auto comes = source.present[k] & !parts;
            near |= bitsOf(comes);
        }
        near |= source.atImpact;
        near &= block.active & bitsOf(reach >= source.slowest);
        for (int lane = 0; lane < W; ++lane)
            if ((near >> lane & 1u) != 0) list[found++] = source.contact[lane];
    }
    return found;
}

template <int W>
std::size_t ContactKernels<W>::findNewlyLoaded(const Block* blocks, const Source* sources, std::size_t count,
                                               std::uint32_t* list)
{
    std::size_t found = 0;
    const Wide zero(real(0));
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        std::uint32_t loaded = 0;
        for (int k = 0; k < 2; ++k)
            if ((block.unloaded[k] & block.active) != 0)
                loaded |= block.unloaded[k] & bitsOf(block.row.points[k].normalImpulse > zero);
        if ((loaded & block.active) == 0) continue;
        for (int lane = 0; lane < W; ++lane)
            if (((loaded & block.active) >> lane & 1u) != 0) list[found++] = sources[at].contact[lane];
    }
    return found;
}

template <int W>
void ContactKernels<W>::pass(Block* blocks, std::size_t count, TickRows& rows, const std::uint8_t* visited,
                             const UnrestNotes& unrest, real restless, bool ofAny)
{
    const Wide limit(restless);
    LaneRow* const velocities = rows.velocities.data();
    for (std::size_t at = 0; at < count; ++at) {
        Block& block = blocks[at];
        std::uint32_t lanes = block.active;
        if (visited != nullptr && lanes != 0) {
            if (block.oneIsland) {
                lanes = visited[block.island[0]] != 0 ? lanes : 0;
            } else {
                for (int lane = 0; lane < W; ++lane)
                    if (visited[block.island[lane]] == 0) lanes &= ~(1u << lane);
            }
        }
        if (lanes == 0) continue;

        const int points = block.points();
        FourLanes<W> a = gatherRows<W>(velocities, block.rowA), b = gatherRows<W>(velocities, block.rowB);
        BodyMotion<Wide> motionA = motionOf(a), motionB = motionOf(b);
        Wide change;
        if (lanes == (block.active | block.out)) {
            change = solveRow(block.row, points, motionA, motionB);
        } else {
            const LaneMask<W> mask = maskOf<W>(lanes);
            const PointRow<Wide> old[2] = {block.row.points[0], block.row.points[1]};
            change = solveRow(block.row, points, motionA, motionB);
            for (int k = 0; k < points; ++k) {
                PointRow<Wide>& p = block.row.points[k];
                p.normalImpulse = select(mask, p.normalImpulse, old[k].normalImpulse);
                p.tangentImpulse = select(mask, p.tangentImpulse, old[k].tangentImpulse);
            }
        }
        if (ofAny) {
            const PointRow<Wide>& p = block.row.points[0];
            change =
                maximum(change, changeBetween(motionOf(a), motionA, absolute(p.turnA) + absolute(p.slideA)));
            change =
                maximum(change, changeBetween(motionOf(b), motionB, absolute(p.turnB) + absolute(p.slideB)));
        }
        setMotion(a, motionA);
        setMotion(b, motionB);
        scatterRows<W>(a, velocities, block.rowA, lanes & block.movesA);
        scatterRows<W>(b, velocities, block.rowB, lanes & block.movesB);
        const std::uint32_t changed = bitsOf(change > limit) & lanes;
        if (changed == 0) continue;
        if (block.oneIsland) {
            note(unrest, block.island[0], __builtin_popcount(changed));
            continue;
        }
        for (int lane = 0; lane < W; ++lane)
            if ((changed >> lane & 1u) != 0) note(unrest, block.island[lane], 1);
    }
}

template <int W>
std::uint32_t ContactKernels<W>::push(const Block* blocks, Source* sources, std::size_t count, TickRows& rows,
                                      const StepContext& context)
{
    std::uint32_t heldBack = 0;
    const Wide zero(real(0)), invH(context.invH), rate(context.tuning.pushRate), most(context.mostPush());
    const Wide slack(context.tuning.pushSlack);
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        Source& source = sources[at];
        if (block.active == 0) continue;
        const int points = block.points();
        Wide bias[2];
        for (int k = 0; k < points; ++k) {
            const Wide off = source.gap[k] + slack * source.restGap;
            const auto held = source.present[k] & !(off > zero) & (rate * off * invH < -most);
            if (any(held))
                for (std::uint32_t bits = bitsOf(held) & block.active; bits != 0; bits &= bits - 1)
                    ++heldBack;
            bias[k] = pushBias(off, invH, rate, most);
        }
        FourLanes<W> a = gatherRows<W>(rows.pushes.data(), block.rowA);
        FourLanes<W> b = gatherRows<W>(rows.pushes.data(), block.rowB);
        BodyMotion<Wide> motionA = motionOf(a), motionB = motionOf(b);
        source.pushed = pushRow(block.row, points, bias[0], bias[1], motionA, motionB);
        setMotion(a, motionA);
        setMotion(b, motionB);
        scatterRows<W>(a, rows.pushes.data(), block.rowA, block.active & block.movesA);
        scatterRows<W>(b, rows.pushes.data(), block.rowB, block.active & block.movesB);
    }
    return heldBack;
}

template <int W>
void ContactKernels<W>::repay(const Block* blocks, Source* sources, std::size_t count, TickRows& rows,
                              const StepContext& context)
{
    const Wide zero(real(0));
    for (std::size_t at = 0; at < count; ++at) {
        const Block& block = blocks[at];
        Source& source = sources[at];
        if (block.active == 0 || (bitsOf(source.pushed > zero) & block.active) == 0) continue;
        const FourLanes<W> poseA = gatherRows<W>(rows.poses.data(), block.rowA);
        const FourLanes<W> poseB = gatherRows<W>(rows.poses.data(), block.rowB);
        FourLanes<W> a = gatherRows<W>(rows.velocities.data(), block.rowA);
        FourLanes<W> b = gatherRows<W>(rows.velocities.data(), block.rowB);
        Wide load = block.row.points[0].normalImpulse;
        if (block.points() == 2) load += block.row.points[1].normalImpulse;
        BodyMotion<Wide> motionA = motionOf(a), motionB = motionOf(b);
        source.stepImpulse += repayPush(block.row, source.pushed, load, apart(source, poseA, poseB),
                                        Wide(context.h), motionA.velocity, motionB.velocity);
        setMotion(a, motionA);
        setMotion(b, motionB);
        scatterRows<W>(a, rows.velocities.data(), block.rowA, block.active & block.movesA);
        scatterRows<W>(b, rows.velocities.data(), block.rowB, block.active & block.movesB);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
