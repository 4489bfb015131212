// SPDX-License-Identifier: MIT
// What must hold of contacts, of those that sleep, of the order of solving, and of the events they raise.

#include "diagnostics/validate.hpp"

#include <tamias2d/math/scalar.hpp>

#include <limits>
#include <tuple>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Below it, products have few digits.
constexpr double kLeastNumber = std::numeric_limits<float>::min();

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

    faults.unit("normal", c.normal);
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
        faults.unit("normal", hit.normal);
        faults.that(isFiniteValue(hit.approachSpeed) && hit.approachSpeed > 0, "approachSpeed",
                    hit.approachSpeed, "must be finite and > 0 m/s");
        faults.range("restitution", hit.restitution, 0, 1, "must be in [0, 1]");
        faults.range("normalImpulse", hit.normalImpulse, 0, kAnyFinite, "must be finite and >= 0 N*s");
        faults.finite("tangentImpulse", hit.tangentImpulse);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
