// SPDX-License-Identifier: MIT
// The interface of joints of one's own: life and death, what they know, what they refuse, sleep, breaking.
#include "support/build.hpp"
#include "support/own_joints.hpp"
#include "support/random.hpp"
#include "support/refusals.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace tamias2d {
namespace {

using namespace test;

static_assert(Constraint<OwnRod> && Constraint<OnParabola> && Constraint<Differential>);
static_assert(Constraint<MeanHeight<8>> && !Constraint<MeanHeight<9>>);
struct WithoutRows {
    static constexpr int bodies = 2;
};
struct WithoutBodies {
    void measure(ConstraintBodies, ConstraintRows&) const {}
};
static_assert(!Constraint<WithoutRows> && !Constraint<WithoutBodies> && !Constraint<int>);

struct Three {
    World world{weightless()};
    Body a = addDisc(world, {0, 0}, 0.5), b = addDisc(world, {2, 0}, 0.5), c = addDisc(world, {4, 0}, 0.5);
};

TEST(OwnJointsApi, AJointKnowsAllItsBodiesAndTheyKnowIt)
{
    TRACES("LC3", "R2", "ADR28");
    Three s;
    Joint joint = s.world.createJoint(Differential{}, s.a, s.b, s.c);
    EXPECT_EQ(joint.bodies(), (std::vector<BodyId>{s.a.id(), s.b.id(), s.c.id()}));
    EXPECT_EQ(joint.bodyA(), s.a.id());
    EXPECT_EQ(joint.bodyB(), s.b.id());
    for (const Body& body : {s.a, s.b, s.c}) {
        ASSERT_EQ(body.joints().size(), 1u);
        EXPECT_EQ(body.joints()[0].id(), joint.id());
    }
    Joint alone = s.world.createJoint(OnParabola{}, s.a);
    EXPECT_EQ(alone.bodies(), std::vector<BodyId>{s.a.id()});
    EXPECT_EQ(s.a.joints().size(), 2u);
    joint.setName("differential");
    joint.setUserData(7);
    EXPECT_EQ(s.world.findJoint("differential")->userData(), 7u);
    EXPECT_TRUE(s.world.validate().empty());
}

TEST(OwnJointsApi, ItsConstraintCanBeReadAndReplaced)
{
    TRACES("LC3", "R2");
    Three s;
    Joint joint = s.world.createJoint(Differential{1, 2, -3}, s.a, s.b, s.c);
    const OwnJoint kind = std::get<OwnJoint>(joint.kind());
    ASSERT_NE(kind.as<Differential>(), nullptr);
    EXPECT_EQ(kind.as<Differential>()->b, 2);
    EXPECT_EQ(kind.as<Midway>(), nullptr);
    EXPECT_EQ(kind.name(), "Differential");
    joint.setKind(OwnJoint(Differential{1, -1, 0}));
    s.a.applyAngularImpulse(1);
    runSeconds(s.world, 0.5);
    EXPECT_LT(
        relativeError(static_cast<double>(s.b.angularVelocity()), static_cast<double>(s.a.angularVelocity())),
        1e-4);
    EXPECT_NEAR(static_cast<double>(s.c.angularVelocity()), 0, 1e-9);
    // Of as many bodies only.
    EXPECT_THROW(joint.setKind(OwnJoint(OwnRod{})), InputError);
    EXPECT_THROW(joint.setKind(RevoluteJoint{}), InputError);
    Joint pair = s.world.createJoint(OwnRod{{}, {}, 2}, s.a, s.b);
    pair.setKind(DistanceJoint{.length = 2});
    EXPECT_TRUE(s.world.validate().empty());
    pair.setKind(OwnJoint(OwnHinge{vec(1, 0), vec(-1, 0)}));
    runSeconds(s.world, 0.5);
    EXPECT_TRUE(s.world.validate().empty());
}

TEST(OwnJointsApi, ATwinMadeFromItsDefinitionIsTheSame)
{
    TRACES("LC3", "R2");
    Three s;
    JointDef def = constraintOf(Midway{}, s.a, s.b, s.c);
    def.name = "midway";
    def.breaking.force = 100;
    Joint joint = s.world.createJoint(def);
    const JointDef twin = s.world.createJoint(joint.definition()).definition();
    EXPECT_EQ(twin.kind, def.kind);
    EXPECT_EQ(twin.moreBodies, def.moreBodies);
    EXPECT_EQ(twin.breaking, def.breaking);
    EXPECT_EQ(twin.name, "midway");
}

TEST(OwnJointsApi, AJointDiesWithAnyOfItsBodies)
{
    TRACES("LC3", "R4");
    for (int dead = 0; dead < 3; ++dead) {
        Three s;
        Joint joint = s.world.createJoint(Midway{}, s.a, s.b, s.c);
        s.world.step();
        Body all[] = {s.a, s.b, s.c};
        all[dead].destroy();
        EXPECT_FALSE(joint.isAlive());
        EXPECT_EQ(s.world.jointCount(), 0u);
        for (int i = 0; i < 3; ++i) {
            if (i != dead) {
                EXPECT_TRUE(all[i].joints().empty());
            }
        }
        s.world.step();
        EXPECT_TRUE(s.world.validate().empty());
    }
}

TEST(OwnJointsApi, ItsBodiesCollideOnlyIfItSaysSo)
{
    TRACES("LC3", "R7");
    for (const bool collide : {false, true}) {
        World world(weightless());
        Body a = addDisc(world, {0, 0}, 0.5, {.velocity = vec(2, 0)}), b = addDisc(world, {9, 5}, 0.5);
        Body c = addDisc(world, {2, 0}, 0.5);
        JointDef def = constraintOf(saying<3>([](ConstraintBodies, ConstraintRows&) {}), a, b, c);
        def.collideConnected = collide;
        world.createJoint(def);
        runSeconds(world, 2);
        EXPECT_EQ(centerOf(a).x > centerOf(c).x, !collide);
    }
}

TEST(OwnJointsApi, BreaksOnceAndIsMended)
{
    TRACES("LC3");
    World world;
    Body hook = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body load = addDisc(world, {0, -1}, 0.5);
    const double weight = static_cast<double>(load.mass()) * 9.81;
    for (const double strength : {1.02, 0.98}) {
        JointDef def = constraintOf(OwnRod{}, hook, load);
        def.breaking.force = toReal(strength * weight);
        load.setTransform({0, -1}, 0);
        load.setLinearVelocity({});
        Joint joint = world.createJoint(def);
        int breaks = 0;
        for (int step = 0; step < 120; ++step) {
            world.step();
            for (const BreakEvent& event : world.events().breaks) {
                ++breaks;
                EXPECT_EQ(event.joint, joint.id());
                EXPECT_GT(static_cast<double>(event.force.y), 0.98 * weight);
            }
        }
        EXPECT_EQ(breaks, strength < 1 ? 1 : 0);
        EXPECT_EQ(joint.isBroken(), strength < 1);
        joint.setEnabled(true);
        EXPECT_FALSE(joint.isBroken());
        joint.destroy();
    }
}

TEST(OwnJointsApi, WhatHangsOnItSleepsAndWakesTogether)
{
    TRACES("LC3");
    World world;
    Body hook = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body a = addDisc(world, {0, -1}, 0.2), b = addDisc(world, {5, -1}, 0.2), c = addDisc(world, {9, -1}, 0.2);
    for (Body body : {a, b, c}) {  // pendulums at rest
        world.createJoint(rodBetween(hook, body, {0, 0}, body.position()));
    }
    a.setTransform({0, -1}, 0);
    Joint own = world.createJoint(
        saying<3>([](ConstraintBodies at, ConstraintRows& rows) {
            rows.rigid(at[0].turned - at[1].turned + at[2].turned).turn(0, 1).turn(1, -1).turn(2, 1);
        }),
        a, b, c);
    for (Body body : {b, c}) body.setTransform({0, -1}, 0);
    for (Body body : {b, c}) body.joints()[0].destroy();
    for (Body body : {b, c}) world.createJoint(rodBetween(hook, body, {0, 0}, {0, -1}));
    runSeconds(world, 5);
    EXPECT_TRUE(a.isAsleep() && b.isAsleep() && c.isAsleep());
    c.applyAngularImpulse(toReal(0.01));
    EXPECT_TRUE(!a.isAsleep() && !b.isAsleep() && !c.isAsleep());
    runSeconds(world, 5);
    own.setEnabled(false);
    EXPECT_TRUE(!a.isAsleep() && !b.isAsleep() && !c.isAsleep());
    EXPECT_TRUE(world.validate().empty());
}

TEST(OwnJointsApi, ABodyHeldByTheWorldAloneSleepsUnlessAMotorRuns)
{
    TRACES("LC3");
    World world;
    Body bead = addDisc(world, {0, 0}, 0.1), driven = addDisc(world, {5, 0}, 0.1);
    world.createJoint(OnParabola{}, bead);
    world.createJoint(saying<1>([](ConstraintBodies at, ConstraintRows& rows) {
                          rows.rigid(at[0].center.x - 5).move(0, {1, 0});
                          rows.rigid(at[0].center.y).move(0, {0, 1});
                          rows.motor(toReal(1e-4), 0.5).turn(0, 1);
                      }),
                      driven);
    runSeconds(world, 5);
    EXPECT_TRUE(bead.isAsleep());
    EXPECT_FALSE(driven.isAsleep());
}

// --- bad input

template <int Count, class Says>
std::string refusalOf(Says says)
{
    World world;
    std::vector<Body> all;
    for (int i = 0; i < 3; ++i) all.push_back(addDisc(world, {2.0 * i, 0}, 0.5));
    const std::uint64_t before = world.stateHash();
    std::string text = "none";
    try {
        if constexpr (Count == 1) world.createJoint(saying<1>(says), all[0]);
        if constexpr (Count == 2) world.createJoint(saying<2>(says), all[0], all[1]);
        if constexpr (Count == 3) world.createJoint(saying<3>(says), all[0], all[1], all[2]);
    } catch (const InputError& error) {
        text = error.what();
    }
    EXPECT_EQ(world.stateHash(), before);
    EXPECT_EQ(world.jointCount(), 0u);
    return text;
}

TEST(OwnJointsApi, WhatAConstraintAnswersIsChecked)
{
    TRACES("R4", "LC3", "ADR28");
    using At = ConstraintBodies;
    using Rows = ConstraintRows;
    EXPECT_EQ((refusalOf<2>([](At, Rows& rows) { rows.rigid(kNaN).move(0, {1, 0}); })),
              "Saying.rows[0].error = nan: must be finite and within +-1e9");
    EXPECT_EQ((refusalOf<2>([](At, Rows& rows) {
                  rows.rigid(0).move(0, {1, 0});
                  rows.limit(0).move(1, vec(0, kInfinity));
              })),
              "Saying.rows[1].direction = inf: must be finite and within +-1e6");
    EXPECT_EQ((refusalOf<2>([](At, Rows& rows) { rows.rigid(0).move(2, {1, 0}); })),
              "Saying.rows[0].body = 2: must be one of those of the constraint");
    EXPECT_EQ((refusalOf<1>([](At, Rows& rows) { rows.rigid(0).turn(-1, 1); })),
              "Saying.rows[0].body = -1: must be one of those of the constraint");
    EXPECT_EQ((refusalOf<1>([](At, Rows& rows) { rows.spring(0, -1).turn(0, 1); })),
              "Saying.rows[0].stiffness = -1: must be in [0, 1e15]");
    EXPECT_EQ((refusalOf<1>([](At, Rows& rows) { rows.spring(0, 1, -1).turn(0, 1); })),
              "Saying.rows[0].damping = -1: must be in [0, 1e15]");
    EXPECT_EQ((refusalOf<1>([](At, Rows& rows) { rows.motor(toReal(kNaN), 1).turn(0, 1); })),
              "Saying.rows[0].speed = nan: must be finite and within +-1e6");
    EXPECT_EQ((refusalOf<1>([](At, Rows& rows) { rows.motor(1, -1).turn(0, 1); })),
              "Saying.rows[0].force = -1: must be in [0, kUnlimited]");
    EXPECT_EQ((refusalOf<1>([](At, Rows& rows) { rows.position(kNaN); })),
              "Saying.position.error = nan: must be finite and within +-1e9");
    EXPECT_EQ((refusalOf<3>([](At, Rows& rows) {
                  for (int i = 0; i < 4; ++i) rows.rigid(0).turn(0, 1);
              })),
              "Saying.rows[3].rigid = 4: must be at most 3 rows");
    EXPECT_EQ((refusalOf<3>([](At, Rows& rows) {
                  for (int i = 0; i < 9; ++i) rows.limit(0).turn(0, 1);
              })),
              "Saying.rows[5].count = 7: must be at most 6");
    EXPECT_EQ(
        (refusalOf<2>([](At, Rows& rows) {
            for (int i = 0; i < 3; ++i) rows.spring(0, 1).turn(0, 1);
            for (int i = 0; i < 2; ++i) rows.motor(0, 1).turn(0, 1);
        })),
        "Saying.rows[4].spring = 5: must be at most 3 springs and 3 motors, together no more than 4 rows");
    EXPECT_EQ((refusalOf<3>([](At, Rows&) { throw std::runtime_error("no such place"); })),
              "Saying.measure = \"no such place\": must not throw");
    EXPECT_EQ((refusalOf<3>([](At, Rows&) { throw 7; })), "Saying.measure = \"\": must not throw");
}

TEST(OwnJointsApi, ItsBodiesAreChecked)
{
    TRACES("R4", "LC3");
    Three s;
    Body ground = addGround(s.world), wall = addGround(s.world, -5);
    Body dead = addDisc(s.world, {9, 9}, 0.5);
    dead.destroy();
    const auto refused = [&](const JointDef& def, const std::string& field) {
        try {
            s.world.createJoint(def);
            ADD_FAILURE() << "not refused: " << field;
        } catch (const InputError& error) {
            EXPECT_EQ(error.field, field) << error.what();
        }
        EXPECT_EQ(s.world.jointCount(), 0u);
    };
    EXPECT_THROW(s.world.createJoint(OwnRod{}, s.a, dead), InputError);
    EXPECT_THROW(s.world.createJoint(OwnRod{}, s.a, s.a), InputError);
    EXPECT_THROW(s.world.createJoint(OnParabola{}, ground), InputError);
    EXPECT_THROW(s.world.createJoint(OwnRod{}, ground, wall), InputError);
    EXPECT_THROW(s.world.createJoint(Midway{}, s.a, s.b, s.a), InputError);
    EXPECT_THROW(s.world.createJoint(Midway{}, s.a, s.b, Body{}), InputError);
    JointDef def = constraintOf(Midway{}, s.a, s.b, s.c);
    def.moreBodies.clear();
    refused(def, "JointDef.moreBodies");
    def = constraintOf(OwnRod{}, s.a, s.b);
    def.moreBodies = {s.c.id()};
    refused(def, "JointDef.moreBodies");
    def.kind = RevoluteJoint{};
    refused(def, "JointDef.moreBodies");
    def.moreBodies.clear();
    def.kind = OwnJoint{};
    refused(def, "OwnJoint");
    def = constraintOf(OnParabola{}, s.a);
    def.bodyB = s.b.id();
    refused(def, "JointDef.bodyB");
    // One that moves is enough.
    s.world.createJoint(Midway{}, ground, wall, s.c);
    s.world.step();
    EXPECT_TRUE(s.world.validate().empty());
}

// From some place on a constraint answers nonsense: it lets go, is counted, and nothing else is harmed.
TEST(OwnJointsApi, AFaultInAStepIsCountedAndLetsGo)
{
    TRACES("R4", "LC3");
    enum class Nonsense { Throws, NotANumber, OtherRows, WrongBody };
    for (const Nonsense nonsense :
         {Nonsense::Throws, Nonsense::NotANumber, Nonsense::OtherRows, Nonsense::WrongBody}) {
        for (const int count : {1, 3}) {
            Three s;
            Body witness = addDisc(s.world, {0, 50}, 0.5, {.velocity = vec(1, 2)});
            const auto says = [nonsense](ConstraintBodies at, ConstraintRows& rows) {
                const bool isOut = at[0].center.x > 0.5;
                if (isOut && nonsense == Nonsense::Throws) throw std::runtime_error("out");
                rows.rigid(isOut && nonsense == Nonsense::NotANumber ? kNaN : at[0].center.y)
                    .move(isOut && nonsense == Nonsense::WrongBody ? 8 : 0, {0, 1});
                if (isOut && nonsense == Nonsense::OtherRows) rows.limit(1).move(0, {1, 0});
            };
            Joint joint = count == 1 ? s.world.createJoint(saying<1>(says), s.a)
                                     : s.world.createJoint(saying<3>(says), s.a, s.b, s.c);
            s.a.setLinearVelocity(vec(1, 1));
            runSeconds(s.world, 0.25);
            EXPECT_EQ(s.world.lastReport().jointFaults, 0u);
            EXPECT_NEAR(s.a.position().y, 0, 1e-5);
            std::uint32_t faults = 0;
            runSeconds(s.world, 1, 60, 4, [&] { faults += s.world.lastReport().jointFaults; });
            EXPECT_GT(faults, 0u);
            EXPECT_TRUE(s.world.validate().empty());
            EXPECT_TRUE(joint.isAlive());
            EXPECT_TRUE(std::isfinite(joint.reading().position));
            EXPECT_TRUE(joint.rowReadings().empty());
            EXPECT_NEAR(witness.position().x, 1.25, 1e-4);
            s.world.stateHash();
            // It takes hold again where it can answer.
            s.a.setTransform({0, 0}, 0);
            s.a.setLinearVelocity({});
            s.a.applyForceToCenter(vec(0, 10));
            s.world.step();
            EXPECT_EQ(s.world.lastReport().jointFaults, 0u);
            EXPECT_NEAR(s.a.position().y, 0, 1e-4);
        }
    }
}

TEST(OwnJointsApi, TenThousandRandomOperationsLeaveNothingBehind)
{
    TRACES("LC3", "R4");
    World world;
    Random random(11);
    std::vector<Body> bodies{addGround(world)};
    std::vector<Joint> joints;
    const auto any = [&](std::size_t count) {
        return static_cast<std::size_t>(random.between(0, double(count)));
    };
    for (int i = 0; i < 10000; ++i) {
        const double dice = random.between(0, 1);
        std::erase_if(joints, [](const Joint& j) { return !j.isAlive(); });
        if (bodies.size() < 5 || (dice < 0.25 && bodies.size() < 40)) {
            bodies.push_back(addBox(world, {random.between(-5, 5), random.between(1, 5)}, 0.5, 0.3));
        } else if (dice < 0.5 && joints.size() < 60) {
            const Body a = bodies[any(bodies.size())], b = bodies[any(bodies.size())],
                       c = bodies[any(bodies.size())];
            const auto wild = [dice](ConstraintBodies at, ConstraintRows& rows) {
                if (at[0].center.y < 0.5) throw std::runtime_error("low");
                rows.rigid(at[0].center.x > 3 ? kNaN : dice).move(0, {1, 0}).turn(0, 1);
                if (at[0].center.x < -3) rows.limit(0).turn(0, 1);
            };
            try {
                joints.push_back(dice < 0.3    ? world.createJoint(OwnRod{{}, {}, 1}, a, b)
                                 : dice < 0.35 ? world.createJoint(OnParabola{}, a)
                                 : dice < 0.4  ? world.createJoint(Midway{}, a, b, c)
                                 : dice < 0.43 ? world.createJoint(Differential{}, a, b, c)
                                 : dice < 0.46 ? world.createJoint(saying<1>(wild), a)
                                 : dice < 0.48 ? world.createJoint(revoluteAt(a, b, a.centerOfMass()))
                                               : world.createJoint(Lift{}, b));
            } catch (const InputError&) {
            }
        } else if (dice < 0.6 && !joints.empty()) {
            joints[any(joints.size())].destroy();
        } else if (dice < 0.7 && !joints.empty()) {
            joints[any(joints.size())].setEnabled(dice < 0.65);
        } else if (dice < 0.77) {
            const std::size_t k = 1 + any(bodies.size() - 1);
            bodies[k].destroy();
            bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(k));
        } else if (dice < 0.8) {
            bodies[1 + any(bodies.size() - 1)].setEnabled(dice < 0.79);
        } else {
            world.step();
            ASSERT_EQ(world.lastReport().nonFinite, 0u) << i;
        }
        if (i % 50 == 0) {
            const std::vector<std::string> faults = world.validate();
            ASSERT_TRUE(faults.empty()) << i << ": " << faults.front();
        }
    }
    while (!bodies.empty()) {
        bodies.back().destroy();
        bodies.pop_back();
    }
    EXPECT_EQ(world.jointCount(), 0u);
    world.step();
}

}  // namespace
}  // namespace tamias2d
