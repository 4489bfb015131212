// SPDX-License-Identifier: MIT
// Joints break at their strength, in the same step however they are reckoned, and not before their window.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/scenes.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace tamias2d {
namespace {

using namespace test;

constexpr double kMass = 2, kArm = 0.5;
constexpr double kWeight = kMass * kGravity, kMoment = kWeight * kArm;

// A weight, what holds it, and by how much, as statics says.
struct Held {
    World world;
    Body base, weight;
    Joint joint;
    double force = 0, torque = 0;   // [N], [N*m]; 0: not asked

    Held() : base(addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static}))
    {
        weight = addBox(world, {0, -1}, 0.4, 0.4);
        weight.setMass({toReal(kMass), {}, toReal(0.1)});
    }
    void holdsWeight(const JointDef& def)
    {
        joint = world.createJoint(def);
        force = kWeight;
    }
    // The weight on an arm that turns about the base: the joint holds its angle.
    void holdsArm(const JointKind& kind)
    {
        weight.setTransform({kArm, 0}, 0);
        world.createJoint(revoluteAt(base, weight, {0, 0}));
        joint = world.createJoint(jointOf(base, weight, kind));
        torque = kMoment;
    }
};

struct BreakingCase {
    const char* name;
    std::function<void(Held&)> tie;
};
void PrintTo(const BreakingCase& c, std::ostream* out)
{
    *out << c.name;
}

const BreakingCase kCases[] = {
    {"revolute", [](Held& h) { h.holdsWeight(revoluteAt(h.base, h.weight, {0, 0})); }},
    {"rod", [](Held& h) { h.holdsWeight(rodBetween(h.base, h.weight, {0, 0}, {0, -1})); }},
    {"rope",
     [](Held& h) {
         JointDef rope = rodBetween(h.base, h.weight, {0, 0}, {0, -1});
         std::get<DistanceJoint>(rope.kind).limits = JointLimits{.lower = 0, .upper = 1};
         h.holdsWeight(rope);
     }},
    {"prismatic", [](Held& h) { h.holdsWeight(slideAlong(h.base, h.weight, {0, -1}, {1, 0})); }},
    {"weld", [](Held& h) { h.holdsWeight(weldAt(h.base, h.weight, {0, 0})); }},
    {"weld by torque",
     [](Held& h) {
         h.weight.setTransform({kArm, 0}, 0);
         h.joint = h.world.createJoint(weldAt(h.base, h.weight, {0, 0}));
         h.torque = kMoment;
     }},
    {"wheel", [](Held& h) { h.holdsWeight(wheelAt(h.base, h.weight, {0, -1}, {0, 1})); }},
    {"groove", [](Held& h) { h.holdsWeight(grooveBetween(h.base, h.weight, {-1, -1}, {1, -1}, {0, -1})); }},
    {"rotary", [](Held& h) { h.holdsArm(RotaryJoint{}); }},
    {"ratchet", [](Held& h) { h.holdsArm(RatchetJoint{}); }},
    {"gear", [](Held& h) { h.holdsArm(GearJoint{.ratio = 2}); }},
    {"rack",
     [](Held& h) {
         Body pinion = addDisc(h.world, {0.5, -1}, 0.5);
         h.world.createJoint(revoluteAt(h.base, pinion, {0.5, -1}));
         h.world.createJoint(jointOf(h.base, pinion, RotaryJoint{}));
         h.world.createJoint(slideAlong(h.base, h.weight, {0, -1}, {0, 1}));
         h.holdsWeight(rackAlong(h.weight, pinion, {0, 1}, toReal(0.5)));
     }},
    {"pulley",
     [](Held& h) { h.holdsWeight(pulleyOver(h.base, h.weight, {0, 0}, {0, -1}, {-1, 2}, {0, 2})); }},
    {"target", [](Held& h) { h.holdsWeight(dragAt(h.base, h.weight, {0, -1})); }},
    {"motor",
     [](Held& h) {
         MotorJoint kind;
         kind.anchorA = vec(0, -1);
         kind.linear = JointSpring{.frequency = 4, .dampingRatio = 1};
         h.holdsWeight(jointOf(h.base, h.weight, kind));
     }},
    {"friction", [](Held& h) { h.holdsWeight(jointOf(h.base, h.weight, FrictionJoint{.maxForce = 100})); }},
};

void setStrength(Held& held, double timesLoad)
{
    JointBreaking breaking;
    if (held.force > 0) breaking.force = toReal(timesLoad * held.force);
    if (held.torque > 0) breaking.torque = toReal(timesLoad * held.torque);
    held.joint.setBreaking(breaking);
}

class BreakingOf : public testing::TestWithParam<BreakingCase> {};

TEST_P(BreakingOf, HappensAboveItsStrengthAndNeverTwoPercentBelow)
{
    TRACES("LC3", "ADR13");
    Held held;
    GetParam().tie(held);
    runSeconds(held.world, 5);  // springs come to rest
    const JointReading now = held.joint.reading();
    const double expected = held.force > 0 ? held.force : held.torque;
    const double measured = held.force > 0 ? length(toDVec2(now.force)) : std::abs(double(now.torque));
    EXPECT_LT(relativeError(measured, expected), 0.01);

    setStrength(held, 1.02);
    runSeconds(held.world, 20);
    EXPECT_FALSE(held.joint.isBroken()) << "bears " << measured << " of " << 1.02 * expected;
    setStrength(held, 0.98);
    held.world.step();
    EXPECT_TRUE(held.joint.isBroken()) << "bears " << measured << " of " << 0.98 * expected;
    EXPECT_EQ(held.world.events().breaks.size(), 1u);
    held.world.step();
    EXPECT_TRUE(held.world.events().breaks.empty());
}

