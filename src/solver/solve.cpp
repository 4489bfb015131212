// SPDX-License-Identifier: MIT
// The order of passes within a step. Each tick: impacts at their times, first kick, one pass over
// the contacts (more for islands that are not settled), drift, second kick, calming.

#include "solver/solve.hpp"

#include "contacts/rows.hpp"
#include "solver/calm.hpp"
#include "solver/integrate.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void forgetSums(SolverStage& stage)
{
    for (Contact& c : stage.contacts.rows) {
        c.stepImpulse = {};
        for (ContactPointRow& point : c.points) point.stepNormal = point.stepTangent = 0;
    }
}

// The warm start of the tick: what the contacts carry, as velocity changes of the bodies. Taken with the
// arms of the present poses: carried over from the tick before, impulses at points that slide would
// change the angular momentum of the whole. What carries a load at this moment is loaded for the tick: no
// impact changes a contact that is.
void gatherSteady(SolverStage& stage, const StepContext& context)
{
    for (Motion& m : stage.motions.rows) {
        m.steady = {};
        m.steadySpin = 0;
        m.loaded = false;
    }
    for (Contact& c : stage.contacts.rows) {
        c.impacts = 0;
        c.fastestImpact = 0;
        if (c.count == 0) continue;
        Motion &a = stage.motions.rows[c.rowA], &b = stage.motions.rows[c.rowB];
        prepareContact(c, a, b);
        addSteady(c, a, b);
        for (int i = 0; i < c.count; ++i) {
            ContactPointRow& point = c.points[i];
            point.wasLoaded = point.normalImpulse > 0;
            point.pushImpulse = 0;
            if (point.wasLoaded) a.loaded = b.loaded = true;
        }
    }
    for (Motion& m : stage.motions.rows) limitSteady(m, context);
}

// One pass settles what rests. An island whose speeds it still changed gets further passes, up to a
// limit, on its own: its neighbors never notice.
void solvePasses(SolverStage& stage, const StepContext& context, SolverScratch& scratch)
{
    const real restless = context.tuning.restless * context.lengthUnit;
    gatherBlocks(stage.contacts, stage.motions, stage.islands, context, scratch.blocks);
    scratch.unrest.clear();
    for (int pass = 0; pass <= context.tuning.extraPasses; ++pass) {
        scratch.unrest.swap(scratch.unrestBefore);
        scratch.unrest.assign(stage.islands.count(), 0);
        passOver(scratch.blocks, stage.contacts, stage.motions, stage.islands, context, restless,
                 scratch.unrestBefore, scratch.unrest);
        const auto isRestless = [restless](real change) { return change > restless; };
        if (std::none_of(scratch.unrest.begin(), scratch.unrest.end(), isRestless)) break;
    }
    scatterBlocks(scratch.blocks, stage.contacts, stage.motions);
}

// Once in a step, overlaps are undone by displacements that leave velocities alone.
void pushApart(SolverStage& stage, const StepContext& context, SolverScratch& scratch, ClampCounts& clamps)
{
    for (const std::uint32_t i : stage.contacts.order) {
        Contact& c = stage.contacts.rows[i];
        pushContact(c, stage.motions.rows[c.rowA], stage.motions.rows[c.rowB], scratch.pushes[c.rowA],
                    scratch.pushes[c.rowB], context, clamps);
    }
    for (const std::uint32_t i : stage.contacts.order) {
        Contact& c = stage.contacts.rows[i];
        repayPush(c, stage.motions.rows[c.rowA], stage.motions.rows[c.rowB], context.h);
    }
}

// The second kick of a force that varies: taken at the new place and at the velocity expected there,
// so that forces that depend on velocity are second order too.
std::uint32_t accelerateAfterDrift(SolverStage& stage, const StepContext& context, double time)
{
    std::vector<Motion>& rows = stage.motions.rows;
    std::vector<std::pair<Vec2, real>>& held = stage.scratch.held;
    held.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        held[i] = {rows[i].velocity, rows[i].spin};
        if (rows[i].loaded) continue;
        rows[i].velocity += context.h / 2 * rows[i].acceleration;
        rows[i].spin += context.h / 2 * rows[i].spinRate;
    }
    const std::uint32_t faults = accelerate(stage.motions, stage.world.bodies, stage.field, time);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].velocity = held[i].first;
        rows[i].spin = held[i].second;
    }
    return faults;
}

}  // namespace

