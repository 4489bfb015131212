// SPDX-License-Identifier: MIT
// One step, top to bottom. Each paragraph reads what those above it wrote; nothing calls back up.
// docs/architecture.md has the same list with what every stage reads and writes.

#include "base/timer.hpp"
#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "graph/coloring.hpp"
#include "islands/links.hpp"
#include "solver/finalize.hpp"
#include "solver/solve.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The bodies that take part, as the solver wants them.
void gatherMotions(const BodyTable& bodies, const ShapeTable& shapes, MotionTable& motions)
{
    motions.rows.clear();
    motions.rowOf.assign(bodies.rows.size(), MotionTable::kNone);
    for (std::uint32_t slot = 0; slot < bodies.rows.size(); ++slot) {
        const BodyRow& b = bodies.rows[slot];
        if (!bodies.ids.isAlive(slot) || !b.enabled) continue;
        Motion m;
        m.center = b.center;
        m.angle = b.angle;
        m.rotation = b.rotation;
        m.velocity = b.velocity;
        m.spin = b.spin;
        m.invMass = b.invMass();
        m.invInertia = b.invInertia();
        m.body = slot;
        if (b.isDynamic()) {
            if (b.lockX) m.velocity.x = 0;
            if (b.lockY) m.velocity.y = 0;
            if (b.lockRotation) m.spin = 0;
        }
        for (const std::uint32_t s : b.shapes) m.extent = maximum(m.extent, shapes.rows[s].convex.extent);
        motions.rowOf[slot] = static_cast<std::uint32_t>(motions.rows.size());
        motions.rows.push_back(m);
    }
}

// The warm start of the step before, for the prediction of where bodies go.
void predictSteady(const ContactTable& contacts, const ShapeTable& shapes, MotionTable& motions,
                   const StepContext& context)
{
    for (const Contact& c : contacts.rows) {
        const std::uint32_t a = motions.rowOf[shapes.rows[c.shapeA].body],
                            b = motions.rowOf[shapes.rows[c.shapeB].body];
        if (a == MotionTable::kNone || b == MotionTable::kNone) continue;
        addSteady(c, motions.rows[a], motions.rows[b]);
    }
    for (Motion& m : motions.rows) limitSteady(m, context);
}

void sweepBoxes(ShapeTable& shapes, const MotionTable& motions, const StepContext& context,
                std::vector<SweepBox>& boxes)
{
    boxes.clear();
    const real dt = static_cast<real>(context.dt);
    for (std::uint32_t slot = 0; slot < shapes.rows.size(); ++slot) {
        if (!shapes.ids.isAlive(slot)) continue;
        ShapeRow& shape = shapes.rows[slot];
        const std::uint32_t row = motions.rowOf[shape.body];
        if (row == MotionTable::kNone) continue;
        const Motion& m = motions.rows[row];
        const Trajectory path = predictedPath(m, m.center, context.invH);
        const real margin = 3 * context.tuning.restGap * shape.convex.size;
        shape.sweptBox = sweptBounds(shape.convex, path, m.center, 0, dt, margin);
        const bool moves = m.moves() || m.velocity != Vec2{} || m.spin != 0;
        boxes.push_back({shape.sweptBox, slot, shape.body, moves});
    }
}

// By row: can anything push it?
std::vector<bool> movableRows(const MotionTable& motions)
{
    std::vector<bool> movable;
    for (const Motion& m : motions.rows) movable.push_back(m.moves());
    return movable;
}

void colorContacts(ContactTable& contacts, const std::vector<bool>& movable)
{
    std::vector<RowPair> pairs;
    for (const Contact& c : contacts.rows) pairs.push_back({c.rowA, c.rowB});
    colorConstraints(pairs, movable, contacts.order, contacts.colorEnds);
}

Islands linkTouching(const ContactTable& contacts, const MotionTable& motions,
                     const std::vector<bool>& movable, const StepContext& context)
{
    std::vector<Link> links;
    for (const Contact& c : contacts.rows) {
        bool linked = false;
        for (int i = 0; i < c.count; ++i) {
            const real reach = (context.tuning.touchingFactor - 1) * c.restGap;
            linked = linked || c.points[i].normalImpulse > 0 || c.points[i].gap <= reach;
        }
        if (linked) links.push_back({c.rowA, c.rowB});
    }
    return linkIslands(links, movable, [&](std::uint32_t a, std::uint32_t b) {
        const Motion &ma = motions.rows[a], &mb = motions.rows[b];
        const bool still = ma.velocity == Vec2{} && mb.velocity == Vec2{} && ma.spin == 0 && mb.spin == 0;
        return still || (ma.velocity == mb.velocity && ma.spin == 0 && mb.spin == 0);
    });
}

void markCrowds(ContactTable& contacts, const std::vector<bool>& movable, const Tuning& tuning)
{
    std::vector<Link> links;
    for (const Contact& c : contacts.rows)
        if (c.count > 0) links.push_back({c.rowA, c.rowB});
    const Islands islands = linkIslands(links, movable, [](std::uint32_t, std::uint32_t) { return true; });
    const auto sizeAt = [&](std::uint32_t row) {
        const std::uint32_t island = islands.islandOf[row];
        return island == Islands::kNone ? 0u : islands.sizeOf[island];
    };
    for (Contact& c : contacts.rows)
        c.crowded = maximum(sizeAt(c.rowA), sizeAt(c.rowB)) >= static_cast<std::uint32_t>(tuning.crowd);
}

}  // namespace

