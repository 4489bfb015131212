// SPDX-License-Identifier: MIT
// Joints of angles alone: rotary limits, springs and motors, ratchets and gears.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

// Wheels on pivots of their own, without gravity.
struct Wheels {
    World world{weightless()};
    Body post = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
    std::vector<Body> all;

    explicit Wheels(std::initializer_list<double> inertias)
    {
        double x = 0;
        for (const double inertia : inertias) {
            Body wheel = addDisc(world, {x, 0}, 0.1);
            wheel.setMass({1, {}, toReal(inertia)});
            world.createJoint(revoluteAt(post, wheel, {x, 0}));
            all.push_back(wheel);
            x += 3;
        }
    }
};

double torqueOf(const Joint& joint)
{
    return static_cast<double>(joint.reading().torque);
}

// --- turns

// What has turned several times is written down, and read again by another world.
TEST(JointTurns, AreKeptByADefinition)
{
    TRACES("LC3", "R5");
    for (const double speed : {7.0, -7.0}) {
        for (const bool revolute : {true, false}) {
            JointDef def;
            if (revolute)
                def.kind = RevoluteJoint{.referenceAngle = 0.5};
            else
                def.kind = RotaryJoint{.referenceAngle = 0.5, .limits = JointLimits{-100, 100}};
            World world(weightless()), other(weightless());
            def.bodyA = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static}).id();
            def.bodyB = addDisc(world, {0, 0}, 0.5, {.spin = speed}).id();
            Joint joint = world.createJoint(def);
            runSeconds(world, 3);  // 21 rad: more than three turns
            const double angle = joint.reading().position;
            EXPECT_NEAR(angle, 3 * speed - 0.5, 1e-2);

            JointDef again = joint.definition();
            again.bodyA = addDisc(other, {0, 0}, 0.05, {.type = BodyType::Static}).id();
            again.bodyB = addDisc(other, {0, 0}, 0.5, {.angle = world.body(def.bodyB).angle()}).id();
            EXPECT_NEAR(other.createJoint(again).reading().position, angle, 1e-9);
            joint.setKind(again.kind);
            EXPECT_NEAR(joint.reading().position, angle, 1e-9);
        }
    }
}

TEST(JointTurns, ThatAJointBeginsWithCountForItsLimits)
{
    TRACES("LC3");
    World world(weightless());
    Body post = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
    Body wheel = addDisc(world, {0, 0}, 0.5, {.spin = 2});
    Joint joint = world.createJoint(
        jointOf(post, wheel,
                RevoluteJoint{.limits = JointLimits{.lower = 0, .upper = toReal(4 * kPi + 1)}, .turns = 2}));
    runSeconds(world, 2);
    EXPECT_EQ(joint.reading().limit, LimitState::AtUpper);
    EXPECT_NEAR(joint.reading().position, 4 * kPi + 1, 1e-3);
    EXPECT_LT(std::abs(angleDifference(wheel.angle(), 1)), 1e-3);
}

// --- rotary joints

TEST(RotaryJoint, HoldsAnAngleAndLeavesPlacesFree)
{
    TRACES("LC3", "GD1", "IM1");
    World world;
    Body a = addBox(world, {0, 0}, 1, 0.5, {.velocity = vec(1, 3), .spin = 2});
    Body b = addBox(world, {3, 0}, 2, 0.5, {.spin = -1, .angle = 0.3});
    Joint joint = world.createJoint(jointOf(a, b, RotaryJoint{.referenceAngle = 0.3}));
    const double spin = (2 * static_cast<double>(a.inertia()) - static_cast<double>(b.inertia())) /
                        static_cast<double>(a.inertia() + b.inertia());
    runSeconds(world, 2);
    EXPECT_LT(std::abs(angleDifference(b.angle() - a.angle(), 0.3)), 1e-4);
    EXPECT_LT(relativeError(spinOf(a), spin), 1e-3);
    EXPECT_LT(length(centerOf(a) - DVec2{2, 6 - 9.81 * 2}), 1e-3);
    EXPECT_LT(length(centerOf(b) - DVec2{3, -9.81 * 2}), 1e-3);
    EXPECT_EQ(joint.reading().force, Vec2{});
}

