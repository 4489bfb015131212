// SPDX-License-Identifier: MIT
// Pairs that may meet in another way than the step was planned for: they are looked at again in every tick,
// unless the strip that lies between them says that they cannot meet. docs/theory/contacts.md, section 3.

#include "solver/tick_sweeps.hpp"

#include "base/room.hpp"
#include "contacts/update.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Takes from how a pair is apart what its bodies went in the last tick.
void keepApart(PairRow& pair, const Table<Way>& ways)
{
    const Way &a = ways[pair.rowA], &b = ways[pair.rowB];
    const Vec2 shift = b.shift - a.shift;
    const real rounding = real(0.001) * (absolute(shift.x) + absolute(shift.y) + pair.near);
    pair.apart.gap += dot(pair.apart.axis, shift) - real(1.001) * (a.turn + b.turn) - rounding;
}

// The lowest speed of B against A along the axis in a tick: rates are linear in time.   [m/s]
real slowestAlong(Vec2 axis, const LaneRow& a, const LaneRow& b)
{
    const real first = axis.x * (b.x - a.x) + axis.y * (b.y - a.y);
    const real last = axis.x * (b.z - a.z) + axis.y * (b.w - a.w);
    return minimum(first, last);
}

}  // namespace

real slackOf(real width, const StepContext& context)
{
    return 2 * context.tuning.restGap * width;
}

PairRow pairRowOf(const Contact& c)
{
    const real near = real(3.01) * c.restGap;
    return {c.rowA, c.rowB, c.swept ? c.apart : Apart{}, near, c.swept, false, 0, 0};
}

void startSweeps(ImpactStage& stage, const StepContext& context, const std::vector<std::uint8_t>* renewed)
{
    ImpactScratch& scratch = stage.scratch;
    Table<PredictedWay>& predicted = stage.rows.predicted;
    predicted.clear();
    for (const Motion& m : stage.motions.rows) {
        const LaneRow& pose = stage.rows.poses[predicted.size()];
        const real room = stage.motions.rooms[predicted.size()];
        const Trajectory path = predictedPath(m, m.center, context.invH);
        // What holds still leaves no box.
        const real least = m.moves() ? stage.world.shapes.widthOf(stage.world.bodies.rows[m.body])
                                     : std::numeric_limits<real>::max();
        predicted.push_back({path.velocity,
                             path.spin,
                             slackOf(least, context) + room,
                             path.acceleration,
                             path.spinRate,
                             0,
                             {pose.x, pose.y},
                             m.moves() ? least : real(0)});
    }
    scratch.tree.clear();  // the boxes are new
    scratch.connected = false;
    const Table<Contact>& contacts = stage.contacts.rows;
    // With room for the contacts that are found in mid-step.
    const std::size_t room = contacts.capacity();
    stage.contacts.order.reserve(room);
    scratch.pairs.reserve(room);
    scratch.points.reserve(2 * room);
    scratch.swept.reserve(room);
    scratch.found.reserve(stage.boxes.size());
    scratch.pairs.resize(contacts.size());
    stage.parallel.forEach(contacts.size(), kContactGrain, [&](const Chunk& chunk) {
        for (std::size_t i = chunk.begin; i < chunk.end; ++i)
            if (renewed == nullptr || (*renewed)[i] != 0) scratch.pairs[i] = pairRowOf(contacts[i]);
    });
    scratch.swept.clear();
    for (std::uint32_t i = 0; i < contacts.size(); ++i)
        if (scratch.pairs[i].swept) scratch.swept.push_back(i);
    stage.rows.spans.resize(stage.motions.rows.size());
}

void resweepForTick(ImpactStage& stage, const StepContext& context)
{
    const Table<Way>& ways = stage.rows.ways;
    const Table<LaneRow>& spans = stage.rows.spans;
    const ShapeTable& shapes = stage.world.shapes;
    ImpactScratch& scratch = stage.scratch;

    if (scratch.swept.empty()) return;
    stage.visited.forEach(stage.parallel, stage.motions.rows, stage.rows,
                          [&](const BodyRows& bodies) { stage.kernels.boundSpeeds(bodies, context); });

    // Which of them may meet in this tick: the others are what the sweep would say without looking.
    enum Verdict : std::uint8_t { Far, Parts, Near };
    constexpr std::size_t kGrain = 256;
    scratch.verdicts.resize(scratch.swept.size());
    stage.parallel.forEach(scratch.swept.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            const std::uint32_t i = scratch.swept[k];
            PairRow& pair = scratch.pairs[i];
            keepApart(pair, ways);
            const real turning = ways[pair.rowA].turning + ways[pair.rowB].turning;
            const real slowest = slowestAlong(pair.apart.axis, spans[pair.rowA], spans[pair.rowB]);
            const real travel = context.h * (maximum(-slowest, real(0)) + turning);
            const bool far = pair.apart.gap - real(1.001) * travel > pair.near;
            const bool hasPoints = stage.passes.holds(i) && stage.contacts.rows[i].count > 0;
            scratch.verdicts[k] = !far ? Near : hasPoints ? Parts : Far;
        }
    });

    ExpectedPaths& paths = scratch.paths;
    paths.begin(stage.motions.rows.size(), context.h, context.invH);
    scratch.again.clear();
    for (std::size_t k = 0; k < scratch.swept.size(); ++k) {
        if (scratch.verdicts[k] == Far) continue;
        const std::uint32_t i = scratch.swept[k];
        Contact& c = stage.contacts.rows[i];
        stage.passes.take(i, stage.contacts);
        if (scratch.verdicts[k] == Parts) {
            adoptManifold(c, {}, 0);
            continue;
        }
        paths.want(c, shapes);
        scratch.again.push_back(i);
    }
    paths.reckonWanted(stage.motions, stage.parallel);

    const std::size_t again = scratch.again.size();
    scratch.exhausted.assign(Parallel::chunksOf(again, kPairBatch), 0);
    stage.parallel.forEach(again, kPairBatch, [&](const Chunk& chunk) {
        const std::size_t count = chunk.end - chunk.begin;
        Contact* batch[kPairBatch];
        for (std::size_t k = 0; k < count; ++k)
            batch[k] = &stage.contacts.rows[scratch.again[chunk.begin + k]];
        Room<SweptResult, kPairBatch> results;
        paths.collide({batch, count}, shapes, stage.motions, results.data());
        for (std::size_t k = 0; k < count; ++k) {
            Contact& c = *batch[k];
            const Convex &a = shapes.convex(c.shapeA), &b = shapes.convex(c.shapeB);
            scratch.exhausted[chunk.index] += results[k].exhausted ? 1 : 0;
            scratch.pairs[scratch.again[chunk.begin + k]].apart = results[k].apart;
            adoptManifold(c, results[k], real(0.3) * maximum(a.size, b.size));
        }
    });
    for (const std::uint32_t count : scratch.exhausted) stage.clamps.advancement += count;
}

void endSweeps(ImpactStage& stage)
{
    for (const std::uint32_t i : stage.scratch.swept) {
        PairRow& pair = stage.scratch.pairs[i];
        keepApart(pair, stage.rows.ways);
        stage.contacts.rows[i].apart = pair.apart;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
