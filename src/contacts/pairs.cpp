// SPDX-License-Identifier: MIT
#include "contacts/pairs.hpp"

#include "contacts/mixing.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The rest gap is a part of the smaller width; what cannot move does not count, as a ground may be
// thinner than anything that rests on it.
real restGapOf(const ContactWorld& world, bool aDynamic, bool bDynamic, const Convex& a, const Convex& b)
{
    const real size = !aDynamic ? b.size : !bDynamic ? a.size : minimum(a.size, b.size);
    return world.restGap * size;
}

// What follows from the shapes as they are now: they may have been changed since the last step.
void refresh(const ContactWorld& world, Contact& contact)
{
    const ShapeRow& a = world.shapes.rows[contact.shapeA];
    const ShapeRow& b = world.shapes.rows[contact.shapeB];
    const Convex &ca = world.shapes.forms[a.form].convex, &cb = world.shapes.forms[b.form].convex;
    const Material& ma = world.shapes.surfaces[a.surface].material;
    const Material& mb = world.shapes.surfaces[b.surface].material;
    contact.rowA = world.motions.rowFor(a.body);
    contact.rowB = world.motions.rowFor(b.body);
    contact.radiusA = ca.radius;
    contact.radiusB = cb.radius;
    contact.restGap = restGapOf(world, world.bodies.rows[a.body].isDynamic(),
                                world.bodies.rows[b.body].isDynamic(), ca, cb);
    contact.friction =
        mixed(ma.friction, mb.friction, ma.frictionMixing, mb.frictionMixing, world.frictionRule);
    contact.restitution = mixed(ma.restitution, mb.restitution, ma.restitutionMixing, mb.restitutionMixing,
                                world.restitutionRule);
    contact.rolling =
        maximum(ma.rollingResistance, mb.rollingResistance) * maximum(contact.radiusA, contact.radiusB);
    // Both surfaces run counter-clockwise: A's along the tangent here, B's against it.
    contact.surfaceSpeed = -(ma.surfaceSpeed + mb.surfaceSpeed);
}

bool isBefore(const Contact& contact, const ShapePair& pair)
{
    return contact.shapeA != pair.a ? contact.shapeA < pair.a : contact.shapeB < pair.b;
}

bool isUncoupled(const UncoupledPairs& pairs, std::uint32_t a, std::uint32_t b)
{
    if (pairs.empty()) return false;
    return std::binary_search(pairs.begin(), pairs.end(), std::pair{minimum(a, b), maximum(a, b)});
}

}  // namespace

bool mayCollide(const ContactWorld& world, const ShapePair& pair)
{
    const ShapeRow& a = world.shapes.rows[pair.a];
    const ShapeRow& b = world.shapes.rows[pair.b];
    const ShapeTable& shapes = world.shapes;
    if (!shouldCollide(shapes.surfaces[a.surface].filter, shapes.surfaces[b.surface].filter)) return false;
    const bool canMove = world.bodies.rows[a.body].canMove() || world.bodies.rows[b.body].canMove();
    return canMove && !isUncoupled(world.uncoupled, a.body, b.body);
}

Contact makeContact(const ContactWorld& world, const ShapePair& pair)
{
    Contact contact;
    contact.shapeA = pair.a;
    contact.shapeB = pair.b;
    refresh(world, contact);
    return contact;
}

namespace {

// Brings the pairs of a chunk together with the old contacts that stand among them.
class Matching {
public:
    Matching(const ContactWorld& world, const std::vector<ShapePair>& pairs, const Table<Contact>& old,
             MatchScratch& scratch)
        : world_(world), pairs_(pairs), old_(old), scratch_(scratch)
    {
    }

    void count(const Chunk& chunk)
    {
        std::uint32_t count = 0;
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            scratch_.allowed[k] = mayCollide(world_, pairs_[k]) ? 1 : 0;
            count += scratch_.allowed[k];
        }
        scratch_.starts[chunk.index] = count;
    }

