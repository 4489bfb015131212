// SPDX-License-Identifier: MIT
#include "diagnostics/validate.hpp"

#include "geometry/validate.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <tuple>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Lengths that should be 1 are so to some rounding errors of a turn.
constexpr double kUnitError = 1e-4;
// Below it, products have few digits.
constexpr double kLeastNumber = std::numeric_limits<float>::min();

void validateMotion(const BodyRow& b, real lengthUnit, Faults& faults)
{
    // A center of mass lies at most some greatest sizes away from an origin at the edge of the world.
    const double most = (kMaxPosition + 4 * kMaxSize) * static_cast<double>(lengthUnit);
    faults.range("center.x", b.center.x, -most, most, "must be within the world");
    faults.range("center.y", b.center.y, -most, most, "must be within the world");
    faults.that(b.angle >= 0 && b.angle < kTwoPi, "angle", b.angle, "must be in [0, 2 pi)");
    const Rot rotation = Rot::ofAngle(b.angle);
    faults.that(rotation.c == b.rotation.c && rotation.s == b.rotation.s, "rotation", b.rotation.s,
                "must be that of the angle");
    faults.finite("velocity", b.velocity);
    faults.finite("spin", b.spin);
    const bool still = b.velocity == Vec2{} && b.spin == 0;
    faults.that(b.type != BodyType::Static || still, "velocity", b.velocity, "must be 0 of a static body");
}

void validateMover(const MoverRow& mover, Faults& faults)
{
    faults.finite("previousCenter", mover.previousCenter);
    faults.that(mover.previousAngle >= 0 && mover.previousAngle < kTwoPi, "previousAngle",
                mover.previousAngle, "must be in [0, 2 pi)");
    faults.finite("previousLocalCenter", mover.previousLocalCenter);
    faults.range("linearDamping", mover.linearDamping, 0, kAnyFinite, "must be finite and >= 0 1/s");
    faults.range("angularDamping", mover.angularDamping, 0, kAnyFinite, "must be finite and >= 0 1/s");
    faults.finite("gravityScale", mover.gravityScale);
}

void validateMassOf(const BodyRow& b, Faults& faults)
{
    faults.finite("localCenter", b.localCenter);
    if (!b.isDynamic()) return;
    faults.that(isFiniteValue(b.mass) && b.mass > 0, "mass", b.mass, "must be finite and > 0 kg");
    faults.that(isFiniteValue(b.inertia) && b.inertia >= 0, "inertia", b.inertia,
                "must be finite and >= 0 kg*m^2");
    faults.finite("invMass", b.invMass());
    faults.finite("invInertia", b.invInertia());
}

void validateExtra(const BodyExtra& extra, Faults& faults)
{
    for (const LastingForce& held : extra.lasting) {
        faults.finite("lasting.force", held.force);
        faults.finite("lasting.point", held.point);
        faults.finite("lasting.torque", held.torque);
    }
    faults.finite("gravity", extra.gravity.value_or(Vec2{}));
}

// The shapes of a body, one after the other and back to the first.
void validateRing(const ShapeList& list, std::uint32_t body, const ShapeTable& shapes,
                  std::vector<bool>& seen, Faults& faults)
{
    std::uint32_t shape = list.first;
    for (std::uint32_t i = 0; i < list.count; ++i) {
        const bool lives = shape < shapes.rows.size() && shapes.ids.isAlive(shape);
        faults.that(lives && shapes.rows[shape].body == body, "shapes", shape, "must be a live shape of it");
        if (!lives) return;
        faults.that(!seen[shape], "shapes", shape, "must be of one body, once");
        if (seen[shape]) return;
        seen[shape] = true;
        const std::uint32_t next = shapes.rows[shape].next;
        const bool tied = next < shapes.rows.size() && shapes.rows[next].previous == shape;
        faults.that(tied, "next", next, "must come after it");
        shape = next;
    }
    if (!list.empty()) faults.that(shape == list.first, "next", shape, "must lead back to the first");
}

// How many use each row of what shapes share.
template <class Table>
void validateUsers(const Table& table, const std::vector<std::uint32_t>& users, std::string_view name,
                   Faults& faults)
{
    std::size_t used = 0;
    for (std::uint32_t i = 0; i < table.slots(); ++i) {
        faults.at(name, i);
        faults.that(table.users(i) == users[i], "users", table.users(i), "must be the shapes that have it");
        used += users[i] > 0 ? 1 : 0;
    }
    faults.at(name, 0);
    faults.that(used == table.size(), "size", table.size(), "must be that of those in use");
}