TEST(RotaryJoint, ReadsTheTorqueItBears)
{
    TRACES("LC3", "T2", "DD10");
    for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) {
        Wheels s{ratio};
        Joint joint = s.world.createJoint(jointOf(s.post, s.all[0], RotaryJoint{}));
        runSeconds(s.world, 1, 60, 4, [&] { s.all[0].applyTorque(toReal(-7 * ratio)); });
        EXPECT_LT(relativeError(torqueOf(joint), 7 * ratio), 0.01) << ratio;
        EXPECT_LT(static_cast<double>(joint.reading().angularError), 1e-4) << ratio;
    }
}

TEST(RotaryJoint, ItsLimitsHoldAtFiftyRadiansASecond)
{
    TRACES("LC3", "DD6");
    for (const double range : {0.5, 20.0}) {
        Wheels s{1};
        Joint joint = s.world.createJoint(jointOf(
            s.post, s.all[0], RotaryJoint{.limits = JointLimits{toReal(-range / 2), toReal(range / 2)}}));
        double over = 0;
        for (int i = 0; i < 90; ++i) {
            if (i % 30 == 0) s.all[0].setAngularVelocity(toReal(i % 60 == 0 ? 50 : -50));
            s.world.step();
            over = std::max(over, std::abs(joint.reading().position) - range / 2);
        }
        EXPECT_LT(over, 1e-3 * range) << range;
    }
}

TEST(RotaryJoint, ItsMotorDrivesAsASimpleMotorDoes)
{
    TRACES("LC3", "DD13");
    Wheels s{2, 3};
    Joint joint = s.world.createJoint(jointOf(s.all[0], s.all[1], RotaryJoint{.motor = JointMotor{10, 6}}));
    runSeconds(s.world, 1);
    EXPECT_LT(relativeError(spinOf(s.all[0]), -3), 0.01);  // 6 N*m on each
    EXPECT_LT(relativeError(spinOf(s.all[1]), 2), 0.01);
    joint.setMotorSpeed(4);
    runSeconds(s.world, 1);
    EXPECT_NEAR(spinOf(s.all[1]) - spinOf(s.all[0]), 4, 1e-3);
}

TEST(RotaryJoint, ItsSpringSwingsTwoFreeBodiesAtItsFrequency)
{
    TRACES("LC3", "IM2", "NFR2");
    Wheels s{2, 6};
    Joint joint =
        s.world.createJoint(jointOf(s.all[0], s.all[1], RotaryJoint{.spring = JointSpring{2, 0, 0}}));
    s.all[0].setAngularVelocity(3);
    s.all[1].setAngularVelocity(-1);
    const double start = s.world.energy().total();
    double worst = 0;
    runSeconds(s.world, 5, 120, 4, [&] {
        const double w = kTwoPi * 2, expected = -4 / w * std::sin(w * s.world.time());
        worst = std::max(worst, std::abs(joint.reading().position - expected));
    });
    EXPECT_LT(worst, 0.02 * 4 / (kTwoPi * 2));
    EXPECT_LT(relativeError(s.world.energy().total(), start), 1e-3);
}

// --- ratchets

TEST(RatchetJoint, TurnsForwardsFreelyAndNeverBackOverATooth)
{
    TRACES("LC3", "DD6");
    for (const double tooth : {0.5, -0.5}) {
        const double way = tooth > 0 ? 1 : -1;
        Wheels s{1};
        Joint joint = s.world.createJoint(jointOf(s.post, s.all[0], RatchetJoint{.tooth = toReal(tooth)}));
        s.all[0].setAngularVelocity(toReal(2 * way));
        runSeconds(s.world, 5.1);  // 10.2 rad: one and a half turns, past tooth 20
        EXPECT_LT(relativeError(joint.reading().position, 10.2 * way), 1e-4);
        EXPECT_NEAR(spinOf(s.all[0]), 2 * way, 1e-5);
        double back = 0;
        runSeconds(s.world, 3, 60, 4, [&] {
            s.all[0].applyTorque(toReal(-20 * way));
            back = std::max(back, 10 - joint.reading().position * way);
        });
        EXPECT_LT(back, 1e-3) << tooth;
        EXPECT_NEAR(spinOf(s.all[0]), 0, 1e-3) << tooth;
        EXPECT_EQ(joint.reading().limit, LimitState::AtLower);
        EXPECT_LT(relativeError(torqueOf(joint) * way, 20), 0.01);
    }
}

