// SPDX-License-Identifier: MIT
#include "broadphase/rest_trees.hpp"
#include "support/random.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace tamias2d {
namespace {

using test::Random;

Aabb boxAt(double x, double y, double half)
{
    return {{x - half, y - half}, {x + half, y + half}};
}

std::set<std::uint32_t> foundIn(const RestTrees& trees, const Aabb& box)
{
    std::set<std::uint32_t> found;
    trees.eachOverlapping(box, [&](std::uint32_t shape) {
        EXPECT_TRUE(found.insert(shape).second) << "found twice: " << shape;
    });
    EXPECT_EQ(trees.anyOverlapping(box), !found.empty());
    return found;
}

TEST(RestTrees, FindWhatASearchOfAllFindsWhateverComesAndGoes)
{
    TRACES("R7", "NFR1");
    Random random(11);
    RestTrees trees;
    std::map<std::uint32_t, Aabb> all;
    for (int round = 0; round < 400; ++round) {
        const int comers = static_cast<int>(random.between(0, round % 50 == 0 ? 300 : 6));
        for (int i = 0; i < comers; ++i) {
            const auto shape = static_cast<std::uint32_t>(random.between(0, 2000));
            if (all.contains(shape)) continue;
            all[shape] = boxAt(random.between(-30, 30), random.between(-3, 3), random.between(0, 2));
            trees.add(shape, all[shape]);
        }
        for (int i = 0; i < 5; ++i) {
            const auto shape = static_cast<std::uint32_t>(random.between(0, 2000));
            trees.remove(shape);
            all.erase(shape);
        }
        trees.settle();
        ASSERT_EQ(trees.size(), all.size());
        const Aabb asked = boxAt(random.between(-30, 30), random.between(-3, 3), random.between(0, 4));
        std::set<std::uint32_t> expected;
        for (const auto& [shape, box] : all)
            if (overlaps(FloatBox::of(box), FloatBox::of(asked))) expected.insert(shape);
        EXPECT_EQ(foundIn(trees, asked), expected) << "round " << round;
    }
}

TEST(RestTrees, AreFewWhateverTheOrder)
{
    TRACES("NFR1");
    RestTrees trees;
    for (std::uint32_t i = 0; i < 5000; ++i) {  // one by one, in a row
        trees.add(i, boxAt(i, 0, 0.5));
        trees.settle();
        ASSERT_LE(trees.treeCount(), 13u) << i;  // log2 of 5000
    }
    EXPECT_EQ(foundIn(trees, boxAt(2500, 0, 1.2)).size(), 3u);
    for (std::uint32_t i = 0; i < 5000; ++i) trees.remove(i);
    EXPECT_EQ(trees.size(), 0u);
    EXPECT_EQ(trees.treeCount(), 0u);
    EXPECT_TRUE(foundIn(trees, boxAt(0, 0, 1e6)).empty());
}

TEST(RestTrees, BearManyBoxesAtOnePlace)
{
    TRACES("R4", "NFR1");
    RestTrees trees;
    for (std::uint32_t i = 0; i < 3000; ++i) trees.add(i, boxAt(7, 7, 0.5));
    trees.settle();
    EXPECT_EQ(foundIn(trees, boxAt(7, 7, 0.1)).size(), 3000u);
    EXPECT_TRUE(foundIn(trees, boxAt(9, 7, 0.1)).empty());
    for (std::uint32_t i = 0; i < 3000; i += 2) trees.remove(i);
    EXPECT_EQ(foundIn(trees, boxAt(7, 7, 0.1)).size(), 1500u);
}

}  // namespace
}  // namespace tamias2d
