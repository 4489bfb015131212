// SPDX-License-Identifier: MIT
// The tick of those that make a step in one: docs/theory/calm.md, section 6.

#include "solver/integrate.hpp"
#include "solver/solve.hpp"

#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {

void tickQuiet(SolverStage& stage, const StepContext& context, ClampCounts& clamps)
{
    SolverScratch& scratch = stage.scratch;
    Table<Motion>& rows = stage.motions.rows;
    TickRows& lanes = scratch.rows;
    const BodyKernels& bodies = scratch.bodies();
    const StepContext whole = wholeTick(context);
    scratch.visited.choose(scratch.quiet.quiet, true);
    chooseCalmRows(scratch.quiet.quiet, true, scratch.calmRows);
    scratch.passes.beginWhole(stage.contacts, scratch.quiet.quiet, context.ticks);
    for (std::uint32_t row = 0; row < rows.size(); ++row)
        if (rows[row].isDamped() && scratch.visited.isQuiet(row)) startDamping(rows[row], whole.h);

    // As in any tick, but for impacts.
    scratch.passes.prepare(stage.contacts, stage.motions, lanes, whole);
    scratch.visited.forEach(stage.parallel, rows, lanes, [&](const BodyRows& run) {
        std::uint32_t none[kBodyGrain];  // nobody strays
        StrayList strays{none, 0};
        bodies.startTick(run, whole, timeOf(0, whole), strays);
        bodies.kick(run, whole, false);
    });
    scratch.passes.solveWhole(stage.contacts, stage.motions, lanes, whole);
    scratch.passes.finish(stage.contacts, stage.motions, lanes);
    lanes.pushes.assign(rows.size(), {});
    scratch.passes.pushApart(stage.contacts, stage.motions, lanes, whole, clamps);
    std::atomic<std::uint32_t> clamped = 0;
    scratch.visited.forEach(stage.parallel, rows, lanes, [&](const BodyRows& run) {
        clamped += bodies.driftAndKick(run, whole, false, true);
    });
    clamps.speed += clamped;
    calm(rows, lanes, scratch.calmRows, bodies, whole, stage.parallel);
    scratch.passes.endWhole(stage.contacts, context.ticks);
    scratch.visited.choose(scratch.quiet.quiet, false);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
