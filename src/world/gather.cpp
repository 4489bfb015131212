// SPDX-License-Identifier: MIT
// The opening of a step: the bodies that take part, where they are expected to go, what holds still on their
// way, and who must wake for them.

#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "joints/tick.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

void addRow(MotionTable& motions, const BodyTable& bodies, std::uint32_t slot)
{
    motions.rowOf[slot] = static_cast<std::uint32_t>(motions.rows.size());
    motions.rows.push_back(motionOf(bodies, slot));
}

// The bodies that take part. Under gravitation all do, as each pulls the others.
void gatherMotions(const BodyTable& bodies, bool all, MotionTable& motions, Parallel& parallel)
{
    constexpr std::size_t kGrain = 128;
    for (const Motion& m : motions.rows) motions.rowOf[m.body] = MotionTable::kNone;
    motions.rowOf.resize(bodies.rows.size(), MotionTable::kNone);
    motions.parts = static_cast<std::uint32_t>(bodies.parts.size());
    motions.rows.resize(bodies.parts.size());
    parallel.forEach(bodies.parts.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
            const std::uint32_t slot = bodies.parts[row];
            motions.rowOf[slot] = static_cast<std::uint32_t>(row);
            motions.rows[row] = motionOf(bodies, slot);
        }
    });
    if (!all) return;
    for (std::uint32_t slot = 0; slot < bodies.rows.size(); ++slot)
        if (bodies.ids.isAlive(slot) && bodies.rows[slot].enabled && !bodies.rows[slot].takesPart)
            addRow(motions, bodies, slot);
}

// Does a moving shape meet one that sleeps?
bool meets(const ContactWorld& world, const ShapePair& pair, const StepContext& context)
{
    Contact contact = makeContact(world, pair);
    const auto motionAt = [&](std::uint32_t shape) {
        const std::uint32_t body = world.shapes.rows[shape].body, row = world.motions.rowOf[body];
        return row != MotionTable::kNone ? world.motions.rows[row] : motionOf(world.bodies, body);
    };
    const Motion a = motionAt(pair.a), b = motionAt(pair.b);
    const SweptPair ways = sweptPairOf(contact, world.shapes, a, b, context.invH);
    return mayMeet(ways, 0, static_cast<real>(context.dt), context);
}

void sortUnique(std::vector<std::uint32_t>& slots)
{
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

}  // namespace

// Do bodies still have the rows of the step before? Grounds that get theirs later may have others.
bool World::Impl::rowsAreKept() const
{
    const auto isOf = [](const Motion& m, std::uint32_t body) { return body == m.body; };
    return motions.rows.size() <= rowBodies.size() &&
           std::equal(motions.rows.begin(), motions.rows.end(), rowBodies.begin(), isOf);
}

// The warm start of the step before, for the prediction of where bodies go.
void World::Impl::predictSteady()
{
    addSteadyJoints(joints, jointSystem, motions.rows, 0);
    addSteadyHinges(joints, bodies, jointSystem, motions.rows, 0);
    Motion still;
    const auto motionAt = [&](std::uint32_t row) -> Motion& {
        return row < motions.rows.size() ? motions.rows[row] : still;
    };
    if (pairsAreCurrent && resting.changes() == restingChanges && rowsAreKept()) {
        for (std::size_t i = 0; i < contacts.loads.size(); ++i) {
            const ContactFacts& of = contacts.facts[i];
            addLoad(contacts.loads[i], motionAt(of.rowA), motionAt(of.rowB));
        }
    } else {
        for (std::size_t i = 0; i < contacts.rows.size(); ++i) {
            const Contact& c = contacts.rows[i];
            const std::uint32_t bodyA = shapes.rows[c.shapeA].body, bodyB = shapes.rows[c.shapeB].body;
            if (!bodies.rows[bodyA].enabled || !bodies.rows[bodyB].enabled) continue;
            const ContactLoad load = i < contacts.loads.size() ? contacts.loads[i] : loadOf(c);
            addLoad(load, motionAt(motions.rowOf[bodyA]), motionAt(motions.rowOf[bodyB]));
        }
    }
}

// The other bodies of the joints of those that take part: grounds get a row, sleepers wake.
void World::Impl::gatherPartners()
{
    met.clear();
    std::vector<std::uint32_t>& still = roused;
    still.clear();
    for (std::uint32_t row = 0; row < motions.parts; ++row) {
        for (const std::uint32_t slot : joints.of(motions.rows[row].body)) {
            const JointRow& joint = joints.rows[slot];
            if (!joint.ties()) continue;
            joint.eachBody([&](std::uint32_t other) {
                const BodyRow& b = bodies.rows[other];
                if (!b.enabled || motions.rowOf[other] != MotionTable::kNone) return;
                if (!b.isAsleep()) {
                    still.push_back(other);
                } else if (!asleep.groups[b.group].isMet) {
                    asleep.groups[b.group].isMet = true;
                    met.push_back(b.group);
                }
            });
        }
    }
    sortUnique(still);
    for (const std::uint32_t slot : still) addRow(motions, bodies, slot);
}

