// SPDX-License-Identifier: MIT
// The order of passes within a step. Each tick: impacts at their times, first kick, one pass over
// the contacts (more for islands that are not settled), drift, second kick, calming.

#include "solver/solve.hpp"

#include "narrowphase/face_kernel.hpp"
#include "solver/calm.hpp"
#include "solver/integrate.hpp"
#include "solver/joint_passes.hpp"
#include "solver/pass_hits.hpp"
#include "solver/tick_sweeps.hpp"
#include "solver/turned_contacts.hpp"

#include <algorithm>
#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// What joints carry, beside what contacts do; what is tied to a loaded body is loaded, too.
void addSteadyOfJoints(SolverStage& stage, TickRows& lanes, bool inertiasAreSame)
{
    const Table<Motion>& rows = stage.motions.rows;
    addSteadyJoints(stage.joints, stage.system, rows, lanes.steady);
    stage.scratch.hinges().addSteady(rows, lanes, inertiasAreSame);
    spreadLoad(stage.system, lanes.steady);
}

// The joints at their new places: for what is halved, the second half of what they carry turns with them.
void turnJoints(SolverStage& stage, TickRows& lanes, const StepContext& context)
{
    const Table<Motion>& rows = stage.motions.rows;
    tallyJoints(stage.joints, stage.system, rows, lanes.velocities);
    measureJoints(stage.joints, stage.world.bodies, stage.motions, stage.system);
    turnSteadyJoints(stage.system, rows, lanes.turned, context);
    stage.scratch.hinges().settle(rows, lanes, context);
}

// Those that are in no lanes yet, or no more: what may become a pile is not, as all of that is solved at
// once.
void seatJoints(SolverStage& stage)
{
    JointSystem& system = stage.system;
    TickRows& lanes = stage.scratch.rows;
    const std::size_t measured = system.joints.size();
    stage.scratch.passes.pile(stage.contacts, stage.motions, system);
    measureJoints(stage.joints, stage.world.bodies, stage.motions, system, measured);
    HingeLanes& hinges = stage.scratch.hinges();
    if (!hinges.empty() || !system.hinges.empty())
        hinges.take(system, stage.joints, stage.world.bodies, stage.motions, stage.islands, lanes);
    if (system.empty()) return;
    lanes.turned.resize(stage.motions.rows.size());
    for (std::size_t i = 0; i < lanes.turned.size(); ++i)
        lanes.turned[i] = {0, 0, 0, system.isTied(i) ? real(1) : real(0)};
}

// Returns whether all bodies have the moments of inertia that they had in the tick before.
bool guard(SolverStage& stage, const StepContext& context)
{
    JointSystem& system = stage.system;
    system.pull.assign(stage.motions.rows.size(), 0);
    stage.scratch.hinges().addPull(system.pull);
    return !guardLightBodies(stage.joints, system, stage.motions.rows, context);
}

// Which bodies impacts have hit in this tick.
void markHits(SolverStage& stage)
{
    const Table<ImpactKick>& kicks = stage.scratch.rows.kicks;
    stage.system.hit.assign(stage.motions.rows.size(), 0);
    stage.system.anyHit = stage.scratch.impacts.kicked;
    if (!stage.system.anyHit) return;
    for (std::size_t i = 0; i < kicks.size(); ++i)
        stage.system.hit[i] = kicks[i].before != Vec2{} || kicks[i].after != Vec2{};
}

// Which groups of joints have a contact in this tick: for those that may be projected.
void markTouched(SolverStage& stage)
{
    JointSystem& system = stage.system;
    const Table<PairRow>& pairs = stage.scratch.impacts.pairs;  // those that came in within the step, too
    system.touchedGroups.assign(system.wholeGroups.size(), 0);
    if (!mayProject(system)) return;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::uint32_t a = system.groupOf[pairs[i].rowA], b = system.groupOf[pairs[i].rowB];
        if (a == b && a == JointSystem::kNone) continue;
        if (stage.contacts.rows[i].count == 0) continue;
        if (a != JointSystem::kNone) system.touchedGroups[a] = 1;
        if (b != JointSystem::kNone) system.touchedGroups[b] = 1;
    }
}

void markMet(SolverStage& stage)
{
    markHits(stage);
    markTouched(stage);
}

