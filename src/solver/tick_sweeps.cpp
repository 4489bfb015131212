// SPDX-License-Identifier: MIT
// Pairs that may meet in another way than the step was planned for: they are looked at again in every tick,
// unless the strip that lies between them says that they cannot meet. docs/theory/contacts.md, section 3.

#include "solver/tick_sweeps.hpp"

#include "base/room.hpp"
#include "contacts/update.hpp"
#include "math/lane_rows.hpp"

#include <cstddef>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

using Wide = Lane<kLanes>;

// Some swept pairs, one a lane; beyond the last one stand copies of it.
struct PairRun {
    std::uint32_t at[kLanes], rowA[kLanes], rowB[kLanes];
    FourLanes<kLanes> apart;        // PairRow: the axis, the gap along it, near
    FourLanes<kLanes> wayA, wayB;   // Way: shift, turn, turning

    PairRun(const ImpactScratch& scratch, const Table<Way>& ways, std::size_t first, std::size_t end)
    {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            at[lane] = scratch.swept[minimum(first + lane, end - 1)];
            rowA[lane] = scratch.pairs[at[lane]].rowA;
            rowB[lane] = scratch.pairs[at[lane]].rowB;
        }
        apart =
            gatherRows<kLanes>(groups<const std::byte>(scratch.pairs.data(), offsetof(PairRow, apart), at));
        wayA = gatherRows<kLanes>(groups<const std::byte>(ways.data(), offsetof(Way, shift), rowA));
        wayB = gatherRows<kLanes>(groups<const std::byte>(ways.data(), offsetof(Way, shift), rowB));
    }

    // Takes from how pairs are apart what their bodies went in the last tick.
    void keepApart(Table<PairRow>& pairs)
    {
        const Wide shiftX = wayB.x - wayA.x, shiftY = wayB.y - wayA.y;
        const Wide rounding = Wide(real(0.001)) * (absolute(shiftX) + absolute(shiftY) + apart.w);
        apart.z += apart.x * shiftX + apart.y * shiftY - Wide(real(1.001)) * (wayA.z + wayB.z) - rounding;
        scatterRows<kLanes>(apart, groups<std::byte>(pairs.data(), offsetof(PairRow, apart), at), ~0u);
    }

    // Those that stay apart in a tick through which bodies go so fast: rates are linear in time.
    std::uint32_t farAt(const Table<LaneRow>& spans, Wide h) const
    {
        const FourLanes<kLanes> a = gatherRows<kLanes>(spans.data(), rowA),
                                b = gatherRows<kLanes>(spans.data(), rowB);
        const Wide first = apart.x * (b.x - a.x) + apart.y * (b.y - a.y);
        const Wide last = apart.x * (b.z - a.z) + apart.y * (b.w - a.w);
        const Wide slowest = minimum(first, last);  // of B against A along the axis   [m/s]
        const Wide travel = h * (maximum(-slowest, Wide(real(0))) + (wayA.w + wayB.w));
        return bitsOf(apart.z - Wide(real(1.001)) * travel > apart.w);
    }

private:
    template <class Byte, class Row>
    static ScatteredRows<Byte> groups(Row* rows, std::size_t offset, const std::uint32_t* numbers)
    {
        return {reinterpret_cast<Byte*>(rows) + offset, sizeof(Row), numbers};
    }
};
static_assert(offsetof(PairRow, near) == offsetof(PairRow, apart) + 3 * sizeof(real));

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

void startSweeps(ImpactStage& stage, const std::vector<std::uint8_t>* renewed)
{
    ImpactScratch& scratch = stage.scratch;
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
    scratch.woken.reserve(stage.motions.rows.capacity());
    scratch.wokenContacts.reserve(room);
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

void predictWay(ImpactStage& stage, std::uint32_t row, const StepContext& context)
{
    const Motion& m = stage.motions.rows[row];
    const LaneRow& pose = stage.rows.poses[row];
    const Trajectory path = predictedPath(m, m.center, context.invH);
    // What holds still leaves no box.
    const real least = m.moves() ? stage.world.shapes.widthOf(stage.world.bodies.rows[m.body])
                                 : std::numeric_limits<real>::max();
    stage.rows.predicted[row] = {path.velocity,
                                 path.spin,
                                 slackOf(least, context) + stage.motions.rooms[row],
                                 path.acceleration,
                                 path.spinRate,
                                 0,
                                 {pose.x, pose.y},
                                 m.moves() ? least : real(0)};
}

void predictWays(ImpactStage& stage, const StepContext& context)
{
    const auto rows = static_cast<std::uint32_t>(stage.motions.rows.size());
    stage.rows.predicted.resize(rows);
    for (std::uint32_t row = 0; row < rows; ++row)
        if (!stage.visited.isQuiet(row)) predictWay(stage, row, context);
}

void sweepFromNowOn(ImpactStage& stage, std::uint32_t contact)
{
    PairRow& pair = stage.scratch.pairs[contact];
    if (pair.swept) return;
    pair.swept = stage.contacts.rows[contact].swept = true;
    stage.scratch.swept.push_back(contact);
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
        for (std::size_t first = chunk.begin; first < chunk.end; first += kLanes) {
            PairRun run(scratch, ways, first, chunk.end);
            run.keepApart(scratch.pairs);
            const std::uint32_t far = run.farAt(spans, Wide(context.h));
            for (std::size_t k = first; k < minimum(first + kLanes, chunk.end); ++k) {
                const std::uint32_t i = scratch.swept[k];
                const bool isFar = (far >> (k - first) & 1u) != 0;
                const bool hasPoints = isFar && stage.passes.holds(i) && stage.contacts.rows[i].count > 0;
                scratch.verdicts[k] = !isFar ? Near : hasPoints ? Parts : Far;
            }
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
    ImpactScratch& scratch = stage.scratch;
    for (std::size_t first = 0; first < scratch.swept.size(); first += kLanes) {
        PairRun run(scratch, stage.rows.ways, first, scratch.swept.size());
        run.keepApart(scratch.pairs);
    }
    for (const std::uint32_t i : scratch.swept) stage.contacts.rows[i].apart = scratch.pairs[i].apart;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
