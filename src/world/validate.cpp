// SPDX-License-Identifier: MIT
// Looks at everything a world owns: diagnostics/validate.hpp has the rules of each table, here are those that
// join several. Nothing is changed.

#include "diagnostics/validate.hpp"
#include "contacts/rows.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Mass, inertia and center of a body are what its shapes make of it, unless they were set by hand.
void validateMass(const BodyRow& b, const MassSum& sum, Faults& faults)
{
    if (b.massIsSet || b.massIsStale) return;
    faults.that(b.mass == (sum.mass > 0 ? static_cast<real>(sum.mass) : real(1)), "mass", b.mass,
                "must be that of its shapes");
    faults.that(b.inertia == static_cast<real>(sum.inertia), "inertia", b.inertia,
                "must be that of its shapes");
    faults.that(b.localCenter == toVec2(sum.center), "localCenter", b.localCenter,
                "must be that of its shapes");
}

// What the solver sees of a shape is its geometry about the center of mass.
void validateConvex(const ShapeForm& s, Vec2 center, Faults& faults)
{
    const Convex anew = makeConvex(s.geometry, s.offset, Rot::ofAngle(wrapAngle(s.angle)), center);
    faults.that(anew.count == s.convex.count && anew.radius == s.convex.radius &&
                    anew.extent == s.convex.extent && anew.vertices[0] == s.convex.vertices[0],
                "convex.extent", s.convex.extent, "must be that of its geometry about the center of mass");
}

// What the setters let pass is what creation would.
void validateJointDef(const JointDef& def, std::size_t slot, real lengthUnit, Faults& faults)
{
    faults.at("joints", slot);
    for (const Complaint& wrong : {check(def.kind, lengthUnit), check(def.breaking)})
        faults.that(!wrong, "def", slot, wrong ? std::string_view(wrong->what()) : std::string_view());
}

void validateLaws(const std::vector<PlacedLaw>& laws, const IdPool<ForceLawId>& ids, const BodyTable& bodies,
                  Faults& faults)
{
    validateIds(ids, "laws", ids.slots(), faults);
    faults.that(laws.size() == ids.alive(), "count", laws.size(), "must be that of their live ids");
    for (std::size_t i = 0; i < laws.size(); ++i) {
        faults.at("laws", i);
        faults.that(ids.owns(laws[i].id), "id", laws[i].id.index, "must be alive");
        faults.that(laws[i].body.isNull() || bodies.ids.owns(laws[i].body), "body", laws[i].body.index,
                    "must be alive, or null for all");
        faults.that(static_cast<bool>(laws[i].law.force), "force", i, "must be a function");
    }
}

// Contacts that the next step will take as they are must be as it would make them.
void validateKept(const ContactTable& contacts, const ContactWorld& world, Faults& faults)
{
    for (std::size_t i = 0; i < contacts.rows.size(); ++i) {
        const Contact& c = contacts.rows[i];
        const ShapePair pair{c.shapeA, c.shapeB};
        const Contact anew = makeContact(world, pair);
        faults.at("contacts", i);
        faults.that(mayCollide(world, pair), "shapeB", c.shapeB, "must be one that may collide with shapeA");
        faults.that(c.radiusA == anew.radiusA && c.radiusB == anew.radiusB && c.restGap == anew.restGap,
                    "restGap", c.restGap, "must be that of the shapes");
        faults.that(c.friction == anew.friction && c.restitution == anew.restitution &&
                        c.rolling == anew.rolling && c.surfaceSpeed == anew.surfaceSpeed,
                    "friction", c.friction, "and all else must be that of the materials");
        if (i >= contacts.loads.size()) continue;
        const ContactLoad load = loadOf(c);
        faults.that(contacts.loads[i].impulse == load.impulse, "impulse", contacts.loads[i].impulse,
                    "must be what the points carry");
    }
}

}  // namespace

void World::Impl::validate(Faults& faults) const
{
    faults.at("world", id);
    faults.that(isFiniteValue(time) && time >= 0, "time", time, "must be finite and >= 0 s");
    validateBodies(bodies, shapes, settings.lengthUnit, faults);
    validateShapes(shapes, bodies, faults);
    for (std::uint32_t slot = 0; slot < bodies.rows.size(); ++slot) {
        if (!bodies.ids.isAlive(slot)) continue;
        const BodyRow& b = bodies.rows[slot];
        faults.at("bodies", slot);
        validateMass(b, massOfShapes(b), faults);
        faults.at("shapes of body", slot);
        for (const std::uint32_t s : shapes.of(b)) validateConvex(shapes.form(s), b.localCenter, faults);
    }
    validateLaws(laws, lawIds, bodies, faults);
    validateJoints(joints, bodies, faults);
    for (std::uint32_t slot = 0; slot < joints.rows.size(); ++slot)
        if (joints.ids.isAlive(slot))
            validateJointDef(joints.rows[slot].def, slot, settings.lengthUnit, faults);
    validateContacts(contacts.rows, contactsAreSorted, shapes, faults);
    if (pairsAreCurrent && !uncoupledIsStale) validateKept(contacts, contactWorld(), faults);
    validateSleep(asleep, bodies, shapes, faults);
    // A shape destroyed and a group fallen asleep take the order with them; contacts that came in mid-step,
    // or have woken since, are not in it.
    const bool asTheStepLeftIt = contactsAreSorted && roused.empty() && report.repaired == 0;
    if (!contacts.order.empty() && asTheStepLeftIt) validateOrder(contacts, motions, faults);
    validateEvents({begins, ends, hits}, faults);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
