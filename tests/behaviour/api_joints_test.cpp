// SPDX-License-Identifier: MIT
// The interface of joints: life and death, what they know, who collides, breaking.
#include "support/build.hpp"
#include "support/random.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

struct Arm {
    World world;
    Body base = addBox(world, {0, 0}, 1, 1, {.type = BodyType::Static});
    Body arm = addBox(world, {1, 0}, 1.2, 0.4);
    Joint hinge = world.createJoint(revoluteAt(base, arm, {0.5, 0}));
};

TEST(ApiJoints, AJointKnowsItsBodiesAndTheyKnowIt)
{
    TRACES("LC3", "R2");
    Arm s;
    EXPECT_EQ(s.hinge.bodyA(), s.base.id());
    EXPECT_EQ(s.hinge.bodyB(), s.arm.id());
    EXPECT_EQ(s.world.jointCount(), 1u);
    ASSERT_EQ(s.arm.joints().size(), 1u);
    EXPECT_EQ(s.arm.joints()[0].id(), s.hinge.id());
    EXPECT_EQ(s.world.joints(), std::vector<JointId>{s.hinge.id()});
    EXPECT_LT(length(s.hinge.anchorA() - Position{0.5, 0}), 1e-6);
    EXPECT_LT(length(s.hinge.anchorB() - Position{0.5, 0}), 1e-6);
    s.hinge.setName("hinge");
    s.hinge.setUserData(7);
    EXPECT_EQ(s.world.findJoint("hinge")->id(), s.hinge.id());
    EXPECT_EQ(s.world.findJoint(s.hinge.id())->userData(), 7u);
    EXPECT_FALSE(s.world.findJoint("other"));
}

TEST(ApiJoints, ATwinMadeFromItsDefinitionIsTheSame)
{
    TRACES("LC3", "R2");
    Arm s;
    RevoluteJoint kind = std::get<RevoluteJoint>(s.hinge.kind());
    kind.limits = JointLimits{-1, 2};
    kind.motor = JointMotor{3, 4};
    s.hinge.setKind(kind);
    s.hinge.setBreaking({.force = 100});
    const JointDef def = s.hinge.definition();
    const JointDef twin = s.world.createJoint(def).definition();
    EXPECT_EQ(twin.kind, def.kind);
    EXPECT_EQ(twin.breaking, def.breaking);
    EXPECT_EQ(twin.bodyA, def.bodyA);
}

TEST(ApiJoints, AJointDiesWithEitherOfItsBodies)
{
    TRACES("LC3", "R4");
    for (const bool first : {true, false}) {
        Arm s;
        (first ? s.base : s.arm).destroy();
        EXPECT_FALSE(s.hinge.isAlive());
        EXPECT_EQ(s.world.jointCount(), 0u);
        EXPECT_TRUE((first ? s.arm : s.base).joints().empty());
        EXPECT_THROW(s.hinge.reading(), InputError);
        s.world.step();
    }
}

TEST(ApiJoints, ADestroyedJointLetsGo)
{
    TRACES("LC3");
    Arm s;
    runSeconds(s.world, 0.5);
    s.hinge.destroy();
    const Position from = s.arm.centerOfMass();
    const DVec2 v = velocityOf(s.arm);
    for (Shape shape : s.arm.shapes()) shape.setFilter({1, 0, 0});
    runSeconds(s.world, 0.5);
    const DVec2 flown = s.arm.centerOfMass() - from;
    EXPECT_NEAR(flown.x, v.x * 0.5, 1e-3);
    EXPECT_NEAR(flown.y, v.y * 0.5 - 9.81 / 8, 1e-3);
}

TEST(ApiJoints, ADisabledJointDoesNothingAndMayBeEnabledAgain)
{
    TRACES("LC3");
    Arm s;
    s.hinge.setEnabled(false);
    s.world.step();
    EXPECT_EQ(s.world.lastReport().joints, 0u);
    EXPECT_EQ(s.hinge.reading().force, Vec2{});
    s.hinge.setEnabled(true);
    runSeconds(s.world, 1);
    EXPECT_EQ(s.world.lastReport().joints, 1u);
    EXPECT_LT(static_cast<double>(s.hinge.reading().error), 1e-3);
}

TEST(ApiJoints, JoinedBodiesCollideOnlyIfAsked)
{
    TRACES("LC3", "R7");
    Arm s;  // the two overlap
    runSeconds(s.world, 0.2);
    EXPECT_TRUE(s.world.contacts().empty());
    s.hinge.setCollideConnected(true);
    s.world.step();
    EXPECT_FALSE(s.world.contacts().empty());
    s.hinge.setCollideConnected(false);
    s.world.step();
    EXPECT_TRUE(s.world.contacts().empty());
}

