// SPDX-License-Identifier: MIT
#include "base/id_pool.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d::test {
namespace {

TEST(IdPool, TakesTheLowestFreeSlotFirst)
{
    TRACES("ADR6");
    IdPool<BodyId> pool(7);
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(pool.take().index, i);
    for (const std::uint32_t slot : {3u, 0u, 4u}) pool.giveBack(slot);
    EXPECT_EQ(pool.take().index, 0u);
    EXPECT_EQ(pool.take().index, 3u);
    EXPECT_EQ(pool.take().index, 4u);
    EXPECT_EQ(pool.take().index, 5u);
}

TEST(IdPool, NeverGivesOutTheSameIdTwice)
{
    TRACES("R4");
    IdPool<BodyId> pool(7);
    const BodyId first = pool.take();
    pool.giveBack(first.index);
    const BodyId second = pool.take();
    EXPECT_EQ(second.index, first.index);
    EXPECT_NE(second, first);
    EXPECT_EQ(first.world, 7u);
    EXPECT_FALSE(first.isNull());
}

}  // namespace
}  // namespace tamias2d::test