// Is nothing near the boxes of a body, by number, that holds still? Who has found that looks again when it
// leaves the room around them; who has found something looks now and then.
bool World::Impl::isClear(std::size_t first, std::size_t end)
{
    constexpr double kRoom = 3;  // boxes, on all sides
    constexpr std::uint64_t kNowAndThen = 8;  // steps
    Aabb all = boxes[first].box;
    for (std::size_t k = first + 1; k < end; ++k) all = merged(all, boxes[k].box);
    const std::uint32_t mover = bodies.rows[boxes[first].body].mover;
    const auto now = static_cast<std::uint32_t>(resting.changes());
    ClearRoom& known = clearRooms[mover];
    const bool isOfNow = known.of == now && known.box.left <= known.box.right;
    if (isOfNow && holds(known.box, FloatBox::of(all))) return true;
    if (!isOfNow && (steps + mover) % kNowAndThen != 0) return false;
    const double room = kRoom * maximum(all.upper.x - all.lower.x, all.upper.y - all.lower.y);
    const Aabb roomy{{all.lower.x - room, all.lower.y - room}, {all.upper.x + room, all.upper.y + room}};
    const bool isClear = !resting.anyOverlapping(roomy);
    known = isClear ? ClearRoom{FloatBox::of(roomy), now} : ClearRoom{};
    return isClear;
}

// The pairs of boxes that move and of shapes that hold still on their way.
void World::Impl::findRestPairs(const ContactWorld& world)
{
    constexpr std::size_t kGrain = 64;
    clearRooms.resize(bodies.movers.slots());
    foundResting.begin(Parallel::chunksOf(boxes.size(), kGrain));
    parallel.forEach(boxes.size(), kGrain, [&](const Chunk& chunk) {
        std::vector<RestPair>& found = foundResting.of(chunk.index);
        for (std::size_t first = chunk.begin, end = first; first < chunk.end; first = end) {
            const std::uint32_t body = boxes[first].body;
            while (end < chunk.end && boxes[end].body == body) ++end;
            // A body that two chunks share belongs to neither.
            const bool isWhole = (first == 0 || boxes[first - 1].body != body) &&
                                 (end == boxes.size() || boxes[end].body != body);
            if (isWhole && isClear(first, end)) continue;
            for (std::size_t k = first; k < end; ++k) {
                const SweepBox& box = boxes[k];
                if (!box.moves) continue;
                resting.eachOverlapping(box.box, [&](std::uint32_t other) {
                    const ShapePair pair{minimum(box.shape, other), maximum(box.shape, other)};
                    if (overlaps(box.box, restingBounds(world, other)) && mayCollide(world, pair))
                        found.push_back({pair, bodies.rows[shapes.rows[other].body].group});
                });
            }
        }
    });
}

// Rows are numbers in contacts: other rows are other contacts.
void World::Impl::noteRows()
{
    const auto isOf = [](std::uint32_t body, const Motion& m) { return body == m.body; };
    if (std::equal(rowBodies.begin(), rowBodies.end(), motions.rows.begin(), motions.rows.end(), isOf))
        return;
    pairsAreCurrent = false;
    rowBodies.clear();
    rowBodies.reserve(2 * motions.rows.size());
    for (const Motion& m : motions.rows) rowBodies.push_back(m.body);
}

std::uint32_t World::Impl::gather(const ForceField& forces, const StepContext& context)
{
    listUncoupled();
    const ContactWorld world = contactWorld();
    std::uint32_t faults = 0;
    for (;;) {
        if (!partsAreSorted) {
            std::erase_if(bodies.parts, [&](std::uint32_t slot) { return !bodies.rows[slot].takesPart; });
            sortUnique(bodies.parts);
            partsAreSorted = true;
        }
        gatherMotions(bodies, forces.gravitationConstant > 0, motions, parallel);
        gatherPartners();
        if (!met.empty()) {
            for (const std::uint32_t group : met) wakeGroup(group);
            continue;
        }
        gatherJoints(joints, bodies, motions, jointSystem);
        predictSteady();
        faults = accelerate(motions, bodies, forces, time);
        if (sweepBodies(context)) boxesAreSwept = false;
        if (resting.changes() != restingChanges) pairsAreCurrent = false;
        if (pairsAreCurrent && boxesAreSwept && !sleepersAreNear) break;

        // What holds still on their way. Those that sleep there and are met wake, and all is gathered again.
        restingChanges = resting.changes();
        findRestPairs(world);
        restPairs.clear();
        sleepersAreNear = false;
        met.clear();
        foundResting.forAll([&](const RestPair& found) {
            if (found.group == BodyRow::kNoGroup) {
                restPairs.push_back(found.pair);
                return;
            }
            sleepersAreNear = true;
            if (!asleep.groups[found.group].isMet && meets(world, found.pair, context)) {
                asleep.groups[found.group].isMet = true;
                met.push_back(found.group);
            }
        });
        if (met.empty()) break;
        for (const std::uint32_t group : met) wakeGroup(group);
    }

    // Those that hold still get their rows behind all others.
    std::vector<std::uint32_t>& still = met;
    still.clear();
    for (const ShapePair& pair : restPairs)
        for (const std::uint32_t shape : {pair.a, pair.b})
            if (motions.rowOf[shapes.rows[shape].body] == MotionTable::kNone)
                still.push_back(shapes.rows[shape].body);
    sortUnique(still);
    for (const std::uint32_t slot : still) addRow(motions, bodies, slot);
    jointSystem.groupOf.resize(motions.rows.size(), JointSystem::kNone);
    paths.grow(motions.rows.size());
    motions.versions.resize(motions.rows.size());
    motions.origins.resize(motions.rows.size());
    motions.centers.resize(motions.rows.size());
    motions.rooms.resize(motions.rows.size());
    motions.slow.resize(motions.rows.size());
    solverScratch.rows.travels.resize(motions.rows.size());
    expectWays(motions.parts, motions.rows.size(), context);
    for (std::size_t row = motions.parts; row < motions.rows.size(); ++row) sweepStill(row, context);
    noteRows();
    return faults;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
