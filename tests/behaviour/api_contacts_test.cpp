// SPDX-License-Identifier: MIT
// What can be read after a step: begins, ends, hits, contacts and their impulses [R7, R8, DD8, DD10].
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace tamias2d {
namespace {

using namespace test;

TEST(Touches, BeginOnceAndEndOnce)
{
    TRACES("R7", "T5");
    World world(withGravity(0, -10));
    Body ground = addGround(world);
    Body box = addBox(world, {0, 2}, 1, 1);
    int begins = 0, ends = 0;
    runSeconds(world, 2, 60, 4, [&] {
        for (const TouchEvent& e : world.events().begins) {
            ++begins;
            EXPECT_LT(e.shapeA, e.shapeB);
            EXPECT_EQ(e.bodyA, ground.id());
            EXPECT_EQ(e.bodyB, box.id());
            EXPECT_EQ(e.shapeA, ground.shapes().front().id());
            EXPECT_EQ(e.shapeB, box.shapes().front().id());
        }
        ends += static_cast<int>(world.events().ends.size());
        EXPECT_EQ(world.touching(box.id(), ground.id()), begins == ends + 1);
        EXPECT_EQ(world.touching(ground.shapes()[0].id(), box.shapes()[0].id()), begins == ends + 1);
    });
    EXPECT_EQ(begins, 1);
    EXPECT_EQ(ends, 0);
    box.applyImpulseToCenter(vec(0, 5));
    world.step();
    EXPECT_EQ(world.events().ends.size(), 1u);
    EXPECT_FALSE(world.touching(box.id(), ground.id()));
}

TEST(Touches, MeansAGapOfAtMostOnePointOneRestGaps)
{
    TRACES("R7", "T5");
    for (const double factor : {0.5, 1.0, 1.09, 1.11, 1.5, 3.0}) {
        World world(weightless());
        Body disc = addDisc(world, {0, 0}, 0.5);
        Body box = addBox(world, {0, 1 + factor * restGapFor(world, 1, 1)}, 1, 1);
        world.step();
        EXPECT_EQ(world.touching(disc.id(), box.id()), factor < 1.1) << factor << " rest gaps";
    }
}

TEST(Touches, EndWhenAShapeIsDestroyed)
{
    TRACES("R7");
    World world;
    Body ground = addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    Body other = addBox(world, {3, 0.501}, 1, 1);
    runSeconds(world, 0.1);
    const ShapeId boxShape = box.shapes().front().id();
    const BodyId boxId = box.id();
    box.destroy();
    other.shapes().front().destroy();
    world.step();
    const auto ends = world.events().ends;
    ASSERT_EQ(ends.size(), 2u);
    EXPECT_EQ(ends[0].shapeA, ground.shapes().front().id());
    EXPECT_EQ(ends[0].shapeB, boxShape) << "ids of what is gone stay readable";
    EXPECT_EQ(ends[0].bodyB, boxId);
    EXPECT_EQ(ends[1].bodyB, other.id());
    EXPECT_FALSE(world.touching(other.id(), ground.id()));
    world.step();
    EXPECT_TRUE(world.events().ends.empty());
}

TEST(Touches, EndAndBeginAgainWhenASlotIsUsedAgain)
{
    TRACES("R7");
    World world;
    addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    runSeconds(world, 0.1);
    const ShapeId gone = box.shapes().front().id();
    box.destroy();
    Body twin = addBox(world, {0, 0.501}, 1, 1);
    world.step();
    ASSERT_EQ(world.events().ends.size(), 1u);
    ASSERT_EQ(world.events().begins.size(), 1u);
    EXPECT_EQ(world.events().ends[0].shapeB, gone);
    EXPECT_EQ(world.events().begins[0].shapeB, twin.shapes().front().id());
}

TEST(Hits, TellTheImpulseOfDd8)
{
    TRACES("R7", "R8", "DD8", "DD11", "DD12", "IM3");
    World world(weightless());
    const double e = 0.7, approach = 3;
    Body left = addDisc(world, {-1.25, 0}, 0.5,
                        {.velocity = vec(2, 0), .density = 4, .friction = 0, .restitution = e});
    Body right = addDisc(world, {1.25, 0}, 0.5, {.velocity = vec(-1, 0), .friction = 0, .restitution = e});
    std::vector<HitEvent> hits;
    runSeconds(world, 1, 60, 4,
               [&] { hits.insert(hits.end(), world.events().hits.begin(), world.events().hits.end()); });
    ASSERT_EQ(hits.size(), 1u);
    const HitEvent& hit = hits[0];
    const double mA = kPi, mB = kPi / 4, tolerance = byPrecision(1e-12, 1e-5);
    const double j = (1 + e) * approach / (1 / mA + 1 / mB);
    EXPECT_EQ(hit.bodyA, left.id());
    EXPECT_EQ(hit.bodyB, right.id());
    EXPECT_NEAR(hit.normal.x, 1, tolerance);
    EXPECT_NEAR(hit.normal.y, 0, tolerance);
    EXPECT_NEAR(hit.approachSpeed, approach, tolerance);
    EXPECT_NEAR(hit.restitution, e, 1e-7);
    EXPECT_NEAR(hit.normalImpulse, j, 1e-6 * j);
    EXPECT_EQ(hit.tangentImpulse, real(0));
    EXPECT_NEAR(hit.velocityA.x, 2, tolerance);
    EXPECT_NEAR(hit.velocityB.x, -1, tolerance);
    // The gap of 1.5 m closes at 3 m/s; they meet at the rest gap.
    EXPECT_NEAR(hit.time, 0.5, 0.001);
    EXPECT_NEAR(hit.point.x, 0.25, 0.002);
    EXPECT_NEAR(hit.armA.x, 0.5, 0.002);
    EXPECT_NEAR(hit.armB.x, -0.5, 0.002);
    EXPECT_NEAR(left.linearVelocity().x, 2 - j / mA, 1e-5);
    EXPECT_NEAR(right.linearVelocity().x, -1 + j / mB, 1e-5);
}

// A gas keeps every kind of event coming: they must be in order, complete and in their step.
TEST(Hits, AreInOrderAndCountedByTheReport)
{
    TRACES("R7", "R8");
    World world(weightless());
    addWalls(world, {0, 0}, {6, 6}, {.friction = 0, .restitution = 1});
    std::mt19937 random(5);
    const auto uniform = [&](double a, double b) { return a + (b - a) * (random() / 4294967296.0); };
    for (int i = 0; i < 25; ++i) {
        addDisc(world, {0.6 + 1.2 * (i % 5), 0.6 + 1.2 * (i / 5)}, 0.3,
                {.velocity = vec(uniform(-8, 8), uniform(-8, 8)), .friction = 0.3, .restitution = 1});
    }
    std::size_t total = 0;
    double start = 0;
    for (int i = 0; i < 300; ++i) {
        const StepReport report = world.step();
        const StepEvents events = world.events();
        EXPECT_EQ(report.impacts, events.hits.size());
        total += events.hits.size();
        const auto inOrder = [](const TouchEvent& a, const TouchEvent& b) {
            return std::tie(a.shapeA, a.shapeB) < std::tie(b.shapeA, b.shapeB);
        };
        EXPECT_TRUE(std::is_sorted(events.begins.begin(), events.begins.end(), inOrder));
        EXPECT_TRUE(std::is_sorted(events.ends.begin(), events.ends.end(), inOrder));
        EXPECT_TRUE(
            std::is_sorted(events.hits.begin(), events.hits.end(), [](const HitEvent& a, const HitEvent& b) {
                return std::tie(a.time, a.shapeA, a.shapeB) < std::tie(b.time, b.shapeA, b.shapeB);
            }));
        for (const HitEvent& hit : events.hits) {
            EXPECT_GE(hit.time, start - 1e-12);
            EXPECT_LE(hit.time, world.time() + 1e-12);
            EXPECT_LT(hit.shapeA, hit.shapeB);
            EXPECT_GT(hit.approachSpeed, 0);
            EXPECT_GE(hit.normalImpulse, 0);
            EXPECT_NEAR(length(hit.normal), 1, 1e-6);
        }
        start = world.time();
    }
    EXPECT_GT(total, 100u) << "a gas of 25 discs at some 6 m/s in 5 s";
}

// DD10, in every step and for every dynamic body: how far the impulses of its contacts and gravity's are from
// its change of momentum.   [N*s]
double worstOfDd10(World& world, double g, int steps)
{
    const double dt = 1.0 / 60;
    double worst = 0;
    for (int step = 0; step < steps; ++step) {
        std::vector<Body> bodies;
        std::vector<DVec2> before;
        for (const BodyId id : world.bodies()) {
            if (world.body(id).type() == BodyType::Dynamic) bodies.push_back(world.body(id));
        }
        for (const Body& body : bodies) before.push_back(body.momentum().linear);
        world.step(dt);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            DVec2 sum{0, -static_cast<double>(bodies[i].mass()) * g * dt};
            for (const ContactView& contact : bodies[i].contacts()) {
                sum += (contact.bodyB == bodies[i].id() ? 1.0 : -1.0) * toDVec2(contact.impulse);
            }
            worst = std::max(worst, length(bodies[i].momentum().linear - before[i] - sum));
        }
    }
    return worst;
}

// Calming takes speed from loaded bodies that hardly move, and sleep what is left of it, by no contact's
// impulse; both can be switched off.
WorldDef withoutCalming()
{
    WorldDef def = withGravity(0, -10);
    def.tuning.calmRate = 0;
    def.allowSleep = false;
    return def;
}

const double kImpulseError = byPrecision(1e-10, 2e-5);  // [N*s], of some 10 N*s

TEST(ContactImpulses, OfABouncingBallSumToItsChangeOfMomentum)
{
    TRACES("DD10", "T2", "R8");
    World world(withGravity(0, -10));
    addGround(world, 0, 100, {.restitution = 0.5});
    addDisc(world, {0, 3}, 0.5);
    EXPECT_LT(worstOfDd10(world, 10, 180), kImpulseError);
}

TEST(ContactImpulses, OfASlidingBoxSumToItsChangeOfMomentum)
{
    TRACES("DD10", "T2", "R8");
    World world(withGravity(0, -10));
    addGround(world);
    addBox(world, {0, 0.501}, 1, 1, {.velocity = vec(5, 0), .friction = 0.3});
    EXPECT_LT(worstOfDd10(world, 10, 180), kImpulseError);
}

TEST(ContactImpulses, OfAStackSumToTheChangeOfMomentumOfEachBox)
{
    TRACES("DD10", "T2", "R8");
    World world(withoutCalming());
    addGround(world);
    for (int i = 0; i < 5; ++i) addBox(world, {0, 0.6 + 1.1 * i}, 1, 1);
    EXPECT_LT(worstOfDd10(world, 10, 180), kImpulseError);
}

TEST(ContactImpulses, OfATopplingHeapSumToTheChangeOfMomentumOfEachBody)
{
    TRACES("DD10", "T2", "R8");
    World world(withoutCalming());
    addGround(world, 0, 100, {.restitution = 0.3});
    for (int i = 0; i < 6; ++i) addBox(world, {0.3 * i, 0.6 + 1.2 * i}, 1, 1, {.angle = 0.1 * i});
    for (int i = 0; i < 4; ++i) addDisc(world, {0.2 + 0.2 * i, 8.0 + i}, 0.4, {.restitution = 0.5});
    EXPECT_LT(worstOfDd10(world, 10, 180), kImpulseError);
}

TEST(ContactImpulses, OfAHeapThatIsShotAtSumToTheChangeOfMomentumOfEachBody)
{
    TRACES("DD10", "T2", "R8", "ADR27");
    World world(withoutCalming());
    addGround(world);
    for (int i = 0; i < 5; ++i) addBox(world, {0, 0.501 + 1.001 * i}, 1, 1);
    for (int i = 0; i < 4; ++i)
        addDisc(world, {-20.0 - 15 * i, 1.0 + i}, 0.3, {.velocity = vec(60, 0), .restitution = 0.5});
    EXPECT_LT(worstOfDd10(world, 10, 120), 6 * kImpulseError);
}

// Along a normal that does not turn, the points tell the same in parts.
TEST(ContactImpulses, OfThePointsSumToThatOfTheContact)
{
    TRACES("DD10", "R7");
    World world(withGravity(0, -10));
    addGround(world);
    addBox(world, {0, 0.7}, 1, 1, {.velocity = vec(3, 0), .friction = 0.3});
    for (int i = 0; i < 120; ++i) {
        world.step();
        for (const ContactView& c : world.contacts()) {
            if (c.pointCount < 2) continue;
            const DVec2 n = toDVec2(c.normal), whole = toDVec2(c.impulse);
            double normal = 0, tangent = 0;
            for (const ContactPoint& p : c.points) {
                normal += static_cast<double>(p.normalImpulse);
                tangent += static_cast<double>(p.tangentImpulse);
            }
            EXPECT_NEAR(normal, dot(whole, n), 1e-3) << "step " << i;
            EXPECT_NEAR(tangent, dot(whole, perpendicular(n)), 1e-3) << "step " << i;
        }
    }
}

TEST(ContactViews, DescribeABoxAtRest)
{
    TRACES("R7", "DD10");
    const double g = 10, dt = 1.0 / 60;
    World world(withGravity(0, -g));
    Body ground = addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    runSeconds(world, 1);
    const auto contacts = world.contacts();
    ASSERT_EQ(contacts.size(), 1u);
    const ContactView& c = contacts[0];
    EXPECT_EQ(c.bodyA, ground.id());
    EXPECT_EQ(c.bodyB, box.id());
    EXPECT_TRUE(c.touching);
    EXPECT_NEAR(c.normal.y, 1, 1e-6);
    EXPECT_NEAR(c.restGap, 0.001, 1e-9);
    ASSERT_EQ(c.pointCount, 2);
    const double weight = g * dt;
    EXPECT_NEAR(c.points[0].normalImpulse + c.points[1].normalImpulse, weight, 1e-3 * weight);
    for (const ContactPoint& p : c.points) {
        EXPECT_NEAR(p.normalImpulse, weight / 2, 0.01 * weight);
        EXPECT_NEAR(p.tangentImpulse, 0, 1e-3 * weight);
        EXPECT_NEAR(p.separation, 0.001, 2e-4);
        EXPECT_NEAR(std::abs(p.position.x), 0.5, 1e-3);
        EXPECT_NEAR(p.position.y, 0.0005, 1e-3);
    }
    EXPECT_NE(c.points[0].feature, c.points[1].feature);
    EXPECT_EQ(box.contacts().size(), 1u);
    EXPECT_EQ(ground.contacts().size(), 1u);
    const auto feature = c.points[0].feature;
    world.step();
    EXPECT_EQ(world.contacts()[0].points[0].feature, feature)
        << "a feature keeps its number while it touches";
}

TEST(ContactViews, AreSortedByShapes)
{
    TRACES("R7");
    World world;
    for (int i = 0; i < 12; ++i) addBox(world, {1.001 * (11 - i), 0.501}, 1, 1);
    addGround(world);
    runSeconds(world, 0.1);
    const auto contacts = world.contacts();
    EXPECT_GE(contacts.size(), 12u);
    EXPECT_TRUE(
        std::is_sorted(contacts.begin(), contacts.end(), [](const ContactView& a, const ContactView& b) {
            return std::tie(a.shapeA, a.shapeB) < std::tie(b.shapeA, b.shapeB);
        }));
    for (const ContactView& c : contacts) EXPECT_LT(c.shapeA, c.shapeB);
}

}  // namespace
}  // namespace tamias2d