TEST(ApiJoints, AnotherKindTakesTheJointsPlace)
{
    TRACES("LC3");
    Arm s;
    s.hinge.setKind(std::get<WeldJoint>(weldAt(s.base, s.arm, {0.5, 0}).kind));
    runSeconds(s.world, 1);
    EXPECT_LT(std::abs(angleDifference(s.arm.angle(), 0)), 1e-3);
    EXPECT_NEAR(centerOf(s.arm).x, 1, 1e-3);
}

TEST(ApiJoints, ALoadBreaksAJointOnceAndAtItsStrengthOnly)
{
    TRACES("LC3", "ADR13");
    for (const double part : {0.98, 1.02}) {  // of the strength
        World world;
        Body hook = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
        Body load = addDisc(world, {0, -1}, 0.1);
        load.setMass({2, {}, 1});
        JointDef def = rodBetween(hook, load, {0, 0}, {0, -1});
        def.breaking.force = toReal(2 * 9.81 / part);
        Joint rod = world.createJoint(def);
        std::size_t events = 0;
        for (int i = 0; i < 120; ++i) {
            world.step();
            for (const BreakEvent& event : world.events().breaks) {
                ++events;
                EXPECT_EQ(event.joint, rod.id());
                EXPECT_EQ(event.bodyB, load.id());
                EXPECT_LT(relativeError(static_cast<double>(event.force.y), 2 * 9.81), 0.01);
            }
        }
        EXPECT_EQ(events, part < 1 ? 0u : 1u);
        EXPECT_EQ(rod.isBroken(), part > 1);
        EXPECT_EQ(rod.isEnabled(), part < 1);
    }
}

// Whatever is made and unmade in whatever order, nothing is left behind and nothing is touched that is gone.
TEST(ApiJoints, TenThousandRandomOperationsLeaveNothingBehind)
{
    TRACES("LC3", "R4");
    World world;
    Random random(7);
    std::vector<Body> bodies{addGround(world)};
    std::vector<Joint> joints;
    const auto any = [&](std::size_t count) {
        return static_cast<std::size_t>(random.between(0, double(count)));
    };
    for (int i = 0; i < 10000; ++i) {
        const double dice = random.between(0, 1);
        std::erase_if(joints, [](const Joint& j) { return !j.isAlive(); });
        if (bodies.size() < 3 || (dice < 0.25 && bodies.size() < 40)) {
            bodies.push_back(addBox(world, {random.between(-5, 5), random.between(1, 5)}, 0.5, 0.3));
        } else if (dice < 0.5 && joints.size() < 80) {
            const Body a = bodies[any(bodies.size())], b = bodies[any(bodies.size())];
            if (a.id() == b.id()) continue;
            const Position place = a.centerOfMass();
            if (length(place - b.centerOfMass()) > 20) continue;
            JointDef def = dice < 0.3    ? revoluteAt(a, b, place)
                           : dice < 0.35 ? weldAt(a, b, place)
                           : dice < 0.4  ? slideAlong(a, b, place, vec(1, 1))
                           : dice < 0.45 ? rodBetween(a, b, place, place + DVec2{1, 0})
                                         : dragAt(a, b, place);
            joints.push_back(world.createJoint(def));
        } else if (dice < 0.6 && !joints.empty()) {
            joints[any(joints.size())].destroy();
        } else if (dice < 0.7 && !joints.empty()) {
            joints[any(joints.size())].setEnabled(dice < 0.65);
        } else if (dice < 0.8) {
            const std::size_t k = 1 + any(bodies.size() - 1);
            bodies[k].destroy();
            bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
            world.step();
            ASSERT_EQ(world.lastReport().nonFinite, 0u) << i;
        }
    }
    while (!bodies.empty()) {
        bodies.back().destroy();
        bodies.pop_back();
    }
    EXPECT_EQ(world.jointCount(), 0u);
    world.step();
}

TEST(ApiJoints, TheOrderOfTheirCreationIsForgotten)
{
    TRACES("LC3", "ADR6");
    const auto hashOf = [](bool backwards) {
        World world;
        Body last = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
        std::vector<JointDef> defs;
        for (int i = 0; i < 8; ++i) {
            Body link = addBox(world, {0.5 * i + 0.25, 0}, 0.5, 0.1);
            defs.push_back(revoluteAt(last, link, {0.5 * i, 0}));
            last = link;
        }
        if (backwards) std::reverse(defs.begin(), defs.end());
        for (const JointDef& def : defs) world.createJoint(def);
        runSeconds(world, 2);
        std::vector<BodyState> states(world.bodyCount());
        world.readStates(world.bodies(), states);
        double sum = 0;
        for (const BodyState& s : states) sum += s.position.x * 3 + s.position.y * 5 + s.angle * 7;
        return sum;
    };
    EXPECT_EQ(hashOf(false), hashOf(true));
}

}  // namespace
}  // namespace tamias2d
