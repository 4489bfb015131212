// SPDX-License-Identifier: MIT
// Impacts in the order of their times: the earliest acts, and all contacts of its two bodies look again.
// docs/theory/contacts.md, section 3.

#include "solver/impacts.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "solver/impact_response.hpp"
#include "solver/newcomers.hpp"

#include <algorithm>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Gap beyond which a pair gets no manifold, and a little for rounding.   [m]
real nearGap(const Contact& c)
{
    return real(3.01) * c.restGap;
}

// How far a body may leave the way that its boxes were made for: they hold a little more than it.   [m]
real slackOf(real width, const StepContext& context)
{
    return 2 * context.tuning.restGap * width;
}

// What a body that is paired again gets around it beyond that, as a part of its width.
constexpr real kRoom = real(0.05);

Aabb withRoom(const Aabb& box, double room)
{
    return {{box.lower.x - room, box.lower.y - room}, {box.upper.x + room, box.upper.y + room}};
}

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

    Contact& contact(std::uint32_t i) { return stage_.contacts.rows[i]; }
    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }
    FlyingPair pairOf(const Contact& c) const { return response_.pairOf(c); }

    void trackFlight(std::uint32_t row);
    Contact& loosen(std::uint32_t i);
    void connect();
    void chain(std::uint32_t i);
    void placePoints(std::uint32_t i);
    void schedule(std::uint32_t i);
    void follow(std::uint32_t row, std::uint32_t hit);
    Trajectory pathOf(std::uint32_t row, Position origin);
    bool turnsOn(const Contact& c, real rest);
    bool isFarFrom(real start, const Contact& c);
    void resweep(std::uint32_t i, bool own);
    void pairAgain(std::uint32_t row);
    void expectWay(std::uint32_t row, const Trajectory& path, real room);
    void pairWithMoving(std::uint32_t row, std::uint32_t shape, const Aabb& needed, const Aabb& roomy);
    bool pairWithResting(std::uint32_t row, std::uint32_t shape, const Aabb& needed, const Aabb& roomy,
                         real end);
    bool meetsSleeper(std::uint32_t row, std::uint32_t shape, std::uint32_t other, real end);
    void takeUp(std::uint32_t first);
    bool isKnown(std::uint32_t row, const ShapePair& pair);
    void add(const ShapePair& pair, bool meets);
};

ImpactSolver::ImpactSolver(ImpactStage& stage, const StepContext& context, int tick)
    : stage_(stage), context_(context), scratch_(stage.scratch),
      tickStart_(static_cast<real>(tick) * context.h),
      response_(stage, context, stage.scratch.flights, tickStart_)
{
    const std::size_t contacts = stage.contacts.rows.size();
    scratch_.flights.resize(stage.motions.rows.size());
    scratch_.flies.assign(stage.motions.rows.size(), 0);
    scratch_.points.resize(2 * contacts);
    scratch_.versions.assign(contacts, 0);
    scratch_.placed.assign(contacts, false);
    scratch_.queue.clear();
    scratch_.queue.reserve(4 * contacts + 64);  // those that are found anew leave the old ones behind
}

// Nobody looks at the flight of a body, or at a contact in its lane, before this.
void ImpactSolver::trackFlight(std::uint32_t row)
{
    if (scratch_.flies[row] != 0) return;
    scratch_.flies[row] = 1;
    scratch_.flights[row] = flightOf(motion(row), context_.invH);
}

Contact& ImpactSolver::loosen(std::uint32_t i)
{
    stage_.passes.loosen(i, stage_.contacts, stage_.motions);
    Contact& c = contact(i);
    trackFlight(c.rowA);
    trackFlight(c.rowB);
    return c;
}

void ImpactSolver::connect()
{
    if (scratch_.connected) return;
    scratch_.connected = true;
    scratch_.chains.reset(scratch_.flights.size());
    for (const std::uint32_t i : stage_.contacts.order) chain(i);
}

void ImpactSolver::chain(std::uint32_t i)
{
    const Contact& c = contact(i);
    if (motion(c.rowA).moves()) scratch_.chains.append(c.rowA, i, 0);
    if (motion(c.rowB).moves()) scratch_.chains.append(c.rowB, i, 1);
}

void ImpactSolver::placePoints(std::uint32_t i)
{
    const Contact& c = contact(i);
    scratch_.placed[i] = true;
    for (int k = 0; k < c.count; ++k)
        scratch_.points[2 * std::size_t{i} + static_cast<std::size_t>(k)] = impactPoint(c, k, pairOf(c));
}

