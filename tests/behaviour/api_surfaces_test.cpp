// SPDX-License-Identifier: MIT
// Surfaces that carry: conveyor belts, platforms and lifts; surfaces that slow: friction, rolling resistance.
// And how two materials become one.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tamias2d {
namespace {

using namespace test;

constexpr double kG = 9.81;  // [m/s^2]

TEST(Conveyor, CarriesABoxToTheLeftOnItsTop)
{
    TRACES("R3", "R5");
    World world;
    const double speed = 2, friction = 0.5;
    addGround(world, 0, 100, {.friction = friction, .surfaceSpeed = speed});
    Body box = addBox(world, {0, 0.251}, 1, 0.5, {.friction = friction});
    // Sliding friction mu g until the box is as fast as the belt, after v / (mu g) = 0.41 s.
    runSeconds(world, 0.2);
    EXPECT_NEAR(box.linearVelocity().x, -friction * kG * 0.2, 0.03);
    runSeconds(world, 0.8);
    EXPECT_NEAR(box.linearVelocity().x, -speed, 1e-3);
    const double at = box.position().x;
    runSeconds(world, 1);
    EXPECT_NEAR(box.position().x - at, -speed, 2e-3);
    EXPECT_NEAR(box.position().y, 0.251, 2e-3);
}

TEST(Conveyor, RunsTheOtherWayWithTheOtherSign)
{
    TRACES("R3", "R5");
    World world;
    Body belt = addGround(world, 0, 100);
    Material material = belt.shapes().front().material();
    Body box = addBox(world, {0, 0.251}, 1, 0.5);
    runSeconds(world, 0.5);
    EXPECT_NEAR(box.linearVelocity().x, 0, 1e-6);
    material.surfaceSpeed = -1;  // switched on while the box lies on it
    belt.shapes().front().setMaterial(material);
    runSeconds(world, 1);
    EXPECT_NEAR(box.linearVelocity().x, 1, 1e-3);
    material.surfaceSpeed = 0;
    belt.shapes().front().setMaterial(material);
    runSeconds(world, 1);
    EXPECT_NEAR(box.linearVelocity().x, 0, 1e-3);
}

TEST(Conveyor, WithoutFrictionCarriesNothing)
{
    TRACES("R3");
    World world;
    addGround(world, 0, 100, {.friction = 0, .surfaceSpeed = 5});
    Body box = addBox(world, {0, 0.251}, 1, 0.5);
    runSeconds(world, 1);
    EXPECT_NEAR(box.linearVelocity().x, 0, 1e-9);
}

TEST(Platform, LiftsWhatStandsOnIt)
{
    TRACES("R5", "R8");
    World world;
    Body lift = addBox(world, {0, 0}, 4, 0.5, {.type = BodyType::Kinematic});
    Body box = addBox(world, {0.5, 0.751}, 1, 1);
    runSeconds(world, 0.5);
    lift.setLinearVelocity(vec(0, 1.5));
    runSeconds(world, 2);
    EXPECT_NEAR(box.linearVelocity().y, 1.5, 1e-3);
    EXPECT_NEAR(box.position().y - lift.position().y, 0.751, 2e-3);
    EXPECT_TRUE(world.touching(box.id(), lift.id()));
    lift.setLinearVelocity(vec(0, -1.5));  // slower than a fall in the end: the box stays on, or lands again
    runSeconds(world, 2);
    EXPECT_NEAR(box.linearVelocity().y, -1.5, 2e-3);
    EXPECT_NEAR(box.position().y - lift.position().y, 0.751, 2e-3);
}

TEST(Platform, CarriesWhatStandsOnItSidewaysByFriction)
{
    TRACES("R5", "R3");
    World world;
    Body platform = addBox(world, {0, 0}, 20, 0.5, {.type = BodyType::Kinematic, .velocity = vec(2, 0)});
    Body box = addBox(world, {0, 0.501}, 1, 0.5);
    runSeconds(world, 2);
    EXPECT_NEAR(box.linearVelocity().x, 2, 1e-3);
    // It slides v^2 / (2 mu g) back on the platform before it goes along.
    EXPECT_NEAR(box.position().x - platform.position().x, -4 / (2 * 0.6 * kG), 0.02);
}

// M = c N r slows a rolling disc by 2/3 c g: of the 3/2 m that rolling has to stop, 1/2 m is its spin.
TEST(RollingResistance, SlowsARollingDiscAsTheClosedFormSays)
{
    TRACES("R3", "R6");
    const double c = 0.05, r = 0.5, v = 2, deceleration = 2.0 / 3 * c * kG;
    World world;
    addGround(world, 0, 200, {.rollingResistance = c});
    Body disc =
        addDisc(world, {-50, r * 1.001}, r, {.velocity = vec(v, 0), .spin = -v / r, .rollingResistance = c});
    runSeconds(world, 3);
    EXPECT_NEAR(disc.linearVelocity().x, v - deceleration * 3, 0.01 * v);
    EXPECT_NEAR(disc.angularVelocity(), -(v - deceleration * 3) / r, 0.01 * v / r);
    runSeconds(world, 7);
    EXPECT_NEAR(disc.position().x + 50, v * v / (2 * deceleration), 0.01 * v * v / (2 * deceleration));
    EXPECT_NEAR(disc.linearVelocity().x, 0, 1e-6);
    EXPECT_NEAR(disc.angularVelocity(), 0, 1e-6);
}

TEST(RollingResistance, HoldsADiscOnASlopeThatIsFlatEnough)
{
    TRACES("R3");
    // It rolls if m g sin r > c N r, so it holds below tan = c.
    for (const double tangent : {0.04, 0.06}) {
        const double c = 0.05, r = 0.5, angle = std::atan(tangent);
        World world(withGravity(-kG * std::sin(angle), -kG * std::cos(angle)));
        addGround(world, 0, 200, {.rollingResistance = c});
        Body disc = addDisc(world, {0, r * 1.001}, r, {.rollingResistance = c});
        runSeconds(world, 5);
        if (tangent < c) {
            EXPECT_NEAR(disc.position().x, 0, 1e-3);
        } else {
            const double a = 2.0 / 3 * (kG * std::sin(angle) - c * kG * std::cos(angle));
            EXPECT_NEAR(disc.position().x, -a * 25 / 2, 0.02 * a * 25 / 2);
        }
    }
}

TEST(RollingResistance, ThatIsTakenAwayStopsActing)
{
    TRACES("R3", "LC2");
    World world;
    const double r = 0.5, v = 3;
    Body ground = addGround(world, 0, 200, {.rollingResistance = 0.05});
    Body disc = addDisc(world, {-50, r * 1.002}, r,
                        {.velocity = vec(v, 0), .spin = -v / r, .rollingResistance = 0.05});
    runSeconds(world, 1);
    for (Body body : {ground, disc}) {
        Material smooth = body.shapes().front().definition().material;
        smooth.rollingResistance = 0;
        body.shapes().front().setMaterial(smooth);
    }
    world.step();
    const double spin = spinOf(disc);
    EXPECT_LT(spin, -1);  // it rolls on
    runSeconds(world, 5);
    EXPECT_NEAR(spinOf(disc), spin, 1e-4);
}

TEST(RollingResistance, OfNoneLetsADiscRollOn)
{
    TRACES("R3");
    World world;
    addGround(world, 0, 200);
    Body disc = addDisc(world, {-50, 0.5005}, 0.5, {.velocity = vec(2, 0), .spin = -4});
    runSeconds(world, 10);
    EXPECT_NEAR(disc.linearVelocity().x, 2, 2e-3);
}

// The friction and restitution of the contact between a resting disc and the ground, as ContactView tells.
struct Mixed {
    real friction, restitution;
};
Mixed mixed(WorldDef worldDef, const Material& upper, const Material& lower)
{
    World world(worldDef);
    Body ground = world.createBody({.type = BodyType::Static});
    ground.createShape({.geometry = makeBox(10, 1), .material = lower});
    Body disc = world.createBody({.position = {0, 1.0005}});
    disc.createShape({.geometry = Circle{}, .material = upper});
    world.step();
    const auto contacts = world.contacts();
    if (contacts.size() != 1) {
        ADD_FAILURE() << contacts.size() << " contacts";
        return {};
    }
    return {contacts[0].friction, contacts[0].restitution};
}

struct RuleCase {
    MixingRule rule;
    double mixed;  // of 0.2 and 0.8   [1]
};
const std::vector<RuleCase> kRules = {
    {MixingRule::Average, 0.5},       {MixingRule::Minimum, 0.2}, {MixingRule::Multiply, 0.16},
    {MixingRule::GeometricMean, 0.4}, {MixingRule::Maximum, 0.8},
};

TEST(Mixing, EveryRuleOfTheWorldGivesItsValue)
{
    TRACES("R3", "DD12");
    const Material a{.friction = toReal(0.2), .restitution = toReal(0.8)};
    const Material b{.friction = toReal(0.8), .restitution = toReal(0.2)};
    for (const RuleCase& e : kRules) {
        WorldDef def;
        def.frictionMixing = def.restitutionMixing = e.rule;
        const Mixed pair = mixed(def, a, b);
        EXPECT_NEAR(pair.friction, e.mixed, 1e-7) << "rule " << int(e.rule);
        EXPECT_NEAR(pair.restitution, e.mixed, 1e-7) << "rule " << int(e.rule);
    }
}

TEST(Mixing, OfTheDefaultsIsRootOfProductAndMaximum)
{
    TRACES("R3");
    const Material a{.friction = toReal(0.2), .restitution = toReal(0.3)};
    const Material b{.friction = toReal(0.8), .restitution = toReal(0.1)};
    const Mixed pair = mixed({}, a, b);
    EXPECT_NEAR(pair.friction, 0.4, 1e-7);
    EXPECT_NEAR(pair.restitution, 0.3, 1e-7);
    const Mixed plain = mixed({}, {}, {});
    EXPECT_NEAR(plain.friction, 0.6, 1e-7);
    EXPECT_EQ(plain.restitution, real(0));
}

TEST(Mixing, OfTwoRulesTheOneFurtherDownTheListIsTaken)
{
    TRACES("R3");
    for (const RuleCase& one : kRules) {
        for (const RuleCase& other : kRules) {
            const Material a{.friction = toReal(0.2),
                             .restitution = toReal(0.2),
                             .frictionMixing = one.rule,
                             .restitutionMixing = other.rule};
            const Material b{.friction = toReal(0.8),
                             .restitution = toReal(0.8),
                             .frictionMixing = other.rule,
                             .restitutionMixing = one.rule};
            const RuleCase& taken = one.rule < other.rule ? other : one;
            const Mixed pair = mixed({}, a, b);
            EXPECT_NEAR(pair.friction, taken.mixed, 1e-7) << int(one.rule) << " and " << int(other.rule);
            EXPECT_NEAR(pair.restitution, taken.mixed, 1e-7) << int(one.rule) << " and " << int(other.rule);
        }
    }
}

TEST(Mixing, AMaterialWithARuleOverridesTheWorlds)
{
    TRACES("R3");
    WorldDef def;
    def.frictionMixing = MixingRule::Maximum;
    const Material a{.friction = toReal(0.2), .frictionMixing = MixingRule::Minimum};
    const Material b{.friction = toReal(0.8)};
    EXPECT_NEAR(mixed(def, a, b).friction, 0.2, 1e-7);
    EXPECT_NEAR(mixed(def, b, a).friction, 0.2, 1e-7);
}

TEST(Mixing, RulesCanBeChangedWhileTheWorldRuns)
{
    TRACES("R3");
    World world;
    addGround(world, 0, 10, {.friction = 0.2, .restitution = 0.2});
    addDisc(world, {0, 0.5005}, 0.5, {.friction = 0.8, .restitution = 0.8});
    world.step();
    world.setMixingRules(MixingRule::Minimum, MixingRule::Average);
    world.step();
    ASSERT_EQ(world.contacts().size(), 1u);
    EXPECT_NEAR(world.contacts()[0].friction, 0.2, 1e-7);
    EXPECT_NEAR(world.contacts()[0].restitution, 0.5, 1e-7);
}

TEST(Mixing, DecidesHowHighABallBounces)
{
    TRACES("R3", "R8", "DD12");
    for (const RuleCase& e : kRules) {
        WorldDef def = weightless();
        def.restitutionMixing = e.rule;
        World world(def);
        addGround(world, 0, 10, {.friction = 0, .restitution = 0.2});
        Body ball = addDisc(world, {0, 2}, 0.5, {.velocity = vec(0, -5), .restitution = 0.8});
        runSeconds(world, 1);
        EXPECT_NEAR(ball.linearVelocity().y, 5 * e.mixed, 5e-5) << "rule " << int(e.rule);
    }
}

}  // namespace
}  // namespace tamias2d