// The second kick of a force that varies: taken at the new place and at the velocity expected there,
// so that forces that depend on velocity are second order too.
std::uint32_t accelerateAfterDrift(SolverStage& stage, const StepContext& context, double time)
{
    Table<Motion>& rows = stage.motions.rows;
    std::vector<std::pair<Vec2, real>>& held = stage.scratch.held;
    held.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        held[i] = {rows[i].velocity, rows[i].spin};
        if (rows[i].isLoaded()) continue;
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

// Groups of joints that the passes did not bring to where they go; then contacts that these did not see
// coming, as joints whirl bodies about, have their say. What still goes deep into a ground after that, or is
// torn, is slowed down. `before` are the velocities before the passes.
void settleGroups(ImpactStage& impacts, const JointWorld& world, const Table<LaneRow>& before)
{
    constexpr int kRounds = 4;  // each finds the corners that the one before turned the bodies onto
    JointSystem& system = impacts.system;
    settleLost(world, system, before, impacts.rows.velocities);
    int round = 0;
    while (round < kRounds && aimTurnedContacts(impacts, world.context, 1)) {
        impacts.passes.solveAgain(impacts.contacts, impacts.motions, impacts.rows,
                                  impacts.scratch.turned.islands, world, system);
        ++round;
    }
    if (round == kRounds && aimTurnedContacts(impacts, world.context, kThrough))
        impacts.clamps.speed += stopTurned(impacts);
    impacts.clamps.speed += slowTorn(impacts, world);
    const std::vector<std::uint8_t>& lost = system.lostGroups;
    if (round > 0 && !world.hinges.empty() &&
        std::find(lost.begin(), lost.end(), std::uint8_t{1}) != lost.end())
        world.hinges.flatten(lost, impacts.rows, world.context);  // the passes have aimed them anew
}

// From the passes to the end of the tick: together, unless forces or joints depend on where all bodies are in
// between. Returns how many bodies were too fast.
std::uint32_t driftAll(SolverStage& stage, const StepContext& context, bool pushed, bool together,
                       bool jointed)
{
    SolverScratch& scratch = stage.scratch;
    Table<Motion>& rows = stage.motions.rows;
    const bool kicked = scratch.impacts.kicked;
    std::atomic<std::uint32_t> clamped = 0;
    scratch.visited.forEach(stage.parallel, rows, scratch.rows, [&](const BodyRows& run) {
        if (together)
            clamped += scratch.bodies().driftAndKick(run, context, kicked, pushed);
        else
            scratch.bodies().drift(run, context, kicked, pushed, jointed);
    });
    return clamped;
}

// The rest of the kick where not all is done together; returns how many bodies were too fast.
std::uint32_t kickAfterDrift(SolverStage& stage, const StepContext& context, bool jointed)
{
    SolverScratch& scratch = stage.scratch;
    std::atomic<std::uint32_t> clamped = 0;
    scratch.visited.forEach(stage.parallel, stage.motions.rows, scratch.rows, [&](const BodyRows& run) {
        clamped += scratch.bodies().kickAfterDrift(run, context, scratch.impacts.kicked, jointed);
    });
    return clamped;
}

// After it: joints once more, and what they carry on.
void settle(SolverStage& stage, const StepContext& context)
{
    SolverScratch& scratch = stage.scratch;
    JointSystem& system = stage.system;
    Table<Motion>& rows = stage.motions.rows;
    settleJoints(system, scratch.hinges(), rows, scratch.rows, context);
    scratch.visited.forEach(stage.parallel, rows, scratch.rows,
                            [&](const BodyRows& run) { scratch.bodies().takeSettled(run); });
    tallyJoints(stage.joints, system, rows, scratch.rows.velocities);
    keepJoints(stage.joints, system, context);
    scratch.hinges().keep(system.anyHit ? system.hit.data() : nullptr, scratch.rows, context);
}

void calm(SolverStage& stage, const StepContext& context)
{
    SolverScratch& scratch = stage.scratch;
    calm(stage.motions.rows, scratch.rows, scratch.calmRows, scratch.bodies(), context, stage.parallel);
}

}  // namespace

void SolverScratch::suit(std::size_t count, ContactTable& contacts)
{
    most_ = maximum(most_, count);
    const LaneWidth width = suitedLanes(asked_, most_);
    passes.use(width, contacts);
    if (width != width_) hinges_ = makeHingeLanes(width, parallel_);
    width_ = width;
    bodyKernelsOfStep_ = &bodyKernels(width);
}

