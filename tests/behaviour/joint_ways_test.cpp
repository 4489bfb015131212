// SPDX-License-Identifier: MIT
// Joints along lines: wheels, grooves, racks and pulleys, against closed forms and statics.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

const double kRatios[] = {1, 10, 100, 1000};

Body addPost(World& world, Position place = {0, 0})
{
    return addDisc(world, place, 0.1, {.type = BodyType::Static});
}
Body addMass(World& world, Position place, double mass, double inertia)
{
    Body body = addDisc(world, place, 0.1);
    body.setMass({toReal(mass), {}, toReal(inertia)});
    return body;
}

double forceY(const Joint& joint)
{
    return static_cast<double>(joint.reading().force.y);
}
double errorOf(const Joint& joint)
{
    return static_cast<double>(joint.reading().error);
}

// --- wheels

TEST(WheelJoint, SagsUnderItsLoadAsItsSpringSays)
{
    TRACES("LC3", "DD13", "T2");
    for (const double ratio : kRatios) {
        World world;
        Body post = addPost(world), load = addMass(world, {0, -1}, ratio, ratio);
        JointDef def = wheelAt(post, load, {0, -1}, vec(0, 1));
        std::get<WheelJoint>(def.kind).spring = JointSpring{1, toReal(0.7), 0};
        Joint joint = world.createJoint(def);
        runSeconds(world, 6);
        const double sag = kGravity / (kTwoPi * kTwoPi);  // g/(2 pi f)^2, whatever the mass
        EXPECT_LT(relativeError(joint.reading().position, -sag), 1e-3) << ratio;
        EXPECT_LT(relativeError(forceY(joint), ratio * kGravity), 0.01) << ratio;
        EXPECT_LT(relativeError(static_cast<double>(joint.reading().springForce), ratio * kGravity), 0.01);
    }
}

TEST(WheelJoint, BearsALoadAcrossItsAxis)
{
    TRACES("LC3", "T2", "DD10");
    for (const double ratio : kRatios) {
        World world;
        Body post = addPost(world), load = addMass(world, {1, 0}, ratio, ratio);
        Joint joint = world.createJoint(wheelAt(post, load, {1, 0}, vec(3, 0)));
        runSeconds(world, 2);
        EXPECT_LT(relativeError(forceY(joint), ratio * kGravity), 0.01) << ratio;
        EXPECT_LT(errorOf(joint), 1e-4) << ratio;
    }
}

TEST(WheelJoint, TwoFreeBodiesSwingAtTheFrequencyOfTheSpring)
{
    TRACES("LC3", "IM1", "GD1");
    World world(weightless());
    Body chassis = addMass(world, {0, 1}, 10, 5), wheel = addMass(world, {0, 0}, 2, 1);
    JointDef def = wheelAt(chassis, wheel, {0, 0}, vec(0, -1));
    std::get<WheelJoint>(def.kind).spring = JointSpring{2, 0, 0};
    Joint joint = world.createJoint(def);
    wheel.setLinearVelocity(vec(0, 1));
    chassis.setLinearVelocity(vec(0, -0.2));
    double worst = 0;
    runSeconds(world, 3, 240, 4, [&] {  // relative speed 1.2 m/s upwards: against the axis
        const double w = kTwoPi * 2, expected = -1.2 / w * std::sin(w * world.time());
        worst = std::max(worst, std::abs(joint.reading().position - expected));
    });
    EXPECT_LT(worst, 0.01 * 1.2 / (kTwoPi * 2) * 3);
    EXPECT_NEAR(world.momentum().linear.y, 0, byPrecision(1e-9, 1e-4));
}

