// SPDX-License-Identifier: MIT
#include "support/build.hpp"
#include "support/traces.hpp"

#include <tamias2d/scene/builtin.hpp>
#include <tamias2d/scene/read.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tamias2d::test {
namespace {

std::string messageOfBuiltin(const std::string& specification)
{
    try {
        makeBuiltinScene(specification);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "(no error)";
}

TEST(BuiltinScenes, AllCanBeMadeAndStepped)
{
    TRACES("R1", "ADR14");
    ASSERT_GE(builtinScenes().size(), 5u);
    for (const BuiltinScene& about : builtinScenes()) {
        const Scene scene = makeBuiltinScene(about.name);
        EXPECT_FALSE(scene.info.title.empty()) << about.name;
        EXPECT_GT(scene.world->bodyCount(), 0u) << about.name;
        const StepReport report = scene.world->step(1 / scene.info.rate, scene.info.substeps);
        EXPECT_EQ(report.status, StepStatus::Done) << about.name;
        EXPECT_EQ(report.nonFinite, 0u) << about.name;
        EXPECT_LT(report.deepestOverlap, 1e-3) << about.name;
    }
}

TEST(BuiltinScenes, AreSortedByNameWithADocumentedDefaultForEveryParameter)
{
    TRACES("ADR14");
    const auto& all = builtinScenes();
    EXPECT_TRUE(
        std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; }));
    for (const BuiltinScene& scene : all) {
        for (const BuiltinParameter& p : scene.parameters) {
            EXPECT_FALSE(p.doc.empty()) << scene.name << "." << p.name;
            if (p.standard == "auto") continue;
            EXPECT_EQ(messageOfBuiltin(scene.name + ":" + p.name + "=" + p.standard), "(no error)");
        }
    }
}

TEST(BuiltinScenes, WrongParametersAreNamed)
{
    TRACES("R4");
    const struct {
        const char* specification;
        const char* message;
    } table[] = {
        {"pyramyd", "pyramyd: no built-in scene has this name; did you mean \"pyramid\"?"},
        {"pyramid:base=0", "pyramid:base=0: base = 0: must be a whole number in [1, 150]"},
        {"pyramid:base=2.5", "pyramid:base=2.5: base = 2.5: must be a whole number in [1, 150]"},
        {"pyramid:base=nan", "pyramid:base=nan: base = nan: must be a whole number in [1, 150]"},
        {"pyramid:base", "pyramid:base: base: must be given a value: base=..."},
        {"pyramid:bse=3",
         "pyramid:bse=3: bse: no parameter of \"pyramid\" has this name; did you mean \"base\"?"},
        {"pile:restitution=1.1", "pile:restitution=1.1: restitution = 1.1: must be a number in [0, 1]"},
        {"tiles:body=ball",
         "tiles:body=ball: body = ball: must be one of box, roundedBox, capsule, circle, hexagon, disc"},
        {"tiles:wall=yes", "tiles:wall=yes: wall = yes: must be true or false"},
    };
    for (const auto& [specification, message] : table) EXPECT_EQ(messageOfBuiltin(specification), message);
}

TEST(BuiltinScenes, ParametersShowInTheWorld)
{
    TRACES("R2");
    EXPECT_EQ(makeBuiltinScene("pyramid:base=4").world->bodyCount(), 1u + 10u);
    EXPECT_EQ(makeBuiltinScene("stack:boxes=7").world->bodyCount(), 1u + 7u);
    EXPECT_EQ(makeBuiltinScene("gas:discs=6,boxes=3").world->bodyCount(), 4u + 9u);
    EXPECT_EQ(makeBuiltinScene("tiles:count=10,separateBodies=false").world->bodyCount(), 3u);
    EXPECT_EQ(makeBuiltinScene("tiles:count=10").world->bodyCount(), 12u);
    EXPECT_EQ(makeBuiltinScene("tiles:count=10,wall=false").world->bodyCount(), 11u);

    const Scene struck = makeBuiltinScene("cradle:balls=5,strikers=2,speed=3");
    EXPECT_EQ(struck.world->momentum().linear.x,
              2 * 3 * static_cast<double>(struck.world->findBody("ball 1")->mass()));
}

TEST(BuiltinScenes, BoxesStandAtTheRestGap)
{
    TRACES("R8");
    const Scene scene = makeBuiltinScene("stack:boxes=3");
    const double gap = static_cast<double>(scene.world->definition().tuning.restGap);
    EXPECT_DOUBLE_EQ(scene.world->findBody("box 1")->position().y, 0.5 + gap);
    EXPECT_DOUBLE_EQ(scene.world->findBody("box 3")->position().y, 2.5 + 3 * gap);
}

TEST(BuiltinScenes, OneSeedGivesOneWorldAndAnotherSeedAnother)
{
    TRACES("ADR6");
    const auto hash = [](const char* name) { return makeBuiltinScene(name).world->stateHash(); };
    EXPECT_EQ(hash("pile:seed=2"), hash("pile:seed=2"));
    EXPECT_NE(hash("pile:seed=2"), hash("pile:seed=3"));
}