StepReport World::Impl::step(double dt, int substeps)
{
    StepReport r;
    const StepContext context = makeStepContext(settings.tuning, settings.lengthUnit, time, dt, substeps);
    Stopwatch whole, watch;
    r.substeps = substeps;

    // Who takes part, with what acts on it.
    ForceField forces = field();
    forces.most = 2 * kMaxSpeed * static_cast<double>(settings.lengthUnit) / dt;
    forces.mostSpinRate = 2 * kMaxSpin / dt;
    gatherMotions(bodies, shapes, motions);
    predictSteady(contacts, shapes, motions, context);
    r.forceLawFaults = accelerate(motions, bodies, forces, time);

    // Who might touch.
    sweepBoxes(shapes, motions, context, boxes);
    sweepPairs(boxes, pairs, sweepScratch);
    begins.clear();
    ends.swap(endsOfDestroyed);
    endsOfDestroyed.clear();
    const ContactWorld world = contactWorld();
    matchPairs(world, pairs, contacts.rows, [&](const Contact& contact) {
        if (contact.touching) ends.push_back(touchEvent(contact));
    });
    r.times.pairs = watch.lap();

    // How.
    paths.begin(motions.rows.size(), static_cast<real>(dt), context.invH);
    for (std::size_t first = 0; first < contacts.rows.size(); first += kPairBatch) {
        const std::size_t count = minimum(kPairBatch, contacts.rows.size() - first);
        const std::span<Contact> batch(contacts.rows.data() + first, count);
        updateForStep(batch, shapes, motions, context, paths, r.clamps);
        for (Contact& contact : batch) {
            prepareContact(contact, motions.rows[contact.rowA], motions.rows[contact.rowB]);
            r.sweptPairs += contact.swept ? 1 : 0;
        }
    }
    r.times.manifolds = watch.lap();

    // Who must be solved together, and who may be side by side.
    const std::vector<bool> movable = movableRows(motions);
    const Islands islands = linkTouching(contacts, motions, movable, context);
    markCrowds(contacts, movable, context.tuning);
    colorContacts(contacts, movable);
    r.times.graph = watch.lap();

    // Move.
    impacts.clear();
    SolverStage stage{world, forces, islands, motions, contacts, boxes, impacts, solverScratch};
    const SolverCounts counts = solve(stage, context);
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
    const FinalCounts final = finalize(motions, contacts, shapes, bodies, context);
    r.nonFinite = final.nonFinite;
    r.clamps.position = final.stopped;
    r.deepestOverlap = final.deepestOverlap;
    const auto byShapes = [](const auto& a, const auto& b) {
        return a.shapeA != b.shapeA ? a.shapeA < b.shapeA : a.shapeB < b.shapeB;
    };
    if (r.repaired > 0) std::sort(contacts.rows.begin(), contacts.rows.end(), byShapes);
    for (Contact& contact : contacts.rows) {
        const bool touches = isTouching(contact, context.tuning);
        if (touches && !contact.touching) begins.push_back(touchEvent(contact));
        if (!touches && contact.touching) ends.push_back(touchEvent(contact));
        contact.touching = touches;
        r.touching += touches ? 1 : 0;
    }
    std::sort(begins.begin(), begins.end(), byShapes);
    std::sort(ends.begin(), ends.end(), byShapes);
    hits.clear();
    std::sort(impacts.begin(), impacts.end(), [](const ImpactRecord& a, const ImpactRecord& b) {
        if (a.hit.time != b.hit.time) return a.hit.time < b.hit.time;
        if (a.shapeA != b.shapeA) return a.shapeA < b.shapeA;
        return a.shapeB != b.shapeB ? a.shapeB < b.shapeB : a.number < b.number;
    });
    for (const ImpactRecord& record : impacts) {
        HitEvent hit = record.hit;
        hit.shapeA = shapes.ids.id(record.shapeA);
        hit.shapeB = shapes.ids.id(record.shapeB);
        hit.bodyA = bodies.ids.id(shapes.rows[record.shapeA].body);
        hit.bodyB = bodies.ids.id(shapes.rows[record.shapeB].body);
        hits.push_back(hit);
    }

    // Report.
    time += dt;
    ++steps;
    r.bodies = static_cast<std::uint32_t>(motions.rows.size());
    for (const Motion& m : motions.rows) r.dynamicBodies += bodies.rows[m.body].isDynamic() ? 1 : 0;
    r.shapes = static_cast<std::uint32_t>(boxes.size());
    r.pairs = static_cast<std::uint32_t>(contacts.rows.size());
    r.impacts = static_cast<std::uint32_t>(impacts.size());
    r.islands = islands.count();
    r.times.finalize = watch.lap();
    r.times.total = whole.lap();
    return r;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