TEST(WheelJoint, ItsMotorReachesItsSpeedAtTheRateOfItsTorqueAndStalls)
{
    TRACES("LC3", "DD13");
    World world(weightless());
    Body post = addPost(world), wheel = addMass(world, {0, 0}, 1, 2);
    JointDef def = wheelAt(post, wheel, {0, 0}, vec(0, 1));
    std::get<WheelJoint>(def.kind).motor = JointMotor{10, 5};
    Joint joint = world.createJoint(def);
    runSeconds(world, 1);
    EXPECT_LT(relativeError(spinOf(wheel), 2.5), 0.01);
    EXPECT_LT(relativeError(static_cast<double>(joint.reading().motorForce), 5), 0.01);
    runSeconds(world, 4);
    EXPECT_NEAR(spinOf(wheel), 10, 1e-3);
    joint.setMotorSpeed(-1);
    runSeconds(world, 6);
    EXPECT_NEAR(spinOf(wheel), -1, 1e-3);
    for (const double load : {0.98, 1.02}) {  // of its torque
        joint.setMotorSpeed(0);
        wheel.setAngularVelocity(0);
        const double before = wheel.angle();
        runSeconds(world, 1, 60, 4, [&] { wheel.applyTorque(toReal(5 * load)); });
        EXPECT_EQ(std::abs(angleDifference(wheel.angle(), before)) < 1e-3, load < 1) << load;
    }
}

TEST(WheelJoint, ItsTravelEndsAtItsLimits)
{
    TRACES("LC3", "DD6");
    World world(weightless());
    Body post = addPost(world), wheel = addMass(world, {0, 0}, 1, 1);
    JointDef def = wheelAt(post, wheel, {0, 0}, vec(0, 1));
    std::get<WheelJoint>(def.kind).spring = std::nullopt;
    std::get<WheelJoint>(def.kind).limits = JointLimits{toReal(-0.2), toReal(0.3)};
    Joint joint = world.createJoint(def);
    double over = 0;
    for (int i = 0; i < 120; ++i) {
        if (i % 30 == 0) wheel.setLinearVelocity(vec(0, i % 60 == 0 ? 30 : -30));
        world.step();
        over = std::max({over, joint.reading().position - 0.3, -0.2 - joint.reading().position});
    }
    EXPECT_LT(over, 1e-3 * 0.5);
    EXPECT_EQ(joint.reading().limit, LimitState::AtLower);
}

TEST(WheelJoint, ACarRollsWithoutSlip)
{
    TRACES("LC3", "T1");
    World world;
    addGround(world, 0, 400);
    Body chassis = addBox(world, {0, 0.9}, 3, 0.4);
    std::vector<Body> wheels;
    for (const double x : {-1.0, 1.0}) {
        wheels.push_back(addDisc(world, {x, 0.5}, 0.4, {.friction = 1}));
        JointDef def = wheelAt(chassis, wheels.back(), {x, 0.5}, vec(0, 1));
        std::get<WheelJoint>(def.kind).motor = JointMotor{-10, 5};
        world.createJoint(def);
    }
    runSeconds(world, 12);
    EXPECT_NEAR(spinOf(wheels[0]), -10, 0.05);
    EXPECT_NEAR(velocityOf(chassis).x, 4, 0.03);  // omega r
    EXPECT_NEAR(angleDifference(chassis.angle(), 0), 0, 0.02);
}

// --- grooves

TEST(GrooveJoint, ABeadOnASlopeFallsAsOnARailAndStopsAtItsEnd)
{
    TRACES("LC3", "IM1", "DD6");
    World world;
    Body post = addPost(world), bead = addMass(world, {0, 0}, 2, 1);
    const double slope = 0.5;  // rad
    const Position end{4 * std::cos(slope), -4 * std::sin(slope)};
    Joint joint = world.createJoint(grooveBetween(post, bead, {0, 0}, end, {0, 0}));
    const double a = kGravity * std::sin(slope);
    runSeconds(world, 1);
    EXPECT_LT(relativeError(joint.reading().position, a / 2), 1e-3);
    EXPECT_LT(relativeError(length(toDVec2(joint.reading().force)), 2 * kGravity * std::cos(slope)), 0.01);
    double farthest = 0;
    runSeconds(world, 3, 60, 4, [&] { farthest = std::max(farthest, joint.reading().position); });
    EXPECT_LT(farthest, 4 + 1e-3);
    EXPECT_LT(length(centerOf(bead) - DVec2{end.x, end.y}), 1e-3);
    EXPECT_EQ(joint.reading().limit, LimitState::AtUpper);
    EXPECT_LT(relativeError(forceY(joint), 2 * kGravity), 0.01);
    EXPECT_LT(errorOf(joint), 1e-3);
}

