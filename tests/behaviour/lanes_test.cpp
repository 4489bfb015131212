// SPDX-License-Identifier: MIT
// How many numbers are reckoned with at once changes no result.
#include <support/build.hpp>
#include <support/scenes.hpp>
#include <support/traces.hpp>

#include <gtest/gtest.h>

namespace tamias2d::test {
namespace {

std::uint64_t hashOfPile(LaneWidth lanes)
{
    World world({.lanes = lanes});
    addBin(world, {});
    addHail(world, 60, true, 3, {.restitution = real(0.3)});
    for (int i = 0; i < 120; ++i) world.step();
    return world.stateHash();
}

TEST(Lanes, GiveTheSameBitsWithEveryWidth)
{
    TRACES("ADR5", "ADR6");
    EXPECT_TRUE(hasLanes(LaneWidth::Best));
    EXPECT_TRUE(hasLanes(LaneWidth::Scalar));
    EXPECT_TRUE(hasLanes(LaneWidth::Bytes16));
    EXPECT_NE(bestLanes(), LaneWidth::Best);
    EXPECT_TRUE(hasLanes(bestLanes()));
    const std::uint64_t expected = hashOfPile(LaneWidth::Best);
    for (const LaneWidth lanes :
         {LaneWidth::Scalar, LaneWidth::Bytes16, LaneWidth::Bytes32, LaneWidth::Bytes64}) {
        if (!hasLanes(lanes)) continue;
        EXPECT_EQ(hashOfPile(lanes), expected) << "width " << static_cast<int>(lanes);
    }
}

TEST(Lanes, ThatTheMachineHasNotAreRefused)
{
    TRACES("R4", "ADR5");
    for (const LaneWidth lanes : {LaneWidth::Bytes32, LaneWidth::Bytes64}) {
        if (hasLanes(lanes)) continue;
        EXPECT_THROW(World({.lanes = lanes}), InputError) << "width " << static_cast<int>(lanes);
    }
}

}  // namespace
}  // namespace tamias2d::test
