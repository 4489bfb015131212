// SPDX-License-Identifier: MIT
#include "support/build.hpp"
#include "support/traces.hpp"

#include <tamias2d/scene/builtin.hpp>
#include <tamias2d/scene/read.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace tamias2d::test {
namespace {

std::string messageOf(const std::string& specification)
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
            EXPECT_EQ(messageOf(scene.name + ":" + p.name + "=" + p.standard), "(no error)");
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
    for (const auto& [specification, message] : table) EXPECT_EQ(messageOf(specification), message);
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
