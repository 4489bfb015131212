// SPDX-License-Identifier: MIT
// Every allocation of this program is counted: a world that is warm steps without one.
#include "memory/counting.hpp"
#include "support/build.hpp"
#include "support/random.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

constexpr int kSteps = 1000;

template <class EachStep>
void warmUp(World& world, std::vector<Body>& bodies, int steps, EachStep&& eachStep)
{
    for (int i = 0; i < steps; ++i) {
        eachStep(i);
        world.step();
    }
    // Half of them leave, so that what is measured stays below the high-water marks of what was.
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (i % 2 == 0) bodies[i].destroy();
    std::erase_if(bodies, [](const Body& body) { return !body.isAlive(); });
    for (int i = 0; i < 100; ++i) {
        eachStep(steps + i);
        world.step();
    }
}

// Allocations of kSteps steps of a warm world, and of the step that made the first of them.
template <class EachStep>
void expectNone(World& world, EachStep&& eachStep)
{
    const long before = allocationCount();
    int first = -1;
    for (int i = 0; i < kSteps; ++i) {
        eachStep(i);
        world.step();
        if (first < 0 && allocationCount() != before) first = i;
    }
    EXPECT_EQ(allocationCount() - before, 0) << "first in step " << first << " of " << kSteps;
}

TEST(Allocations, AreCountedHere)
{
    TRACES("NFR1");
    const long before = allocationCount();
    const std::vector<double> numbers(100);
    EXPECT_EQ(allocationCount() - before, 1);
    World world;
    addBox(world, {0, 0}, 1, 1);
    EXPECT_GT(allocationCount() - before, 10);
}

TEST(Allocations, NoneIsMadeInAStepOfAWarmPile)
{
    TRACES("NFR1", "ADR4");
    WorldDef def;
    def.allowSleep = false;  // what falls asleep takes its contacts along, into memory of its group
    World world(def);
    addGround(world);
    addWalls(world, {-6, 0}, {6, 60});
    // It stirs the pile and crushes nothing against the ground, as there is room for the largest of them
    // below it: what is squeezed out flies as nothing else did.
    addBox(world, {0, 3.5}, 4.8, 0.4, {.type = BodyType::Kinematic, .spin = 0.5});
    Random random(1);
    std::vector<Body> bodies;
    for (int i = 0; i < 100; ++i) {
        const Position place{-5.0 + 10.0 * (i % 10) / 9, 3.0 + i / 10};
        const double size = random.between(0.4, 0.9);
        switch (i % 4) {
        case 0:
            bodies.push_back(addBox(world, place, size, 0.6, {.rounding = i % 8 == 0 ? 0.05 : 0}));
            break;
        case 1:
            bodies.push_back(addDisc(world, place, size / 2, {.rollingResistance = 0.02}));
            break;
        case 2:
            bodies.push_back(addCapsule(world, place, size, 0.15));
            break;
        default:
            bodies.push_back(addRegular(world, place, 5, size / 2));
            break;
        }
    }
    // Thrown up now and then, all of them land at once: more impacts in a step than there will be later.
    warmUp(world, bodies, 600, [&](int step) {
        if (step % 100 != 50) return;
        for (Body& body : bodies) body.setLinearVelocity(vec(random.between(-4, 4), 6));
    });
    expectNone(world, [](int) {});
    EXPECT_GT(world.lastReport().touching, 40u);
}

TEST(Allocations, NoneIsMadeByThreadsInAStepOfAWarmPile)
{
    TRACES("NFR1", "ADR26");
    WorldDef def;
    def.allowSleep = false;
    def.threads = 3;
    World world(def);
    world.setProfiling(true);
    addGround(world);
    for (int row = 0; row < 6; ++row)
        for (int i = 0; i < 60; ++i) addBox(world, {1.1 * i - 33, 0.501 + 1.001 * row}, 1, 1);
    for (int i = 0; i < 200; ++i) world.step();
    expectNone(world, [](int) {});
    EXPECT_GT(world.lastReport().touching, 300u);
}

// A chain that is solved at once and one that is solved joint by joint. They hang and swing a little, so that
// what the broad phase finds is much the same in each step.
TEST(Allocations, NoneIsMadeInAStepOfWarmChains)
{
    TRACES("NFR1", "LC3");
    WorldDef def;
    def.allowSleep = false;
    World world(def);
    for (const double load : {1.0, 400.0}) {
        Body last = addDisc(world, {load, 10}, 0.1, {.type = BodyType::Static});
        for (int i = 0; i < 12; ++i) {
            const Position at{load, 10 - 0.5 * i};
            Body link = addBox(world, {at.x, at.y - 0.25}, 0.1, 0.5, {.density = i == 11 ? load : 1});
            world.createJoint(revoluteAt(last, link, at));
            last = link;
        }
        last.setLinearVelocity(vec(1, 0));
    }
    for (const BodyId id : world.bodies())
        for (Shape shape : world.body(id).shapes()) shape.setFilter({.mask = 0});
    for (int i = 0; i < 200; ++i) world.step();
    EXPECT_GT(world.lastReport().stiffGroups, 0u);
    expectNone(world, [](int) {});
}

