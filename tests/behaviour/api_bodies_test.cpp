// SPDX-License-Identifier: MIT
// What a body is and can be changed to at any time: type, pose, locks, enabled or not, names, definitions.
#include "support/build.hpp"
#include "support/describe.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <array>

namespace tamias2d {
namespace {

using namespace test;

TEST(BodyType, AStaticBodyNeverMoves)
{
    TRACES("R2", "DC-m");
    World world;
    Body wall = addBox(world, {0, 5}, 1, 1, {.type = BodyType::Static, .angle = 0.5});
    addBox(world, {0, 8}, 2, 2, {.velocity = vec(0, -50)});
    wall.applyForceToCenter(vec(1e6, 0));
    wall.applyImpulse(vec(1e6, 0), {0, 6});
    wall.applyAngularImpulse(1e6);
    wall.addForce({.force = vec(1e6, 0), .torque = 1e6});
    runSeconds(world, 1);
    EXPECT_EQ(wall.position(), (Position{0, 5}));
    EXPECT_EQ(wall.angle(), 0.5);
    EXPECT_EQ(wall.linearVelocity(), vec(0, 0));
    EXPECT_EQ(wall.angularVelocity(), real(0));
}

TEST(BodyType, AKinematicBodyKeepsTheVelocityItIsGiven)
{
    TRACES("R2", "R5", "R6");
    World world;
    Body platform =
        addBox(world, {0, 0}, 4, 0.5, {.type = BodyType::Kinematic, .velocity = vec(0.5, 0.25), .spin = 0.1});
    addBox(world, {0, 2}, 1, 1, {.density = 1000});
    platform.applyForceToCenter(vec(1e6, 0));
    platform.applyImpulse(vec(1e6, 0), {0, 6});
    platform.addForce({.force = vec(1e6, 0), .torque = 1e6});
    runSeconds(world, 2);
    EXPECT_EQ(platform.linearVelocity(), vec(0.5, 0.25));
    EXPECT_EQ(platform.angularVelocity(), toReal(0.1));
    const double tolerance = byPrecision(1e-12, 1e-6);
    EXPECT_NEAR(platform.position().x, 1, tolerance);
    EXPECT_NEAR(platform.position().y, 0.5, tolerance);
    EXPECT_NEAR(platform.angle(), 0.2, tolerance);
}

TEST(BodyType, CanChangeAtAnyTime)
{
    TRACES("R2");
    World world(withGravity(0, -10));
    Body body = addBox(world, {0, 100}, 1, 1, {.velocity = vec(2, 0), .spin = 3});
    runSeconds(world, 0.5);
    body.setType(BodyType::Static);
    EXPECT_EQ(body.type(), BodyType::Static);
    EXPECT_EQ(body.linearVelocity(), vec(0, 0)) << "made static, it loses its velocity";
    EXPECT_EQ(body.angularVelocity(), real(0));
    const Position stopped = body.position();
    runSeconds(world, 0.5);
    EXPECT_EQ(body.position(), stopped);

    body.setType(BodyType::Kinematic);
    body.setLinearVelocity(vec(0, 4));
    runSeconds(world, 0.5);
    EXPECT_NEAR(body.position().y - stopped.y, 2, byPrecision(1e-10, 1e-5));

    body.setType(BodyType::Dynamic);
    EXPECT_EQ(body.linearVelocity(), vec(0, 4)) << "velocity stays where it makes sense";
    runSeconds(world, 0.5);
    EXPECT_NEAR(body.linearVelocity().y, -1, byPrecision(1e-10, 1e-4));
    EXPECT_NEAR(body.position().y - stopped.y, 2 + 2 - 1.25, byPrecision(1e-10, 1e-4));
}

TEST(Enabling, ADisabledBodyNeitherMovesNorCollidesAndGoesOnLater)
{
    TRACES("R2", "R7");
    World world(withGravity(0, -10));
    Body ground = addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    runSeconds(world, 0.2);
    ASSERT_TRUE(world.touching(box.id(), ground.id()));
    box.setEnabled(false);
    EXPECT_FALSE(box.isEnabled());
    EXPECT_FALSE(box.definition().enabled);
    Body stone = addBox(world, {0, 3}, 1, 1);
    const Position before = box.position();
    runSeconds(world, 1);
    EXPECT_EQ(box.position(), before);
    EXPECT_FALSE(world.touching(box.id(), ground.id()));
    EXPECT_FALSE(world.touching(box.id(), stone.id()));
    EXPECT_NEAR(stone.position().y, 0.5, 0.005) << "the stone falls through the disabled box";
    stone.destroy();
    box.setEnabled(true);
    runSeconds(world, 0.2);
    EXPECT_TRUE(world.touching(box.id(), ground.id()));
}

TEST(Enabling, ADisabledBodyInFlightContinuesWithItsVelocity)
{
    TRACES("R2");
    World world(weightless());
    Body disc = addDisc(world, {0, 0}, 0.5, {.velocity = vec(3, 0)});
    disc.setEnabled(false);
    runSeconds(world, 1);
    EXPECT_EQ(disc.position(), (Position{0, 0}));
    disc.setEnabled(true);
    runSeconds(world, 1);
    EXPECT_NEAR(disc.position().x, 3, byPrecision(1e-12, 1e-5));
}

TEST(Teleport, MovesAtOnceAndKeepsTheVelocity)
{
    TRACES("R2");
    World world(weightless());
    Body disc = addDisc(world, {0, 0}, 0.5, {.velocity = vec(1, 2), .spin = 3});
    world.step();
    disc.setTransform({1000, -500}, 0.25);
    EXPECT_EQ(disc.position(), (Position{1000, -500}));
    EXPECT_EQ(disc.angle(), 0.25);
    EXPECT_EQ(disc.linearVelocity(), vec(1, 2));
    EXPECT_EQ(disc.angularVelocity(), real(3));
    for (const double alpha : {0.0, 0.5, 1.0}) {
        EXPECT_EQ(disc.interpolated(alpha).position, (Position{1000, -500})) << "alpha " << alpha;
        EXPECT_EQ(disc.interpolated(alpha).angle, 0.25) << "alpha " << alpha;
    }
}

TEST(Teleport, EndsTouchesThereAndBeginsThemHere)
{
    TRACES("R7");
    World world;
    Body left = addBox(world, {-10, 0}, 4, 1, {.type = BodyType::Static});
    Body right = addBox(world, {10, 0}, 4, 1, {.type = BodyType::Static});
    Body box = addBox(world, {-10, 1.001}, 1, 1);
    runSeconds(world, 0.1);
    ASSERT_TRUE(world.touching(box.id(), left.id()));
    box.setTransform({10, 1.001}, 0);
    world.step();
    EXPECT_FALSE(world.touching(box.id(), left.id()));
    EXPECT_TRUE(world.touching(box.id(), right.id()));
    EXPECT_EQ(world.events().ends.size(), 1u);
    EXPECT_EQ(world.events().begins.size(), 1u);
}

TEST(Locks, HoldTheirAxisAgainstForcesAndCollisions)
{
    TRACES("R2");
    World world(weightless());
    BodyDef def;
    def.lockX = true;
    Body rail = world.createBody(def);
    rail.createShape({.geometry = makeBox(1, 1)});
    Body pillar = addBox(world, {5, 0}, 1, 1);
    pillar.setLocks(true, true, false);
    Body upright = addBox(world, {10, 0}, 1, 1);
    upright.setLocks(false, false, true);
    addDisc(world, {-3, 0.2}, 0.5, {.velocity = vec(10, 0), .restitution = 1});
    for (int i = 0; i < 60; ++i) {
        rail.applyForce(vec(3, 1), {0, 0.3});
        pillar.applyForce(vec(0, 3), {5.4, 0});
        upright.applyForce(vec(0, 3), {10.4, 0});
        upright.applyAngularImpulse(1);
        world.step();
    }
    EXPECT_EQ(rail.position().x, 0.0);
    EXPECT_NE(rail.position().y, 0.0);
    EXPECT_NE(rail.angularVelocity(), real(0));
    EXPECT_EQ(pillar.position(), (Position{5, 0}));
    EXPECT_NE(pillar.angularVelocity(), real(0));
    EXPECT_EQ(upright.angle(), 0.0);
    EXPECT_GT(upright.position().y, 1);
    EXPECT_TRUE(pillar.definition().lockX && pillar.definition().lockY && !pillar.definition().lockRotation);
    pillar.setLocks(false, false, false);
    pillar.applyImpulseToCenter(vec(1, 0));
    world.step();
    EXPECT_GT(pillar.position().x, 5);
}

// A disc of 1 kg against one that cannot turn nor move along x: it bounces as from a wall.
TEST(Locks, MakeABodyImmovableForCollisionsAlongThem)
{
    TRACES("R2", "R8", "DD8");
    World world(weightless());
    Body rail = addBox(world, {0, 0}, 1, 1, {.restitution = 1});
    rail.setLocks(true, false, true);
    Body disc = addDisc(world, {-2, 0}, 0.5, {.velocity = vec(4, 0), .restitution = 1});
    runSeconds(world, 1);
    EXPECT_NEAR(disc.linearVelocity().x, -4, byPrecision(1e-12, 1e-5));
    EXPECT_EQ(rail.position(), (Position{0, 0}));
}

// Of the two points of its contact one lies under the center, where nothing can move a body that only turns;
// the other one must hold it all the same, whichever of them comes first.
TEST(Locks, LetAPinnedPlankTipHoweverSlowly)
{
    TRACES("R2", "R7");
    // A plank pinned at its middle, with a box a little off the middle on top of it.
    World world;
    addGround(world);
    Body plank = addBox(world, {0, 1.5}, 4, 0.2);
    plank.setLocks(true, true, false);
    const Body box = addBox(world, {0.02, 1.5 + 0.1 + 0.2 + 0.0002}, 0.4, 0.4, {.friction = 1});
    runSeconds(world, 8);
    EXPECT_GT(box.position().x, 0.05);
}

TEST(Locks, LeaveABodyThatOnlyTurnsToTheContactBesideItsCenter)
{
    TRACES("R2", "R8");
    for (const int side : {-1, 1}) {
        World world(weightless());
        addBox(world, {side * 2.5, -1.001}, 5, 1, {.type = BodyType::Static});
        Body plank = addBox(world, {0, 0}, 2, 1);
        plank.setLocks(true, true, false);
        for (int i = 0; i < 120; ++i) {
            plank.applyTorque(toReal(-10.0 * side));
            world.step();
        }
        EXPECT_EQ(plank.position(), (Position{0, 0}));
        EXPECT_LE(std::abs(angleDifference(plank.angle(), 0)), 0.002) << "side " << side;
        EXPECT_NEAR(plank.angularVelocity(), 0, 1e-3) << "side " << side;
    }
}

TEST(Names, FindTheFirstBodyThatBearsThem)
{
    TRACES("R2");
    World world;
    Body first = world.createBody({.name = "ball"});
    Body second = world.createBody({.name = "ball"});
    EXPECT_FALSE(world.findBody("box").has_value());
    ASSERT_TRUE(world.findBody("ball").has_value());
    EXPECT_EQ(world.findBody("ball")->id(), first.id());
    first.setName("box");
    EXPECT_EQ(first.name(), "box");
    EXPECT_EQ(world.findBody("ball")->id(), second.id());
    EXPECT_EQ(world.findBody("box")->id(), first.id());
    second.destroy();
    EXPECT_FALSE(world.findBody("ball").has_value());
}

TEST(UserData, IsKeptForBodiesAndShapes)
{
    TRACES("R2");
    World world;
    Body body = world.createBody({.userData = 42});
    Shape shape = body.createShape({.userData = 43});
    EXPECT_EQ(body.userData(), 42u);
    EXPECT_EQ(shape.userData(), 43u);
    body.setUserData(~0ull);
    shape.setUserData(7);
    world.step();
    EXPECT_EQ(body.definition().userData, ~0ull);
    EXPECT_EQ(shape.definition().userData, 7u);
}

TEST(Handles, FindWhatIsAliveAndOnlyThat)
{
    TRACES("R1", "R4", "ADR4");
    World world;
    Body a = world.createBody(), b = world.createBody();
    Shape shape = a.createShape({});
    EXPECT_EQ(shape.body(), a.id());
    ASSERT_TRUE(world.findShape(shape.id()).has_value());
    EXPECT_EQ(world.findShape(shape.id())->body(), a.id());
    EXPECT_EQ(world.shape(shape.id()).id(), shape.id());
    EXPECT_EQ(world.body(b.id()).id(), b.id());
    EXPECT_EQ(world.bodies(), (std::vector<BodyId>{a.id(), b.id()}));
    EXPECT_EQ(world.bodyCount(), 2u);
    EXPECT_EQ(world.shapeCount(), 1u);
    world.destroyBody(a.id());
    EXPECT_FALSE(world.findBody(a.id()).has_value());
    EXPECT_FALSE(world.findShape(shape.id()).has_value());
    EXPECT_FALSE(world.findBody(BodyId{}).has_value());
    EXPECT_EQ(world.bodyCount(), 1u);
    EXPECT_EQ(world.shapeCount(), 0u);
    Body again = world.createBody();
    EXPECT_NE(again.id(), a.id()) << "a slot used again has a new generation";
    EXPECT_FALSE(a.isAlive());
}

TEST(BulkStates, ReadAndWriteInTheOrderOfTheIds)
{
    TRACES("R2");
    World world(weightless());
    Body a = addDisc(world, {1, 2}, 0.5, {.velocity = vec(3, 4), .spin = 5, .angle = 6});
    Body b = addBox(world, {-1, -2}, 1, 1);
    const std::array<BodyId, 2> ids = {b.id(), a.id()};
    std::array<BodyState, 2> states{};
    world.readStates(ids, states);
    EXPECT_EQ(states[1].position, (Position{1, 2}));
    EXPECT_EQ(states[1].angle, 6.0);
    EXPECT_EQ(states[1].linearVelocity, vec(3, 4));
    EXPECT_EQ(states[1].angularVelocity, real(5));
    const std::uint64_t hash = world.stateHash();
    world.writeStates(ids, states);
    EXPECT_EQ(world.stateHash(), hash) << "what was read, written back, changes nothing";
    states[0] = {{9, 8}, -1, vec(7, 6), 5};
    world.writeStates(ids, states);
    EXPECT_EQ(b.position(), (Position{9, 8}));
    EXPECT_NEAR(b.angle(), kTwoPi - 1, 1e-15);
    EXPECT_EQ(b.linearVelocity(), vec(7, 6));
    EXPECT_EQ(b.angularVelocity(), real(5));
    EXPECT_EQ(a.position(), (Position{1, 2}));
    world.readStates({}, {});
    world.writeStates({}, {});
}

}  // namespace
}  // namespace tamias2d
