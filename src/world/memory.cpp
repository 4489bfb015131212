// SPDX-License-Identifier: MIT
// What the tables hold.

#include "base/memory.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <class Table>
TableMemory ofTable(std::string_view name, const Table& table)
{
    return {name, table.size(), table.slots(), table.capacity(), table.bytes()};
}

// Slots are given out lowest first, so there are as many as were ever in use at once.
template <class Id, class Rows>
TableMemory ofSlots(std::string_view name, const IdPool<Id>& ids, const Rows& rows)
{
    return {name, ids.alive(), rows.size(), rows.capacity(), bytesOf(rows) + ids.bytes()};
}

template <class... Vectors>
std::size_t bytesOfAll(const Vectors&... vectors)
{
    return (bytesOf(vectors) + ...);
}

}  // namespace

void World::Impl::noteMost()
{
    most.contacts = maximum(most.contacts, contacts.rows.size());
    most.motions = maximum(most.motions, motions.rows.size());
    most.boxes = maximum(most.boxes, boxes.size());
    most.pairs = maximum(most.pairs, pairs.size());
}

MemoryReport World::Impl::memory() const
{
    std::size_t room = 0, jointLists = bytesOf(joints.ofBody);
    for (const SleepGroup& group : asleep.groups) room += group.contacts.capacity();
    for (const auto& list : joints.ofBody) jointLists += bytesOf(list);
    for (const JointRow& joint : joints.rows) jointLists += bytesOfAll(joint.more, joint.angles);
    const TickRows& ticks = solverScratch.rows;

    MemoryReport all;
    all.tables = {
        ofSlots("bodies", bodies.ids, bodies.rows),
        ofTable("bodies that may move", bodies.movers),
        ofTable("extras of bodies", bodies.extras),
        ofSlots("shapes", shapes.ids, shapes.rows),
        ofTable("forms of shapes", shapes.forms),
        ofTable("surfaces of shapes", shapes.surfaces),
        {"shapes at rest, in trees", resting.size(), resting.places(), resting.places(), resting.bytes()},
        ofSlots("joints", joints.ids, joints.rows),
        {"contacts", contacts.rows.size(), most.contacts, contacts.rows.capacity(),
         bytesOfAll(contacts.rows, contacts.facts, contacts.nearness, contacts.loads, contacts.order,
                    contacts.colorEnds, matchScratch.matched, matchScratch.left)},
        {"contacts asleep", asleep.contacts, asleep.mostContacts, room,
         room * sizeof(Contact) + bytesOf(asleep.groups)},
        {"bodies in a step", motions.rows.size(), most.motions, motions.rows.capacity(),
         bytesOfAll(bodies.parts, motions.rows, motions.rowOf, motions.versions, motions.origins,
                    motions.centers, motions.rooms, motions.slow, references.rows, clearRooms, ticks.origins,
                    ticks.poses, ticks.starts, ticks.velocities, ticks.steady, ticks.expected, ticks.loads,
                    ticks.pushes, ticks.changes, ticks.kicks, ticks.travels, ticks.predicted, ticks.ways,
                    solverScratch.impacts.flights) +
             paths.bytes() + solverScratch.impacts.paths.bytes()},
        {"boxes and pairs in a step", boxes.size() + pairs.size(), most.boxes + most.pairs,
         boxes.capacity() + pairs.capacity(),
         bytesOfAll(boxes, pairs, foundPairs, restPairs, sweepScratch.entries, sweepScratch.unsorted,
                    sweepScratch.bucketEnds, sweepScratch.found, sweepScratch.pairEnds)},
    };
    all.tables[7].bytes += jointLists;
    return all;
}

MemoryReport World::memory() const noexcept
{
    return impl_->memory();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
