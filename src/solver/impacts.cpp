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

class ImpactSolver {
public:
    ImpactSolver(ImpactStage& stage, const StepContext& context, int tick);
    void run();

private:
    ImpactStage& stage_;
    const StepContext& context_;
    ImpactScratch& scratch_;
    const real tickStart_;                   // within the step   [s]
    bool connected_ = false;                 // have the chains been made?
    ImpactResponse response_;

    Contact& contact(std::uint32_t i) { return stage_.contacts.rows[i]; }
    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }
    FlyingPair pairOf(const Contact& c) const { return response_.pairOf(c); }

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
    void pairWithMoving(std::uint32_t row, std::uint32_t shape, const Aabb& needed);
    void pairWithResting(std::uint32_t row, std::uint32_t shape, const Aabb& needed, real end);
    bool meetsSleeper(std::uint32_t row, std::uint32_t shape, std::uint32_t other, real end);
    void takeUp(std::uint32_t first);
    bool isKnown(std::uint32_t row, const ShapePair& pair);
    void add(const ShapePair& pair);
};

ImpactSolver::ImpactSolver(ImpactStage& stage, const StepContext& context, int tick)
    : stage_(stage), context_(context), scratch_(stage.scratch),
      tickStart_(static_cast<real>(tick) * context.h),
      response_(stage, context, stage.scratch.flights, tickStart_)
{
    const std::size_t rows = stage.motions.rows.size(), contacts = stage.contacts.rows.size();
    scratch_.flights.resize(rows);
    scratch_.reach.resize(rows);
    scratch_.points.resize(2 * contacts);
    scratch_.versions.assign(contacts, 0);
    scratch_.placed.assign(contacts, false);
    scratch_.places.resize(contacts);
    scratch_.queue.clear();
    for (std::size_t row = 0; row < rows; ++row) {
        scratch_.flights[row] = flightOf(stage.motions.rows[row], context.invH);
        scratch_.reach[row] = fastestPoint(scratch_.flights[row], stage.motions.rows[row], context.h);
    }
    for (std::uint32_t k = 0; k < contacts; ++k) scratch_.places[stage.contacts.order[k]] = k;
}

void ImpactSolver::connect()
{
    if (connected_) return;
    connected_ = true;
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
    const Contact& c = contact(i);
    ++scratch_.versions[i];
    if (!scratch_.placed[i]) placePoints(i);
    const Impact impact = nextImpact(c, &scratch_.points[2 * std::size_t{i}], pairOf(c), context_);
    if (impact.time == kNever) return;
    scratch_.queue.push_back({impact, c.impacts, scratch_.places[i], scratch_.versions[i]});
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
    Contact& c = contact(i);
    const real start = pairOf(c).start();
    for (int k = 0; k < c.count; ++k)
        if (c.points[k].normalImpulse > 0) return;
    if (!c.swept) c.clearance = -std::numeric_limits<real>::max();  // not known
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
        scratch_.places.push_back(i);  // the order of what comes in is that of the rows
        chain(i);
    }
}

void ImpactSolver::add(const ShapePair& pair)
{
    const auto i = static_cast<std::uint32_t>(stage_.contacts.rows.size());
    Contact added = makeContact(stage_.world, pair);
    added.swept = true;
    stage_.contacts.order.push_back(i);
    stage_.contacts.rows.push_back(added);
    ++stage_.repaired;
    takeUp(i);
    resweep(i, false);
    schedule(i);
}

// A body thrown out of the box it was paired in is paired again, at once.
void ImpactSolver::pairAgain(std::uint32_t row)
{
    const std::uint32_t body = motion(row).body;
    const Position center = motion(row).center;
    const Trajectory path = pathOf(row, center);
    const real end = static_cast<real>(context_.dt) - tickStart_;

    for (const std::uint32_t shape : stage_.world.bodies.rows[body].shapes) {
        const Convex& convex = stage_.world.shapes.rows[shape].convex;
        const real margin = 3 * stage_.world.restGap * convex.size;
        const Aabb needed = sweptBounds(convex, path, center, scratch_.flights[row].clock, end, margin);
        if (!scratch_.tree.isBuilt()) scratch_.tree.build(stage_.boxes, stage_.world.shapes.rows.size());
        const SweepBox* own = scratch_.tree.boxOf(shape);
        const bool left = own == nullptr || !contains(own->box, needed);
        if (left) pairWithMoving(row, shape, needed);
        if (left || !stage_.asleep.isEmpty()) pairWithResting(row, shape, needed, end);
    }
}