void ImpactSolver::schedule(std::uint32_t i)
{
    const Contact& c = loosen(i);
    ++scratch_.versions[i];
    if (!scratch_.placed[i]) placePoints(i);
    const Impact impact = nextImpact(c, &scratch_.points[2 * std::size_t{i}], pairOf(c), context_);
    if (impact.time == kNever) return;
    scratch_.queue.push_back({impact, c.impacts, stage_.passes.placeOf(i), scratch_.versions[i]});
    std::push_heap(scratch_.queue.begin(), scratch_.queue.end());
}

Trajectory ImpactSolver::pathOf(std::uint32_t row, Position origin)
{
    const Flight& f = scratch_.flights[row];
    Trajectory path = predictedPath(motion(row), origin, context_.invH);
    path.position += f.offset;
    path.angle += static_cast<double>(f.turned);
    if (f.turned != 0) path.rotation = Rot::ofAngle(path.angle);
    path.velocity = f.velocity;
    path.spin = f.spin;
    return path;
}

// Does either body turn so far in the time left that its corners leave their chords by what counts
// as overlap? Then the pair may meet at another corner.
bool ImpactSolver::turnsOn(const Contact& c, real rest)
{
    const auto sagitta = [rest](real spin, real extent) { return spin * rest * (spin * rest) / 8 * extent; };
    return sagitta(scratch_.flights[c.rowA].spin, motion(c.rowA).extent) +
               sagitta(scratch_.flights[c.rowB].spin, motion(c.rowB).extent) >
           c.restGap / 2;
}

// Are the two too far apart at `start` to meet in the rest of the tick?
bool ImpactSolver::isFarFrom(real start, const Contact& c)
{
    const Flight &a = scratch_.flights[c.rowA], &b = scratch_.flights[c.rowB];
    const Motion &ma = motion(c.rowA), &mb = motion(c.rowB);
    const real went = length(b.shiftAt(start) - a.shiftAt(start)) + ma.extent * absolute(a.turnAt(start)) +
                      mb.extent * absolute(b.turnAt(start));
    const real travel = travelWithin(a, ma, b, mb, context_.h);
    return c.clearance - real(1.001) * went - travel > nearGap(c);
}

// A pair of a body that was hit: its way is another from then on. The pair that was hit itself is
// looked at again only if it turns on; loaded contacts keep their manifold.
void ImpactSolver::resweep(std::uint32_t i, bool own)
{
    Contact& c = loosen(i);
    const real start = pairOf(c).start();
    for (int k = 0; k < c.count; ++k)
        if (c.points[k].normalImpulse > 0) return;
    if (!c.swept) {
        c.clearance = -std::numeric_limits<real>::max();  // not known
        scratch_.swept.push_back(i);
    }
    c.swept = true;
    if (!(start < context_.h) || (own && !turnsOn(c, context_.h - start))) return;
    if (isFarFrom(start, c)) {
        adoptManifold(c, {}, 0);
        placePoints(i);
        return;
    }

    SweptPair pair = sweptPairOf(c, stage_.world.shapes, motion(c.rowA), motion(c.rowB), context_.invH);
    const Position origin = originOf(motion(c.rowA), motion(c.rowB));
    pair.pathA = pathOf(c.rowA, origin);
    pair.pathB = pathOf(c.rowB, origin);
    const SweptResult result = collideSwept(pair, start, context_.h);
    stage_.clamps.advancement += result.exhausted ? 1 : 0;
    adoptManifold(c, result, 0);
    prepareContact(c, motion(c.rowA), motion(c.rowB));
    placePoints(i);
}

// Makes room for the contacts from number `first` on, which have just come in, and takes them up.
void ImpactSolver::takeUp(std::uint32_t first)
{
    const auto count = static_cast<std::uint32_t>(stage_.contacts.rows.size());
    scratch_.points.resize(2 * std::size_t{count});
    scratch_.versions.resize(count, 0);
    scratch_.placed.resize(count, false);
    for (std::uint32_t i = first; i < count; ++i) {
        if (contact(i).swept) scratch_.swept.push_back(i);
        chain(i);
    }
}

