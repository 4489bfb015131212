// SPDX-License-Identifier: MIT
// Bodies at rest fall asleep: when, who with, and what stays as it is.
#include <support/overlap.hpp>
#include <support/run.hpp>
#include <support/scenes.hpp>

namespace tamias2d::test {
namespace {

constexpr double kSettled = 3;  // time in which a stack of a few boxes comes to rest and falls asleep   [s]

bool allAsleep(World& world)
{
    const std::vector<BodyId> ids = world.bodies();
    return std::all_of(ids.begin(), ids.end(), [&](BodyId id) {
        return world.body(id).type() != BodyType::Dynamic || world.body(id).isAsleep();
    });
}

TEST(Sleep, ComesToAStackAtRestAndTakesNothingButSpeed)
{
    TRACES("R8", "NFR1", "ADR25");
    World world;
    addGround(world);
    const std::vector<Placed> boxes = addStack(world, 5);
    const RunTotals totals = runSeconds(world, kSettled);
    EXPECT_TRUE(allAsleep(world));
    EXPECT_EQ(world.lastReport().asleep, 5u);
    EXPECT_EQ(world.lastReport().awake, 0u);
    EXPECT_EQ(world.lastReport().dynamicBodies, 5u);
    EXPECT_EQ(world.lastReport().touching, 5u);
    EXPECT_EQ(world.energy().kinetic(), 0.0);
    EXPECT_LE(totals.sumOfEnergyRises, byPrecision(2e-4, 1e-3));
    for (const Placed& box : boxes) {
        EXPECT_FALSE(box.body.isAwake());
        EXPECT_EQ(velocityOf(box.body), DVec2{});
        EXPECT_EQ(spinOf(box.body), 0.0);
    }
}

TEST(Sleep, LeavesPosesContactsAndTouchesAsTheyAre)
{
    TRACES("R7", "R8", "ADR25");
    World world;
    addGround(world);
    const std::vector<Placed> boxes = addStack(world, 3);
    runSeconds(world, kSettled);
    ASSERT_TRUE(allAsleep(world));
    const std::vector<ContactView> before = world.contacts();
    ASSERT_EQ(before.size(), 3u);
    std::vector<Position> places;
    for (const Placed& box : boxes) places.push_back(box.body.position());

    runSeconds(world, 5, 60, 4, [&] {
        EXPECT_TRUE(world.events().begins.empty());
        EXPECT_TRUE(world.events().ends.empty());
        EXPECT_TRUE(world.events().hits.empty());
    });
    EXPECT_TRUE(allAsleep(world));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_EQ(boxes[i].body.position(), places[i]);
        EXPECT_EQ(boxes[i].body.interpolated(0.5).position, places[i]);
    }
    EXPECT_TRUE(world.touching(boxes[0].body.id(), boxes[1].body.id()));
    EXPECT_FALSE(world.touching(boxes[0].body.id(), boxes[2].body.id()));
    EXPECT_EQ(boxes[1].body.contacts().size(), 2u);
    const std::vector<ContactView> after = world.contacts();
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_EQ(after[i].impulse, before[i].impulse);
        EXPECT_TRUE(after[i].touching);
    }
    EXPECT_EQ(world.queryPoint(boxes[2].body.position()).size(), 1u);
    EXPECT_EQ(world.castRay({0, 10}, {0, -1})->body, boxes[2].body.id());
}

TEST(Sleep, EndsWithoutAJolt)
{
    TRACES("R8", "ADR25");
    World world;
    addGround(world);
    const std::vector<Placed> boxes = addStack(world, 10);
    runSeconds(world, 6);
    ASSERT_TRUE(allAsleep(world));
    std::vector<Position> places;
    for (const Placed& box : boxes) places.push_back(box.body.position());
    Body top = boxes.back().body;
    top.wake();
    for (const Placed& box : boxes) EXPECT_TRUE(box.body.isAwake()) << "all wake that slept together";
    double fastest = 0;
    for (int i = 0; i < 20; ++i) {
        world.step();
        fastest = std::max(fastest, fastestBody(world));
        EXPECT_TRUE(world.events().begins.empty());
        EXPECT_TRUE(world.events().ends.empty());
        EXPECT_TRUE(world.events().hits.empty());
    }
    record("fastest_mps", fastest);
    EXPECT_LE(fastest, 2e-3);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        EXPECT_LE(length(boxes[i].body.position() - places[i]), 1e-4) << i;
    runSeconds(world, 1);
    EXPECT_TRUE(allAsleep(world)) << "and they fall asleep again";
}

