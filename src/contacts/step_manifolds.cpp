// SPDX-License-Identifier: MIT
#include "contacts/step_manifolds.hpp"

#include "base/room.hpp"
#include "contacts/rows.hpp"

#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// What is swept is looked at again anyway, and what came in mid-step is for no pose. Bodies that move along
// together are where they were to each other.
bool keepsManifold(const ContactFacts& of, const MotionTable& motions)
{
    if (of.swept || of.versionA != motions.versions[of.rowA] || of.versionB != motions.versions[of.rowB])
        return false;
    const CenterWay &a = motions.centers[of.rowA], &b = motions.centers[of.rowB];
    const DVec2 off = (b.center - a.center) - of.between;
    const real travel = travelBy(b.glide - a.glide, b.bend - a.bend);
    return absolute(off.x) + absolute(off.y) + static_cast<double>(travel) <= static_cast<double>(of.room);
}

void takePlaces(Contact& contact, const SweptResult& result)
{
    for (int k = 0; k < contact.count; ++k) {
        contact.points[k].armA = result.places[k].armA;
        contact.points[k].armB = result.places[k].armB;
        contact.points[k].gap = result.places[k].gap;
    }
}

void updateBatch(std::span<Contact* const> contacts, const ShapeTable& shapes, const MotionTable& motions,
                 const StepContext& context, const ExpectedPaths& paths, ManifoldCounts& counts)
{
    Room<SweptResult, kPairBatch> results;
    paths.collide(contacts, shapes, motions, results.data());

    const real dt = static_cast<real>(context.dt);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        Contact& contact = *contacts[i];
        const SweptResult& result = results[i];
        const Convex &a = shapes.convex(contact.shapeA), &b = shapes.convex(contact.shapeB);
        counts.exhausted += result.exhausted ? 1 : 0;
        adoptManifold(contact, result, real(0.3) * maximum(a.size, b.size));
        contact.swept =
            contact.atImpact || result.bends ||
            (contact.count == 0 && withinReach({a, paths.wayOf(contact.rowA)}, {b, paths.wayOf(contact.rowB)},
                                               contact.restGap, result.startGap, dt));
        contact.apart = result.apart;
        contact.versionA = motions.versions[contact.rowA];
        contact.versionB = motions.versions[contact.rowB];
        contact.between = motions.centers[contact.rowB].center - motions.centers[contact.rowA].center;
        counts.swept += contact.swept ? 1 : 0;
        if (result.placed)
            takePlaces(contact, result);
        else
            placeContact(contact, motions.rows[contact.rowA], motions.rows[contact.rowB]);
    }
}

}  // namespace

bool isTouching(const Contact& c, const Tuning& tuning)
{
    for (int i = 0; i < c.count; ++i)
        if (c.points[i].gap <= (tuning.touchingFactor - 1) * c.restGap) return true;
    return false;
}

Nearness nearnessOf(const Contact& c, const Tuning& tuning)
{
    bool linked = isTouching(c, tuning);
    for (int i = 0; i < c.count; ++i) linked = linked || c.points[i].normalImpulse > 0;
    return linked ? Nearness::Linked : c.count > 0 ? Nearness::Near : Nearness::Apart;
}

void noteFacts(ContactTable& table, std::size_t row, const Tuning& tuning)
{
    const Contact& c = table.rows[row];
    table.facts[row] = {c.rowA, c.rowB, c.versionA, c.versionB, c.between, kManifoldRoom * c.restGap,
                        c.swept};
    table.nearness[row] = nearnessOf(c, tuning);
}

void findRenewed(ContactTable& table, bool same, const MotionTable& motions, const StepContext& context,
                 ManifoldScratch& scratch, Parallel& parallel)
{
    const Table<Contact>& contacts = table.rows;
    Table<ContactFacts>& facts = table.facts;
    facts.reserve(contacts.capacity());
    facts.resize(contacts.size());
    table.nearness.reserve(contacts.capacity());
    table.nearness.resize(contacts.size());
    scratch.counts.assign(Parallel::chunksOf(contacts.size(), kPairBatch), {});
    scratch.renewed.reserve(contacts.capacity());
    scratch.renewed.resize(contacts.size());
    scratch.needed.assign(motions.rows.size(), 0);
    parallel.forEach(contacts.size(), kPairBatch, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            if (!same) noteFacts(table, k, context.tuning);
            const ContactFacts& of = facts[k];
            scratch.renewed[k] = keepsManifold(of, motions) ? 0 : 1;
            if (scratch.renewed[k] == 0) {
                ++scratch.counts[chunk.index].kept;
                continue;
            }
            for (const std::uint32_t row : {of.rowA, of.rowB})
                std::atomic_ref(scratch.needed[row]).store(1, std::memory_order_relaxed);
        }
    });
}

ManifoldCounts renewManifolds(ContactTable& table, const ShapeTable& shapes, const MotionTable& motions,
                              const StepContext& context, ExpectedPaths& paths, ManifoldScratch& scratch,
                              Parallel& parallel)
{
    Table<Contact>& contacts = table.rows;
    parallel.forEach(motions.rows.size(), kPairBatch, [&](const Chunk& chunk) {
        for (std::size_t row = chunk.begin; row < chunk.end; ++row)
            if (scratch.needed[row] != 0 && !paths.isReckoned(row))
                paths.reckon(row, motions.rows[row], true);
    });

    parallel.forEach(contacts.size(), kPairBatch, [&](const Chunk& chunk) {
        ManifoldCounts& counts = scratch.counts[chunk.index];
        if (counts.kept == chunk.end - chunk.begin) return;
        Contact* batch[kPairBatch];
        std::size_t count = 0;
        for (std::size_t k = chunk.begin; k < chunk.end; ++k)
            if (scratch.renewed[k] != 0) batch[count++] = &contacts[k];
        updateBatch({batch, count}, shapes, motions, context, paths, counts);
        for (std::size_t k = chunk.begin; k < chunk.end; ++k)
            if (scratch.renewed[k] != 0) noteFacts(table, k, context.tuning);
    });

    ManifoldCounts sum;
    for (const ManifoldCounts& counts : scratch.counts) {
        sum.kept += counts.kept;
        sum.swept += counts.swept;
        sum.exhausted += counts.exhausted;
    }
    return sum;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