TEST(BuiltinScenes, ASceneFileMayOverruleTheWorldAndAddBodies)
{
    TRACES("R1");
    const Scene scene = readScene(R"({"tamias2d": 1, "title": "Mine",
        "builtin": {"name": "stack", "boxes": 2}, "run": {"rate": 120},
        "world": {"gravity": [0, -1], "tuning": {"restGap": 0.01}},
        "bodies": [{"name": "hammer", "position": [0, 9], "shapes": [{"circle": {}}]}],
        "laws": [{"law": "drag", "linear": 0.1, "body": "box 2"},
                 {"law": "drag", "linear": 0.2, "body": 3}]})");
    EXPECT_EQ(scene.info.title, "Mine");
    EXPECT_EQ(scene.info.rate, 120);
    EXPECT_EQ(scene.world->definition().gravity, vec(0, -1));
    ASSERT_EQ(scene.world->bodyCount(), 4u);
    EXPECT_NEAR(scene.world->findBody("box 1")->position().y, 0.51, 1e-7);
    const auto laws = scene.world->forceLaws();
    ASSERT_EQ(laws.size(), 2u);
    EXPECT_EQ(laws[0].first, scene.world->findBody("box 2")->id());
    EXPECT_EQ(laws[1].first, scene.world->findBody("hammer")->id());
}

// From the strike to the next one the balls that left are as many as those that came, as fast, and the
// others stay.
TEST(BuiltinScenes, ACradleOnStringsHandsOnWhatStrikesIt)
{
    TRACES("R8", "LC3", "GD1", "DD15", "DD16");
    for (const int strikers : {1, 2, 3}) {
        const double speed = 4;
        const Scene scene = makeBuiltinScene("pendulums:strikers=" + std::to_string(strikers));
        World& world = *scene.world;
        std::vector<Body> balls;
        for (int i = 1; i <= 5; ++i) balls.push_back(*world.findBody("ball " + std::to_string(i)));
        const double start = world.energy().total();
        const double given = strikers * static_cast<double>(balls[0].mass()) * speed * speed / 2;
        std::vector<double> fastest(5);
        double before = 0, after = 0, drift = 0;
        for (int step = 0; step < 1200; ++step) {
            const double momentum = world.momentum().linear.x;
            world.step();
            if (!world.events().hits.empty() && before == 0) {
                before = momentum;
                after = world.momentum().linear.x;
            }
            drift = std::max(drift, std::abs(world.energy().total() - start));
            const bool hasStruck = before != 0 && world.time() < 2.5;  // and comes back after 3 s
            for (std::size_t i = 0; hasStruck && i < balls.size(); ++i)
                fastest[i] = std::max(fastest[i], std::abs(static_cast<double>(balls[i].linearVelocity().x)));
        }
        const double all = strikers * static_cast<double>(balls[0].mass()) * speed;
        EXPECT_NEAR(before / all, 1, 0.01);
        EXPECT_NEAR(after / before, 1, 0.01);
        for (int i = 0; i < 5; ++i) {
            const bool leaves = i >= 5 - strikers;
            EXPECT_NEAR(fastest[static_cast<std::size_t>(i)] / speed, leaves ? 1 : 0, 0.01)
                << "ball " << i + 1 << " of 5, " << strikers << " strike";
        }
        EXPECT_LT(drift / given, byPrecision(0.001, 0.005)) << strikers << " strike, 20 s";
    }
}

TEST(BuiltinScenes, TheChainOfAWreckingBallKeepsItsLengthWhileItHits)
{
    TRACES("LC3", "DD15", "DD16");
    for (const int load : {5, 50, 500, 700, 2000, 4000, 5000}) {
        const Scene scene = makeBuiltinScene("wrecker:load=" + std::to_string(load));
        World& world = *scene.world;
        Body ball = *world.findBody("ball"), brick = world.body(world.bodies().back());  // at the top
        const Position stood = brick.position();
        double worst = 0, fastest = 0, rise = 0, energy = world.energy().total();
        const double begun = energy;
        for (int step = 0; step < 600; ++step) {
            world.step();
            double stretch = 0;
            for (const JointId id : world.joints())
                stretch += static_cast<double>(world.joint(id).reading().error);
            worst = std::max(worst, stretch / 8);
            fastest = std::max(fastest, static_cast<double>(length(ball.linearVelocity())));
            const double now = world.energy().total();
            rise = std::max(rise, now - energy);
            energy = now;
        }
        EXPECT_LT(worst, 0.0015) << "load " << load;
        EXPECT_LT(rise, 0.002 * begun) << "load " << load;
        if (load >= 50) {  // lighter ones do not fell it
            EXPECT_GT(length(brick.position() - stood), 0.5) << "load " << load;
        }
        if (load >= 500) {  // it falls through the chain's length and its radius
            EXPECT_NEAR(fastest / std::sqrt(2 * 9.81 * 9), 1, 0.01) << "load " << load;
        }
    }
}

TEST(BuiltinScenes, AnOrbitComesBackAfterItsPeriod)
{
    TRACES("T3", "GD2");
    const Scene scene = makeBuiltinScene("orbit:period=5,eccentricity=0.3");
    const Position start = scene.world->findBody("light")->position();
    for (int i = 0; i < 300; ++i) scene.world->step();
    const DVec2 missed = scene.world->findBody("light")->position() - start;
    // The path is 50 m long; the integrator is second order.
    EXPECT_LT(length(missed), 0.1);
}

}  // namespace
}  // namespace tamias2d::test
