// SPDX-License-Identifier: MIT
// Where bodies are expected to go, and the boxes that hold their shapes all along. What hardly moves keeps
// its boxes, and with them its pairs; what hardly turns its manifolds with what moves along with it.

#include "contacts/step_manifolds.hpp"
#include "contacts/update.hpp"
#include "world/impl.hpp"

#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Parts of the width of a body: how far its points may go before its boxes are made anew. What moves on
// leaves its boxes anyway, but should not leave the way they are for at each touch: found by counting
// instructions.
constexpr real kBoxRoom = real(0.005), kMovingRoom = real(0.02);

// By how much any of its points may go on by turning before its manifolds are found anew.   [m]
real turnRoom(real width, const StepContext& context)
{
    return kManifoldRoom * context.tuning.restGap * width;
}

}  // namespace

// Something about the body has changed that its boxes and manifolds come from.
void World::Impl::forgetKept(const BodyRow& body)
{
    references.forget(body.mover);
    pairsAreCurrent = false;
}

// Where the bodies of some rows go.
void World::Impl::expectWays(std::size_t begin, std::size_t end, const StepContext& context)
{
    const BodyRows rows{motions.rows.data(), solverScratch.rows, static_cast<std::uint32_t>(begin),
                        static_cast<std::uint32_t>(end)};
    solverScratch.bodiesFor(motions.rows.size()).expect(rows, motions.centers.data(), context);
}

// One body: its boxes, from `next` on, which hold those of the step before. Returns whether any of them is
// another one.
bool World::Impl::sweepBody(std::size_t row, const StepContext& context, SweepBox* next)
{
    const Motion& m = motions.rows[row];
    const BodyRow& body = bodies.rows[m.body];
    ReferencePoses::Row& known = references.rows[body.mover];
    const auto [turn, travel, freeTravel] = solverScratch.rows.travels[row];
    motions.centers[row].center = m.center;
    if (!known.ofManifolds.holds(m, turn)) {
        known.width = shapes.widthOf(body);
        known.ofManifolds.renew(m, turnRoom(known.width, context));
    }
    motions.versions[row] = known.ofManifolds.version;
    motions.slow[row] = freeTravel <= context.tuning.quiet * context.tuning.restGap * known.width ? 1 : 0;

    const bool moves = m.moves() || m.velocity != Vec2{} || m.spin != 0;
    bool keeps = known.ofBoxes.holds(m, travel);
    std::size_t k = 0;
    for (const std::uint32_t slot : shapes.of(body)) {
        if (!keeps) break;
        keeps = next[k].shape == slot && next[k].body == m.body && next[k].moves == moves;
        ++k;
    }
    motions.rooms[row] = 0;
    motions.origins[row] = keeps ? known.ofBoxes.center : m.center;
    if (keeps) return false;

    const real room = (travel < kBoxRoom / 2 * known.width ? kBoxRoom : kMovingRoom) * known.width;
    motions.rooms[row] = room;
    const Trajectory& path = paths.reckon(row, m, true);
    for (const std::uint32_t slot : shapes.of(body)) {
        const Convex& convex = shapes.convex(slot);
        const real margin = 3 * context.tuning.restGap * convex.size + room;
        *next++ = {sweptBounds(convex, path, m.center, 0, static_cast<real>(context.dt), margin), slot,
                   m.body, moves};
    }
    known.ofBoxes.renew(m, room);
    return true;
}

// One that holds still, which has no boxes here.
void World::Impl::sweepStill(std::size_t row, const StepContext& context)
{
    const Motion& m = motions.rows[row];
    BodyRow& body = bodies.rows[m.body];
    bodies.moverFor(body);  // a ground that is met for the first time has none yet
    references.rows.resize(bodies.movers.slots());
    ReferenceTurn& turn = references.rows[body.mover].ofManifolds;
    if (!turn.holds(m, solverScratch.rows.travels[row].turn))
        turn.renew(m, turnRoom(shapes.widthOf(body), context));
    motions.versions[row] = turn.version;
    motions.centers[row].center = m.center;
    motions.origins[row] = m.center;
}

// All that take part in the step. Returns whether any box is another one than in the step before.
bool World::Impl::sweepBodies(const StepContext& context)
{
    constexpr std::size_t kGrain = 64;
    references.rows.resize(bodies.movers.slots());
    motions.versions.resize(motions.rows.size());
    motions.origins.resize(motions.rows.size());
    motions.centers.resize(motions.rows.size());
    motions.rooms.assign(motions.rows.size(), 0);
    motions.slow.assign(motions.rows.size(), 0);
    solverScratch.rows.travels.resize(motions.rows.size());

    // By chunk: how many boxes, then where they begin.
    std::vector<std::uint32_t>& firstOf = chunkStarts;
    firstOf.assign(Parallel::chunksOf(motions.parts, kGrain), 0);
    const auto countOf = [&](std::size_t row) { return bodies.rows[motions.rows[row].body].shapes.count; };
    parallel.forEach(motions.parts, kGrain, [&](const Chunk& chunk) {
        std::size_t count = 0;
        for (std::size_t row = chunk.begin; row < chunk.end; ++row) count += countOf(row);
        firstOf[chunk.index] = static_cast<std::uint32_t>(count);
    });
    std::uint32_t start = 0;
    for (std::uint32_t& count : firstOf) count = (start += count) - count;

    std::atomic<bool> changed = boxes.size() != start;
    boxes.resize(start);
    paths.begin(motions.rows.size(), static_cast<real>(context.dt), context.invH);
    parallel.forEach(motions.parts, kGrain, [&](const Chunk& chunk) {
        expectWays(chunk.begin, chunk.end, context);
        SweepBox* next = boxes.data() + firstOf[chunk.index];
        for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
            if (sweepBody(row, context, next)) changed.store(true, std::memory_order_relaxed);
            next += countOf(row);
        }
    });
    return changed;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
