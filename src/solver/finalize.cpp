// SPDX-License-Identifier: MIT
#include "solver/finalize.hpp"

#include "contacts/rows.hpp"
#include "contacts/step_manifolds.hpp"
#include "contacts/update.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

bool isNumber(const Motion& m)
{
    return isFinite(m.center) && std::isfinite(m.angle) && isFinite(m.velocity) && std::isfinite(m.spin);
}

// Holds the body at the edge of the world, without the speed that led there.
bool stopAtEdge(Motion& m, real lengthUnit)
{
    const double most = kMaxPosition * static_cast<double>(lengthUnit);
    const Position inside{clamp(m.center.x, -most, most), clamp(m.center.y, -most, most)};
    if (inside == m.center) return false;
    if (inside.x != m.center.x) m.velocity.x = 0;
    if (inside.y != m.center.y) m.velocity.y = 0;
    m.center = inside;
    return true;
}

// Returns whether it is where the solver has left it.
bool finalizeBody(Motion& m, BodyTable& bodies, const StepContext& context, FinalCounts& counts)
{
    BodyRow& b = bodies.rows[m.body];
    remember(bodies, m.body);
    if (!isNumber(m)) {
        b.velocity = {};
        b.spin = 0;
        b.enabled = false;
        m.center = b.center;
        m.angle = b.angle;
        m.rotation = b.rotation;
        ++counts.nonFinite;
        return false;
    }
    const bool stops = stopAtEdge(m, context.lengthUnit);
    counts.stopped += stops ? 1 : 0;
    b.center = m.center;
    b.angle = m.angle;
    b.rotation = m.rotation;
    b.velocity = m.velocity;
    b.spin = m.spin;
    return !stops;
}

// Where the contact is now. A swept pair's manifold may be stale by now: its nearest features are looked up
// again, so that touching and separation are those of the final poses.
void finalizeContact(Contact& c, const Motion& a, const Motion& b, const ShapeTable& shapes,
                     const StepContext& context, FinalCounts& counts)
{
    if (c.swept) {
        const SweptPair pair = sweptPairOf(c, shapes, a, b, context.invH);
        SweptResult nearest;
        if (c.apart.gap <= 3 * c.restGap) nearest = nearestAt(pair, 0);
        adoptManifold(c, nearest, real(0.3) * maximum(pair.a.size, pair.b.size));
    }
    placeContact(c, a, b);
    for (int i = 0; i < c.count; ++i) {
        const double overlap = -static_cast<double>(c.points[i].gap + c.restGap);
        if (overlap > counts.deepestOverlap) counts.deepestOverlap = overlap;
    }
}

FinalCounts sumOf(const std::vector<FinalCounts>& ofChunks)
{
    FinalCounts sum;
    for (const FinalCounts& counts : ofChunks) {
        sum.nonFinite += counts.nonFinite;
        sum.stopped += counts.stopped;
        sum.touching += counts.touching;
        sum.deepestOverlap = maximum(sum.deepestOverlap, counts.deepestOverlap);
    }
    return sum;
}

}  // namespace

void remember(BodyTable& bodies, std::uint32_t slot)
{
    const BodyRow& b = bodies.rows[slot];
    if (b.mover == BodyRow::kNone) return;
    bodies.rememberPose(b);
    MoverRow& mover = bodies.movers[b.mover];
    mover.stepForce = {};
    mover.stepTorque = 0;
}

FinalCounts finalize(SolverScratch& solver, MotionTable& motions, ContactTable& contacts,
                     const ShapeTable& shapes, BodyTable& bodies, const StepContext& context,
                     FinalScratch& scratch, Parallel& parallel)
{
    constexpr std::size_t kBodies = 256, kContacts = 128;
    std::vector<FinalCounts>& ofChunks = scratch.ofChunks;
    ofChunks.assign(Parallel::chunksOf(motions.rows.size(), kBodies), {});
    parallel.forEach(motions.rows.size(), kBodies, [&](const Chunk& chunk) {
        for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
            Motion& m = motions.rows[row];
            if (bodies.rows[m.body].takesPart && !finalizeBody(m, bodies, context, ofChunks[chunk.index]))
                solver.rows.poses[row] = poseRow(m, solver.rows.origins[row].center);
        }
    });
    FinalCounts counts = sumOf(ofChunks);

    // Contacts: those in lanes stay there, and the table of all, the largest there is, stays closed.
    const std::size_t count = contacts.rows.size();
    contacts.facts.resize(count);
    contacts.nearness.resize(count);
    contacts.loads.reserve(contacts.rows.capacity());
    contacts.loads.resize(count);
    const ContactEndCounts ofLanes = solver.passes.conclude(solver.rows, context, contacts, scratch.changed);
    for (const std::uint32_t i : scratch.changed) contacts.rows[i].touching = !contacts.rows[i].touching;

    ofChunks.assign(Parallel::chunksOf(count, kContacts), {});
    scratch.changedLoose.begin(ofChunks.size());
    parallel.forEach(count, kContacts, [&](const Chunk& chunk) {
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
            if (solver.passes.isInLane(static_cast<std::uint32_t>(i))) continue;
            Contact& c = contacts.rows[i];
            FinalCounts& ofChunk = ofChunks[chunk.index];
            finalizeContact(c, motions.rows[c.rowA], motions.rows[c.rowB], shapes, context, ofChunk);
            noteFacts(contacts, i, context.tuning);
            contacts.loads[i] = loadOf(c);
            const bool touches = isTouching(c, context.tuning);
            ofChunk.touching += touches ? 1 : 0;
            if (touches != c.touching)
                scratch.changedLoose.of(chunk.index).push_back(static_cast<std::uint32_t>(i));
            c.touching = touches;
        }
    });
    scratch.changed.reserve(contacts.rows.capacity());
    scratch.changedLoose.forAll([&](std::uint32_t i) { scratch.changed.push_back(i); });
    const FinalCounts ofLoose = sumOf(ofChunks);
    counts.deepestOverlap = maximum(ofLoose.deepestOverlap, static_cast<double>(ofLanes.deepest));
    counts.touching = ofLoose.touching + ofLanes.touching;
    return counts;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
