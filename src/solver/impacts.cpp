// SPDX-License-Identifier: MIT
// Impacts in the order of their times: the earliest acts, and all contacts of its two bodies look again.
// docs/theory/contacts.md, section 3.

#include "solver/impacts.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "solver/impact_pairs.hpp"
#include "solver/impact_response.hpp"
#include "solver/tick_sweeps.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

class ImpactSolver {
public:
    ImpactSolver(ImpactStage& stage, const StepContext& context, int tick);
    void run(const std::vector<std::uint32_t>& approaching);

private:
    ImpactStage& stage_;
    const StepContext& context_;
    ImpactScratch& scratch_;
    const real tickStart_;                   // within the step   [s]
    ImpactResponse response_;
    WayPairs ways_;

    Contact& contact(std::uint32_t i) { return stage_.contacts.rows[i]; }
    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }
    PairRow& pairRow(std::uint32_t i) { return scratch_.pairs[i]; }
    const Flight& flight(std::uint32_t row) { return scratch_.flights[row]; }
    FlyingPair pairOf(const Contact& c) const { return response_.pairOf(c); }

    void trackFlight(std::uint32_t row);
    void trackPair(std::uint32_t i);
    Contact& loosen(std::uint32_t i);
    void placePoints(std::uint32_t i);
    void schedule(std::uint32_t i);
    bool turnsOn(std::uint32_t i);
    bool isLoaded(std::uint32_t i);
    bool staysFar(const PairRow& pair);
    void adopt(std::uint32_t i, const SweptResult& result);
    void resweep(std::uint32_t i, bool own);
    void sweepOn(std::uint32_t i);
    void lookAgain(std::uint32_t i);
    void follow(std::uint32_t row, std::uint32_t hit);
    void pairAgain(std::uint32_t row);
    void lookFarther(std::uint32_t row);
};

ImpactSolver::ImpactSolver(ImpactStage& stage, const StepContext& context, int tick)
    : stage_(stage), context_(context), scratch_(stage.scratch), tickStart_(timeOf(tick, context).start),
      response_(stage, context, stage.scratch.flights, tickStart_), ways_(stage, context, tickStart_)
{
    const std::size_t contacts = stage.contacts.rows.size();
    scratch_.flights.resize(stage.motions.rows.size());
    scratch_.flies.assign(stage.motions.rows.size(), 0);
    scratch_.points.resize(2 * contacts);
    for (PairRow& pair : scratch_.pairs) pair.placed = false, pair.version = 0, pair.farUntil = 0;
    scratch_.queue.clear();
    scratch_.queue.reserve(4 * contacts + 64);  // those that are found anew leave the old ones behind
}

// Nobody looks at the flight of a body before this.
void ImpactSolver::trackFlight(std::uint32_t row)
{
    if (scratch_.flies[row] != 0) return;
    scratch_.flies[row] = 1;
    scratch_.flights[row] = flightOf(motion(row), context_.invH);
}

void ImpactSolver::trackPair(std::uint32_t i)
{
    trackFlight(pairRow(i).rowA);
    trackFlight(pairRow(i).rowB);
}

Contact& ImpactSolver::loosen(std::uint32_t i)
{
    stage_.passes.loosen(i, stage_.contacts, stage_.motions);
    trackPair(i);
    return contact(i);
}

// As long as nothing happens to a contact it stays in its lane, which says what must be known of it.
void ImpactSolver::placePoints(std::uint32_t i)
{
    Contact& c = contact(i);
    ImpactPoint* const points = &scratch_.points[2 * std::size_t{i}];
    pairRow(i).placed = true;
    if (!stage_.passes.isInLane(i)) {
        for (int k = 0; k < c.count; ++k) points[k] = impactPoint(c, k, pairOf(c));
        return;
    }
    const LaneView view = stage_.passes.view(i);
    c.normal = view.normal;
    for (int k = 0; k < c.count; ++k) {
        const LaneView::Point& p = view.points[k];
        points[k] = isPlainPoint(c, k) ? ImpactPoint{view.normal, p.turnA, p.turnB, p.gap}
                                       : turnedImpactPoint(c, k, pairOf(c));
        points[k].yields = p.yields;
    }
}

