// SPDX-License-Identifier: MIT
// A sound set of tables has no fault; spoil one entry, and it is told by table, row, field and rule.
#include "diagnostics/validate.hpp"

#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace tamias2d {
namespace {

constexpr real kNan = std::numeric_limits<real>::quiet_NaN();

// A ball on each of two others, all in one row: three bodies of a shape each, two contacts.
struct Tables {
    BodyTable bodies{1};
    ShapeTable shapes{1};
    ContactTable contacts;
    JointTable joints{1};
    MotionTable motions;
    std::vector<TouchEvent> begins;
    std::vector<HitEvent> hits;

    Tables()
    {
        for (std::uint32_t i = 0; i < 4; ++i) addBall(i);
        bodies.ids.giveBack(3);  // a free slot
        shapes.unlink(bodies.rows[3].shapes, 3);
        shapes.clear(3);
        shapes.ids.giveBack(3);
        bodies.clear(bodies.rows[3]);
        addContact(0, 1, 0);
        addContact(1, 2, 1);
        contacts.colorEnds = {1, 2, 2};
        addJoint(0, 1);
        addJoint(1, 2);
        begins = {touch(0, 1), touch(1, 2)};
        hits.resize(2);
        for (HitEvent& hit : hits) {
            hit.normal = {1, 0};
            hit.approachSpeed = 1;
        }
        hits[1].time = 2;
    }

    std::vector<std::string> faults() const
    {
        Faults faults;
        validateBodies(bodies, shapes, 1, faults);
        validateShapes(shapes, bodies, faults);
        validateContacts(contacts.rows, true, shapes, faults);
        validateJoints(joints, bodies, faults);
        validateOrder(contacts, motions, faults);
        validateEvents({begins, {}, hits}, faults);
        return faults.found();
    }

private:
    void addBall(std::uint32_t i)
    {
        bodies.ids.take();
        shapes.ids.take();
        BodyRow& b = bodies.rows.emplace_back();
        b.center = {real(1.001) * static_cast<real>(i), 0};
        b.mass = b.inertia = 1;
        bodies.moverFor(b);
        shapes.rows.emplace_back().body = i;
        shapes.setForm(i, Circle{{}, real(0.5)}, {}, 0, {});
        shapes.setSurface(i, {});
        shapes.link(b.shapes, i);
        if (i == 3) return;
        Motion m;
        m.body = i;
        m.invMass = {1, 1};
        motions.rows.push_back(m);
        motions.rowOf.push_back(i);
    }

    void addContact(std::uint32_t a, std::uint32_t b, std::uint32_t place)
    {
        Contact c;
        c.shapeA = c.rowA = a;
        c.shapeB = c.rowB = b;
        c.normal = {1, 0};
        c.count = 1;
        c.restGap = real(0.001);
        c.friction = real(0.5);
        c.touching = true;
        c.points[0].normalImpulse = 2;
        c.points[0].tangentImpulse = 1;
        contacts.rows.push_back(c);
        contacts.order.push_back(place);
    }

    void addJoint(std::uint32_t a, std::uint32_t b)
    {
        const JointId id = joints.ids.take();
        JointRow& j = joints.rows.emplace_back();
        j.def.bodyA = bodies.ids.id(a);
        j.def.bodyB = bodies.ids.id(b);
        j.bodyA = a;
        j.bodyB = b;
        joints.ofBody.resize(4);
        joints.ofBody[a].push_back(id.index);
        joints.ofBody[b].push_back(id.index);
    }

