// SPDX-License-Identifier: MIT
// One step, top to bottom. Each paragraph reads what those above it wrote; nothing calls back up.
// docs/architecture.md has the same list with what every stage reads and writes.

#include "base/timer.hpp"
#include "contacts/rows.hpp"
#include "contacts/step_manifolds.hpp"
#include "graph/coloring.hpp"
#include "islands/links.hpp"
#include "joints/reading.hpp"
#include "solver/finalize.hpp"
#include "solver/solve.hpp"
#include "world/impl.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

bool byShapes(const TouchEvent& a, const TouchEvent& b)
{
    return a.shapeA != b.shapeA ? a.shapeA < b.shapeA : a.shapeB < b.shapeB;
}

// Who can be pushed, and whether all that cannot be holds still. Returns whether all is as before.
bool readRows(const MotionTable& motions, GraphScratch& graph)
{
    const Table<Motion>& rows = motions.rows;
    bool isSame = graph.movable.size() == rows.size(), groundsMove = false;
    graph.movable.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool moves = rows[i].moves();
        isSame = isSame && graph.movable[i] == moves;
        graph.movable[i] = moves;
        groundsMove = groundsMove || (!moves && (rows[i].velocity != Vec2{} || rows[i].spin != 0));
    }
    isSame = isSame && !groundsMove && !graph.groundsMove;
    graph.groundsMove = groundsMove;
    return isSame;
}

// Who meets whom, and how near. Returns whether all are as near as before; they are the `same` pairs.
bool readContacts(const ContactTable& contacts, bool same, GraphScratch& graph, Parallel& parallel)
{
    if (same && graph.nearness == contacts.nearness) return true;
    graph.nearness.assign(contacts.nearness.begin(), contacts.nearness.end());
    if (same) return false;
    const Table<ContactFacts>& facts = contacts.facts;
    graph.pairs.resize(facts.size());
    parallel.forEach(facts.size(), kContactGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) graph.pairs[k] = {facts[k].rowA, facts[k].rowB};
    });
    return false;
}

// The pairs that are at least that near.
void listLinks(GraphScratch& graph, Nearness least)
{
    graph.links.clear();
    for (std::size_t k = 0; k < graph.pairs.size(); ++k)
        if (graph.nearness[k] >= least) graph.links.push_back({graph.pairs[k].a, graph.pairs[k].b});
}

void linkTouching(const JointSystem& system, const MotionTable& motions, GraphScratch& graph)
{
    std::vector<Link>& links = graph.links;
    listLinks(graph, Nearness::Linked);
    for (const JointTie& joint : system.ties) {
        links.push_back({joint.rowA, joint.rowB});
        const std::uint32_t moving = joint.movingRow(motions.rows);
        for (int k = 0; joint.more && k < joint.more->count; ++k)
            links.push_back({moving, joint.more->rows[k]});
    }
    const auto sameMotion = [&](std::uint32_t a, std::uint32_t b) {
        const Motion &ma = motions.rows[a], &mb = motions.rows[b];
        const bool still = ma.velocity == Vec2{} && mb.velocity == Vec2{} && ma.spin == 0 && mb.spin == 0;
        return still || (ma.velocity == mb.velocity && ma.spin == 0 && mb.spin == 0);
    };
    linkIslands(links, graph.movable, sameMotion, graph.islands);
}

void markCrowds(ContactTable& contacts, const Tuning& tuning, GraphScratch& graph,
                std::vector<std::uint8_t>& renewed, Parallel& parallel)
{
    listLinks(graph, Nearness::Near);
    const Islands& islands = graph.crowds;
    linkIslands(graph.links, graph.movable, [](std::uint32_t, std::uint32_t) { return true; }, graph.crowds);
    const auto sizeAt = [&](std::uint32_t row) {
        const std::uint32_t island = islands.islandOf[row];
        return island == Islands::kNone ? 0u : islands.sizeOf[island];
    };
    parallel.forEach(contacts.rows.size(), kContactGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            const RowPair& pair = graph.pairs[k];
            const bool crowded =
                maximum(sizeAt(pair.a), sizeAt(pair.b)) >= static_cast<std::uint32_t>(tuning.crowd);
            if (crowded == contacts.rows[k].crowded) continue;
            contacts.rows[k].crowded = crowded;
            renewed[k] = 1;
        }
    });
}

bool exceeds(const JointReading& reading, const JointBreaking& limit)
{
    const auto strength = static_cast<real>(length(toDVec2(reading.force)));
    return !(strength <= limit.force && absolute(reading.torque) <= limit.torque &&
             reading.error <= limit.error);
}

}  // namespace