void ImpactSolver::pairWithMoving(std::uint32_t row, std::uint32_t shape, const Aabb& needed)
{
    scratch_.tree.overlapping(needed, motion(row).body, scratch_.found);
    if (scratch_.tree.boxOf(shape) != nullptr) scratch_.tree.grow(shape, needed);
    for (const std::uint32_t k : scratch_.found) {
        const std::uint32_t other = stage_.boxes[k].shape;
        const ShapePair pair{minimum(shape, other), maximum(shape, other)};
        if (mayCollide(stage_.world, pair) && !isKnown(row, pair)) add(pair);
    }
}

// What holds still may have no row yet; what sleeps comes in if it is met.
void ImpactSolver::pairWithResting(std::uint32_t row, std::uint32_t shape, const Aabb& needed, real end)
{
    scratch_.found.clear();
    stage_.resting.eachOverlapping(needed, [&](std::uint32_t other) {
        if (overlaps(needed, stage_.world.shapes.rows[other].sweptBox)) scratch_.found.push_back(other);
    });
    std::sort(scratch_.found.begin(), scratch_.found.end());
    for (const std::uint32_t other : scratch_.found) {
        const ShapePair pair{minimum(shape, other), maximum(shape, other)};
        const std::uint32_t body = stage_.world.shapes.rows[other].body;
        if (body == motion(row).body || !mayCollide(stage_.world, pair)) continue;
        const BodyRow& b = stage_.world.bodies.rows[body];
        if (stage_.motions.rowOf[body] == MotionTable::kNone) {
            if (b.isAsleep()) {
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
        if (!isKnown(row, pair)) add(pair);
    }
}

bool ImpactSolver::meetsSleeper(std::uint32_t row, std::uint32_t shape, std::uint32_t other, real end)
{
    const ShapeRow& sleeper = stage_.world.shapes.rows[other];
    const Motion& m = motion(row);
    const Motion still = motionOf(stage_.world.bodies.rows[sleeper.body], sleeper.body);
    const Position origin = originOf(m, still);
    const real restGap =
        stage_.world.restGap * minimum(stage_.world.shapes.rows[shape].convex.size, sleeper.convex.size);
    const SweptPair pair{stage_.world.shapes.rows[shape].convex, sleeper.convex, pathOf(row, origin),
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

void ImpactSolver::run()
{
    for (std::uint32_t i = 0; i < stage_.contacts.rows.size(); ++i) {
        const Contact& c = contact(i);
        const real most = scratch_.reach[c.rowA] + scratch_.reach[c.rowB];
        if (c.count > 0 && most >= slowestInCrowd(c, context_)) schedule(i);
    }
    while (!scratch_.queue.empty()) {
        std::pop_heap(scratch_.queue.begin(), scratch_.queue.end());
        const DueImpact due = scratch_.queue.back();
        scratch_.queue.pop_back();
        const std::uint32_t i = stage_.contacts.order[due.place];
        if (due.version != scratch_.versions[i]) continue;
        connect();
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
    ImpactSolver(stage, context, tick).run();
}

void keepClearance(Contact& c, const std::vector<Way>& ways)
{
    const Way &a = ways[c.rowA], &b = ways[c.rowB];
    c.clearance -= real(1.001) * (length(b.shift - a.shift) + a.turn + b.turn) + real(0.01) * c.restGap;
}

void resweepForTick(ImpactStage& stage, const std::vector<Way>& ways, const StepContext& context)
{
    const std::vector<Motion>& rows = stage.motions.rows;
    const ShapeTable& shapes = stage.world.shapes;
    ExpectedPaths& paths = stage.scratch.paths;
    paths.begin(rows.size(), context.h, context.invH);

    Contact* batch[kPairBatch];
    std::size_t count = 0;
    const auto sweep = [&] {
        const std::span<const SweptResult> results = paths.collide({batch, count}, shapes, stage.motions);
        for (std::size_t i = 0; i < count; ++i) {
            Contact& c = *batch[i];
            const Convex &a = shapes.rows[c.shapeA].convex, &b = shapes.rows[c.shapeB].convex;
            stage.clamps.advancement += results[i].exhausted ? 1 : 0;
            c.clearance = results[i].startGap;
            adoptManifold(c, results[i], real(0.3) * maximum(a.size, b.size));
        }
        count = 0;
    };
    for (Contact& c : stage.contacts.rows) {
        if (!c.swept) continue;
        const Motion &a = rows[c.rowA], &b = rows[c.rowB];
        keepClearance(c, ways);
        // Too far apart to meet in this tick: what the sweep would say without looking.
        const real travel =
            travelWithin(flightOf(a, context.invH), a, flightOf(b, context.invH), b, context.h);
        if (c.clearance - travel > nearGap(c)) {
            adoptManifold(c, {}, 0);
            continue;
        }
        batch[count++] = &c;
        if (count == kPairBatch) sweep();
    }
    if (count > 0) sweep();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