TEST(RatchetJoint, RocksBetweenItsTeethAndAdvancesToothByTooth)
{
    TRACES("LC3");
    Wheels s{1};
    Joint joint = s.world.createJoint(jointOf(s.post, s.all[0], RatchetJoint{.tooth = toReal(0.3)}));
    double passed = 0;
    runSeconds(s.world, 40, 60, 4, [&] {
        // To and fro with a little more to: each time one that is far enough is kept.
        s.all[0].applyTorque(toReal(8 * std::sin(4 * s.world.time()) + 0.5));
        const double at = joint.reading().position;
        EXPECT_GT(at, passed - 1e-3);
        passed = std::max(passed, 0.3 * std::floor(at / 0.3));
    });
    EXPECT_GT(passed, 2 * kTwoPi);
}

TEST(RatchetJoint, ItsTwinHoldsTheToothThatHolds)
{
    TRACES("LC3", "R5");
    Wheels s{1};
    Joint joint = s.world.createJoint(jointOf(s.post, s.all[0], RatchetJoint{.tooth = toReal(0.3)}));
    s.all[0].setAngularVelocity(2);
    runSeconds(s.world, 1);
    for (int i = 0; i < 5; ++i) {
        runSeconds(s.world, 1, 60, 4, [&] { s.all[0].applyTorque(-50); });
        EXPECT_NEAR(angleDifference(s.all[0].angle(), 6 * 0.3), 0, 1e-3);
        const JointDef def = joint.definition();
        joint.destroy();
        joint = s.world.createJoint(def);
    }
}

TEST(RatchetJoint, BeginsAnewWhereItIsEnabledAgain)
{
    TRACES("LC3");
    Wheels s{1};
    Joint joint = s.world.createJoint(jointOf(s.post, s.all[0], RatchetJoint{.tooth = toReal(0.5)}));
    s.all[0].setAngularVelocity(2);
    runSeconds(s.world, 1);
    joint.setEnabled(false);
    s.all[0].setAngularVelocity(-2);
    runSeconds(s.world, 0.9);  // back to 0.2
    joint.setEnabled(true);
    runSeconds(s.world, 1);
    EXPECT_GT(joint.reading().position, -1e-3);
    EXPECT_LT(joint.reading().position, 0.5);
    EXPECT_NEAR(spinOf(s.all[0]), 0, 1e-3);
}

// --- gears

TEST(GearJoint, KeepsItsRatioAndItsPhaseForManyTurns)
{
    TRACES("LC3", "IM2", "NFR2");
    for (const double ratio : {-0.5, 2.5, -3.7}) {
        Wheels s{1, 2};
        s.all[1].setTransform({3, 0}, 1);
        Joint joint = s.world.createJoint(gearBetween(s.all[0], s.all[1], toReal(ratio)));
        // Angular momentum as the gear sees it: I_A w + r I_B (r w) = I_A w_0.
        s.all[0].setAngularVelocity(30);
        const double expected = 30 / (1 + ratio * ratio * 2);
        double turnedA = 0, turnedB = 0, worst = 0, lastA = 0, lastB = 1, energy = 0;
        s.world.step();
        runSeconds(s.world, 20, 60, 4, [&] {
            if (energy == 0) energy = s.world.energy().total();
            turnedA += angleDifference(s.all[0].angle(), lastA);
            turnedB += angleDifference(s.all[1].angle(), lastB);
            lastA = s.all[0].angle();
            lastB = s.all[1].angle();
            worst = std::max(worst, relativeError(spinOf(s.all[1]), ratio * spinOf(s.all[0])));
        });
        EXPECT_LT(relativeError(spinOf(s.all[0]), expected), 1e-3) << ratio;
        EXPECT_LT(worst, 1e-4) << ratio;
        EXPECT_LT(std::abs(turnedB - ratio * turnedA), 1e-4 * std::abs(turnedB)) << ratio;
        EXPECT_LT(static_cast<double>(joint.reading().angularError), 1e-4) << ratio;
        EXPECT_LT(relativeError(s.world.energy().total(), energy), 1e-4) << ratio;
        // Its twin takes over where it is.
        const Joint twin = s.world.createJoint(joint.definition());
        EXPECT_LT(static_cast<double>(twin.reading().angularError), 1e-3) << ratio;
    }
}