TEST(Sleep, IsNotForWhatBeginsToSlide)
{
    TRACES("R8", "DD3", "ADR25");
    // Tan 0.31 against friction 0.3: slower than 1 cm/s for a good while. A sleep would stop it for good.
    World world;
    Options slope{.type = BodyType::Static, .angle = std::atan(0.302), .friction = 0.3};
    addBox(world, {0, 0}, 100, 1, slope);
    const double c = std::cos(slope.angle), s = std::sin(slope.angle), gap = restGapFor(world, 1);
    const Body box =
        addBox(world, {-(1 + gap) * s, (1 + gap) * c}, 1, 1, {.angle = slope.angle, .friction = 0.3});
    const Position start = box.position();
    const double a = 9.81 * (s - 0.3 * c);
    runSeconds(world, 4);
    EXPECT_TRUE(box.isAwake());
    EXPECT_NEAR(length(box.position() - start), a * 8, 0.1 * a * 8);
}

TEST(Sleep, IsNotForWhatDriftsAlone)
{
    TRACES("GD1", "ADR25");
    World world(weightless());
    const Body slow = addBox(world, {0, 0}, 1, 1, {.velocity = vec(1e-4, 0)});
    const Body still = addBox(world, {5, 0}, 1, 1);
    runSeconds(world, 10);
    EXPECT_TRUE(slow.isAwake());
    EXPECT_NEAR(slow.position().x, 1e-3, 1e-7);
    EXPECT_TRUE(still.isAsleep()) << "it has nothing to lose";
}

TEST(Sleep, IsNotForWhatHangsAtTheTopOfItsFlight)
{
    TRACES("GD2", "ADR25");
    WorldDef def = withGravity(0, -0.001);
    World world(def);
    const Body ball = addDisc(world, {0, 0}, 0.5, {.velocity = vec(0, 0.001)});
    runSeconds(world, 2);
    EXPECT_TRUE(ball.isAwake());
    EXPECT_NEAR(ball.position().y, 0, 1e-6);
}

TEST(Sleep, IsKeptAwayByABodyThatMayNot)
{
    TRACES("R8", "ADR25");
    World world;
    addGround(world);
    std::vector<Placed> boxes = addStack(world, 3);
    boxes[1].body.setAllowSleep(false);
    EXPECT_FALSE(boxes[1].body.allowsSleep());
    const Body apart = addBox(world, {10, 0.501}, 1, 1);
    runSeconds(world, kSettled);
    for (const Placed& box : boxes) EXPECT_TRUE(box.body.isAwake());
    EXPECT_TRUE(apart.isAsleep()) << "a ground joins nobody";
    boxes[1].body.setAllowSleep(true);
    runSeconds(world, kSettled);
    EXPECT_TRUE(allAsleep(world));
    boxes[1].body.setAllowSleep(false);
    for (const Placed& box : boxes) EXPECT_TRUE(box.body.isAwake());
}

TEST(Sleep, IsKeptAwayByWhatRuns)
{
    TRACES("R8", "ADR25");
    World world;
    Options belt{.surfaceSpeed = 1};
    addGround(world, 0, 20, belt);
    addBox(world, {3, 1}, 1, 2, {.type = BodyType::Static});
    const Body blocked = addBox(world, {2, 0.501}, 1, 1, {.friction = 0.1});  // the belt runs left
    Body lift = addBox(world, {30, 0}, 2, 1, {.type = BodyType::Kinematic, .velocity = vec(0, 0.001)});
    const Body rider = addBox(world, {30, 1.001}, 1, 1);
    runSeconds(world, kSettled);
    EXPECT_TRUE(blocked.isAwake());
    EXPECT_TRUE(rider.isAwake());
    EXPECT_TRUE(lift.isAwake());
    lift.setLinearVelocity({});
    runSeconds(world, kSettled);
    EXPECT_TRUE(rider.isAsleep()) << "once the lift stands";
    EXPECT_FALSE(lift.isAwake());
}