TEST(GrooveJoint, BearsAHangingLoadAndLetsItTurn)
{
    TRACES("LC3", "T2", "DD10");
    for (const double ratio : kRatios) {
        World world;
        Body post = addPost(world), load = addMass(world, {0.5, -1}, ratio, ratio);
        load.setAngularDamping(5);
        Joint joint = world.createJoint(grooveBetween(post, load, {-1, 0}, {1, 0}, {0.5, 0}));
        runSeconds(world, 2);
        EXPECT_LT(relativeError(forceY(joint), ratio * kGravity), 0.01) << ratio;
        EXPECT_NEAR(static_cast<double>(joint.reading().torque), 0, 1e-3 * ratio) << ratio;
        EXPECT_LT(errorOf(joint), 1e-4) << ratio;
    }
}

TEST(GrooveJoint, TurnsWithTheBodyItIsIn)
{
    TRACES("LC3", "GD1");
    World world(weightless());
    Body plate = addMass(world, {0, 0}, 5, 5), bead = addMass(world, {0.3, 0.2}, 1, 1);
    plate.setAngularVelocity(3);
    Joint joint = world.createJoint(grooveBetween(plate, bead, {-1, 0.2}, {1, 0.2}, {0.3, 0.2}));
    const Momentum before = world.momentum();
    const double energy = world.energy().total();
    runSeconds(world, 5);
    EXPECT_LT(relativeError(world.momentum().angular, before.angular), byPrecision(1e-6, 1e-4));
    EXPECT_LT(errorOf(joint), 1e-3);
    EXPECT_LE(world.energy().total(), energy * 1.001);
    EXPECT_EQ(joint.reading().limit, LimitState::AtUpper);  // where it is flung to
}

// --- racks

TEST(RackJoint, AFallingRackTurnsItsPinion)
{
    TRACES("LC3", "IM1", "IM2");
    World world;
    Body post = addPost(world);
    Body pinion = addMass(world, {0, 0}, 1, 0.8), rack = addMass(world, {0.5, 0}, 3, 1);
    world.createJoint(revoluteAt(post, pinion, {0, 0}));
    world.createJoint(slideAlong(post, rack, {0.5, 0}, vec(0, 1)));
    Joint joint = world.createJoint(rackAlong(rack, pinion, vec(0, 1), toReal(0.5)));
    double worst = 0;
    const double start = world.energy().total();
    runSeconds(world, 2, 60, 4, [&] {
        const double turned = -spinOf(pinion) * 0.5, way = -velocityOf(rack).y;
        worst = std::max(worst, relativeError(turned, -way, 1));
    });
    // m g = (m + I/r^2) a: the rest of the weight turns the pinion.
    const double a = 3 * kGravity / (3 + 0.8 / 0.25);
    EXPECT_LT(relativeError(velocityOf(rack).y, -a * 2), 1e-3);
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(relativeError(joint.reading().position, a * 2), 1e-3);  // of the pinion against the rack
    EXPECT_LT(errorOf(joint), 1e-4);
    EXPECT_LT(relativeError(forceY(joint), -0.8 / 0.25 * a), 0.01);
    EXPECT_LT(std::abs(world.energy().total() - start), 1e-3 * 3 * kGravity * a * 2);
}