INSTANTIATE_TEST_SUITE_P(Joints, BreakingOf, testing::ValuesIn(kCases));

// Which joint broke in which step.
using Breaks = std::vector<std::pair<int, std::uint32_t>>;

// A bridge of weak planks, held by chains of every kind that bears, under hail.
Breaks breaksOf(LaneWidth lanes, int threads, double window)
{
    WorldDef worldDef;
    worldDef.lanes = lanes;
    worldDef.threads = threads;
    World world(worldDef);
    Body banks = addBox(world, {0, -20}, 1, 1, {.type = BodyType::Static});
    const auto tie = [&](JointDef def, double force) {
        def.breaking.force = toReal(force);
        def.breaking.window = toReal(window);
        world.createJoint(def);
    };
    Body last = banks;
    for (int i = 0; i < 16; ++i) {
        const double x = i - 7.5;
        Body plank = addBox(world, {x, 0}, 1, 0.2);
        tie(i % 3 == 2 ? weldAt(last, plank, {x - 0.5, 0}) : revoluteAt(last, plank, {x - 0.5, 0}), 60);
        if (i % 2 == 0) tie(rodBetween(banks, plank, {x, 4}, {x, 0}), 25);
        if (i % 5 == 0) tie(dragAt(banks, plank, {x, 0}), 20);
        if (i % 4 == 3) tie(slideAlong(banks, plank, {x, 0}, {0, 1}), 30);
        last = plank;
    }
    tie(revoluteAt(last, banks, {8, 0}), 60);
    for (int i = 0; i < 300; ++i)
        addDisc(world, {0.9 * (i % 15 - 7), 2 + 0.7 * (i / 15)}, 0.3, {.velocity = vec(0, -3)});
    Breaks breaks;
    for (int step = 0; step < 120; ++step) {
        world.step();
        for (const BreakEvent& event : world.events().breaks) breaks.emplace_back(step, event.joint.index);
    }
    return breaks;
}

TEST(JointBreaking, HappensInTheSameStepWithEveryWidthAndNumberOfThreads)
{
    TRACES("LC3", "ADR5", "ADR6");
    for (const double window : {0.0, 0.1}) {
        const Breaks expected = breaksOf(LaneWidth::Best, 1, window);
        EXPECT_GT(expected.size(), 5u) << "window " << window;
        for (const LaneWidth lanes :
             {LaneWidth::Scalar, LaneWidth::Bytes16, LaneWidth::Bytes32, LaneWidth::Bytes64})
            if (hasLanes(lanes)) {
                EXPECT_EQ(breaksOf(lanes, 1, window), expected);
            }
        for (const int threads : {2, 3, 8}) EXPECT_EQ(breaksOf(LaneWidth::Best, threads, window), expected);
    }
}

// A weight on a rod that bears it and 3 N more, for a window of 0.2 s: 12 steps.
struct Pulled : Held {
    Pulled()
    {
        holdsWeight(rodBetween(base, weight, {0, 0}, {0, -1}));
        joint.setBreaking({.force = toReal(kWeight + 3), .window = toReal(0.2)});
        runSeconds(world, 0.5);
    }
    void pull(int steps, double newtons)
    {
        for (int i = 0; i < steps && !joint.isBroken(); ++i) {
            weight.applyForceToCenter(vec(0, -newtons));
            world.step();
            pulled += joint.isBroken() ? 0 : 1;
        }
    }
    int pulled = 0;  // steps that the rod outlived
};

TEST(JointBreaking, WithAWindowTakesItsTime)
{
    TRACES("LC3", "ADR13");
    Pulled s;
    s.pull(100, 6);
    EXPECT_TRUE(s.joint.isBroken());
    EXPECT_EQ(s.pulled, 11);
}

TEST(JointBreaking, WithAWindowForgetsWhatIsOver)
{
    TRACES("LC3");
    Pulled s;
    for (int i = 0; i < 20; ++i) {
        s.pull(10, 6);
        s.pull(2, 0);  // the second one without any trace of the pull
    }
    EXPECT_FALSE(s.joint.isBroken());
    s.pull(100, 6);
    EXPECT_TRUE(s.joint.isBroken());
}

TEST(JointBreaking, WithAWindowOutlastsTheBlowThatBreaksOneWithout)
{
    TRACES("LC3");
    for (const double window : {0.0, 0.2}) {
        Held held;
        held.holdsWeight(rodBetween(held.base, held.weight, {0, 0}, {0, -1}));
        held.joint.setBreaking({.force = toReal(3 * kWeight), .window = toReal(window)});
        runSeconds(held.world, 0.5);
        held.weight.applyImpulseToCenter(vec(0, -10));
        runSeconds(held.world, 1);
        EXPECT_EQ(held.joint.isBroken(), window == 0);
    }
}

TEST(JointBreaking, ComesThoughAllIsStillForTheWindow)
{
    TRACES("LC3", "ADR25");
    Held held;
    held.holdsWeight(rodBetween(held.base, held.weight, {0, 0}, {0, -1}));
    held.joint.setBreaking({.force = toReal(0.9 * kWeight), .window = 3});
    runSeconds(held.world, 2.9);
    EXPECT_FALSE(held.joint.isBroken());
    runSeconds(held.world, 0.2);
    EXPECT_TRUE(held.joint.isBroken());
}

}  // namespace
}  // namespace tamias2d
