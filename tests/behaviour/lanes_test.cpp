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

// A net of discs on hinges, of every sort that one can be, that falls on the ground; a crate in it goes to
// sleep and is woken by the net.
std::uint64_t hashOfNet(LaneWidth lanes, int threads)
{
    constexpr int kSide = 9;
    World world({.lanes = lanes, .threads = threads});
    addBox(world, {0, -3}, 40, 1, {.type = BodyType::Static});
    addBox(world, {0, -2}, 1, 1);
    std::vector<Body> discs;
    const auto tie = [&](std::size_t i, std::size_t k, double x, double y) {
        JointDef def = revoluteAt(discs[i], discs[k], {x, y});
        RevoluteJoint& hinge = std::get<RevoluteJoint>(def.kind);
        const std::size_t sort = (i + 3 * k) % 5;
        if (sort == 1) hinge.limits = JointLimits{toReal(-0.2), toReal(0.3)};
        if (sort == 2) hinge.spring = JointSpring{3, toReal(0.4), toReal(0.1)};
        if (sort == 3) hinge.motor = JointMotor{2, toReal(0.05)};
        if (sort == 4) {
            hinge.limits = JointLimits{toReal(0.1), 2};
            hinge.spring = JointSpring{5, toReal(0.5)};
            hinge.motor = JointMotor{0, toReal(0.02)};
        }
        world.createJoint(def);
    };
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y) {
            discs.push_back(addDisc(world, {x - 4.0, y + 0.5}, 0.4));
            if ((x + y) % 3 == 0) discs.back().setAngularDamping(toReal(0.5));
            if (y > 0) tie(discs.size() - 2, discs.size() - 1, x - 4, y);
            if (x > 0) tie(discs.size() - 1 - kSide, discs.size() - 1, x - 4.5, y + 0.5);
        }
    for (int i = 0; i < 90; ++i) world.step();
    return world.stateHash();
}

TEST(Lanes, GiveHingesTheSameBitsWithEveryWidthAndOnThreads)
{
    TRACES("ADR5", "ADR6", "ADR30");
    const std::uint64_t expected = hashOfNet(LaneWidth::Best, 1);
    EXPECT_EQ(hashOfNet(LaneWidth::Best, 3), expected) << "threads";
    for (const LaneWidth lanes :
         {LaneWidth::Scalar, LaneWidth::Bytes16, LaneWidth::Bytes32, LaneWidth::Bytes64}) {
        if (!hasLanes(lanes)) continue;
        EXPECT_EQ(hashOfNet(lanes, 1), expected) << "width " << static_cast<int>(lanes);
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