void World::Impl::breakJoints()
{
    breaks.clear();
    std::vector<std::uint32_t>& slots = met;
    slots.clear();
    for (const JointTie& rows : jointSystem.ties)
        if (joints.rows[rows.joint].def.breaking != JointBreaking{}) slots.push_back(rows.joint);
    std::sort(slots.begin(), slots.end());
    const double rounding = stepTime / 1000;  // of many steps that add up to a window
    for (const std::uint32_t slot : slots) {
        JointRow& joint = joints.rows[slot];
        const JointReading reading = readJoint(joint, bodies, stepTime);
        const bool isOver = exceeds(reading, joint.def.breaking);
        joint.overTime = isOver ? joint.overTime + stepTime : 0;
        if (!isOver) continue;
        if (joint.overTime <
            static_cast<double>(joint.def.breaking.window) - rounding) {  // it may yet: nobody sleeps
            joint.eachBody([&](std::uint32_t body) { bodies.beginStillness(bodies.rows[body]); });
            continue;
        }
        joint.overTime = 0;
        joint.def.enabled = false;
        joint.broken = true;
        uncoupledIsStale = true;
        ++joints.changes;
        joint.forgetLoads();
        breaks.push_back({joints.ids.id(slot), joint.def.bodyA, joint.def.bodyB, reading.force,
                          reading.torque, reading.error});
    }
}

// Contacts are about to change their numbers or their anchors: nothing beside their rows is true any more.
void World::Impl::leaveLanes()
{
    solverScratch.passes.leave(contacts);
    contacts.loads.clear();
}

// By shapes: those of bodies that have woken stand behind all others until now.
void World::Impl::sortContacts()
{
    if (contactsAreSorted) return;
    leaveLanes();
    tamias2d::sortContacts(contacts.rows, matchScratch);
    contactsAreSorted = true;
}

// Bodies that took part in the last step and do no more: it was their last, for interpolation, too.
void World::Impl::rememberLeavers()
{
    for (const std::uint32_t slot : leavers)
        if (bodies.ids.isAlive(slot) && !bodies.rows[slot].takesPart) remember(bodies, slot);
    leavers.clear();
}

// Bodies whose values are no numbers have been disabled: they count no more.
void World::Impl::setAside()
{
    for (const Motion& m : motions.rows) {
        BodyRow& b = bodies.rows[m.body];
        if (b.enabled) continue;
        b.enabled = true;
        tally(b, false);
        b.enabled = false;
    }
}