void ImpactSolver::schedule(std::uint32_t i)
{
    const std::uint32_t version = ++pairRow(i).version;
    if (!stage_.passes.holds(i)) return;
    trackPair(i);
    if (!pairRow(i).placed) placePoints(i);
    const Contact& c = contact(i);
    const Impact impact = nextImpact(c, &scratch_.points[2 * std::size_t{i}], pairOf(c), context_);
    if (impact.time == kNever) return;
    scratch_.queue.push_back({impact, c.impacts, stage_.passes.placeOf(i), version});
    std::push_heap(scratch_.queue.begin(), scratch_.queue.end());
}

// Does either body turn so far in the time left that its corners leave their chords by what counts
// as overlap? Then the pair may meet at another corner.
bool ImpactSolver::turnsOn(std::uint32_t i)
{
    const Flight &a = flight(pairRow(i).rowA), &b = flight(pairRow(i).rowB);
    const real rest = context_.h - maximum(a.clock, b.clock);
    const auto sagitta = [rest](real spin, real extent) { return spin * rest * (spin * rest) / 8 * extent; };
    return sagitta(a.spin, a.extent) + sagitta(b.spin, b.extent) > contact(i).restGap / 2;
}

bool ImpactSolver::isLoaded(std::uint32_t i)
{
    if (!stage_.passes.holds(i)) return false;
    if (stage_.passes.isInLane(i)) return stage_.passes.view(i).isLoaded;
    const Contact& c = contact(i);
    for (int k = 0; k < c.count; ++k)
        if (c.points[k].normalImpulse > 0) return true;
    return false;
}

// Those of which that is known have had their bodies tracked.
bool ImpactSolver::staysFar(const PairRow& pair)
{
    return pair.farUntil > 0 && flight(pair.rowA).strayed + flight(pair.rowB).strayed < pair.farUntil;
}

void ImpactSolver::adopt(std::uint32_t i, const SweptResult& result)
{
    const bool isEmpty = !result.near || result.manifold.count == 0;
    if (isEmpty && (!stage_.passes.holds(i) || contact(i).count == 0)) return;
    Contact& c = loosen(i);
    adoptManifold(c, result, 0);
    if (c.count > 0) prepareContact(c, motion(c.rowA), motion(c.rowB));
    placePoints(i);
}

// A pair of a body that was hit: its way is another from then on. The pair that was hit itself is looked at
// again only if it turns on; loaded contacts keep their manifold.
void ImpactSolver::resweep(std::uint32_t i, bool own)
{
    if (isLoaded(i)) return;
    PairRow& pair = pairRow(i);
    sweepFromNowOn(stage_, i);
    const Flight &a = flight(pair.rowA), &b = flight(pair.rowB);
    const real start = maximum(a.clock, b.clock);
    if (!(start < context_.h) || (own && !turnsOn(i))) return;
    const Apart apart = apartAt(start, pair.apart, a, b);
    const real room = apart.gap - approachWithin(apart.axis, a, b, start, context_.h) - pair.near;
    const bool isFar = room > 0;
    pair.farUntil = 0;
    if (isFar) {
        pair.farUntil = a.strayed + b.strayed + room;
        adopt(i, {});
    } else {
        sweepOn(i);
    }
}

void ImpactSolver::sweepOn(std::uint32_t i)
{
    PairRow& pair = pairRow(i);
    const Contact& c = contact(i);
    const Flight &flightA = flight(pair.rowA), &flightB = flight(pair.rowB);
    const Motion &a = motion(pair.rowA), &b = motion(pair.rowB);
    const real start = maximum(flightA.clock, flightB.clock);
    const Position origin = originOf(a, b);
    const ShapeTable& shapes = stage_.world.shapes;
    const SweptPair swept{shapes.convex(c.shapeA), shapes.convex(c.shapeB),
                          pathOf(a, flightA, origin, context_.invH),
                          pathOf(b, flightB, origin, context_.invH), c.restGap};
    const SweptResult result = collideSwept(swept, start, context_.h);
    stage_.clamps.advancement += result.exhausted ? 1 : 0;
    pair.apart = apartBefore(start, result.apart, flightA, flightB);
    adopt(i, result);
}

