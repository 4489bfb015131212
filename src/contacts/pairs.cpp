// SPDX-License-Identifier: MIT
#include "contacts/pairs.hpp"

#include "contacts/mixing.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The rest gap is a part of the smaller width; what cannot move does not count, as a ground may be
// thinner than anything that rests on it.
real restGapOf(const ContactWorld& world, const ShapeRow& a, const ShapeRow& b)
{
    const bool aDynamic = world.bodies.rows[a.body].isDynamic();
    const bool bDynamic = world.bodies.rows[b.body].isDynamic();
    const real size = !aDynamic   ? b.convex.size
                      : !bDynamic ? a.convex.size
                                  : minimum(a.convex.size, b.convex.size);
    return world.restGap * size;
}

// What follows from the shapes as they are now: they may have been changed since the last step.
void refresh(const ContactWorld& world, Contact& contact)
{
    const ShapeRow& a = world.shapes.rows[contact.shapeA];
    const ShapeRow& b = world.shapes.rows[contact.shapeB];
    const Material &ma = a.def.material, &mb = b.def.material;
    contact.rowA = world.motions.rowFor(a.body);
    contact.rowB = world.motions.rowFor(b.body);
    contact.radiusA = a.convex.radius;
    contact.radiusB = b.convex.radius;
    contact.restGap = restGapOf(world, a, b);
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
    if (!shouldCollide(a.def.filter, b.def.filter)) return false;
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

void matchPairs(const ContactWorld& world, const std::vector<ShapePair>& pairs,
                std::vector<Contact>& contacts, MatchScratch& scratch)
{
    std::vector<Contact>& matched = scratch.matched;
    matched.clear();
    // With room for those that are found in mid-step. The two take turns, so both are as large.
    const std::size_t room = pairs.size() + pairs.size() / 4 + 16;
    if (contacts.capacity() < room) contacts.reserve(room + room / 2);
    matched.reserve(contacts.capacity());
    scratch.left.clear();
    scratch.left.reserve(contacts.size() / 4 + 16);
    const auto leave = [&](const Contact& contact) {
        if (contact.touching) scratch.left.push_back(contact);
    };
    std::size_t old = 0;
    for (const ShapePair& pair : pairs) {
        if (!mayCollide(world, pair)) continue;
        for (; old < contacts.size() && isBefore(contacts[old], pair); ++old) leave(contacts[old]);
        if (old < contacts.size() && contacts[old].shapeA == pair.a && contacts[old].shapeB == pair.b) {
            matched.push_back(contacts[old++]);
            refresh(world, matched.back());
        } else {
            matched.push_back(makeContact(world, pair));
        }
    }
    for (; old < contacts.size(); ++old) leave(contacts[old]);
    contacts.swap(matched);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