// Those that do not meet as they are expected to go are looked at when the next tick begins.
void ImpactSolver::add(const ShapePair& pair, bool meets)
{
    const auto i = static_cast<std::uint32_t>(stage_.contacts.rows.size());
    Contact added = makeContact(stage_.world, pair);
    added.swept = true;
    stage_.contacts.order.push_back(i);
    stage_.contacts.rows.push_back(added);
    ++stage_.repaired;
    takeUp(i);
    if (!meets) return;
    resweep(i, false);
    schedule(i);
}

// A body thrown out of the box it was paired in is paired again, at once: in one with some room around its
// new way, as what has been turned once is soon turned again.
void ImpactSolver::pairAgain(std::uint32_t row)
{
    const std::uint32_t body = motion(row).body;
    const Position center = motion(row).center;
    const Trajectory path = pathOf(row, center);
    const real end = static_cast<real>(context_.dt) - tickStart_;
    const real room = kRoom * stage_.rows.predicted[row].width;
    bool hasRoom = true;

    for (const std::uint32_t shape : stage_.world.shapes.of(stage_.world.bodies.rows[body])) {
        const Convex& convex = stage_.world.shapes.convex(shape);
        const real margin = 3 * stage_.world.restGap * convex.size;
        const Aabb needed = sweptBounds(convex, path, center, scratch_.flights[row].clock, end, margin);
        const Aabb roomy = withRoom(needed, static_cast<double>(room));
        if (!scratch_.tree.isBuilt()) scratch_.tree.build(stage_.boxes, stage_.world.shapes.rows.size());
        const SweepBox* own = scratch_.tree.boxOf(shape);
        const bool left = own == nullptr || !contains(own->box, needed);
        hasRoom = hasRoom && (left || contains(own->box, roomy));
        if (left) pairWithMoving(row, shape, needed, roomy);
        if (left || !stage_.asleep.isEmpty())
            hasRoom = pairWithResting(row, shape, needed, roomy, end) && hasRoom;
    }
    expectWay(row, path, hasRoom ? room : real(0));
}

// From now on the body is expected to go along `path`, within `room` [m].
void ImpactSolver::expectWay(std::uint32_t row, const Trajectory& path, real room)
{
    PredictedWay& way = stage_.rows.predicted[row];
    if (!(way.width > 0)) return;
    const LaneRow& pose = stage_.rows.poses[row];
    const real t = tickStart_;
    way.acceleration = path.acceleration;
    way.spinRate = path.spinRate;
    way.velocity = path.velocity - t * path.acceleration;
    way.spin = path.spin - t * path.spinRate;
    way.offset = Vec2{pose.x, pose.y} + path.position - t * way.velocity - (t * t / 2) * way.acceleration;
    way.strayed = 0;
    way.slack = slackOf(way.width, context_) + room;
}

void ImpactSolver::pairWithMoving(std::uint32_t row, std::uint32_t shape, const Aabb& needed,
                                  const Aabb& roomy)
{
    scratch_.tree.overlapping(roomy, motion(row).body, scratch_.found);
    if (scratch_.tree.boxOf(shape) != nullptr) scratch_.tree.grow(shape, roomy);
    for (const std::uint32_t k : scratch_.found) {
        const std::uint32_t other = stage_.boxes[k].shape;
        const ShapePair pair{minimum(shape, other), maximum(shape, other)};
        if (mayCollide(stage_.world, pair) && !isKnown(row, pair))
            add(pair, overlaps(needed, stage_.boxes[k].box));
    }
}

// What holds still may have no row yet; what sleeps comes in if it is met.
// Returns whether nothing sleeps in that room: what is not met keeps sleeping, and is looked at again as soon
// as the way changes.
bool ImpactSolver::pairWithResting(std::uint32_t row, std::uint32_t shape, const Aabb& needed,
                                   const Aabb& roomy, real end)
{
    scratch_.found.clear();
    stage_.resting.eachOverlapping(roomy, [&](std::uint32_t other) {
        if (overlaps(roomy, restingBounds(stage_.world, other))) scratch_.found.push_back(other);
    });
    std::sort(scratch_.found.begin(), scratch_.found.end());
    bool nobodySleeps = true;
    for (const std::uint32_t other : scratch_.found) {
        const ShapePair pair{minimum(shape, other), maximum(shape, other)};
        const std::uint32_t body = stage_.world.shapes.rows[other].body;
        if (body == motion(row).body || !mayCollide(stage_.world, pair)) continue;
        const BodyRow& b = stage_.world.bodies.rows[body];
        if (stage_.motions.rowOf[body] == MotionTable::kNone) {
            if (b.isAsleep()) {
                nobodySleeps = false;
                if (!meetsSleeper(row, shape, other, end)) continue;
                const auto first = static_cast<std::uint32_t>(stage_.contacts.rows.size());
                rouse(stage_, b.group, context_, context_.time + static_cast<double>(tickStart_));
                scratch_.chains.grow(stage_.motions.rows.size());
                takeUp(first);
            } else {
                enter(stage_, body, context_);
                scratch_.chains.grow(stage_.motions.rows.size());
            }
        }
        if (!isKnown(row, pair)) add(pair, overlaps(needed, restingBounds(stage_.world, other)));
    }
    return nobodySleeps;
}