TEST(Allocations, NoneIsMadeInAStepOfAWarmGas)
{
    TRACES("NFR1", "ADR7", "ADR13");
    World world(weightless());
    addWalls(world, {-10, -10}, {10, 10}, {.restitution = 1});
    Random random(2);
    std::vector<Body> bodies;
    for (int i = 0; i < 100; ++i) {
        const Position place{-9.0 + 2 * (i % 10), -9.0 + 2 * (i / 10)};
        const double x = random.between(-10, 10), y = random.between(-10, 10);
        const Options options{.velocity = vec(x, y), .spin = x, .friction = 0, .restitution = 1};
        if (i % 2 == 0)
            bodies.push_back(addDisc(world, place, 0.4, options));
        else
            bodies.push_back(addRegular(world, place, 3 + i % 5, 0.4, options));
    }
    std::size_t hits = 0;
    const auto count = [&](int) { hits += world.events().hits.size(); };
    warmUp(world, bodies, 1000, count);
    hits = 0;
    expectNone(world, count);
    EXPECT_GT(hits, 1000u);
}

// A pile that falls asleep as one group, is woken by a kick, and falls asleep again, twelve times over.
TEST(Allocations, NoneIsMadeWhereBodiesFallAsleepAndWakeOnceTheyHaveDoneSo)
{
    TRACES("NFR1", "ADR25");
    World world;
    addGround(world);
    std::vector<Body> bodies;
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 8 - row; ++i)
            bodies.push_back(addBox(world, {1.05 * i + 0.5 * row - 4, 0.501 + 1.001 * row}, 1, 1));
    std::uint32_t asleep = 0, fell = 0;
    const auto kick = [&](int step) {
        if (world.lastReport().asleep > asleep) ++fell;
        asleep = world.lastReport().asleep;
        if (step % 80 == 79) bodies[3].applyAngularImpulse(toReal(0.02));
    };
    for (int i = 0; i < 400; ++i) {
        kick(i);
        world.step();
    }
    fell = 0;
    expectNone(world, kick);
    EXPECT_GE(fell, 10u);
}

// Forces of all kinds, several shapes a body, setters in each step, and islands that stand on nothing.
TEST(Allocations, NoneIsMadeInAStepOfAWarmWorldThatIsPushedAround)
{
    TRACES("NFR1", "R2");
    World world(withGravity(0, -2));
    addWalls(world, {-8, 0}, {8, 12}, {.restitution = 0.5});
    world.setGravitationConstant(toReal(0.01));
    world.addForceLaw(drag(0.01, 0.002));
    std::vector<Body> bodies;
    for (int i = 0; i < 40; ++i) {
        Body body = addBox(world, {-7.0 + 2 * (i % 8), 1.0 + 2 * (i / 8)}, 0.8, 0.5,
                           {.restitution = i % 3 == 0 ? 0.8 : 0.0});
        ShapeDef wheel;
        wheel.geometry = Circle{vec(0.4, 0), toReal(0.3)};
        body.createShape(wheel);
        body.setLinearDamping(toReal(i % 2 == 0 ? 0.1 : 0));
        if (i % 5 == 0) body.addForceLaw(springTo({0, 6}, 2, 0.1));
        if (i % 5 == 1) body.addForce({.force = vec(0.2, 0.5), .forceTurns = true});
        if (i % 5 == 2) body.setOwnGravity(vec(0, 0));
        bodies.push_back(body);
    }
    const auto pushAround = [&](int step) {
        Body& body = bodies[static_cast<std::size_t>(step) % bodies.size()];
        const double side = step % 2 == 0 ? 1 : -1;
        body.applyForce(vec(20 * side, 10), body.position());
        if (step % 7 == 0) body.setLinearVelocity(vec(4 * side, 3));
        if (step % 11 == 0) body.applyAngularImpulse(toReal(0.1 * side));
        world.setGravity(vec(side, -2));
    };
    warmUp(world, bodies, 1000, pushAround);
    expectNone(world, pushAround);
}

}  // namespace
}  // namespace tamias2d