SolverCounts solve(SolverStage& stage, const StepContext& context)
{
    SolverCounts counts;
    SolverScratch& scratch = stage.scratch;
    scratch.impacts.tree.clear();  // the boxes are new
    std::vector<Motion>& rows = stage.motions.rows;
    std::uint32_t groups = 0;
    ImpactStage impacts{stage.world,     stage.field,   stage.resting,    stage.asleep,
                        stage.islands,   stage.motions, stage.contacts,   stage.boxes,
                        scratch.kicks,   stage.impacts, scratch.impacts,  counts.clamps,
                        counts.repaired, groups,        counts.lawFaults, stage.roused};

    for (Motion& m : rows) {
        const BodyRow& body = stage.world.bodies.rows[m.body];
        m.damping = makeDamping(m.moves() ? body.linearDamping : real(0), context.h);
        m.spinDamping = makeDamping(m.moves() ? body.angularDamping : real(0), context.h);
    }
    forgetSums(stage);
    scratch.ways.assign(rows.size(), {});
    bool varies = stage.field.varies(stage.motions, stage.world.bodies);

    Stopwatch watch;
    for (int tick = 0; tick < context.ticks; ++tick) {
        const ProfileScope tickSpan(stage.profile, "tick");
        ProfileScope span(stage.profile, "forces");
        const double time = context.time + context.dt * tick / context.ticks;
        scratch.kicks.assign(rows.size(), {});
        scratch.changes.assign(rows.size(), {});
        scratch.pushes.assign(rows.size(), {});
        if (varies && tick > 0)
            counts.lawFaults += accelerate(stage.motions, stage.world.bodies, stage.field, time);

        // Impacts at their times.
        span.next("swept pairs");
        resweepForTick(impacts, scratch.ways, context);
        span.next("warm start");
        gatherSteady(stage, context);
        span.next("impacts");
        applyImpacts(impacts, context, tick);
        scratch.changes.resize(rows.size());  // for those that came in
        scratch.pushes.resize(rows.size());
        scratch.ways.resize(rows.size());
        if (!stage.roused.empty()) varies = stage.field.varies(stage.motions, stage.world.bodies);
        counts.impactTime += watch.lap();

        // First kick, contacts.
        span.next("passes");
        for (std::size_t i = 0; i < rows.size(); ++i) {
            kickFirst(rows[i], scratch.kicks[i]);
            scratch.changes[i] = {-rows[i].velocity, -rows[i].spin};
        }
        solvePasses(stage, context, scratch);
        if (tick == 0) pushApart(stage, context, scratch, counts.clamps);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Vec2 solved = scratch.changes[i].velocity + rows[i].velocity;
            scratch.changes[i].velocity += rows[i].velocity + rows[i].steady;
            scratch.changes[i].spin += rows[i].spin + rows[i].steadySpin;
            repayImpact(rows[i], scratch.kicks[i], solved, context.h);
        }

        // Drift, second kick.
        span.next("drift");
        for (std::size_t i = 0; i < rows.size(); ++i)
            scratch.ways[i] = drift(rows[i], scratch.pushes[i], context.h);
        if (varies)
            counts.lawFaults += accelerateAfterDrift(stage, context, time + context.dt / context.ticks);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            Motion& m = rows[i];
            kickSecond(m, scratch.kicks[i]);
            m.steady = scratch.changes[i].velocity;
            m.steadySpin = scratch.changes[i].spin;
            scratch.changes[i].velocity += context.h * m.acceleration;
            scratch.changes[i].spin += context.h * m.spinRate;
        }
        span.next("calm");
        calm(rows, scratch.changes, stage.islands, context, scratch.freeIslands);
        for (Motion& m : rows)
            if (m.moves() && clampSpeed(m, context.lengthUnit)) ++counts.clamps.speed;
        counts.solveTime += watch.lap();
    }
    for (Contact& c : stage.contacts.rows)
        if (c.swept) keepClearance(c, scratch.ways);
    return counts;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