void validateForm(const ShapeForm& form, std::uint32_t slot, Faults& faults)
{
    const Complaint wrong = checkGeometry("geometry", form.geometry);
    faults.that(!wrong, "def", slot, wrong ? std::string_view(wrong->what()) : std::string_view());

    const Convex& c = form.convex;
    faults.range("convex.count", c.count, 1, kMaxPolygonVertices, "must be in [1, 16]");
    faults.range("convex.radius", c.radius, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.range("convex.extent", c.extent, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.that(isFiniteValue(c.size) && c.size > 0, "convex.size", c.size, "must be finite and > 0 m");
    for (int i = 0; i < minimum(c.count, kMaxPolygonVertices); ++i) {
        const auto k = static_cast<std::size_t>(i);
        faults.finite("convex.vertices", c.vertices[k]);
        if (i >= c.faces()) continue;
        const double unit = static_cast<double>(length(c.normals[k]));
        faults.range("convex.normals", unit, 1 - kUnitError, 1 + kUnitError, "must have length 1");
    }
}

void validateSurface(const ShapeSurface& surface, Faults& faults)
{
    const Material& m = surface.material;
    faults.range("density", surface.density, 0, kAnyFinite, "must be finite and >= 0 kg/m^2");
    faults.range("material.friction", m.friction, 0, kAnyFinite, "must be >= 0");
    faults.range("material.restitution", m.restitution, 0, 1, "must be in [0, 1]");
    faults.range("material.rollingResistance", m.rollingResistance, 0, kAnyFinite, "must be >= 0");
}

}  // namespace

void validateBodies(const BodyTable& bodies, const ShapeTable& shapes, real lengthUnit, Faults& faults)
{
    validateIds(bodies.ids, "bodies", bodies.rows.size(), faults);
    std::size_t owned = 0, movers = 0, extras = 0;
    std::vector<bool> seen(shapes.rows.size(), false);
    for (std::uint32_t slot = 0; slot < bodies.rows.size(); ++slot) {
        const BodyRow& b = bodies.rows[slot];
        faults.at("bodies", slot);
        if (!bodies.ids.isAlive(slot)) {
            faults.that(b.shapes.empty(), "shapes", b.shapes.size(), "must be none of a dead body");
            faults.that(b.mover == BodyRow::kNone && b.extra == BodyRow::kNone, "mover", b.mover,
                        "must be none of a dead body");
            continue;
        }
        const auto type = static_cast<int>(b.type);
        faults.that(type >= 0 && type <= 2, "type", type, "must be Static, Kinematic or Dynamic");
        validateMotion(b, lengthUnit, faults);
        validateMassOf(b, faults);
        faults.that(b.type == BodyType::Static || b.mover != BodyRow::kNone, "mover", b.mover,
                    "must be one unless it is static");
        validateMover(bodies.mover(b), faults);
        validateExtra(bodies.extra(b), faults);
        movers += b.mover != BodyRow::kNone ? 1 : 0;
        extras += b.extra != BodyRow::kNone ? 1 : 0;
        owned += b.shapes.size();
        validateRing(b.shapes, slot, shapes, seen, faults);
    }
    faults.at("bodies", 0);
    faults.that(movers == bodies.movers.size(), "movers", bodies.movers.size(), "must be of one body each");
    faults.that(extras == bodies.extras.size(), "extras", bodies.extras.size(), "must be of one body each");
    faults.at("shapes", 0);
    faults.that(owned == shapes.ids.alive(), "owned", owned, "must be all live shapes");
}

void validateShapes(const ShapeTable& shapes, const BodyTable& bodies, Faults& faults)
{
    validateIds(shapes.ids, "shapes", shapes.rows.size(), faults);
    std::vector<std::uint32_t> formUsers(shapes.forms.slots(), 0), surfaceUsers(shapes.surfaces.slots(), 0);
    for (std::uint32_t slot = 0; slot < shapes.rows.size(); ++slot) {
        const ShapeRow& s = shapes.rows[slot];
        faults.at("shapes", slot);
        if (!shapes.ids.isAlive(slot)) {
            faults.that(s.form == BodyRow::kNone && s.surface == BodyRow::kNone, "form", s.form,
                        "must be none of a dead shape");
            continue;
        }
        faults.that(s.body < bodies.rows.size() && bodies.ids.isAlive(s.body), "body", s.body,
                    "must be a live body");
        const bool hasBoth = s.form < formUsers.size() && s.surface < surfaceUsers.size();
        faults.that(hasBoth, "form", s.form, "must be one that there is");
        if (!hasBoth) continue;
        if (formUsers[s.form]++ == 0) validateForm(shapes.forms[s.form], slot, faults);
        if (surfaceUsers[s.surface]++ == 0) validateSurface(shapes.surfaces[s.surface], faults);
    }
    validateUsers(shapes.forms, formUsers, "forms", faults);
    validateUsers(shapes.surfaces, surfaceUsers, "surfaces", faults);
}

namespace {

void validateJointState(const JointRow& j, Faults& faults)
{
    faults.that(!j.broken || !j.def.enabled, "broken", j.broken, "must not be of a joint that is enabled");
    faults.range("stiffSteps", j.stiffSteps, 0, 1000, "must be in [0, 1000]");
    faults.finite("angle", j.angle);
    faults.finite("angleA", j.angleA);
    faults.finite("notch", j.notch);
    for (const CountedAngle& angle : j.angles) faults.finite("angles", angle.now - angle.start);
    for (const real impulse : j.impulses) faults.finite("impulses", impulse);
    for (int i = JointSlot::kLower; i < JointSlot::kLower + JointSlot::kLimits; ++i)
        faults.that(j.impulses[i] >= 0, "impulses", j.impulses[i], "must not pull of a limit");
    faults.finite("stepImpulse", j.stepImpulse);
    faults.finite("stepTurn", j.stepTurn);
    faults.finite("stepWork", j.stepWork);
}

}  // namespace

void validateJoints(const JointTable& joints, const BodyTable& bodies, Faults& faults)
{
    validateIds(joints.ids, "joints", joints.rows.size(), faults);
    faults.that(joints.ofBody.size() <= bodies.rows.size(), "ofBody", joints.ofBody.size(),
                "must be one list a body at most");
    const auto timesListed = [&](std::uint32_t body, std::uint32_t joint) {
        if (body >= joints.ofBody.size()) return std::ptrdiff_t{0};
        return std::count(joints.ofBody[body].begin(), joints.ofBody[body].end(), joint);
    };
    std::size_t places = 0;
    for (std::uint32_t slot = 0; slot < joints.rows.size(); ++slot) {
        if (!joints.ids.isAlive(slot)) continue;
        const JointRow& j = joints.rows[slot];
        faults.at("joints", slot);
        const auto validateBody = [&](BodyId id, std::uint32_t body) {
            faults.that(bodies.ids.owns(id) && id.index == body, "body", body, "must be a live body");
            faults.that(timesListed(body, slot) == 1, "ofBody", body, "must list it once");
        };
        validateBody(j.def.bodyA, j.bodyA);
        validateBody(j.def.bodyB, j.bodyB);
        faults.that(j.more.size() == j.def.moreBodies.size(), "more", j.more.size(), "must be as many");
        for (std::size_t k = 0; k < minimum(j.more.size(), j.def.moreBodies.size()); ++k)
            validateBody(j.def.moreBodies[k], j.more[k]);
        const auto* const own = std::get_if<OwnJoint>(&j.def.kind);
        faults.that((j.bodyA == j.bodyB) == (own && own->bodies() == 1), "body", j.bodyB,
                    "must be another one");
        std::size_t count = 0;
        j.eachBody([&](std::uint32_t) { ++count; });
        faults.that(j.angles.size() == (own ? count : 0), "angles", j.angles.size(),
                    "must be one for each body of a joint of one's own");
        places += count;
        validateJointState(j, faults);
    }
    std::size_t listed = 0;
    for (const std::vector<std::uint32_t>& list : joints.ofBody) listed += list.size();
    faults.at("joints", 0);
    faults.that(listed == places, "ofBody", listed, "must be one for each body of each live joint");
}

namespace {

void validateContact(const Contact& c, Faults& faults)
{
    faults.range("count", c.count, 0, 2, "must be in [0, 2]");
    faults.that(!c.touching || c.count > 0, "touching", c.count, "must not be without a point");
    faults.that(isFiniteValue(c.restGap) && c.restGap > 0, "restGap", c.restGap, "must be finite and > 0 m");
    faults.range("friction", c.friction, 0, kAnyFinite, "must be finite and >= 0");
    faults.range("restitution", c.restitution, 0, 1, "must be in [0, 1]");
    faults.range("rolling", c.rolling, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.range("radiusA", c.radiusA, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.range("radiusB", c.radiusB, 0, kAnyFinite, "must be finite and >= 0 m");
    faults.finite("rollingImpulse", c.rollingImpulse);
    faults.finite("stepImpulse", c.stepImpulse);
    if (c.count < 1 || c.count > 2) return;

    const double unit = static_cast<double>(length(c.normal));
    faults.range("normal", unit, 1 - kUnitError, 1 + kUnitError, "must have length 1");
    for (int i = 0; i < c.count; ++i) {
        const ContactPointRow& p = c.points[i];
        faults.finite("points.localA", p.anchor.localA);
        faults.finite("points.localB", p.anchor.localB);
        faults.finite("points.armA", p.armA);
        faults.finite("points.armB", p.armB);
        faults.finite("points.gap", p.gap);
        faults.range("points.normalImpulse", p.normalImpulse, 0, kAnyFinite, "must be finite and >= 0 N*s");
        const double cone =
            1.0001 * static_cast<double>(c.friction) * static_cast<double>(p.normalImpulse) + kLeastNumber;
        faults.range("points.tangentImpulse", p.tangentImpulse, -cone, cone,
                     "must be within friction times the normal impulse");
        faults.finite("points.stepNormal", p.stepNormal);
        faults.finite("points.stepTangent", p.stepTangent);
    }
}

}  // namespace

void validateContacts(std::span<const Contact> contacts, bool sorted, const ShapeTable& shapes,
                      Faults& faults)
{
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const Contact& c = contacts[i];
        faults.at("contacts", i);
        faults.that(c.shapeA < c.shapeB, "shapeA", c.shapeA, "must be below shapeB");
        const auto lives = [&](std::uint32_t s) { return s < shapes.rows.size() && shapes.ids.isAlive(s); };
        faults.that(lives(c.shapeA), "shapeA", c.shapeA, "must be a live shape");
        faults.that(lives(c.shapeB), "shapeB", c.shapeB, "must be a live shape");
        if (lives(c.shapeA) && lives(c.shapeB))
            faults.that(shapes.rows[c.shapeA].body != shapes.rows[c.shapeB].body, "shapeB", c.shapeB,
                        "must be of another body than shapeA");
        if (i > 0 && sorted) {
            const Contact& before = contacts[i - 1];
            faults.that(std::tie(before.shapeA, before.shapeB) < std::tie(c.shapeA, c.shapeB), "shapeB",
                        c.shapeB, "must come after the pair before, in order of slots");
        }
        validateContact(c, faults);
    }
}

void validateSleep(const SleepTable& asleep, const BodyTable& bodies, const ShapeTable& shapes,
                   Faults& faults)
{
    std::uint32_t sleepers = 0, touching = 0;
    for (std::uint32_t number = 0; number < asleep.groups.size(); ++number) {
        const SleepGroup& group = asleep.groups[number];
        const auto isMember = [&](std::uint32_t body) { return bodies.rows[body].group == number; };
        validateContacts(group.contacts, true, shapes, faults);
        faults.at("sleep groups", number);
        sleepers += static_cast<std::uint32_t>(group.bodies.size());
        for (const std::uint32_t body : group.bodies) {
            const bool lives = body < bodies.rows.size() && bodies.ids.isAlive(body);
            faults.that(lives, "bodies", body, "must be live bodies");
            if (!lives) continue;
            faults.that(isMember(body), "bodies", body, "must know their group");
            faults.that(!bodies.rows[body].hasVelocity(), "bodies", body, "must be still");
            faults.that(!bodies.rows[body].takesPart, "bodies", body, "must take no part in steps");
        }
        for (const Contact& c : group.contacts) {
            touching += c.touching ? 1 : 0;
            const std::uint32_t a = shapes.rows[c.shapeA].body, b = shapes.rows[c.shapeB].body;
            faults.that(isMember(a) || isMember(b), "contacts", c.shapeA, "must be of a body of the group");
            faults.that(isMember(a) || !bodies.rows[a].canMove(), "contacts", a,
                        "must lead to none that moves");
            faults.that(isMember(b) || !bodies.rows[b].canMove(), "contacts", b,
                        "must lead to none that moves");
        }
    }
    faults.at("sleep groups", 0);
    faults.that(sleepers == asleep.bodies, "all bodies", sleepers, "must be counted");
    faults.that(touching == asleep.touching, "all touching", touching, "must be counted");
    for (std::uint32_t body = 0; body < bodies.rows.size(); ++body) {
        if (bodies.ids.isAlive(body) && bodies.rows[body].isAsleep()) --sleepers;
    }
    faults.that(sleepers == 0, "sleeping bodies", sleepers, "must each be in their group");
}

void validateOrder(const ContactTable& contacts, const MotionTable& motions, Faults& faults)
{
    const std::vector<std::uint32_t>& order = contacts.order;
    faults.at("order", 0);
    faults.that(order.size() == contacts.rows.size(), "size", order.size(), "must be that of the contacts");
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<bool> placed(contacts.rows.size(), false);
    std::vector<std::uint32_t> colorOf(motions.rows.size(), kNone);  // by row: the last one it was seen in
    std::uint32_t color = 0;
    for (std::size_t place = 0; place < order.size(); ++place) {
        const std::uint32_t i = order[place];
        faults.at("order", place);
        const bool first = i < placed.size() && !placed[i];
        faults.that(first, "contact", i, "must be each contact, once");
        if (!first) continue;
        placed[i] = true;

        while (color < contacts.colorEnds.size() && place >= contacts.colorEnds[color]) ++color;
        const Contact& c = contacts.rows[i];
        const std::size_t most = maximum(c.rowA, c.rowB);
        faults.that(most < motions.rows.size(), "row", most, "must be a row of the last step");
        if (most >= motions.rows.size() || color + 1 >= contacts.colorEnds.size()) continue;
        for (const std::uint32_t row : {c.rowA, c.rowB}) {
            if (!motions.rows[row].moves()) continue;
            faults.that(colorOf[row] != color, "color", color, "must have no two contacts of a body");
            colorOf[row] = color;
        }
    }
}

namespace {

void validateTouches(std::span<const TouchEvent> events, std::string_view name, Faults& faults)
{
    for (std::size_t i = 0; i < events.size(); ++i) {
        faults.at(name, i);
        faults.that(!events[i].shapeA.isNull() && !events[i].shapeB.isNull(), "shapeA",
                    events[i].shapeA.index, "must not be null");
        if (i == 0) continue;
        // By slots: a pair that ended and was made anew in its slots may have ended twice.
        const auto before = std::pair(events[i - 1].shapeA.index, events[i - 1].shapeB.index);
        faults.that(before <= std::pair(events[i].shapeA.index, events[i].shapeB.index), "shapeA",
                    events[i].shapeA.index, "must be in order of shapes");
    }
}

}  // namespace

void validateEvents(const StepEvents& events, Faults& faults)
{
    validateTouches(events.begins, "begins", faults);
    validateTouches(events.ends, "ends", faults);
    for (std::size_t i = 0; i < events.hits.size(); ++i) {
        const HitEvent& hit = events.hits[i];
        faults.at("hits", i);
        faults.finite("time", hit.time);
        faults.that(i == 0 || events.hits[i - 1].time <= hit.time, "time", hit.time, "must be in order");
        faults.finite("point", hit.point);
        const double unit = static_cast<double>(length(hit.normal));
        faults.range("normal", unit, 1 - kUnitError, 1 + kUnitError, "must have length 1");
        faults.that(isFiniteValue(hit.approachSpeed) && hit.approachSpeed > 0, "approachSpeed",
                    hit.approachSpeed, "must be finite and > 0 m/s");
        faults.range("restitution", hit.restitution, 0, 1, "must be in [0, 1]");
        faults.range("normalImpulse", hit.normalImpulse, 0, kAnyFinite, "must be finite and >= 0 N*s");
        faults.finite("tangentImpulse", hit.tangentImpulse);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
