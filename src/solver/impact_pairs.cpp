// SPDX-License-Identifier: MIT
// Who a body may meet on a way that it was not expected to go. docs/theory/contacts.md, section 3.

#include "solver/impact_pairs.hpp"

#include "contacts/update.hpp"
#include "solver/newcomers.hpp"
#include "solver/quiet_bodies.hpp"
#include "solver/tick_sweeps.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// What a body that is paired again gets around it, as a part of its width.
constexpr real kRoom = real(0.05);

Aabb withRoom(const Aabb& box, double room)
{
    return {{box.lower.x - room, box.lower.y - room}, {box.upper.x + room, box.upper.y + room}};
}

// How far a box can grow within another that holds it.   [m]
real roomIn(const Aabb& box, const Aabb& needed)
{
    const double x = minimum(needed.lower.x - box.lower.x, box.upper.x - needed.upper.x);
    const double y = minimum(needed.lower.y - box.lower.y, box.upper.y - needed.upper.y);
    return static_cast<real>(minimum(x, y));
}

void chain(ImpactStage& stage, std::uint32_t i)
{
    ContactChains& chains = stage.scratch.chains;
    const PairRow& pair = stage.scratch.pairs[i];
    if (stage.motions.rows[pair.rowA].moves()) chains.append(pair.rowA, i, 0);
    if (stage.motions.rows[pair.rowB].moves()) chains.append(pair.rowB, i, 1);
}

}  // namespace

void connect(ImpactStage& stage)
{
    ImpactScratch& scratch = stage.scratch;
    if (scratch.connected) return;
    scratch.connected = true;
    scratch.chains.reset(stage.motions.rows.size());
    for (const std::uint32_t i : stage.contacts.order) chain(stage, i);
}

Trajectory WayPairs::pathOf(std::uint32_t row, Position origin)
{
    return tamias2d::pathOf(motion(row), scratch_.flights[row], origin, context_.invH);
}

// Makes room for the contacts from number `first` on, which have just come in, and takes them up. Those of
// bodies that slept until now are loaded, and are solved with all others.
void WayPairs::takeUp(std::uint32_t first)
{
    const auto count = static_cast<std::uint32_t>(stage_.contacts.rows.size());
    scratch_.points.resize(2 * std::size_t{count});
    for (std::uint32_t i = first; i < count; ++i) {
        const Contact& c = stage_.contacts.rows[i];
        scratch_.pairs.push_back(pairRowOf(c));
        if (c.swept) scratch_.swept.push_back(i);
        if (c.count > 0) stage_.passes.loosen(i, stage_.contacts, stage_.motions);
        chain(stage_, i);
    }
}

// Those that do not meet as they are expected to go are looked at when the next tick begins.
void WayPairs::add(const ShapePair& pair, bool meets)
{
    const auto i = static_cast<std::uint32_t>(stage_.contacts.rows.size());
    Contact added = makeContact(stage_.world, pair);
    for (const std::uint32_t row : {added.rowA, added.rowB}) {
        stage_.visited.visit(row, stage_.kernels, stage_.motions.rows, stage_.rows, context_, scratch_.tick);
        wakeQuiet(stage_, row, context_);
    }
    added.swept = true;
    stage_.contacts.order.push_back(i);
    stage_.contacts.rows.push_back(added);
    ++stage_.repaired;
    takeUp(i);
    if (meets) scratch_.met.push_back(i);
}

const std::vector<std::uint32_t>& WayPairs::pairAgain(std::uint32_t row)
{
    scratch_.met.clear();
    const std::uint32_t body = motion(row).body;
    const Position center = motion(row).center;
    const Trajectory path = pathOf(row, center);
    const real end = static_cast<real>(context_.dt) - tickStart_;
    const real wanted = kRoom * stage_.rows.predicted[row].width;
    real room = wanted;  // that all its shapes have

    for (const std::uint32_t shape : stage_.world.shapes.of(stage_.world.bodies.rows[body])) {
        scratch_.partners.forget();
        const Convex& convex = stage_.world.shapes.convex(shape);
        const real margin = 3 * stage_.world.restGap * convex.size;
        const Aabb needed = sweptBounds(convex, path, center, scratch_.flights[row].clock, end, margin);
        const Aabb roomy = withRoom(needed, static_cast<double>(wanted));
        if (!scratch_.tree.isBuilt()) scratch_.tree.build(stage_.boxes, stage_.world.shapes.rows.size());
        const SweepBox* own = scratch_.tree.boxOf(shape);
        const bool left = own == nullptr || !contains(own->box, needed);
        if (left)
            pairWithMoving(row, shape, needed, roomy);
        else
            room = minimum(room, roomIn(own->box, needed));
        if (left || !stage_.asleep.isEmpty())
            room = pairWithResting(row, shape, needed, roomy, end) ? room : real(0);
    }
    expectWay(row, path, room);
    return scratch_.met;
}

// From now on the body is expected to go along `path`, within `room` [m].
void WayPairs::expectWay(std::uint32_t row, const Trajectory& path, real room)
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

void WayPairs::pairWithMoving(std::uint32_t row, std::uint32_t shape, const Aabb& needed, const Aabb& roomy)
{
    scratch_.tree.overlapping(roomy, motion(row).body, scratch_.found);
    if (scratch_.tree.boxOf(shape) != nullptr) scratch_.tree.grow(shape, roomy);
    for (const std::uint32_t k : scratch_.found) {
        const std::uint32_t other = stage_.boxes[k].shape;
        const ShapePair pair{minimum(shape, other), maximum(shape, other)};
        if (mayCollide(stage_.world, pair) && !isKnown(row, shape, other))
            add(pair, overlaps(needed, stage_.boxes[k].box));
    }
}

// What holds still may have no row yet; what sleeps comes in if it is met.
// Returns whether nothing sleeps in that room: what is not met keeps sleeping, and is looked at again as soon
// as the way changes.
bool WayPairs::pairWithResting(std::uint32_t row, std::uint32_t shape, const Aabb& needed, const Aabb& roomy,
                               real end)
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
                scratch_.partners.forget();
            } else {
                enter(stage_, body, context_);
                scratch_.chains.grow(stage_.motions.rows.size());
            }
        }
        if (!isKnown(row, shape, other)) add(pair, overlaps(needed, restingBounds(stage_.world, other)));
    }
    return nobodySleeps;
}

bool WayPairs::meetsSleeper(std::uint32_t row, std::uint32_t shape, std::uint32_t other, real end)
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

// A pair is asked for but once between two times that all are noted.
bool WayPairs::isKnown(std::uint32_t row, std::uint32_t shape, std::uint32_t other)
{
    if (!scratch_.partners.areNoted()) notePartners(row, shape);
    return scratch_.partners.has(other);
}

void WayPairs::notePartners(std::uint32_t row, std::uint32_t shape)
{
    scratch_.partners.begin(stage_.world.shapes.rows.size());
    const ContactChains& chains = scratch_.chains;
    for (std::uint32_t link = chains.first(row); link != ContactChains::kEnd; link = chains.next(link)) {
        const Contact& c = stage_.contacts.rows[ContactChains::contactOf(link)];
        if (c.shapeA == shape) scratch_.partners.note(c.shapeB);
        if (c.shapeB == shape) scratch_.partners.note(c.shapeA);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