    void match(const Chunk& chunk)
    {
        std::size_t at = chunk.begin == 0 ? 0 : firstFrom(pairs_[chunk.begin]);
        const std::size_t end = chunk.end == pairs_.size() ? old_.size() : firstFrom(pairs_[chunk.end]);
        Contact* next = scratch_.matched.data() + scratch_.starts[chunk.index];
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            if (scratch_.allowed[k] == 0) continue;
            const ShapePair& pair = pairs_[k];
            for (; at < end && isBefore(old_[at], pair); ++at) leave(at);
            if (at < end && old_[at].shapeA == pair.a && old_[at].shapeB == pair.b) {
                scratch_.leaves[at] = 0;
                *next = old_[at++];
                refresh(world_, *next++);
            } else {
                *next++ = makeContact(world_, pair);
            }
        }
        for (; at < end; ++at) leave(at);
    }

    void leave(std::size_t i) { scratch_.leaves[i] = old_[i].touching ? 1 : 0; }

private:
    const ContactWorld& world_;
    const std::vector<ShapePair>& pairs_;
    const Table<Contact>& old_;
    MatchScratch& scratch_;

    std::size_t firstFrom(const ShapePair& pair) const
    {
        return static_cast<std::size_t>(std::lower_bound(old_.begin(), old_.end(), pair, isBefore) -
                                        old_.begin());
    }
};

}  // namespace

void matchPairs(const ContactWorld& world, const std::vector<ShapePair>& pairs, Table<Contact>& contacts,
                MatchScratch& scratch, Parallel& parallel)
{
    constexpr std::size_t kGrain = 256;
    Matching matching(world, pairs, contacts, scratch);
    scratch.allowed.resize(pairs.size());
    scratch.leaves.resize(contacts.size());
    scratch.starts.resize(Parallel::chunksOf(pairs.size(), kGrain));
    parallel.forEach(pairs.size(), kGrain, [&](const Chunk& chunk) { matching.count(chunk); });
    std::uint32_t total = 0;
    for (std::uint32_t& count : scratch.starts) count = (total += count) - count;

    // With room for those that are found in mid-step. The two take turns, so both are as large.
    Table<Contact>& matched = scratch.matched;
    const std::size_t room = pairs.size() + pairs.size() / 4 + 16;
    if (contacts.capacity() < room) contacts.reserve(room + room / 2);
    matched.reserve(contacts.capacity());
    scratch.left.clear();
    scratch.left.reserve(contacts.size() / 4 + 16);
    matched.resize(total);
    parallel.forEach(pairs.size(), kGrain, [&](const Chunk& chunk) { matching.match(chunk); });
    for (std::size_t i = 0; pairs.empty() && i < contacts.size(); ++i) matching.leave(i);
    for (std::size_t i = 0; i < contacts.size(); ++i)
        if (scratch.leaves[i] != 0) scratch.left.push_back(contacts[i]);
    contacts.swap(matched);
}

void sortContacts(Table<Contact>& contacts, MatchScratch& scratch)
{
    const auto before = [](const Contact& a, const Contact& b) { return isBefore(a, {b.shapeA, b.shapeB}); };
    const auto firstLate = std::is_sorted_until(contacts.begin(), contacts.end(), before);
    scratch.late.clear();
    scratch.late.reserve(contacts.capacity());
    for (auto c = firstLate; c != contacts.end(); ++c)
        scratch.late.push_back({{c->shapeA, c->shapeB}, static_cast<std::uint32_t>(c - contacts.begin())});
    std::sort(scratch.late.begin(), scratch.late.end());
    Table<Contact>& late = scratch.matched;
    late.clear();
    late.reserve(contacts.capacity());
    for (const auto& [pair, at] : scratch.late) late.push_back(contacts[at]);

    // Merged from the end: each moves once, and those before the first late one do not move at all.
    auto to = contacts.end(), from = firstLate;
    while (!late.empty()) {
        if (from != contacts.begin() && before(late.back(), *(from - 1))) {
            *--to = *--from;
        } else {
            *--to = late.back();
            late.pop_back();
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
