// SPDX-License-Identifier: MIT
// Worlds: empty ones, several at once, their settings, their clock, their state hash, and that the same calls
// give the same bits.
#include "support/build.hpp"
#include "support/describe.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <set>

namespace tamias2d {
namespace {

using namespace test;

void buildScene(World& world)
{
    addGround(world, 0, 40, {.restitution = 0.2});
    for (int i = 0; i < 5; ++i) addBox(world, {0.1 * i, 0.6 + 1.1 * i}, 1, 1);
    addDisc(world, {-6, 1}, 0.5, {.velocity = vec(9, 2), .restitution = 0.8});
    addCapsule(world, {5, 4}, 2, 0.3, {.spin = 3});
    addRegular(world, {3, 6}, 5, 0.6, {.spin = -2});
}

TEST(World, OfNothingCanBeStepped)
{
    TRACES("R1");
    World world;
    for (int i = 0; i < 10; ++i) EXPECT_EQ(world.step().status, StepStatus::Done);
    EXPECT_EQ(world.bodyCount(), 0u);
    EXPECT_EQ(world.shapeCount(), 0u);
    EXPECT_TRUE(world.bodies().empty());
    EXPECT_TRUE(world.contacts().empty());
    EXPECT_TRUE(world.events().begins.empty() && world.events().ends.empty() && world.events().hits.empty());
    EXPECT_EQ(world.energy().total(), 0);
    EXPECT_EQ(world.momentum().angular, 0);
    EXPECT_FALSE(world.findBody("").has_value());
}

TEST(World, MovesBodiesWithoutShapes)
{
    TRACES("R1", "R5");
    World world(withGravity(0, -10));
    Body point = world.createBody({.linearVelocity = vec(2, 0), .mass = MassProperties{3, {}, 0}});
    world.createBody({.type = BodyType::Static});
    world.createBody({.type = BodyType::Kinematic, .linearVelocity = vec(1, 0)});
    runSeconds(world, 1);
    EXPECT_NEAR(point.position().x, 2, byPrecision(1e-12, 1e-4));
    EXPECT_NEAR(point.position().y, -5, byPrecision(1e-12, 1e-4));
    EXPECT_TRUE(point.shapes().empty());
    EXPECT_TRUE(point.contacts().empty());
}

// A dynamic body that has neither shapes nor a mass yet is still a body: nothing about it is infinite or NaN.
TEST(World, MovesADynamicBodyOfNoMassSoundly)
{
    TRACES("R1", "DC-m");
    World world(withGravity(0, -10));
    Body bare = world.createBody();
    Body line = world.createBody({.position = {5, 5}});
    line.createShape({.geometry = Segment{vec(-1, 0), vec(1, 0)}});
    addGround(world);
    bare.applyForceToCenter(vec(1, 0));
    bare.applyImpulseToCenter(vec(1, 0));
    bare.applyTorque(1);
    line.applyAngularImpulse(1);
    runSeconds(world, 2);
    for (const Body& body : {bare, line}) {
        EXPECT_TRUE(isFinite(body.position()) && isFinite(body.linearVelocity()));
        EXPECT_TRUE(std::isfinite(body.angularVelocity()) && std::isfinite(body.angle()));
        EXPECT_TRUE(std::isfinite(body.energy().total()));
    }
    EXPECT_EQ(world.lastReport().nonFinite, 0u);
}

TEST(World, KeepsTheClock)
{
    TRACES("R1");
    World world;
    EXPECT_EQ(world.time(), 0.0);
    EXPECT_EQ(world.stepCount(), 0u);
    world.step(0.25, 2);
    world.step(0.5, 1);
    EXPECT_EQ(world.time(), 0.75);
    EXPECT_EQ(world.stepCount(), 2u);
    EXPECT_EQ(world.lastReport().substeps, 1);
    for (int i = 0; i < 360000; ++i) world.step(0.01, 1);
    EXPECT_NEAR(world.time(), 3600.75, 1e-6) << "an hour in steps of 0.01 s";
}

TEST(World, ReportsWhatItHolds)
{
    TRACES("R1", "R7");
    World world;
    addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    addBox(world, {5, 3}, 1, 1).setEnabled(false);
    Body two = addDisc(world, {-5, 0.501}, 0.5);
    two.createShape({.geometry = Circle{}});
    const StepReport report = world.step();
    EXPECT_EQ(report.status, StepStatus::Done);
    EXPECT_EQ(report.substeps, 4);
    EXPECT_EQ(report.bodies, 3u);
    EXPECT_EQ(report.dynamicBodies, 2u);
    EXPECT_EQ(world.bodyCount(), 4u);
    EXPECT_EQ(world.shapeCount(), 5u);
    EXPECT_EQ(report.touching, 3u);
    EXPECT_GE(report.pairs, 3u);
    EXPECT_EQ(report.nonFinite, 0u);
    EXPECT_EQ(report.clamps.speed + report.clamps.position + report.clamps.push, 0u);
    EXPECT_EQ(world.lastReport().touching, 3u);
    box.destroy();
    EXPECT_EQ(world.step().touching, 2u);
}

TEST(World, ReportsTheDeepestOverlap)
{
    TRACES("R7");
    World world(weightless());
    addBox(world, {0, 0}, 1, 1);
    Body other = addBox(world, {0.9, 0}, 1, 1);
    const StepReport first = world.step(1.0 / 60);
    EXPECT_GT(first.deepestOverlap, 0.05);
    EXPECT_LE(first.deepestOverlap, 0.1);
    other.setTransform({3, 0}, 0);
    EXPECT_EQ(world.step().deepestOverlap, 0.0);
}

TEST(World, HasSettingsThatCanChange)
{
    TRACES("R1", "T3", "GD2");
    World world;
    EXPECT_EQ(world.definition().gravity, vec(0, -9.81));
    EXPECT_EQ(world.definition().gravitationConstant, real(0));
    world.setGravity(vec(1, 2));
    world.setGravitationConstant(3);
    world.setMixingRules(MixingRule::Minimum, MixingRule::Multiply);
    Tuning tuning;
    tuning.restGap = toReal(0.01);
    tuning.crowd = 9;
    tuning.impactsPerContact = 7;
    tuning.sleepTime = 2;
    tuning.sleepSpeed = toReal(0.1);
    world.setTuning(tuning);
    EXPECT_EQ(world.definition().gravity, vec(1, 2));
    EXPECT_EQ(world.definition().gravitationConstant, real(3));
    EXPECT_EQ(world.definition().frictionMixing, MixingRule::Minimum);
    EXPECT_EQ(world.definition().restitutionMixing, MixingRule::Multiply);
    EXPECT_EQ(world.definition().tuning, tuning);
}

TEST(World, RestsBodiesAtTheGapItIsTuned)
{
    TRACES("R8");
    WorldDef def;
    def.tuning.restGap = toReal(0.02);
    World world(def);
    Body ground = addGround(world);
    Body box = addBox(world, {0, 0.52}, 1, 1);
    runSeconds(world, 1);
    EXPECT_NEAR(box.position().y, 0.52, 1e-3);
    EXPECT_TRUE(world.touching(box.id(), ground.id()));
}

TEST(Worlds, ShareNothing)
{
    TRACES("R1", "A7");
    World alone;
    buildScene(alone);
    runSeconds(alone, 2);

    World one, two(withGravity(0, 3));
    buildScene(one);
    two.setMixingRules(MixingRule::Maximum, MixingRule::Maximum);
    buildScene(two);
    for (int i = 0; i < 120; ++i) {
        one.step();
        two.step(1.0 / 100, 2);
        if (i % 7 == 0) addDisc(two, {0.0 + i, 20}, 0.5);
        World brief;
        addDisc(brief, {0, 0}, 1);
        brief.step();
    }
    EXPECT_EQ(one.stateHash(), alone.stateHash());
    EXPECT_NE(two.stateHash(), alone.stateHash());
}

TEST(Determinism, TheSameCallsGiveTheSameBitsAtEveryStep)
{
    TRACES("R1", "R5", "R8", "ADR6");
    World a, b;
    buildScene(a);
    buildScene(b);
    EXPECT_EQ(a.stateHash(), b.stateHash());
    std::set<std::uint64_t> hashes;
    for (int i = 0; i < 300; ++i) {
        a.step();
        b.step();
        ASSERT_EQ(a.stateHash(), b.stateHash()) << "step " << i;
        hashes.insert(a.stateHash());
    }
    EXPECT_EQ(hashes.size(), 300u) << "a state that moves has a new hash at every step";
}

TEST(Determinism, OfWhatIsLeftDoesNotDependOnWhatWasDestroyed)
{
    TRACES("R1", "ADR6");
    World plain, visited;
    buildScene(plain);
    buildScene(visited);
    for (int i = 0; i < 200; ++i) {
        // A visitor far away comes and goes: nobody meets it.
        Body visitor = addDisc(visited, {500, 0}, 0.5, {.velocity = vec(1, 0)});
        plain.step();
        visited.step();
        visitor.destroy();
    }
    const auto statesOf = [](World& world) {
        const std::vector<BodyId> ids = world.bodies();
        std::vector<BodyState> states(ids.size());
        world.readStates(ids, states);
        return states;
    };
    const auto a = statesOf(plain), b = statesOf(visited);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position) << "body " << i;
        EXPECT_EQ(a[i].angle, b[i].angle) << "body " << i;
        EXPECT_EQ(a[i].linearVelocity, b[i].linearVelocity) << "body " << i;
        EXPECT_EQ(a[i].angularVelocity, b[i].angularVelocity) << "body " << i;
    }
}