// One function to read from top to bottom. NOLINTNEXTLINE(readability-function-size)
StepReport World::Impl::step(double dt, int substeps)
{
    StepReport r;
    const StepContext context = makeStepContext(settings.tuning, settings.lengthUnit, time, dt, substeps);
    Stopwatch whole, watch;
    profile.clear();
    const ProfileScope wholeSpan(profile, "step");
    ProfileScope span(profile, "gather");
    r.substeps = substeps;

    // Who takes part, with what acts on it.
    ForceField forces = field();
    forces.most = 2 * kMaxSpeed * static_cast<double>(settings.lengthUnit) / dt;
    forces.mostSpinRate = 2 * kMaxSpin / dt;
    rememberLeavers();
    settle();
    wakeByLaws(r.forceLawFaults);
    r.forceLawFaults += gather(forces, context);

    // Who might touch.
    begins.clear();
    ends.swap(endsOfDestroyed);
    endsOfDestroyed.clear();
    const ContactWorld world = contactWorld();
    span.next("broad phase");
    bool sameContacts = pairsAreCurrent;
    if (!pairsAreCurrent || !boxesAreSwept) {
        sweepPairs(boxes, restPairs, foundPairs, sweepScratch, parallel);
        sameContacts = pairsAreCurrent && foundPairs == pairs;
        pairs.swap(foundPairs);
        boxesAreSwept = true;
    }
    if (!sameContacts) {
        leaveLanes();
        sortContacts();
        span.next("pairs to contacts");
        matchPairs(world, pairs, contacts.rows, matchScratch, parallel);
        for (const Contact& contact : matchScratch.left) ends.push_back(touchEvent(contact));
        pairsAreCurrent = true;
    }
    r.times.pairs = watch.lap();

    // How.
    span.next("manifolds");
    findRenewed(contacts, sameContacts, motions, context, manifoldScratch, parallel);
    solverScratch.passes.release(manifoldScratch.renewed, contacts);
    const ManifoldCounts manifolds =
        renewManifolds(contacts, shapes, motions, context, paths, manifoldScratch, parallel);
    r.sweptPairs = manifolds.swept;
    r.clamps.advancement += manifolds.exhausted;
    r.times.manifolds = watch.lap();

    // Who must be solved together, and who may be side by side.
    span.next("islands and colors");
    const bool sameRows = readRows(motions, graph);
    const bool sameLinks = readContacts(contacts, sameContacts, graph, parallel);
    const bool hadJoints = std::exchange(graph.hasJoints, !jointSystem.empty());
    const bool sameIslands = sameRows && sameLinks && !hadJoints && !graph.hasJoints;
    if (!sameIslands) {
        linkTouching(jointSystem, motions, graph);
        markCrowds(contacts, context.tuning, graph, manifoldScratch.renewed, parallel);
    }
    if (!sameContacts)
        colorConstraints(graph.pairs, graph.movable, contacts.order, contacts.colorEnds, graph.colors);
    r.times.graph = watch.lap();

    // Move.
    span.next("solve");
    impacts.clear();
    roused.clear();
    SolverStage stage{world,         forces,   resting,      asleep,      graph.islands,
                      motions,       contacts, joints,       jointSystem, boxes,
                      impacts,       roused,   sameContacts, sameIslands, manifoldScratch.renewed,
                      solverScratch, profile,  parallel};
    const SolverCounts counts = solve(stage, context);
    for (const std::uint32_t group : roused) wakeGroup(group, false);  // their contacts are here already
    r.clamps.speed += counts.clamps.speed;
    r.clamps.push += counts.clamps.push;
    r.clamps.impactsPerContact += counts.clamps.impactsPerContact;
    r.clamps.advancement += counts.clamps.advancement;
    r.repaired = counts.repaired;
    r.forceLawFaults += counts.lawFaults;
    r.times.impacts = counts.impactTime;
    r.times.solve = counts.solveTime;
    watch.lap();

    // Hand back, and say what happened.
    span.next("finalize");
    if (r.repaired > 0 || !roused.empty()) contactsAreSorted = pairsAreCurrent = false;
    sortContacts();
    const FinalCounts final =
        finalize(solverScratch, motions, contacts, shapes, bodies, context, finalScratch, parallel);
    r.nonFinite = final.nonFinite;
    if (r.nonFinite > 0) setAside();
    r.clamps.position = final.stopped;
    r.deepestOverlap = final.deepestOverlap;
    r.touching = final.touching;
    span.next("events");
    for (const std::uint32_t i : finalScratch.changed)
        (contacts.rows[i].touching ? begins : ends).push_back(touchEvent(contacts.rows[i]));
    std::sort(begins.begin(), begins.end(), byShapes);
    std::sort(ends.begin(), ends.end(), byShapes);
    hits.clear();
    std::sort(impacts.begin(), impacts.end(), [](const ImpactRecord& a, const ImpactRecord& b) {
        if (a.hit.time != b.hit.time) return a.hit.time < b.hit.time;
        if (a.shapeA != b.shapeA) return a.shapeA < b.shapeA;
        return a.shapeB != b.shapeB ? a.shapeB < b.shapeB : a.number < b.number;
    });
    for (const ImpactRecord& record : impacts) {
        r.impacts += record.hit.simultaneous ? 0 : 1;
        HitEvent hit = record.hit;
        hit.shapeA = shapes.ids.id(record.shapeA);
        hit.shapeB = shapes.ids.id(record.shapeB);
        hit.bodyA = bodies.ids.id(shapes.rows[record.shapeA].body);
        hit.bodyB = bodies.ids.id(shapes.rows[record.shapeB].body);
        hits.push_back(hit);
    }

    stepTime = dt;
    breakJoints();

    // Who may rest now.
    span.next("sleep");
    r.touching += asleep.touching;
    for (const Motion& m : motions.rows)
        if (!bodies.rows[m.body].isDynamic() || final.nonFinite > 0) refreshPart(m.body);
    noteMost();
    fallAsleep(context);

    // Report.
    time += dt;
    ++steps;
    r.bodies = census.bodies;
    r.dynamicBodies = census.dynamicBodies;
    r.quiet = counts.quiet;
    r.asleep = asleep.bodies;
    r.awake = census.dynamicBodies - asleep.bodies;
    r.shapes = census.shapes;
    r.pairs = static_cast<std::uint32_t>(contacts.rows.size());
    r.joints = static_cast<std::uint32_t>(jointSystem.ties.size());
    r.stiffGroups = static_cast<std::uint32_t>(jointSystem.directCount) + counts.piles;
    r.stiffFallbacks = jointSystem.fallbacks + counts.pileFallbacks;
    r.jointFaults = jointSystem.countFaults();
    r.islands = graph.islands.count();
    r.times.finalize = watch.lap();
    r.times.total = whole.lap();
    return r;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
