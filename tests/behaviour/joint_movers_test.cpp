// SPDX-License-Identifier: MIT
// Joints that drive and brake without tying, and one that only keeps bodies from colliding.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

struct Plane {
    World world{weightless()};
    Body floor = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body puck;

    explicit Plane(double mass = 2, double inertia = 0.5) : puck(addDisc(world, {3, 0}, 0.1))
    {
        puck.setMass({toReal(mass), {}, toReal(inertia)});
    }
};

// --- motors

TEST(MotorJoint, ReachesItsSpeedsAtTheRateOfItsForce)
{
    TRACES("LC3", "DD13");
    Plane s;
    Joint joint = s.world.createJoint(jointOf(
        s.floor, s.puck, MotorJoint{.velocity = vec(3, 4), .spin = 6, .maxForce = 5, .maxTorque = 1}));
    runSeconds(s.world, 1);
    EXPECT_LT(relativeError(velocityOf(s.puck), DVec2{1.5, 2}), 0.01);  // 2.5 m/s^2, straight
    EXPECT_LT(relativeError(spinOf(s.puck), 2), 0.01);
    EXPECT_LT(relativeError(length(toDVec2(joint.reading().force)), 5), 0.01);
    EXPECT_LT(relativeError(static_cast<double>(joint.reading().motorForce), 1), 0.01);
    EXPECT_LT(relativeError(static_cast<double>(joint.reading().motorPower), 5 * 2.5 + 1 * 2), 0.02);
    runSeconds(s.world, 4);
    EXPECT_LT(relativeError(velocityOf(s.puck), DVec2{3, 4}), 1e-4);
    EXPECT_LT(relativeError(spinOf(s.puck), 6), 1e-4);
}

TEST(MotorJoint, ASpeedIsThatInTheFrameOfA)
{
    TRACES("LC3", "GD1");
    Plane s;
    s.floor.setType(BodyType::Kinematic);
    s.floor.setAngularVelocity(toReal(0.5));
    s.floor.setLinearVelocity(vec(1, 0));
    s.world.createJoint(jointOf(s.floor, s.puck, MotorJoint{}));  // as A goes
    runSeconds(s.world, kTwoPi);  // half a turn
    EXPECT_LT(relativeError(spinOf(s.puck), 0.5), 1e-3);
    const DVec2 around = centerOf(s.puck) - centerOf(s.floor);
    EXPECT_LT(length(around - DVec2{-3, 0}), 0.02);
}

TEST(MotorJoint, GoesToAPlaceAndAnAngleAndPushesNoHarderThanItsForce)
{
    TRACES("LC3", "DD13");
    Plane s;
    const JointSpring spring{2, 1, 0};
    Joint joint = s.world.createJoint(jointOf(s.floor, s.puck,
                                              MotorJoint{.anchorA = vec(-1, 2),
                                                         .referenceAngle = 1,
                                                         .linear = spring,
                                                         .angular = spring,
                                                         .maxForce = 10,
                                                         .maxTorque = 1}));
    double fastest = 0;
    runSeconds(s.world, 0.2, 60, 4, [&] { fastest = std::max(fastest, length(velocityOf(s.puck))); });
    EXPECT_LT(fastest, 5 * 0.2 * 1.01);
    EXPECT_GT(fastest, 5 * 0.2 * 0.99);
    runSeconds(s.world, 6);
    EXPECT_LT(length(centerOf(s.puck) - DVec2{-1, 2}), 1e-3);
    EXPECT_NEAR(s.puck.angle(), 1, 1e-3);
    EXPECT_NEAR(joint.reading().position, 0, 1e-3);
}

TEST(MotorJoint, KeepsMomentumOfTwoFreeBodies)
{
    TRACES("LC3", "GD1");
    Plane s;
    s.floor.setType(BodyType::Dynamic);
    s.floor.setMass({5, {}, 2});
    s.puck.setLinearVelocity(vec(0.3, 1));
    s.world.createJoint(jointOf(
        s.floor, s.puck, MotorJoint{.velocity = vec(1, -1), .spin = 2, .maxForce = 3, .maxTorque = 1}));
    const Momentum before = s.world.momentum();
    runSeconds(s.world, 5);
    EXPECT_LT(relativeError(s.world.momentum().linear, before.linear), byPrecision(1e-9, 1e-5));
    EXPECT_LT(relativeError(s.world.momentum().angular, before.angular, 1), byPrecision(1e-6, 1e-4));
}

TEST(MotorJoint, KeepsBodiesAwakeOnlyIfItRuns)
{
    TRACES("LC3", "NFR1");
    for (const double speed : {0.0, 1e-4}) {
        Plane s;
        s.world.createJoint(jointOf(s.floor, s.puck, MotorJoint{.velocity = vec(speed, 0), .maxForce = 1}));
        runSeconds(s.world, 3);
        EXPECT_EQ(s.puck.isAwake(), speed != 0);
    }
}

// --- friction