TEST(GearJoint, PassesTorqueOnByItsRatio)
{
    TRACES("LC3", "T2", "DD10");
    for (const double ratio : {1.0, -4.0, 10.0, 100.0}) {
        Wheels s{1, 1};
        Joint gear = s.world.createJoint(gearBetween(s.all[0], s.all[1], toReal(ratio)));
        Joint hold = s.world.createJoint(jointOf(s.post, s.all[1], RotaryJoint{}));
        runSeconds(s.world, 1, 60, 4, [&] { s.all[0].applyTorque(toReal(10 * ratio)); });
        EXPECT_LT(relativeError(torqueOf(gear), 10), 0.01) << ratio;
        EXPECT_LT(relativeError(torqueOf(hold), -10), 0.01) << ratio;
    }
}

TEST(GearJoint, AClockworkOfFourKeepsAllItsRatios)
{
    TRACES("LC3", "IM2");
    Wheels s{1, 0.5, 2, 0.1};
    s.world.createJoint(gearBetween(s.all[0], s.all[1], -2));
    s.world.createJoint(gearBetween(s.all[1], s.all[2], toReal(-0.75)));
    s.world.createJoint(gearBetween(s.all[2], s.all[3], -5));
    s.world.createJoint(jointOf(s.post, s.all[0], RotaryJoint{.motor = JointMotor{7, 1000}}));
    runSeconds(s.world, 10);
    EXPECT_LT(relativeError(spinOf(s.all[0]), 7), 1e-3);
    EXPECT_LT(relativeError(spinOf(s.all[1]), -14), 1e-3);
    EXPECT_LT(relativeError(spinOf(s.all[2]), 10.5), 1e-3);
    EXPECT_LT(relativeError(spinOf(s.all[3]), -52.5), 1e-3);
}

TEST(GearJoint, MayBeShiftedWhileItRuns)
{
    TRACES("LC3", "R4");
    Wheels s{1, 1};
    Joint joint = s.world.createJoint(gearBetween(s.all[0], s.all[1], 2));
    s.world.createJoint(jointOf(s.post, s.all[0], RotaryJoint{.motor = JointMotor{5, 1000}}));
    runSeconds(s.world, 5);
    EXPECT_LT(relativeError(spinOf(s.all[1]), 10), 1e-3);
    const double start = s.all[1].angle();
    joint.setKind(gearBetween(s.all[0], s.all[1], toReal(0.5)).kind);
    s.world.step();
    EXPECT_LT(std::abs(angleDifference(s.all[1].angle(), start)), 0.3);  // no leap: it goes on from there
    runSeconds(s.world, 2);
    EXPECT_LT(relativeError(spinOf(s.all[1]), 2.5), 1e-3);
}

TEST(GearJoint, BreaksAtItsTorqueOnly)
{
    TRACES("LC3", "ADR13");
    for (const double part : {0.98, 1.02}) {
        Wheels s{1, 1};
        JointDef def = gearBetween(s.all[0], s.all[1], 2);
        def.breaking.torque = toReal(10 / part);
        Joint gear = s.world.createJoint(def);
        s.world.createJoint(jointOf(s.post, s.all[1], RotaryJoint{}));
        runSeconds(s.world, 2, 60, 4, [&] { s.all[0].applyTorque(20); });
        EXPECT_EQ(gear.isBroken(), part > 1) << part;
    }
}

}  // namespace
}  // namespace tamias2d