bool ImpactSolver::meetsSleeper(std::uint32_t row, std::uint32_t shape, std::uint32_t other, real end)
{
    const std::uint32_t body = stage_.world.shapes.rows[other].body;
    const Convex& convex = stage_.world.shapes.convex(other);
    const Motion& m = motion(row);
    const Motion still = motionOf(stage_.world.bodies, body);
    const Position origin = originOf(m, still);
    const real restGap = stage_.world.restGap * minimum(stage_.world.shapes.convex(shape).size, convex.size);
    const SweptPair pair{stage_.world.shapes.convex(shape), convex, pathOf(row, origin),
                         predictedPath(still, origin, context_.invH), restGap};
    return mayMeet(pair, scratch_.flights[row].clock, end, context_);
}

bool ImpactSolver::isKnown(std::uint32_t row, const ShapePair& pair)
{
    const ContactChains& chains = scratch_.chains;
    for (std::uint32_t link = chains.first(row); link != ContactChains::kEnd; link = chains.next(link)) {
        const Contact& c = contact(ContactChains::contactOf(link));
        if (c.shapeA == pair.a && c.shapeB == pair.b) return true;
    }
    return false;
}

// What the impact of a contact changes for a body of it: all its other contacts go another way.
void ImpactSolver::follow(std::uint32_t row, std::uint32_t hit)
{
    if (!motion(row).moves()) return;
    const ContactChains& chains = scratch_.chains;
    for (std::uint32_t link = chains.first(row); link != ContactChains::kEnd; link = chains.next(link)) {
        const std::uint32_t i = ContactChains::contactOf(link);
        if (i == hit) continue;
        resweep(i, false);
        schedule(i);
    }
    pairAgain(row);
}