TEST(RackJoint, APinionRollsOnAFixedRackForManyTurns)
{
    TRACES("LC3", "IM2");
    World world(weightless());
    Body rail = addPost(world, {0, 0});
    Body pinion = addMass(world, {0, 0.25}, 1, 1);
    world.createJoint(wheelAt(rail, pinion, {0, 0.25}, vec(1, 0)));  // holds its height
    Joint spring = world.joint(world.joints()[0]);
    WheelJoint free = std::get<WheelJoint>(spring.kind());
    free.spring.reset();
    spring.setKind(free);
    Joint rack = world.createJoint(rackAlong(rail, pinion, vec(1, 0), toReal(-0.25)));  // it lies above
    pinion.setAngularVelocity(-20);
    pinion.setLinearVelocity(vec(5, 0));
    runSeconds(world, 20);
    EXPECT_LT(relativeError(velocityOf(pinion).x, 5), 1e-4);
    EXPECT_LT(relativeError(-0.25 * spinOf(pinion), velocityOf(pinion).x), 1e-4);
    EXPECT_LT(relativeError(centerOf(pinion).x, 100), 1e-4);
    EXPECT_LT(errorOf(rack), 1e-4);
    // Its twin knows how many turns there were.
    const Joint twin = world.createJoint(rack.definition());
    EXPECT_LT(errorOf(twin), 1e-4);
}

TEST(RackJoint, KeepsMomentumOfFreeBodies)
{
    TRACES("LC3", "GD1");
    World world(weightless());
    Body rack = addMass(world, {0, 0}, 2, 3), pinion = addMass(world, {0, 0.5}, 1, 0.5);
    world.createJoint(rackAlong(rack, pinion, vec(1, 0), toReal(-0.5)));
    rack.setAngularVelocity(1);
    pinion.setLinearVelocity(vec(1, 0.2));
    const Momentum before = world.momentum();
    runSeconds(world, 5);
    EXPECT_LT(relativeError(world.momentum().linear, before.linear), byPrecision(1e-9, 1e-5));
    EXPECT_LT(relativeError(world.momentum().angular, before.angular, 1), byPrecision(1e-6, 1e-4));
}

// --- pulleys

TEST(PulleyJoint, AnAtwoodMachineFallsAsItShould)
{
    TRACES("LC3", "IM1", "DD10");
    for (const bool taut : {false, true}) {
        for (const double ratio : {1.0, 2.0, 0.5}) {
            World world;
            Body a = addMass(world, {-1, 0}, 2, 1), b = addMass(world, {1, 0}, 3, 1);
            JointDef def = pulleyOver(a, b, {-1, 0}, {1, 0}, {-1, 10}, {1, 10}, toReal(ratio));
            std::get<PulleyJoint>(def.kind).taut = taut;
            Joint joint = world.createJoint(def);
            const double start = world.energy().total();
            runSeconds(world, 1);
            // Tension T: m_A a_A = T - m_A g, m_B a_B = r T - m_B g, a_A + r a_B = 0.
            const double tension = (1 + ratio) * kGravity / (1.0 / 2 + ratio * ratio / 3);
            const double fall = tension / 2 - kGravity;
            EXPECT_LT(relativeError(velocityOf(a).y, fall), 1e-3) << ratio;
            EXPECT_LT(relativeError(velocityOf(a).y + ratio * velocityOf(b).y, 0, 1), 1e-4);
            EXPECT_LT(relativeError(forceY(joint), ratio * tension), 0.01) << ratio;
            EXPECT_LT(errorOf(joint), 1e-4);
            EXPECT_LT(std::abs(world.energy().total() - start), 2e-3 * 2 * kGravity) << ratio;
        }
    }
}

