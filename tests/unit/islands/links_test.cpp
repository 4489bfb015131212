// SPDX-License-Identifier: MIT
#include "islands/links.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

const auto kNeverAlike = [](std::uint32_t, std::uint32_t) { return false; };

template <class SameMotion>
Islands linked(const std::vector<Link>& links, const std::vector<bool>& pushable, SameMotion sameMotion)
{
    Islands islands;
    linkIslands({{0, 1}}, {true, true}, sameMotion, islands);  // what is left of others does not count
    linkIslands(links, pushable, sameMotion, islands);
    return islands;
}

TEST(Islands, JoinWhatIsLinkedAndNotThroughTheGround)
{
    TRACES("ADR11");
    // 0 is a ground; 1-2-3 are a chain on it, 4 stands on it alone, 5-6 float.
    const std::vector<bool> pushable{false, true, true, true, true, true, true};
    const Islands islands = linked({{0, 3}, {2, 1}, {3, 2}, {4, 0}, {6, 5}}, pushable, kNeverAlike);
    ASSERT_EQ(islands.count(), 3u);
    EXPECT_EQ(islands.islandOf, (std::vector<std::uint32_t>{Islands::kNone, 0, 0, 0, 1, 2, 2}));
    EXPECT_EQ(islands.groundOf, (std::vector<std::uint32_t>{0, 0, Islands::kNone}));
    EXPECT_EQ(islands.sizeOf, (std::vector<std::uint32_t>{3, 1, 2}));
}

TEST(Islands, OnGroundsThatMoveDifferentlyStandOnNoneInParticular)
{
    TRACES("ADR11");
    const std::vector<bool> pushable{false, true, false};
    EXPECT_EQ(linked({{0, 1}, {1, 2}}, pushable, kNeverAlike).groundOf[0], Islands::kSeveral);
    const auto alike = [](std::uint32_t, std::uint32_t) { return true; };
    EXPECT_EQ(linked({{0, 1}, {1, 2}}, pushable, alike).groundOf[0], 0u);
}

TEST(Islands, AreTheSameInWhateverOrderTheLinksCome)
{
    TRACES("ADR6");
    const std::vector<bool> pushable(6, true);
    const Islands one = linked({{0, 1}, {2, 3}, {1, 2}, {4, 5}}, pushable, kNeverAlike);
    const Islands other = linked({{5, 4}, {2, 1}, {3, 2}, {1, 0}}, pushable, kNeverAlike);
    EXPECT_EQ(one.islandOf, other.islandOf);
}

}  // namespace
}  // namespace tamias2d