void ImpactSolver::run(const std::vector<std::uint32_t>& approaching)
{
    for (const std::uint32_t row : scratch_.strays) {
        connect();
        trackFlight(row);
        pairAgain(row);
    }
    for (const std::uint32_t i : approaching) schedule(i);
    while (!scratch_.queue.empty()) {
        std::pop_heap(scratch_.queue.begin(), scratch_.queue.end());
        const DueImpact due = scratch_.queue.back();
        scratch_.queue.pop_back();
        const std::uint32_t i = stage_.contacts.order[due.place];
        if (due.version != scratch_.versions[i]) continue;
        connect();
        scratch_.kicked = true;
        response_.act(contact(i), due.impact);
        resweep(i, true);
        schedule(i);
        follow(contact(i).rowA, i);
        follow(contact(i).rowB, i);
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

void keepClearance(Contact& c, const std::vector<Way>& ways)
{
    const Way &a = ways[c.rowA], &b = ways[c.rowB];
    c.clearance -= real(1.001) * (length(b.shift - a.shift) + a.turn + b.turn) + real(0.01) * c.restGap;
}

void startSweeps(ImpactStage& stage, const StepContext& context)
{
    ImpactScratch& scratch = stage.scratch;
    std::vector<PredictedWay>& predicted = stage.rows.predicted;
    predicted.clear();
    for (const Motion& m : stage.motions.rows) {
        const LaneRow& pose = stage.rows.poses[predicted.size()];
        const Trajectory path = predictedPath(m, m.center, context.invH);
        real least = std::numeric_limits<real>::max();
        if (m.moves()) {  // what holds still leaves no box
            for (const std::uint32_t shape : stage.world.shapes.of(stage.world.bodies.rows[m.body]))
                least = minimum(least, stage.world.shapes.convex(shape).size);
        }
        predicted.push_back({path.velocity,
                             path.spin,
                             slackOf(least, context),
                             path.acceleration,
                             path.spinRate,
                             0,
                             {pose.x, pose.y},
                             m.moves() ? least : real(0)});
    }
    scratch.tree.clear();  // the boxes are new
    scratch.connected = false;
    scratch.swept.clear();
    for (std::uint32_t i = 0; i < stage.contacts.rows.size(); ++i)
        if (stage.contacts.rows[i].swept) scratch.swept.push_back(i);
}

void resweepForTick(ImpactStage& stage, const StepContext& context)
{
    const std::vector<Motion>& rows = stage.motions.rows;
    const std::vector<Way>& ways = stage.rows.ways;
    const ShapeTable& shapes = stage.world.shapes;
    ImpactScratch& scratch = stage.scratch;

    if (scratch.swept.empty()) return;
    stage.parallel.forEach(rows.size(), kBodyGrain, [&](const Chunk& chunk) {
        stage.kernels.boundSpeeds(bodiesOf(chunk, stage.motions.rows, stage.rows), context);
    });

    // Which of them may meet in this tick: the others are what the sweep would say without looking.
    enum Verdict : std::uint8_t { Far, Parts, Near };
    constexpr std::size_t kGrain = 256;
    scratch.verdicts.resize(scratch.swept.size());
    stage.parallel.forEach(scratch.swept.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            Contact& c = stage.contacts.rows[scratch.swept[k]];
            const Motion &a = rows[c.rowA], &b = rows[c.rowB];
            keepClearance(c, ways);
            const real reach = context.h * (ways[c.rowA].reach + ways[c.rowB].reach);
            if (c.count == 0 && c.clearance - reach > nearGap(c)) {
                scratch.verdicts[k] = Far;
                continue;
            }
            const real travel =
                travelWithin(flightOf(a, context.invH), a, flightOf(b, context.invH), b, context.h);
            const bool far = c.clearance - travel > nearGap(c);
            scratch.verdicts[k] = !far ? Near : c.count > 0 ? Parts : Far;
        }
    });

    ExpectedPaths& paths = scratch.paths;
    paths.begin(rows.size(), context.h, context.invH);
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
        scratch.again.push_back(&c);
    }
    paths.reckonWanted(stage.motions, stage.parallel);

    const std::size_t again = scratch.again.size();
    scratch.exhausted.assign(Parallel::chunksOf(again, kPairBatch), 0);
    stage.parallel.forEach(again, kPairBatch, [&](const Chunk& chunk) {
        const std::span<Contact* const> batch(scratch.again.data() + chunk.begin, chunk.end - chunk.begin);
        SweptResult results[kPairBatch];
        paths.collide(batch, shapes, stage.motions, results);
        for (std::size_t i = 0; i < batch.size(); ++i) {
            Contact& c = *batch[i];
            const Convex &a = shapes.convex(c.shapeA), &b = shapes.convex(c.shapeB);
            scratch.exhausted[chunk.index] += results[i].exhausted ? 1 : 0;
            c.clearance = results[i].startGap;
            adoptManifold(c, results[i], real(0.3) * maximum(a.size, b.size));
        }
    });
    for (const std::uint32_t count : scratch.exhausted) stage.clamps.advancement += count;
}

void startTick(ImpactStage& stage, const StepContext& context, int tick)
{
    std::vector<Motion>& motions = stage.motions.rows;
    ImpactScratch& scratch = stage.scratch;
    const real t = static_cast<real>(tick) * context.h;
    const TickTime time{tick, t, static_cast<real>(context.dt) - t};
    scratch.strays.resize(motions.size());
    scratch.starts.resize(Parallel::chunksOf(motions.size(), kBodyGrain));
    stage.parallel.forEach(motions.size(), kBodyGrain, [&](const Chunk& chunk) {
        StrayList strays{scratch.strays.data() + chunk.begin, 0};
        const real fastest =
            stage.kernels.startTick(bodiesOf(chunk, motions, stage.rows), context, time, strays);
        scratch.starts[chunk.index] = {fastest, strays.count};
    });

    scratch.fastest = 0;
    std::size_t strays = 0;
    for (std::size_t k = 0; k < scratch.starts.size(); ++k) {
        const auto [fastest, count] = scratch.starts[k];
        scratch.fastest = maximum(fastest, scratch.fastest);
        for (std::size_t i = 0; i < count; ++i) scratch.strays[strays++] = scratch.strays[k * kBodyGrain + i];
    }
    scratch.strays.resize(strays);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