TEST(Sleep, DoesNotComeInAWorldWithout)
{
    TRACES("R8", "ADR25");
    WorldDef def;
    def.allowSleep = false;
    World world(def);
    addGround(world);
    addStack(world, 2);
    BodyDef sleeper;
    sleeper.awake = false;
    EXPECT_TRUE(world.createBody(sleeper).isAwake());
    world.destroyBody(world.bodies().back());
    runSeconds(world, kSettled);
    EXPECT_EQ(world.lastReport().awake, 2u);
    world.setAllowSleep(true);
    EXPECT_TRUE(world.definition().allowSleep);
    world.step();
    EXPECT_TRUE(allAsleep(world)) << "they have been still for long";
    world.setAllowSleep(false);
    world.step();
    EXPECT_EQ(world.lastReport().awake, 2u);
}

TEST(Sleep, DoesNotComeUnderGravitation)
{
    TRACES("T3", "ADR25");
    WorldDef def = weightless();
    def.gravitationConstant = 1;
    World world(def);
    const Body body = addDisc(world, {0, 0}, 0.5, {.density = 1e-6});
    addDisc(world, {500, 0}, 0.5, {.type = BodyType::Static, .density = 1});
    runSeconds(world, 5);
    EXPECT_TRUE(body.isAwake());
    EXPECT_GT(velocityOf(body).x, 0) << "what is static pulls, too";
}

TEST(Sleep, ComesAtOnceOnRequestWithAllThatTouch)
{
    TRACES("R8", "ADR25");
    World world;
    Body ground = addGround(world);
    std::vector<Placed> boxes = addStack(world, 3);
    Body apart = addBox(world, {10, 0.501}, 1, 1);
    world.step();
    EXPECT_TRUE(boxes[2].body.sleep());
    for (const Placed& box : boxes) {
        EXPECT_TRUE(box.body.isAsleep());
        EXPECT_EQ(velocityOf(box.body), DVec2{});
    }
    EXPECT_TRUE(apart.isAwake());
    EXPECT_TRUE(boxes[0].body.sleep()) << "it does already";
    EXPECT_FALSE(ground.sleep());
    apart.setAllowSleep(false);
    EXPECT_FALSE(apart.sleep());
    Body flier = addBox(world, {20, 5}, 1, 1, {.velocity = vec(3, 0)});
    EXPECT_TRUE(flier.sleep()) << "in mid-air, as told";
    runSeconds(world, 1);
    EXPECT_EQ(flier.position(), (Position{20, 5}));
    flier.wake();
    runSeconds(world, 0.5);
    EXPECT_NEAR(flier.position().y, 5 - 9.81 / 8, 1e-3);
    EXPECT_EQ(flier.position().x, 20) << "its speed is lost";
}

TEST(Sleep, MayBeTheStateABodyIsMadeIn)
{
    TRACES("R2", "R8", "ADR25");
    World world;
    BodyDef def;
    def.awake = false;
    def.position = {0, 5};
    Body body = world.createBody(def);
    body.createShape({.geometry = makeBox(1, 1)});
    EXPECT_TRUE(body.isAsleep());
    EXPECT_FALSE(body.definition().awake);
    runSeconds(world, 1);
    EXPECT_EQ(body.position(), (Position{0, 5}));
    EXPECT_EQ(world.lastReport().asleep, 1u);
    body.wake();
    EXPECT_TRUE(body.definition().awake);
    runSeconds(world, 0.5);
    EXPECT_NEAR(body.position().y, 5 - 9.81 / 8, 1e-3);
}