TEST(StateHash, SeesEveryChange)
{
    TRACES("R1", "ADR6");
    const std::vector<std::pair<const char*, std::function<void(World&, Body&, Shape&)>>> changes = {
        {"position", [](World&, Body& b, Shape&) { b.setTransform({1e-12, 0}, 0); }},
        {"angle", [](World&, Body& b, Shape&) { b.setTransform({0, 0}, 1e-9); }},
        {"velocity", [](World&, Body& b, Shape&) { b.setLinearVelocity(vec(1e-9, 0)); }},
        {"spin", [](World&, Body& b, Shape&) { b.setAngularVelocity(toReal(1e-9)); }},
        {"mass", [](World&, Body& b, Shape&) { b.setMass({2, {}, 1}); }},
        {"damping", [](World&, Body& b, Shape&) { b.setLinearDamping(1); }},
        {"turning damping", [](World&, Body& b, Shape&) { b.setAngularDamping(1); }},
        {"gravity scale", [](World&, Body& b, Shape&) { b.setGravityScale(2); }},
        {"own gravity", [](World&, Body& b, Shape&) { b.setOwnGravity(vec(0, 1)); }},
        {"locks", [](World&, Body& b, Shape&) { b.setLocks(true, false, false); }},
        {"type", [](World&, Body& b, Shape&) { b.setType(BodyType::Kinematic); }},
        {"enabled", [](World&, Body& b, Shape&) { b.setEnabled(false); }},
        {"force", [](World&, Body& b, Shape&) { b.applyForceToCenter(vec(1, 0)); }},
        {"torque", [](World&, Body& b, Shape&) { b.applyTorque(1); }},
        {"lasting force", [](World&, Body& b, Shape&) { b.addForce({.force = vec(1, 0)}); }},
        {"friction", [](World&, Body&, Shape& s) { s.setMaterial({.friction = toReal(0.5)}); }},
        {"restitution", [](World&, Body&, Shape& s) { s.setMaterial({.restitution = toReal(0.5)}); }},
        {"filter", [](World&, Body&, Shape& s) { s.setFilter({.mask = 3}); }},
        {"rolling", [](World&, Body&, Shape& s) { s.setMaterial({.rollingResistance = 1}); }},
        {"law", [](World& w, Body&, Shape&) { w.addForceLaw(drag(1)); }},
        {"another law", [](World& w, Body&, Shape&) { w.addForceLaw(drag(2)); }},
        {"density", [](World&, Body&, Shape& s) { s.setDensity(2); }},
        {"geometry", [](World&, Body&, Shape& s) { s.redefine({.geometry = Circle{{}, toReal(0.50001)}}); }},
        {"another shape", [](World&, Body& b, Shape&) { b.createShape({}); }},
        {"another body", [](World& w, Body&, Shape&) { w.createBody(); }},
        {"no shape", [](World&, Body&, Shape& s) { s.destroy(); }},
        {"no body", [](World&, Body& b, Shape&) { b.destroy(); }},
        {"gravity", [](World& w, Body&, Shape&) { w.setGravity(vec(0, -9.8)); }},
        {"gravitation", [](World& w, Body&, Shape&) { w.setGravitationConstant(1); }},
        {"time", [](World& w, Body&, Shape&) { w.step(1e-9, 1); }},
    };
    std::set<std::uint64_t> hashes;
    for (const auto& [name, change] : changes) {
        World world;
        Body body = addDisc(world, {0, 0}, 0.5);
        Shape shape = body.shapes().front();
        hashes.insert(world.stateHash());
        change(world, body, shape);
        EXPECT_TRUE(hashes.insert(world.stateHash()).second) << name;
    }
    EXPECT_EQ(hashes.size(), changes.size() + 1) << "all start alike, and end apart";
}

TEST(StateHash, IsThatOfTheStateAndNotOfTheHandles)
{
    TRACES("R1", "ADR6");
    auto first = std::make_unique<World>();
    buildScene(*first);
    first->step();
    const std::uint64_t hash = first->stateHash();
    EXPECT_EQ(first->stateHash(), hash) << "asking changes nothing";
    first.reset();
    World second;
    buildScene(second);
    second.step();
    EXPECT_EQ(second.stateHash(), hash);
}

}  // namespace
}  // namespace tamias2d