TEST(PulleyJoint, HoldsWhatItsRatioBalances)
{
    TRACES("LC3", "T2", "DD10");
    for (const double ratio : kRatios) {
        World world;
        Body a = addMass(world, {-1, 0}, 1, 1), b = addMass(world, {1, 0}, ratio, ratio);
        Joint joint = world.createJoint(pulleyOver(a, b, {-1, 0}, {1, 0}, {-1, 3}, {1, 3}, toReal(ratio)));
        runSeconds(world, 3);
        EXPECT_LT(relativeError(forceY(joint), ratio * kGravity), 0.01) << ratio;
        EXPECT_LT(std::abs(centerOf(a).y), 2e-3) << ratio;
        EXPECT_LT(errorOf(joint), 1e-4) << ratio;
    }
}

TEST(PulleyJoint, ARopeIsSlackUntilItIsTautAndThenNoLonger)
{
    TRACES("LC3");
    World world;
    Body post = addPost(world, {-1, 0}), load = addMass(world, {1, 3}, 2, 1);
    JointDef def = pulleyOver(post, load, {-1, 0}, {1, 3}, {-1, 5}, {1, 5});
    std::get<PulleyJoint>(def.kind).length = 9;  // the load may go down to 1
    Joint rope = world.createJoint(def);
    double lowest = 3;
    runSeconds(world, 3, 60, 4, [&] {
        lowest = std::min(lowest, centerOf(load).y);
        if (world.time() < 0.6) {
            EXPECT_NEAR(centerOf(load).y, 3 - kGravity / 2 * world.time() * world.time(), 1e-4);
        }
    });
    EXPECT_GT(lowest, 1 - 1e-3);
    EXPECT_EQ(rope.reading().limit, LimitState::AtUpper);
    EXPECT_LT(relativeError(forceY(rope), 2 * kGravity), 0.01);
}

TEST(PulleyJoint, AnEndStopsBeforeItsWheel)
{
    TRACES("LC3", "DD6");
    World world;
    Body a = addMass(world, {-1, 0}, 1, 1), b = addMass(world, {1, 0}, 3, 1);
    JointDef def = pulleyOver(a, b, {-1, 0}, {1, 0}, {-1, 2}, {1, 2});
    std::get<PulleyJoint>(def.kind).stopA = toReal(0.5);
    Joint joint = world.createJoint(def);
    double highest = 0;
    runSeconds(world, 4, 60, 4, [&] { highest = std::max(highest, centerOf(a).y); });
    EXPECT_LT(highest, 1.5 + 1e-3);
    EXPECT_NEAR(centerOf(a).y, 1.5, 2e-3);
    EXPECT_LT(relativeError(forceY(joint), 3 * kGravity), 0.01);
    EXPECT_LT(errorOf(joint), 2e-3);
}

TEST(PulleyJoint, AnEndThatReachesItsWheelIsHeldThere)
{
    TRACES("LC3", "R4");
    World world;
    Body a = addMass(world, {-1, 0}, 1, 1), b = addMass(world, {1, 0}, 3, 1);
    Joint joint = world.createJoint(pulleyOver(a, b, {-1, 0}, {1, 0}, {-1, 2}, {1, 2}));
    double most = 0;
    const double start = world.energy().total();
    const RunTotals totals = runSeconds(world, 20, 60, 4, [&] { most = std::max(most, errorOf(joint)); });
    EXPECT_LT(most, 0.02);
    EXPECT_LE(totals.highestEnergy, start + 0.1);
    EXPECT_EQ(totals.faults, 0u);
}

TEST(PulleyJoint, BreaksAtItsStrengthOnly)
{
    TRACES("LC3", "ADR13");
    for (const double part : {0.98, 1.02}) {
        World world;
        Body post = addPost(world, {-1, 0}), load = addMass(world, {1, 0}, 2, 1);
        JointDef def = pulleyOver(post, load, {-1, 0}, {1, 0}, {-1, 3}, {1, 3});
        def.breaking.force = toReal(2 * kGravity / part);
        Joint rope = world.createJoint(def);
        runSeconds(world, 2);
        EXPECT_EQ(rope.isBroken(), part > 1) << part;
    }
}

}  // namespace
}  // namespace tamias2d