TEST(Sleep, TakesTheTimeAndSpeedItIsTuned)
{
    TRACES("R8", "ADR15", "ADR25");
    for (const double time : {0.25, 2.0}) {
        WorldDef def;
        def.tuning.sleepTime = toReal(time);
        World world(def);
        addGround(world);
        const Body box = addBox(world, {0, 0.5 + restGapFor(world, 1)}, 1, 1);
        double slept = 0;
        while (!box.isAsleep() && slept < 5) world.step(), slept = world.time();
        EXPECT_NEAR(slept, time, 0.2) << time;
    }
    WorldDef def;
    def.tuning.sleepSpeed = toReal(1e-9);
    World world(def);
    Options smooth{.friction = 0};
    addGround(world, 0, 100, smooth);
    smooth.velocity = vec(0.005, 0);
    const Body box = addBox(world, {0, 0.501}, 1, 1, smooth);
    runSeconds(world, 4);
    EXPECT_NEAR(box.position().x, 0.02, 1e-4) << "slow is not still if it is tuned so";
}

TEST(Sleep, ComesToAWholePileWithinTwelveSeconds)
{
    TRACES("R8", "NFR1", "ADR25");
    // By Newton's law a disc on a level floor rolls on for ever, until something resists that.
    for (const std::uint32_t seed : {5u, 6u, 7u}) {
        for (const bool discs : {false, true}) {
            World world;
            addBin(world, {});
            addHail(world, 150, discs, seed, {.rollingResistance = 0.05});
            runSeconds(world, 12);
            record(discs ? "awake_discs" : "awake_boxes", world.lastReport().awake);
            EXPECT_TRUE(allAsleep(world))
                << "seed " << seed << ", discs " << discs << ", awake " << world.lastReport().awake;
            EXPECT_LE(deepestOverlap(world), 0.01) << "seed " << seed << ", discs " << discs;
        }
    }
}

// It may be put to sleep before the step in which that contact ends.
TEST(Sleep, KeepsNoContactWithABodyThatWasDisabled)
{
    TRACES("R7", "ADR25");
    World world;
    addGround(world, 0);
    Body below = addBox(world, {0, 0.5}, 1, 1), above = addBox(world, {0, 1.5}, 1, 1);
    for (int i = 0; i < 20; ++i) world.step();
    ASSERT_TRUE(world.touching(below.id(), above.id()));
    above.setEnabled(false);
    ASSERT_TRUE(below.sleep());
    world.step();
    EXPECT_FALSE(world.touching(below.id(), above.id()));
    EXPECT_EQ(world.events().ends.size(), 1u);
    EXPECT_TRUE(below.isAsleep());
    for (const ContactView& c : world.contacts()) {
        EXPECT_NE(c.bodyA, above.id());
        EXPECT_NE(c.bodyB, above.id());
    }
}

TEST(Sleep, GivesTheSameBitsEachTime)
{
    TRACES("ADR6", "ADR25");
    const auto hashes = [] {
        World world;
        addBin(world, {});
        // A disc that rolls on a box off the level by microradians would for minutes.
        std::vector<Body> bodies = addHail(world, 40, true, 5, {.rollingResistance = 0.05});
        std::vector<std::uint64_t> all;
        for (int i = 0, slept = 0; i < 3600 && slept < 2; ++i) {
            world.step();
            all.push_back(world.stateHash());
            if (!allAsleep(world)) continue;
            if (++slept == 1) bodies[3].applyImpulseToCenter(vec(1, 2));
        }
        EXPECT_TRUE(allAsleep(world)) << "awake: " << world.lastReport().awake;
        return all;
    };
    EXPECT_EQ(hashes(), hashes());
    World world;
    Body box = addBox(world, {0, 0}, 1, 1);
    const std::uint64_t awake = world.stateHash();
    ASSERT_TRUE(box.sleep());
    EXPECT_NE(world.stateHash(), awake) << "sleep is part of the state";
    box.wake();
    EXPECT_EQ(world.stateHash(), awake);
}

}  // namespace
}  // namespace tamias2d::test