    TouchEvent touch(std::uint32_t a, std::uint32_t b) const
    {
        return {shapes.ids.id(a), shapes.ids.id(b), bodies.ids.id(a), bodies.ids.id(b)};
    }
};

TEST(Validate, FindsNothingInSoundTables)
{
    TRACES("R4", "ADR4");
    for (const std::string& fault : Tables().faults()) ADD_FAILURE() << fault;
}

struct Spoiled {
    const char* told;
    std::function<void(Tables&)> spoil;
};

void expectTold(const std::vector<Spoiled>& cases)
{
    for (const Spoiled& one : cases) {
        Tables tables;
        one.spoil(tables);
        std::string all;
        for (const std::string& fault : tables.faults()) all += fault + "\n";
        EXPECT_NE(all.find(one.told), std::string::npos) << "wanted: " << one.told << "\ntold: " << all;
    }
}

TEST(Validate, TellsWhatIsWrongWithBodies)
{
    TRACES("R4", "ADR4");
    expectTold({
        {"bodies[1].velocity = (nan, 0): must be finite",
         [](Tables& t) { t.bodies.rows[1].velocity.x = kNan; }},
        {"bodies[1].spin", [](Tables& t) { t.bodies.rows[1].spin = kNan; }},
        {"bodies[2].center.x = 2e+09: must be within the world",
         [](Tables& t) { t.bodies.rows[2].center.x = 2e9; }},
        {"bodies[0].angle = 7: must be in [0, 2 pi)", [](Tables& t) { t.bodies.rows[0].angle = 7; }},
        {"bodies[0].rotation", [](Tables& t) { t.bodies.rows[0].angle = 1; }},
        {"bodies[0].mass = 0: must be finite and > 0 kg", [](Tables& t) { t.bodies.rows[0].mass = 0; }},
        {"bodies[0].inertia = -1", [](Tables& t) { t.bodies.rows[0].inertia = -1; }},
        {"bodies[0].linearDamping = -1", [](Tables& t) { t.bodies.movers[0].linearDamping = -1; }},
        {"bodies[0].velocity = (1, 0): must be 0 of a static body",
         [](Tables& t) {
             t.bodies.rows[0].type = BodyType::Static;
             t.bodies.rows[0].velocity.x = 1;
         }},
        {"bodies[0].type = 3", [](Tables& t) { t.bodies.rows[0].type = static_cast<BodyType>(3); }},
        {"bodies[0].shapes = 0: must be of one body, once",
         [](Tables& t) { t.bodies.rows[0].shapes.count = 2; }},
        {"bodies[0].shapes = 1: must be a live shape of it",
         [](Tables& t) { t.bodies.rows[0].shapes.first = 1; }},
        {"bodies[0].shapes = 9: must be a live shape of it",
         [](Tables& t) { t.bodies.rows[0].shapes.first = 9; }},
        {"bodies[0].next = 1: must come after it", [](Tables& t) { t.shapes.rows[0].next = 1; }},
        {"bodies[0].mover = 4294967295: must be one unless it is static",
         [](Tables& t) { t.bodies.rows[0].mover = BodyRow::kNone; }},
        {"bodies[0].movers = 3: must be of one body each",
         [](Tables& t) { t.bodies.rows[0].mover = BodyRow::kNone; }},
        {"bodies[0].extras = 1: must be of one body each", [](Tables& t) { t.bodies.extras.take(); }},
        {"bodies[3].shapes = 1: must be none of a dead body",
         [](Tables& t) { t.bodies.rows[3].shapes = {0, 1}; }},
        {"bodies[0].rows = 3: must be as many as there are slots",
         [](Tables& t) { t.bodies.rows.pop_back(); }},
    });
}

TEST(Validate, TellsWhatIsWrongWithShapes)
{
    TRACES("R4", "ADR4");
    expectTold({
        {"shapes[0].owned = 2: must be all live shapes", [](Tables& t) { t.bodies.rows[1].shapes = {}; }},
        {"shapes[1].body = 3: must be a live body", [](Tables& t) { t.shapes.rows[1].body = 3; }},
        {"shapes[0].convex.size = 0: must be finite and > 0 m",
         [](Tables& t) { t.shapes.forms.spoil(0).convex.size = 0; }},
        {"shapes[0].convex.count = 0", [](Tables& t) { t.shapes.forms.spoil(0).convex.count = 0; }},
        {"shapes[0].convex.vertices", [](Tables& t) { t.shapes.forms.spoil(0).convex.vertices[0].x = kNan; }},
        {"geometry.radius = -1", [](Tables& t) { t.shapes.forms.spoil(0).geometry = Circle{{}, -1}; }},
        {"shapes[0].material.restitution = 2",
         [](Tables& t) { t.shapes.surfaces.spoil(0).material.restitution = 2; }},
        {"shapes[1].form = 4294967295: must be one that there is",
         [](Tables& t) { t.shapes.rows[1].form = BodyRow::kNone; }},
        {"forms[0].users = 3: must be the shapes that have it",
         [](Tables& t) { t.shapes.rows[1].form = BodyRow::kNone; }},
        {"surfaces[1].users = 1: must be the shapes that have it",
         [](Tables& t) {
             std::uint32_t none = t.shapes.rows[1].surface;
             t.shapes.setSurface(1, {2, {}, {}});
             t.shapes.rows[1].surface = none;
         }},
        {"convex.normals = 0: must have length 1",
         [](Tables& t) {
             t.shapes.setForm(1, makeBox(1, 1), {}, 0, {});
             t.shapes.forms.spoil(t.shapes.rows[1].form).convex.normals[2] = {};
         }},
    });
}

TEST(Validate, TellsWhatIsWrongWithJoints)
{
    TRACES("LC3", "R4", "ADR4");
    expectTold({
        {"joints[1].body = 3: must be a live body", [](Tables& t) { t.joints.rows[1].bodyB = 3; }},
        {"joints[1].body = 2: must be a live body",
         [](Tables& t) { t.joints.rows[1].def.bodyB = t.bodies.ids.id(0); }},
        {"joints[1].body = 1: must be another one", [](Tables& t) { t.joints.rows[1].bodyB = 1; }},
        {"joints[0].ofBody = 0: must list it once", [](Tables& t) { t.joints.ofBody[0].clear(); }},
        {"joints[0].ofBody = 0: must list it once", [](Tables& t) { t.joints.ofBody[0].push_back(0); }},
        {"joints[0].ofBody = 5: must be one for each body of each live joint",
         [](Tables& t) { t.joints.ofBody[2].push_back(7); }},
        {"ofBody = 5: must be one list a body at most", [](Tables& t) { t.joints.ofBody.resize(5); }},
        {"joints[0].angle = nan: must be finite", [](Tables& t) { t.joints.rows[0].angle = kNan; }},
        {"joints[0].notch", [](Tables& t) { t.joints.rows[0].notch = kNan; }},
        {"joints[0].impulses", [](Tables& t) { t.joints.rows[0].impulses[0] = kNan; }},
        {"joints[1].impulses = -1: must not pull of a limit",
         [](Tables& t) { t.joints.rows[1].impulses[JointSlot::kUpper] = -1; }},
        {"joints[0].broken = 1: must not be of a joint that is enabled",
         [](Tables& t) { t.joints.rows[0].broken = true; }},
    });
}

TEST(Validate, TellsWhatIsWrongWithContacts)
{
    TRACES("R7", "ADR4");
    expectTold({
        {"contacts[1].shapeB = 1: must come after the pair before",
         [](Tables& t) { std::swap(t.contacts.rows[0], t.contacts.rows[1]); }},
        {"contacts[1].shapeB = 1: must come after",
         [](Tables& t) { t.contacts.rows[1] = t.contacts.rows[0]; }},
        {"contacts[0].shapeA = 1: must be below shapeB",
         [](Tables& t) { std::swap(t.contacts.rows[0].shapeA, t.contacts.rows[0].shapeB); }},
        {"contacts[1].shapeB = 3: must be a live shape", [](Tables& t) { t.contacts.rows[1].shapeB = 3; }},
        {"contacts[1].shapeB = 2: must be of another body", [](Tables& t) { t.shapes.rows[2].body = 1; }},
        {"contacts[0].normal = 2: must have length 1", [](Tables& t) { t.contacts.rows[0].normal.x = 2; }},
        {"contacts[0].count = 3", [](Tables& t) { t.contacts.rows[0].count = 3; }},
        {"contacts[0].touching = 0", [](Tables& t) { t.contacts.rows[0].count = 0; }},
        {"contacts[0].points.normalImpulse = -1",
         [](Tables& t) { t.contacts.rows[0].points[0].normalImpulse = -1; }},
        {"contacts[0].points.tangentImpulse = 1: must be within friction",
         [](Tables& t) { t.contacts.rows[0].points[0].normalImpulse = 1; }},
        {"contacts[0].points.gap = nan", [](Tables& t) { t.contacts.rows[0].points[0].gap = kNan; }},
        {"contacts[0].restGap = 0", [](Tables& t) { t.contacts.rows[0].restGap = 0; }},
    });
}

TEST(Validate, TellsWhatIsWrongWithTheOrderAndWithEvents)
{
    TRACES("R7", "ADR4", "ADR11", "ADR13");
    expectTold({
        {"order[1].color = 0: must have no two contacts of a body",
         [](Tables& t) { t.contacts.colorEnds = {2, 2, 2}; }},
        {"order[1].contact = 0: must be each contact, once", [](Tables& t) { t.contacts.order[1] = 0; }},
        {"order[1].contact = 7: must be each contact, once", [](Tables& t) { t.contacts.order[1] = 7; }},
        {"order[0].size = 1", [](Tables& t) { t.contacts.order.pop_back(); }},
        {"order[0].row = 9", [](Tables& t) { t.contacts.rows[0].rowB = 9; }},
        {"begins[1].shapeA = 0: must be in order", [](Tables& t) { std::swap(t.begins[0], t.begins[1]); }},
        {"hits[1].time = 0: must be in order", [](Tables& t) { std::swap(t.hits[0], t.hits[1]); }},
        {"hits[0].approachSpeed = 0", [](Tables& t) { t.hits[0].approachSpeed = 0; }},
    });
}

TEST(Validate, AcceptsTwoContactsOfABodyInTheColorThatIsSolvedInOrder)
{
    TRACES("ADR11");
    Tables tables;
    tables.contacts.colorEnds = {2};
    EXPECT_TRUE(tables.faults().empty());
}

}  // namespace
}  // namespace tamias2d
