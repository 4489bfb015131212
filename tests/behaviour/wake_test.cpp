// SPDX-License-Identifier: MIT
// What wakes the sleeping, and what does not.
#include <support/run.hpp>
#include <support/scenes.hpp>

#include <functional>
#include <memory>

namespace tamias2d::test {
namespace {

// Three boxes asleep on a plate that lies on a floor, and another body asleep far away.
struct Sleepers {
    World world;
    Body floor = addGround(world);
    Body plate = addBox(world, {0, 0.5}, 4, 1, {.type = BodyType::Static});
    std::vector<Placed> boxes;
    Body apart = addBox(world, {20, 0.501}, 1, 1);

    explicit Sleepers(BodyType plateType = BodyType::Static)
    {
        plate.setType(plateType);
        const double gap = restGapFor(world, 1);
        for (int i = 0; i < 3; ++i) {
            const Position at{0, 1.5 + gap + i * (1 + gap)};
            boxes.push_back({addBox(world, at, 1, 1), at});
        }
        runSeconds(world, 4);
        EXPECT_EQ(world.lastReport().asleep, 4u);
    }
    Body top() { return boxes.back().body; }
    Shape plateShape() { return plate.shapes().front(); }
    bool areAwake() const
    {
        return boxes[0].body.isAwake() && boxes[1].body.isAwake() && boxes[2].body.isAwake();
    }
    bool areAsleep() const
    {
        return boxes[0].body.isAsleep() && boxes[1].body.isAsleep() && boxes[2].body.isAsleep();
    }
};

struct Cause {
    const char* name;
    std::function<void(Sleepers&)> act;
};

TEST(Waking, FollowsFromEveryChangeOfABodyAtOnceForAllThatSleepWithIt)
{
    TRACES("R2", "R8", "ADR25");
    const std::vector<Cause> causes = {
        {"wake", [](Sleepers& s) { s.top().wake(); }},
        {"force", [](Sleepers& s) { s.top().applyForceToCenter(vec(1, 0)); }},
        {"force at", [](Sleepers& s) { s.top().applyForce(vec(1, 0), {0, 3}); }},
        {"torque", [](Sleepers& s) { s.top().applyTorque(1); }},
        {"impulse", [](Sleepers& s) { s.top().applyImpulseToCenter(vec(0.1, 0)); }},
        {"impulse at", [](Sleepers& s) { s.top().applyImpulse(vec(0.1, 0), {0, 3}); }},
        {"angular impulse", [](Sleepers& s) { s.top().applyAngularImpulse(toReal(0.1)); }},
        {"velocity", [](Sleepers& s) { s.top().setLinearVelocity(vec(0, 0.1)); }},
        {"spin", [](Sleepers& s) { s.top().setAngularVelocity(toReal(0.1)); }},
        {"place", [](Sleepers& s) { s.top().setTransform({0, 4}, 0); }},
        {"lasting force", [](Sleepers& s) { s.top().addForce({.force = vec(1, 0)}); }},
        {"mass", [](Sleepers& s) { s.top().setMass({2, {}, 1}); }},
        {"gravity scale", [](Sleepers& s) { s.top().setGravityScale(2); }},
        {"own gravity", [](Sleepers& s) { s.top().setOwnGravity(vec(0, 1)); }},
        {"damping", [](Sleepers& s) { s.top().setLinearDamping(1); }},
        {"locks", [](Sleepers& s) { s.top().setLocks(true, false, false); }},
        {"type",
         [](Sleepers& s) {
             s.top().setType(BodyType::Kinematic);
             s.boxes.pop_back();
             s.boxes.push_back(s.boxes.front());
         }},
        {"no more sleep", [](Sleepers& s) { s.top().setAllowSleep(false); }},
        {"material", [](Sleepers& s) { s.top().shapes().front().setMaterial({.friction = 0}); }},
        {"filter", [](Sleepers& s) { s.top().shapes().front().setFilter({.category = 2}); }},
        {"density", [](Sleepers& s) { s.top().shapes().front().setDensity(2); }},
        {"geometry", [](Sleepers& s) { s.top().shapes().front().redefine({.geometry = makeBox(1, 2)}); }},
        {"another shape", [](Sleepers& s) { s.top().createShape({.offset = vec(0, 1)}); }},
        {"a state",
         [](Sleepers& s) {
             const BodyId id = s.top().id();
             const BodyState state{{0, 5}, 0, {}, 0};
             s.world.writeStates({&id, 1}, {&state, 1});
         }},
    };
    for (const Cause& cause : causes) {
        Sleepers s;
        cause.act(s);
        EXPECT_TRUE(s.areAwake()) << cause.name;
        EXPECT_TRUE(s.apart.isAsleep()) << cause.name;
        s.world.step();
    }
}

TEST(Waking, FollowsFromEveryChangeOfWhatTheyRestOn)
{
    TRACES("R8", "ADR25");
    const std::vector<Cause> causes = {
        {"gone", [](Sleepers& s) { s.plate.destroy(); }},
        {"its shape gone", [](Sleepers& s) { s.plateShape().destroy(); }},
        {"moved away", [](Sleepers& s) { s.plate.setTransform({0, -20}, 0); }},
        {"moved a little", [](Sleepers& s) { s.plate.setTransform({0, 0.499}, 0); }},
        {"disabled", [](Sleepers& s) { s.plate.setEnabled(false); }},
        {"dynamic", [](Sleepers& s) { s.plate.setType(BodyType::Dynamic); }},
        {"material", [](Sleepers& s) { s.plateShape().setMaterial({.friction = 0}); }},
        {"belt", [](Sleepers& s) { s.plateShape().setMaterial({.surfaceSpeed = 1}); }},
        {"filter", [](Sleepers& s) { s.plateShape().setFilter({.mask = 0}); }},
        {"geometry", [](Sleepers& s) { s.plateShape().redefine({.geometry = makeBox(4, 2)}); }},
    };
    for (const Cause& cause : causes) {
        for (const BodyType type : {BodyType::Static, BodyType::Kinematic}) {
            Sleepers s(type);
            cause.act(s);
            EXPECT_TRUE(s.areAwake()) << cause.name;
            EXPECT_TRUE(s.apart.isAsleep()) << cause.name;
        }
    }
}

TEST(Waking, LetsAStackFallWhoseBaseIsGone)
{
    TRACES("GD2", "R8", "ADR25");
    const std::vector<Cause> causes = {
        {"gone", [](Sleepers& s) { s.plate.destroy(); }},
        {"moved away", [](Sleepers& s) { s.plate.setTransform({0, -20}, 0); }},
        {"disabled", [](Sleepers& s) { s.plate.setEnabled(false); }},
        {"filter", [](Sleepers& s) { s.plateShape().setFilter({.mask = 0}); }},
    };
    for (const Cause& cause : causes) {
        Sleepers s;
        const double before = s.top().position().y;
        cause.act(s);
        int ends = 0;
        runSeconds(s.world, 0.25, 60, 4, [&] { ends += static_cast<int>(s.world.events().ends.size()); });
        EXPECT_NEAR(before - s.top().position().y, 9.81 * 0.25 * 0.25 / 2, 2e-3) << cause.name;
        EXPECT_GE(ends, 1) << cause.name << ": the lowest has left the plate";
        runSeconds(s.world, 5);
        EXPECT_NEAR(s.boxes[0].body.position().y, 0.501, 0.01) << cause.name;
        EXPECT_TRUE(s.areAsleep()) << cause.name;
    }
}

TEST(Waking, FollowsFromWhatTheWholeWorldFeels)
{
    TRACES("GD2", "ADR25");
    const std::vector<Cause> causes = {
        {"gravity", [](Sleepers& s) { s.world.setGravity(vec(1, -9)); }},
        {"gravitation", [](Sleepers& s) { s.world.setGravitationConstant(1); }},
        {"mixing", [](Sleepers& s) { s.world.setMixingRules(MixingRule::Minimum, MixingRule::Minimum); }},
        {"tuning",
         [](Sleepers& s) {
             Tuning tuning;
             tuning.restGap = toReal(0.01);
             s.world.setTuning(tuning);
         }},
    };
    for (const Cause& cause : causes) {
        Sleepers s;
        cause.act(s);
        EXPECT_TRUE(s.areAwake()) << cause.name;
        EXPECT_TRUE(s.apart.isAwake()) << cause.name;
        s.world.step();
    }
}

TEST(Waking, DoesNotFollowFromQuestionsAndFromWhatChangesNothing)
{
    TRACES("R7", "ADR25");
    Sleepers s;
    Body top = s.top();
    const BodyDef def = top.definition();
    top.transform(), top.centerOfMass(), top.velocityAt({0, 0}), top.mass(), top.energy(), top.momentum();
    top.contacts(), top.shapes(), top.interpolated(0.5), top.isAwake(), top.lastingForces();
    s.world.contacts(), s.world.energy(), s.world.stateHash(), s.world.queryPoint({0, 2});
    s.world.castRayAll({0, 9}, {0, -9});
    s.world.touching(top.id(), s.plate.id());
    top.setName("top");
    top.setUserData(7);
    top.setLinearVelocity({});
    top.setAngularVelocity(0);
    top.setTransform(def.position, def.angle);
    top.applyForceToCenter({});
    top.applyImpulseToCenter({});
    top.setGravityScale(1);
    s.world.setGravity(s.world.definition().gravity);
    s.world.setTuning(s.world.definition().tuning);
    s.plateShape().setMaterial(s.plateShape().material());
    s.plate.setEnabled(true);
    s.floor.createShape({.offset = vec(40, 3)});
    addBox(s.world, {0, 30}, 1, 1, {.type = BodyType::Static});
    s.world.step();
    EXPECT_TRUE(s.areAsleep());
    EXPECT_TRUE(s.apart.isAsleep());
}

TEST(Waking, FollowsFromABodyThatMeetsThemAndNotFromOneThatPasses)
{
    TRACES("R7", "R8", "GD1", "ADR25");
    Sleepers s;
    // Its box, on its way, holds the stack; it does not come near.
    Body passer = addDisc(s.world, {-8, 14}, 0.1, {.velocity = vec(900, -900)});
    passer.setGravityScale(0);
    s.world.step();
    EXPECT_TRUE(s.areAsleep());
    passer.destroy();

    Body ball = addDisc(s.world, {-3, s.top().position().y}, 0.3, {.velocity = vec(5, 0)});
    ball.setGravityScale(0);
    const DVec2 before = s.world.momentum().linear;
    double woke = -1;
    for (int i = 0; i < 60 && woke < 0; ++i) {
        s.world.step();
        if (s.areAwake()) woke = ball.position().x;
    }
    EXPECT_NEAR(woke, -0.8, 0.2) << "when it is there, and not before";
    EXPECT_TRUE(s.apart.isAsleep());
    EXPECT_GT(s.world.energy().kinetic(), 0);
    EXPECT_LE(s.world.momentum().linear.x, before.x + 1e-6);
    EXPECT_GT(velocityOf(s.top()).x, 0.01) << "it took part in the impact";
}

// A group's place in the table is used again by whoever sleeps next.
TEST(Waking, FollowsFromEveryMeetingAsFromTheFirst)
{
    TRACES("R6", "R8", "ADR25");
    World world;
    addGround(world);
    Body box = addBox(world, {0, 0.5}, 1, 1);
    for (int round = 0; round < 4; ++round) {
        runSeconds(world, 2);
        ASSERT_TRUE(box.isAsleep()) << "round " << round;
        Body ball = addDisc(world, {0, 1.4}, 0.25);
        bool woke = false;
        for (int i = 0; i < 60; ++i) {
            world.step();
            woke = woke || box.isAwake();
            ASSERT_GT(ball.position().y, 1.2) << "round " << round << ", step " << i;
        }
        EXPECT_TRUE(woke) << "round " << round;
        ball.destroy();
    }
}

// What cannot move sleeps as a dynamic body does, and bears what does not.
TEST(Waking, OfALockedSupportKeepsUpWhatIsAwakeOnIt)
{
    TRACES("R6", "R8", "ADR25");
    World world;
    Body plank = addBox(world, {0, 0}, 4, 0.5);
    plank.setLocks(true, true, true);
    Body box = addBox(world, {0, 0.751}, 1, 1);
    box.setAllowSleep(false);
    world.step();
    ASSERT_TRUE(world.touching(plank.id(), box.id()));
    for (int i = 0; i < 240; ++i) {
        if (i == 120) plank.sleep();
        world.step();
        ASSERT_NEAR(box.position().y, 0.75, 2e-3) << "step " << i;
        EXPECT_TRUE(world.events().ends.empty()) << "step " << i;
        EXPECT_TRUE(world.validate().empty()) << "step " << i;
    }
}

TEST(Waking, IsInTimeForAnImpactThatNobodyCouldForesee)
{
    TRACES("GD1", "DD8", "ADR25");
    // A ball at rest is hit in mid-step by a fast one and thrown at a sleeping one, all within the step.
    World world(weightless());
    const Options elastic{.restitution = 1};
    Options fast = elastic;
    fast.velocity = vec(600, 0);
    const Body first = addDisc(world, {-3, 0}, 0.5, fast);
    const Body second = addDisc(world, {0, 0}, 0.5, elastic);
    BodyDef def;
    def.awake = false;
    def.position = {3, 0};
    Body third = world.createBody(def);
    third.createShape({.geometry = Circle{{}, toReal(0.5)}, .material = {.restitution = 1}});
    world.step();
    EXPECT_TRUE(third.isAwake());
    EXPECT_NEAR(velocityOf(third).x, 600, byPrecision(1e-6, 1e-2));
    EXPECT_NEAR(velocityOf(first).x, 0, byPrecision(1e-6, 1e-2));
    EXPECT_NEAR(velocityOf(second).x, 0, byPrecision(1e-6, 1e-2));
    // 600/60 = 10 m in all, of which 2 m to the second and 2 m from there to the third.
    EXPECT_NEAR(third.position().x, 3 + 6, 0.02);
}

TEST(Waking, OfAPileInMidStepKeepsItStanding)
{
    TRACES("GD1", "R8", "ADR25");
    Sleepers s;
    const Options elastic{.restitution = 1};
    Options fast = elastic;
    fast.velocity = vec(600, 0);
    const double height = s.top().position().y;
    addDisc(s.world, {-5, height}, 0.2, fast);
    Body second = addDisc(s.world, {-3, height}, 0.2, elastic);
    second.sleep();  // so that it hangs there, and is hit asleep
    s.world.step();
    EXPECT_TRUE(s.areAwake());
    EXPECT_GT(velocityOf(s.top()).x, 10);
    EXPECT_LT(length(velocityOf(s.boxes[0].body)), 5.0) << "the lowest feels no more than friction";
    EXPECT_NEAR(s.boxes[0].body.position().y, 1.501, 0.01);
}

TEST(Waking, FollowsFromAGroundThatComes)
{
    TRACES("R8", "ADR25");
    const std::vector<Cause> causes = {
        {"made there", [](Sleepers& s) { addBox(s.world, {0.5, 3}, 1, 1, {.type = BodyType::Static}); }},
        {"moved there",
         [](Sleepers& s) {
             addBox(s.world, {9, 9}, 1, 1, {.type = BodyType::Static}).setTransform({0.5, 3}, 0);
         }},
        {"enabled there",
         [](Sleepers& s) {
             BodyDef def;
             def.type = BodyType::Static;
             def.position = {0.5, 3};
             def.enabled = false;
             Body body = s.world.createBody(def);
             body.createShape({.geometry = makeBox(1, 1)});
             body.setEnabled(true);
         }},
        {"let in by its filter",
         [](Sleepers& s) {
             Body body = addBox(s.world, {0, -9}, 1, 1, {.type = BodyType::Static});
             body.shapes().front().setFilter({.mask = 0});
             body.setTransform({0.5, 3}, 0);
             EXPECT_TRUE(s.areAsleep()) << "not yet";
             body.shapes().front().setFilter({});
         }},
    };
    for (const Cause& cause : causes) {
        Sleepers s;
        const Position before = s.top().position();
        cause.act(s);
        EXPECT_TRUE(s.areAwake()) << cause.name;
        EXPECT_TRUE(s.apart.isAsleep()) << cause.name;
        runSeconds(s.world, 1);
        EXPECT_GT(length(s.top().position() - before), 0.02) << cause.name << " pushes it away";
    }
}

TEST(Waking, FollowsFromAWholeWallThatComesAtOnce)
{
    TRACES("R8", "NFR1", "ADR25");
    Sleepers s;
    Body wall = s.world.createBody({.type = BodyType::Static});
    for (int i = 0; i < 50; ++i)
        wall.createShape({.geometry = makeBox(toReal(0.1), toReal(0.1)), .offset = vec(-0.55, 0.1 * i)});
    EXPECT_TRUE(s.areAwake());
    EXPECT_TRUE(s.apart.isAsleep());
}

TEST(Waking, FollowsFromALiftThatBeginsToMove)
{
    TRACES("R8", "ADR25");
    Sleepers s(BodyType::Kinematic);
    const double before = s.top().position().y;
    s.plate.setLinearVelocity(vec(0, 1));
    runSeconds(s.world, 1);
    EXPECT_TRUE(s.areAwake());
    EXPECT_NEAR(s.top().position().y - before, 1, 0.02);
    s.plate.setLinearVelocity({});
    runSeconds(s.world, 4);
    EXPECT_TRUE(s.areAsleep());
    s.plate.setLinearVelocity(vec(0, -1));  // away from under them
    runSeconds(s.world, 1);
    EXPECT_NEAR(s.top().position().y, before, 0.02);
}

TEST(Waking, FollowsFromALawThatGivesAnotherAnswer)
{
    TRACES("R5", "ADR25");
    Sleepers s;
    const ForceLaw steady{.name = "steady",
                          .force = [](const BodyView&, double) { return Wrench{{0, -1}, 0}; }};
    s.top().addForceLaw(steady);
    s.world.step();
    EXPECT_TRUE(s.areAwake()) << "it is new";
    runSeconds(s.world, 4);
    EXPECT_TRUE(s.areAsleep()) << "it is the same all the time";

    const double push = s.world.time() + 1;
    s.world.addForceLaw({.name = "later", .force = [push](const BodyView&, double t) {
                             return Wrench{{t < push ? 0.0 : 3.0, 0}, 0};
                         }});
    runSeconds(s.world, 0.9);
    EXPECT_TRUE(s.areAsleep()) << "nothing has changed yet";
    runSeconds(s.world, 0.2);
    EXPECT_TRUE(s.areAwake());
    s.world.addForceLaw(drag(1));
    runSeconds(s.world, 1);
    EXPECT_TRUE(s.areAwake() || s.areAsleep());
}

TEST(Waking, DoesNotComeFromANeighborThatSleepsWithoutTouching)
{
    TRACES("R8", "ADR25");
    World world;
    addGround(world);
    std::vector<Placed> one = addStack(world, 3), other = addStack(world, 3, 1.5);
    runSeconds(world, 4);
    EXPECT_EQ(world.lastReport().asleep, 6u);
    one[0].body.wake();
    EXPECT_TRUE(other[0].body.isAsleep());
    runSeconds(world, 4);
    EXPECT_EQ(world.lastReport().asleep, 6u);
    EXPECT_TRUE(other[0].body.isAsleep());
}

TEST(Waking, IsNotUndoneByDestroyingTheSleeping)
{
    TRACES("R1", "ADR25");
    Sleepers s;
    s.boxes[1].body.destroy();
    EXPECT_TRUE(s.boxes[0].body.isAwake());
    EXPECT_TRUE(s.boxes[2].body.isAwake());
    runSeconds(s.world, 4);
    EXPECT_NEAR(s.top().position().y, 2.502, 0.01) << "it fell on the lower one";
    s.apart.destroy();
    EXPECT_EQ(s.world.step().asleep, 2u);
    s.boxes[0].body.shapes().front().destroy();
    runSeconds(s.world, 4);
    EXPECT_NEAR(s.top().position().y, 1.501, 0.01);
}

}  // namespace
}  // namespace tamias2d::test