// A great body has pairs with all that is around it: hit by a light one, it strays from its way by less than
// lies between it and most of them.
void ImpactSolver::lookAgain(std::uint32_t i)
{
    if (staysFar(pairRow(i))) return;
    trackPair(i);
    resweep(i, false);
    schedule(i);
}

void ImpactSolver::pairAgain(std::uint32_t row)
{
    for (const std::uint32_t i : ways_.pairAgain(row)) lookAgain(i);
}

// Pairs of a body on another way that were too far apart to meet on the old one.
void ImpactSolver::lookFarther(std::uint32_t row)
{
    const ContactChains& chains = scratch_.chains;
    for (std::uint32_t link = chains.first(row); link != ContactChains::kEnd; link = chains.next(link)) {
        const std::uint32_t i = ContactChains::contactOf(link);
        if (!pairRow(i).swept && !stage_.passes.holds(i)) lookAgain(i);
    }
}

// What the impact of a contact changes for a body of it: all its other contacts go another way.
void ImpactSolver::follow(std::uint32_t row, std::uint32_t hit)
{
    if (!motion(row).moves()) return;
    const ContactChains& chains = scratch_.chains;
    for (std::uint32_t link = chains.first(row); link != ContactChains::kEnd; link = chains.next(link)) {
        const std::uint32_t i = ContactChains::contactOf(link);
        if (i != hit) lookAgain(i);
    }
    pairAgain(row);
}

void ImpactSolver::run(const std::vector<std::uint32_t>& approaching)
{
    for (const std::uint32_t row : scratch_.strays) {
        connect(stage_);
        trackFlight(row);
        pairAgain(row);
        lookFarther(row);
    }
    for (const std::uint32_t i : approaching) schedule(i);
    while (!scratch_.queue.empty()) {
        std::pop_heap(scratch_.queue.begin(), scratch_.queue.end());
        const DueImpact due = scratch_.queue.back();
        scratch_.queue.pop_back();
        const std::uint32_t i = stage_.contacts.order[due.place];
        if (due.version != pairRow(i).version) continue;
        connect(stage_);
        scratch_.kicked = true;
        response_.act(loosen(i), due.impact);
        resweep(i, true);
        schedule(i);
        follow(pairRow(i).rowA, i);
        follow(pairRow(i).rowB, i);
    }
}

}  // namespace

void applyImpacts(ImpactStage& stage, const StepContext& context, int tick)
{
    const std::vector<std::uint32_t>& approaching =
        stage.passes.approaching(stage.rows, context, stage.scratch.fastest);
    if (approaching.empty() && stage.scratch.strays.empty()) return;
    ImpactSolver(stage, context, tick).run(approaching);
}

void startTick(ImpactStage& stage, const StepContext& context, int tick)
{
    Table<Motion>& motions = stage.motions.rows;
    ImpactScratch& scratch = stage.scratch;
    const TickTime time = timeOf(tick, context);
    scratch.tick = tick;
    scratch.strays.resize(motions.size());
    const std::vector<BodyChunk>& chunks = stage.visited.chunks(motions.size());
    scratch.starts.reserve(chunks.capacity());
    scratch.starts.resize(chunks.size());
    stage.parallel.forEach(chunks.size(), 1, [&](const Chunk& chunk) {
        const auto [begin, end] = chunks[chunk.begin];
        StrayList strays{scratch.strays.data() + begin, 0};
        const real fastest =
            stage.kernels.startTick({motions.data(), stage.rows, begin, end}, context, time, strays);
        scratch.starts[chunk.begin] = {fastest, strays.count};
    });

    scratch.fastest = 0;
    std::size_t strays = 0;
    for (std::size_t k = 0; k < scratch.starts.size(); ++k) {
        const auto [fastest, count] = scratch.starts[k];
        scratch.fastest = maximum(fastest, scratch.fastest);
        for (std::size_t i = 0; i < count; ++i)
            scratch.strays[strays++] = scratch.strays[chunks[k].begin + i];
    }
    scratch.strays.resize(strays);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