SolverCounts solve(SolverStage& stage, const StepContext& context)
{
    SolverCounts counts;
    SolverScratch& scratch = stage.scratch;
    Table<Motion>& rows = stage.motions.rows;
    TickRows& lanes = scratch.rows;
    std::uint32_t groups = 0;
    scratch.suit(rows.size(), stage.contacts);
    ImpactStage impacts{
        stage.world,      stage.field,      stage.resting,    stage.asleep,    stage.islands, stage.motions,
        stage.contacts,   scratch.passes,   scratch.bodies(), lanes,           stage.joints,  stage.system,
        scratch.hinges(), stage.boxes,      stage.impacts,    scratch.impacts, counts.clamps, counts.repaired,
        groups,           counts.lawFaults, stage.roused,     scratch.visited, stage.parallel};

    lanes.origins.resize(rows.size());
    lanes.poses.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Motion& m = rows[i];
        startDamping(m, context.h);
        lanes.origins[i] = {stage.motions.origins[i]};
        lanes.poses[i] = poseRow(m, stage.motions.origins[i]);
    }
    scratch.passes.begin(stage.contacts, stage.motions, stage.islands, lanes, context,
                         stage.sameContacts && stage.system.empty(), stage.renewed);
    seatJoints(stage);
    HingeLanes& hinges = scratch.hinges();
    std::size_t roused = 0;
    startSweeps(impacts, stage.sameContacts ? &stage.renewed : nullptr);
    if (!stage.sameIslands) findCalmRows(stage.islands, scratch.calmRows);
    for (Table<LaneRow>* each :
         {&lanes.starts, &lanes.velocities, &lanes.expected, &lanes.loads, &lanes.pushes})
        each->resize(rows.size());
    lanes.ways.assign(rows.size(), {});
    lanes.kicks.assign(rows.size(), {});
    scratch.impacts.kicked = false;
    lanes.changes.resize(rows.size());
    bool varies = stage.field.varies(stage.motions, stage.world.bodies);
    scratch.visited.begin(rows, stage.contacts, context, varies || !stage.system.empty());

    Stopwatch watch;
    if (findQuiet(impacts, context, stage.sameContacts, varies, scratch.quiet)) {
        const ProfileScope span(stage.profile, "quiet");
        tickQuiet(stage, context, counts.clamps);
    }
    predictWays(impacts, context);
    const bool allAreQuiet = scratch.visited.chunks(rows.size()).empty() && scratch.visited.anyQuiet();
    if (!allAreQuiet) chooseCalmRows(scratch.visited.quiet(), false, scratch.calmRows);
    for (int tick = 0; tick < context.ticks && !allAreQuiet; ++tick) {
        const ProfileScope tickSpan(stage.profile, "tick");
        ProfileScope span(stage.profile, "forces");
        const double time = context.time + context.dt * tick / context.ticks;
        if (scratch.impacts.kicked) lanes.kicks.assign(rows.size(), {});
        scratch.impacts.kicked = false;
        if (varies && tick > 0)
            counts.lawFaults += accelerate(stage.motions, stage.world.bodies, stage.field, time);

        // Impacts at their times.
        span.next("swept pairs");
        resweepForTick(impacts, context);
        span.next("warm start");
        bool hasJoints = !stage.system.empty();
        const bool inertiasAreSame = hasJoints && guard(stage, context);
        scratch.passes.prepare(stage.contacts, stage.motions, lanes, context, &stage.system);
        if (hasJoints) addSteadyOfJoints(stage, lanes, inertiasAreSame);
        startTick(impacts, context, tick);
        span.next("impacts");
        applyImpacts(impacts, context, tick);
        if (!stage.roused.empty()) varies = stage.field.varies(stage.motions, stage.world.bodies);
        hasJoints = !stage.system.empty();  // those of sleepers that were hit, too
        if (hasJoints) markMet(stage);
        if (varies || hasJoints) scratch.visited.visitAll(scratch.bodies(), rows, lanes, context, tick);
        if (!scratch.impacts.woken.empty()) chooseCalmRows(scratch.visited.quiet(), false, scratch.calmRows);
        scratch.impacts.woken.clear();
        if (stage.roused.size() > roused) seatJoints(stage);
        roused = stage.roused.size();
        counts.impactTime += watch.lap();

        // First kick, contacts.
        span.next("passes");
        scratch.visited.forEach(stage.parallel, rows, lanes, [&](const BodyRows& run) {
            scratch.bodies().kick(run, context, scratch.impacts.kicked);
        });
        const JointWorld jointWorld{
            stage.joints, stage.world.bodies, stage.motions, stage.islands, context, hinges,
            lanes,        scratch.energies};
        passOver(stage, jointWorld);
        scratch.passes.finish(stage.contacts, stage.motions, lanes, &jointWorld, &stage.system);
        if (hasJoints) settleGroups(impacts, jointWorld, scratch.before);
        scratch.passes.addUp(stage.contacts, stage.motions, context);
        recordPassHits(impacts, context, tick);
        if (tick == 0) {
            lanes.pushes.assign(rows.size(), {});
            scratch.passes.pushApart(stage.contacts, stage.motions, lanes, context, counts.clamps,
                                     &jointWorld, &stage.system);
        }

        span.next("drift");
        const bool together = !varies && !hasJoints;
        counts.clamps.speed += driftAll(stage, context, tick == 0, together, hasJoints);
        if (hasJoints) turnJoints(stage, lanes, context);
        if (varies)
            counts.lawFaults += accelerateAfterDrift(stage, context, time + context.dt / context.ticks);
        if (!together) counts.clamps.speed += kickAfterDrift(stage, context, hasJoints);
        if (hasJoints) {
            span.next("joints");
            settle(stage, context);
        }
        span.next("calm");
        calm(stage, context);
        counts.solveTime += watch.lap();
    }
    counts.quiet = countQuiet(scratch.visited, scratch.quiet);
    scratch.visited.end(scratch.bodies(), rows, lanes, context, stage.parallel);
    scratch.passes.endPiles(stage.contacts, stage.motions, context);
    counts.piles = static_cast<std::uint32_t>(scratch.passes.piles().count());
    counts.pileFallbacks = scratch.passes.piles().fallbacks();
    hinges.store(stage.system, stage.joints);
    releaseGuard(stage.system, rows);
    scratch.passes.end(stage.contacts, scratch.impacts.swept);
    endSweeps(impacts);
    return counts;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
