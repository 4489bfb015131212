// SPDX-License-Identifier: MIT
#include "broadphase/tree.hpp"
#include "support/boxes.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

std::vector<std::uint32_t> byBruteForce(const Table<SweepBox>& boxes, const Aabb& box, std::uint32_t body)
{
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].body != body && overlaps(boxes[i].box, box)) found.push_back(i);
    return found;
}

TEST(BoxTree, FindsTheBoxesThatLookingAtAllFinds)
{
    TRACES("R7", "T5");
    for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 64u, 65u, 600u}) {
        Table<SweepBox> boxes = randomBoxes(count, count);
        BoxTree tree;
        tree.build(boxes, count);
        std::vector<std::uint32_t> found;
        for (const SweepBox& asked : randomBoxes(50, 99)) {
            tree.overlapping(asked.box, asked.body, found);
            EXPECT_EQ(found, byBruteForce(boxes, asked.box, asked.body)) << count << " boxes";
        }
    }
}

TEST(BoxTree, FindsABoxThatHasGrownWhereItIsNow)
{
    TRACES("R7", "T5");
    Table<SweepBox> boxes = randomBoxes(300, 3);
    BoxTree tree;
    tree.build(boxes, boxes.size());
    const Aabb far{{500, -3}, {510, 4}};
    std::vector<std::uint32_t> found;
    tree.overlapping(far, 7, found);
    EXPECT_TRUE(found.empty());
    tree.grow(42, far);
    tree.overlapping(far, 7, found);
    EXPECT_EQ(found, std::vector<std::uint32_t>{42});
    EXPECT_TRUE(contains(tree.boxOf(42)->box, far));
}

TEST(BoxTree, KnowsNoBoxOfAShapeThatHasNone)
{
    TRACES("R7");
    Table<SweepBox> boxes = randomBoxes(10, 4);
    boxes.erase(boxes.begin() + 3);
    BoxTree tree;
    tree.build(boxes, 12);
    EXPECT_EQ(tree.boxOf(3), nullptr);
    EXPECT_EQ(tree.boxOf(11), nullptr);
    EXPECT_EQ(tree.boxOf(100), nullptr);
    EXPECT_EQ(tree.boxOf(4)->shape, 4u);
}

}  // namespace
}  // namespace tamias2d
