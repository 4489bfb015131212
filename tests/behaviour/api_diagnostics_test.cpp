// SPDX-License-Identifier: MIT
// Energy and momentum against figures worked out by hand, per body and in all; angles always in [0, 2 pi).
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <array>

namespace tamias2d {
namespace {

using namespace test;

TEST(Energy, OfABodyIsWorkedOutByHand)
{
    TRACES("DD15", "DD16");
    World world(withGravity(0, -10));
    // 2 x 1 m, 3 kg/m^2: 6 kg, inertia 6 (4 + 1) / 12 = 2.5 kg m^2.
    Body box = addBox(world, {4, 7}, 2, 1, {.velocity = vec(3, -4), .spin = 2, .density = 3});
    EXPECT_NEAR(box.energy().linear, 6 * 25 / 2.0, 100 * kExact);
    EXPECT_NEAR(box.energy().rotational, 2.5 * 4 / 2, 10 * kExact);
    EXPECT_NEAR(box.energy().potential, 6 * 10 * 7.0, 1000 * kExact);
    EXPECT_NEAR(box.energy().kinetic(), 80, 100 * kExact);
    EXPECT_NEAR(box.energy().total(), 500, 1000 * kExact);
}

TEST(Momentum, OfABodyIsWorkedOutByHand)
{
    TRACES("GD1", "DD3", "DD6");
    World world(weightless());
    Body box = addBox(world, {4, 7}, 2, 1, {.velocity = vec(3, -4), .spin = 2, .density = 3});
    EXPECT_NEAR(box.momentum().linear.x, 18, 100 * kExact);
    EXPECT_NEAR(box.momentum().linear.y, -24, 100 * kExact);
    // m p x v + I omega = 6 (4 (-4) - 7 3) + 2.5 2
    EXPECT_NEAR(box.momentum().angular, 6 * -37.0 + 5, 1000 * kExact);
}

TEST(Energy, IsThatOfTheCenterOfMassNotOfTheOrigin)
{
    TRACES("DD15", "DD16", "DD1");
    World world(withGravity(0, -10));
    Body body = world.createBody({.position = {0, 0}, .linearVelocity = vec(1, 0), .angularVelocity = 3});
    body.createShape({.geometry = makeBox(1, 1), .offset = vec(0, 5)});
    body.setLinearVelocity(vec(1, 0));
    EXPECT_NEAR(body.energy().potential, 50, 100 * kExact);
    EXPECT_NEAR(body.energy().linear, 0.5, kExact);
    EXPECT_NEAR(body.energy().rotational, 9.0 / 12, 10 * kExact);
    EXPECT_NEAR(body.momentum().angular, 1 * (0 * 0 - 5 * 1) + 3.0 / 6, 10 * kExact);
}

TEST(Energy, OfAWorldIsTheSumOverItsEnabledDynamicBodies)
{
    TRACES("DD15", "DD16", "GD1");
    World world(withGravity(0, -10));
    Body a = addBox(world, {1, 2}, 1, 1, {.velocity = vec(3, 0)});
    Body b = addDisc(world, {-2, 3}, 1, {.velocity = vec(0, 2), .spin = 4});
    addGround(world, -10);
    addBox(world, {0, -5}, 1, 1, {.type = BodyType::Kinematic, .velocity = vec(9, 9)});
    addBox(world, {50, 50}, 1, 1, {.velocity = vec(9, 9)}).setEnabled(false);
    EXPECT_NEAR(world.energy().linear, a.energy().linear + b.energy().linear, 1e-12);
    EXPECT_NEAR(world.energy().rotational, b.energy().rotational, 1e-12);
    EXPECT_NEAR(world.energy().potential, 20 + 30 * kPi, 100 * kExact);
    EXPECT_NEAR(world.momentum().linear.x, 3, 10 * kExact);
    EXPECT_NEAR(world.momentum().linear.y, 2 * kPi, 10 * kExact);
    EXPECT_NEAR(world.momentum().angular, a.momentum().angular + b.momentum().angular, 1e-12);
}

TEST(Energy, CountsOwnAndScaledGravity)
{
    TRACES("DD16", "GD2");
    World world(withGravity(0, -10));
    Body light = addBox(world, {0, 4}, 1, 1);
    light.setGravityScale(toReal(0.5));
    Body sideways = addBox(world, {3, 4}, 1, 1);
    sideways.setOwnGravity(vec(2, 0));
    EXPECT_NEAR(light.energy().potential, 20, 100 * kExact);
    EXPECT_NEAR(sideways.energy().potential, -6, 100 * kExact);
    // And each of them keeps its total as it falls.
    const double before = world.energy().total();
    runSeconds(world, 1);
    EXPECT_NEAR(world.energy().total(), before, byPrecision(1e-10, 1e-3));
}

TEST(Energy, CountsTheLawsThatStateAPotential)
{
    TRACES("DD16");
    World world(weightless());
    Body box = addBox(world, {3, 4}, 1, 1);
    box.addForceLaw(springTo({0, 0}, 8));
    world.addForceLaw(drag(1));  // has none
    EXPECT_NEAR(box.energy().potential, 8 * 25 / 2.0, 100 * kExact);
    EXPECT_NEAR(world.energy().potential, 100, 100 * kExact);
}

TEST(Energy, CountsTheGravitationOfAPairOnce)
{
    TRACES("DD16", "T3");
    WorldDef def = weightless();
    def.gravitationConstant = 2;
    World world(def);
    Body a = addBox(world, {0, 0}, 1, 1, {.density = 3});
    addBox(world, {10, 0}, 1, 1, {.density = 5});
    EXPECT_NEAR(world.energy().potential, -2 * 3 * 5 / 10.0, 10 * kExact);
    EXPECT_EQ(a.energy().potential, 0.0);
}

TEST(Energy, OfAFallTurnsFromPotentialToKinetic)
{
    TRACES("DD15", "DD16", "GD2");
    World world(withGravity(0, -10));
    Body ball = addDisc(world, {0, 100}, 0.5);
    const double total = ball.energy().total(), m = kPi / 4;
    runSeconds(world, 2);
    EXPECT_NEAR(ball.energy().kinetic(), m * 400 / 2, byPrecision(1e-9, 0.02));
    EXPECT_NEAR(ball.energy().potential, m * 10 * 80, byPrecision(1e-9, 0.02));
    EXPECT_NEAR(ball.energy().total(), total, byPrecision(1e-9, 0.02));
}

TEST(VelocityAt, IsThatOfTheCenterAndOfTheTurning)
{
    TRACES("DD9", "A4");
    World world(weightless());
    Body body = world.createBody({.position = {10, 0}});
    body.createShape({.geometry = makeBox(1, 1), .offset = vec(1, 0)});
    body.setLinearVelocity(vec(1, 2));
    body.setAngularVelocity(3);
    // The center is at (11, 0); 2 m above it the turning adds (-6, 0).
    EXPECT_NEAR(body.velocityAt({11, 2}).x, -5, 10 * kExact);
    EXPECT_NEAR(body.velocityAt({11, 2}).y, 2, 10 * kExact);
    EXPECT_NEAR(body.velocityAt({12, 0}).y, 5, 10 * kExact);
    Body wall = addBox(world, {0, 9}, 1, 1, {.type = BodyType::Static});
    EXPECT_EQ(wall.velocityAt({5, 5}), vec(0, 0));
}

// The traps: a tiny negative angle plus 2 pi rounds to 2 pi itself, and large ones lose digits.
TEST(Angle, IsAlwaysInOneTurn)
{
    TRACES("DC-phi", "R6");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 1, 1);
    const auto expectInRange = [&](double given) {
        const std::array<BodyId, 1> ids = {body.id()};
        std::array<BodyState, 1> states{};
        world.readStates(ids, states);
        for (const double angle : {body.angle(), body.transform().angle, body.definition().angle,
                                   states[0].angle, body.interpolated(0.3).angle, wrapAngle(given)}) {
            EXPECT_GE(angle, 0.0) << "given " << given;
            EXPECT_LT(angle, kTwoPi) << "given " << given;
        }
        EXPECT_FALSE(std::signbit(body.angle())) << "given " << given;
    };
    for (const double angle : {0.0,
                               -0.0,
                               1e-300,
                               -1e-300,
                               -1e-20,
                               -1e-16,
                               -4e-16,
                               3.0,
                               -3.0,
                               kPi,
                               -kPi,
                               kTwoPi,
                               -kTwoPi,
                               std::nextafter(kTwoPi, 0),
                               std::nextafter(kTwoPi, 7),
                               100 * kTwoPi,
                               -1e6,
                               1e6,
                               1e15,
                               -1e300,
                               1.7e308}) {
        body.setTransform({0, 0}, angle);
        expectInRange(angle);
        const Body made = world.createBody({.angle = angle});
        EXPECT_GE(made.angle(), 0.0) << "given " << angle;
        EXPECT_LT(made.angle(), kTwoPi) << "given " << angle;
        if (std::abs(angle) < 1000) {
            EXPECT_NEAR(angleDifference(body.angle(), angle), 0, 1e-12) << "given " << angle;
        }
    }
    for (const double spin : {-7.0, 7.0, 1e-9, -1e-9}) {
        body.setTransform({0, 0}, 0);
        body.setAngularVelocity(toReal(spin));
        for (int i = 0; i < 200; ++i) {
            world.step();
            expectInRange(0);
        }
    }
}

// A3, A4: motion along x leaves y alone; a positive torque turns from +x to +y.
TEST(Axes, AreCartesianAndRightHanded)
{
    TRACES("A2", "A3", "A4", "DD5", "DD13");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(2, 0)});
    runSeconds(world, 1);
    EXPECT_NEAR(body.position().x, 2, 1e-5);
    EXPECT_EQ(body.position().y, 0.0);
    body.setLinearVelocity(vec(0, 0));
    body.applyForce(vec(0, 1), {2.5, 0});  // right of the center, upwards
    world.step();
    EXPECT_GT(body.angularVelocity(), real(0));
    EXPECT_GT(body.angle(), 0.0);
    EXPECT_LT(body.angle(), 1.0);
    const Position right = toWorld(body.transform(), vec(0.5, 0));
    EXPECT_GT(right.y, body.position().y) << "the right side goes up";
}

}  // namespace
}  // namespace tamias2d
