// SPDX-License-Identifier: MIT
#include "support/build.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace tamias2d {
namespace {

using namespace test;

void addPile(World& world)
{
    addGround(world);
    for (int i = 0; i < 12; ++i) addBox(world, {0.3 * (i % 3), 0.6 + 1.1 * i}, 1, 1, {.restitution = 0.3});
}

TEST(Profile, IsEmptyUnlessItIsAskedFor)
{
    TRACES("NFR1");
    World world;
    addPile(world);
    world.step();
    EXPECT_TRUE(world.profile().empty());
    world.setProfiling(true);
    EXPECT_TRUE(world.profile().empty());
    world.step();
    EXPECT_FALSE(world.profile().empty());
    world.setProfiling(false);
    EXPECT_TRUE(world.profile().empty());
    world.step();
    EXPECT_TRUE(world.profile().empty());
}

TEST(Profile, HasASpanForTheStepAndOneForEachTickThatNestOrFollowEachOther)
{
    TRACES("NFR1");
    World world;
    addPile(world);
    world.setProfiling(true);
    double end = 0;
    for (int step = 0; step < 60; ++step) {
        world.step(1.0 / 60, 3);
        std::map<std::string, int> counts;
        std::vector<ProfileSpan> around;
        const ProfileSpan* last = nullptr;
        for (const ProfileSpan& span : world.profile()) {
            ++counts[span.name];
            EXPECT_LE(span.begin, span.end) << span.name;
            EXPECT_GE(span.begin, last ? last->begin : end) << span.name;
            EXPECT_EQ(span.thread, 0u);
            while (!around.empty() && around.back().depth >= span.depth) {
                EXPECT_LE(around.back().end, span.begin) << around.back().name << ", then " << span.name;
                around.pop_back();
            }
            EXPECT_EQ(around.size(), span.depth) << span.name;
            if (!around.empty()) {
                EXPECT_LE(span.end, around.back().end) << span.name << " in " << around.back().name;
            }
            around.push_back(span);
            last = &span;
        }
        EXPECT_EQ(counts["step"], 1);
        EXPECT_EQ(counts["tick"], 6);  // two a sub-step
        EXPECT_EQ(counts["passes"], 6);
        end = world.profile().front().end;
    }
}

TEST(Profile, OfABadStepIsThatOfTheLastGoodOne)
{
    TRACES("R4");
    World world;
    addPile(world);
    world.setProfiling(true);
    world.step();
    const double end = world.profile().front().end;
    world.step(-1);
    EXPECT_EQ(world.profile().front().end, end);
}

TEST(Profile, ChangesNoResult)
{
    TRACES("ADR6");
    World plain, profiled;
    addPile(plain);
    addPile(profiled);
    profiled.setProfiling(true);
    for (int i = 0; i < 100; ++i) {
        plain.step();
        profiled.step();
    }
    EXPECT_EQ(plain.stateHash(), profiled.stateHash());
}

}  // namespace
}  // namespace tamias2d