TEST(FrictionJoint, BrakesAtItsForceAndStops)
{
    TRACES("LC3", "DD13", "T1");
    Plane s;
    Joint joint = s.world.createJoint(jointOf(s.floor, s.puck, FrictionJoint{.maxForce = 4, .maxTorque = 1}));
    s.puck.setLinearVelocity(vec(3, 4));
    s.puck.setAngularVelocity(8);
    runSeconds(s.world, 1);
    EXPECT_LT(relativeError(length(velocityOf(s.puck)), 5 - 2), 1e-3);  // 4 N on 2 kg
    EXPECT_LT(relativeError(spinOf(s.puck), 8 - 2), 1e-3);              // 1 N*m on 0.5 kg*m^2
    EXPECT_LT(relativeError(length(toDVec2(joint.reading().force)), 4), 0.01);
    runSeconds(s.world, 4);
    // v^2/(2 a), and in a straight line
    EXPECT_LT(length(centerOf(s.puck) - (DVec2{3, 0} + 6.25 * DVec2{0.6, 0.8})), 0.01);
    EXPECT_LT(length(velocityOf(s.puck)), 1e-5);
    EXPECT_NEAR(spinOf(s.puck), 0, 1e-5);
}

TEST(FrictionJoint, HoldsWhatIsPushedByLess)
{
    TRACES("LC3", "T2");
    for (const double part : {0.98, 1.02}) {
        Plane s;
        Joint joint =
            s.world.createJoint(jointOf(s.floor, s.puck, FrictionJoint{.maxForce = 10, .maxTorque = 1}));
        runSeconds(s.world, 2, 60, 4, [&] { s.puck.applyForceToCenter(vec(6 * part, 8 * part)); });
        const double moved = length(centerOf(s.puck) - DVec2{3, 0});
        EXPECT_EQ(moved < 1e-3, part < 1) << part << ": " << moved << " m";
        if (part > 1) continue;
        EXPECT_LT(relativeError(toDVec2(joint.reading().force), part * DVec2{-6, -8}), 0.01);
    }
}

TEST(FrictionJoint, SlowsTwoFreeBodiesToOneVelocityAndKeepsMomentum)
{
    TRACES("LC3", "GD1");
    Plane s;
    s.floor.setType(BodyType::Dynamic);
    s.floor.setMass({4, {}, 2});
    s.puck.setLinearVelocity(vec(3, 0));
    s.world.createJoint(jointOf(s.floor, s.puck, FrictionJoint{.maxForce = 4}));
    const Momentum before = s.world.momentum();
    runSeconds(s.world, 3);
    EXPECT_LT(relativeError(velocityOf(s.puck).x, 1), 1e-3);  // 2 kg of 6
    EXPECT_LT(relativeError(s.world.momentum().linear, before.linear), byPrecision(1e-9, 1e-5));
    EXPECT_LT(relativeError(s.world.momentum().angular, before.angular, 1), byPrecision(1e-6, 1e-4));
}

TEST(FrictionJoint, OffTheCenterItTurnsWhatItBrakes)
{
    TRACES("LC3", "IM2");
    Plane s;
    s.world.createJoint(jointOf(s.floor, s.puck, FrictionJoint{.anchor = vec(0, 0.1), .maxForce = 1}));
    s.puck.setLinearVelocity(vec(10, 0));
    runSeconds(s.world, 0.5);
    EXPECT_LT(relativeError(spinOf(s.puck), 0.1 / 0.5 * 0.5), 0.01);  // F d/I t, the direction hardly turns
}

// --- filters

TEST(FilterJoint, KeepsTwoBodiesFromCollidingAndDoesNothingElse)
{
    TRACES("LC3", "R7");
    World world;
    addGround(world);
    Body a = addBox(world, {0, 0.501}, 1, 1), b = addBox(world, {0.2, 3}, 1, 1),
         c = addBox(world, {0.1, 6}, 1, 1);
    Joint filter = world.createJoint(jointOf(a, b, FilterJoint{}));
    runSeconds(world, 1);
    EXPECT_LT(centerOf(b).y, 0.51);  // through A, on the ground
    EXPECT_EQ(world.lastReport().joints, 0u);
    runSeconds(world, 2);
    EXPECT_GT(centerOf(c).y, 1.4);  // on both
    const JointReading reading = filter.reading();
    EXPECT_EQ(reading.force, Vec2{});
    EXPECT_EQ(reading.error, 0);
    EXPECT_TRUE(world.events().breaks.empty());
}

TEST(FilterJoint, TiesNoSleepers)
{
    TRACES("LC3", "NFR1");
    World world;
    addGround(world);
    Body still = addBox(world, {0, 0.501}, 1, 1), other = addDisc(world, {20, 0.5}, 0.5);
    world.createJoint(jointOf(still, other, FilterJoint{}));
    other.setLinearVelocity(vec(1, 0));
    runSeconds(world, 3);
    EXPECT_TRUE(still.isAsleep());
    EXPECT_FALSE(other.isAsleep());
}

TEST(FilterJoint, MayBeSwitchedOff)
{
    TRACES("LC3", "R7");
    World world(weightless());
    Body a = addBox(world, {0, 0}, 1, 1), b = addBox(world, {0.2, 0.1}, 1, 1);
    Joint filter = world.createJoint(jointOf(a, b, FilterJoint{}));
    runSeconds(world, 0.5);
    EXPECT_TRUE(world.contacts().empty());
    filter.setEnabled(false);
    world.step();
    EXPECT_FALSE(world.contacts().empty());
    runSeconds(world, 1);
    EXPECT_GT(length(centerOf(b) - centerOf(a)), 0.3);  // pressed apart
    filter.setEnabled(true);
    world.step();
    EXPECT_TRUE(world.contacts().empty());
}

}  // namespace
}  // namespace tamias2d
