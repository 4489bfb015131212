// SPDX-License-Identifier: MIT
// Who takes part in steps, and where all others lie: lists and trees that change when something happens,
// so that a step need not look at what rests.

#include "contacts/update.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// So that questions, which reckon in double, find all that touches their box.
Aabb grown(const Aabb& box, real extent)
{
    const double slack = 1e-6 * static_cast<double>(extent);
    return {{box.lower.x - slack, box.lower.y - slack}, {box.upper.x + slack, box.upper.y + slack}};
}

}  // namespace

void World::Impl::tally(const BodyRow& b, bool comes)
{
    if (!b.enabled) return;
    const auto add = [comes](std::uint32_t& count, std::size_t n) {
        count = static_cast<std::uint32_t>(comes ? count + n : count - n);
    };
    add(census.bodies, 1);
    add(census.dynamicBodies, b.isDynamic() ? 1 : 0);
    add(census.shapes, b.shapes.size());
}

// Lists the body among those that take part, or lays its shapes to rest, as its state asks.
void World::Impl::refreshPart(std::uint32_t slot)
{
    BodyRow& b = bodies.rows[slot];
    const bool moves = b.isDynamic() ? !b.isAsleep() : b.type == BodyType::Kinematic && b.hasVelocity();
    if ((b.enabled && moves) == b.takesPart) return;
    b.takesPart = !b.takesPart;
    forgetKept(b);
    if (b.takesPart) {
        if (!bodies.parts.empty() && bodies.parts.back() >= slot) partsAreSorted = false;
        bodies.parts.push_back(slot);
        displaceAll(slot);
    } else {
        partsAreSorted = false;  // it leaves the list when that is sorted
        leavers.push_back(slot);
        if (b.enabled) placeAll(slot, false);
    }
}

void World::Impl::place(std::uint32_t shape, bool rouses)
{
    resting.remove(shape);
    toPlace.push_back({shape, rouses});
}

// A shape has changed: who meets it where it lies must wake.
void World::Impl::placeAgain(std::uint32_t slot)
{
    const BodyRow& b = bodies.rows[shapes.rows[slot].body];
    if (b.enabled && !b.takesPart) place(slot, true);
}

void World::Impl::placeAll(std::uint32_t slot, bool rouses)
{
    for (const std::uint32_t shape : shapes.of(bodies.rows[slot])) place(shape, rouses);
}

void World::Impl::placeEverything()
{
    for (std::uint32_t slot = 0; slot < bodies.rows.size(); ++slot)
        if (bodies.ids.isAlive(slot) && bodies.rows[slot].enabled && !bodies.rows[slot].takesPart)
            placeAll(slot, false);
}

void World::Impl::displaceAll(std::uint32_t slot)
{
    for (const std::uint32_t shape : shapes.of(bodies.rows[slot])) resting.remove(shape);
}

// Masses of bodies that nothing moves are summed up only when somebody asks: a ground of many shapes would be
// summed up anew with each of them.
void World::Impl::settleMass(std::uint32_t slot)
{
    if (bodies.rows[slot].massIsStale) updateMass(slot);
}

void World::Impl::settle()
{
    if (!staleMasses.empty()) {
        for (const std::uint32_t slot : staleMasses) settleMass(slot);
        staleMasses.clear();
        if (staleMasses.capacity() > 4096) staleMasses.shrink_to_fit();
    }
    while (!toPlace.empty()) {
        std::vector<std::uint32_t> rousing;
        for (const RestingShape& entry : toPlace) {
            if (!shapes.ids.isAlive(entry.shape) || resting.holds(entry.shape)) continue;
            const BodyRow& b = bodies.rows[shapes.rows[entry.shape].body];
            if (!b.enabled || b.takesPart) continue;
            const Convex& convex = shapes.convex(entry.shape);
            resting.add(entry.shape, grown(restingBounds(b, convex, settings.tuning.restGap), convex.extent));
            if (entry.rouses && !asleep.isEmpty()) rousing.push_back(entry.shape);
        }
        toPlace.clear();
        if (toPlace.capacity() > 4096) toPlace.shrink_to_fit();
        resting.settle();
        wakeAmong(rousing);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
