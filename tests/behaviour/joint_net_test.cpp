// SPDX-License-Identifier: MIT
// Nets of discs: more joints than the discs can move in ways, so that loads can cancel each other in many.
#include "support/build.hpp"
#include "support/random.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tamias2d {
namespace {

using namespace test;

struct NetCase {
    int side;
    double speed, gravity;   // [m/s], [m/s^2]
};
void PrintTo(const NetCase& c, std::ostream* out)
{
    *out << c.side << " by " << c.side << ", struck at " << c.speed << " m/s, under " << c.gravity
         << " m/s^2";
}

class Nets : public testing::TestWithParam<NetCase> {};

// It hangs by its upper corners, its top row as taut as a row can be: next to nothing moves but what strikes
// it, and nothing has as much mass.
TEST_P(Nets, AreNeverFasterThanWhatStrikesThem)
{
    TRACES("LC3");
    const auto [side, speed, gravity] = GetParam();
    World world(withGravity(0, -gravity));
    const Body ground = addGround(world, 0, 400);
    std::vector<Body> net;
    std::vector<Joint> joints;
    const auto hinge = [&](const Body& a, const Body& b, Position at) {
        joints.push_back(world.createJoint(revoluteAt(a, b, at)));
    };
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const Position at{1.0 * column, 20 - 1.0 * row};
            net.push_back(addDisc(world, at, 0.3));
            if (column > 0) hinge(net[net.size() - 2], net.back(), {at.x - 0.5, at.y});
            if (row > 0)
                hinge(net[net.size() - 1 - static_cast<std::size_t>(side)], net.back(), {at.x, at.y + 0.5});
        }
    }
    hinge(ground, net[0], {0, 20.5});
    hinge(ground, net[static_cast<std::size_t>(side) - 1], {1.0 * (side - 1), 20.5});
    addDisc(world, {-6, 16}, 0.5, {.velocity = vec(speed, 4)});
    double fastest = 0, apart = 0;
    runSeconds(world, 10, 60, 4, [&] {
        for (const Body& disc : net)
            fastest = std::max(fastest, std::hypot(static_cast<double>(disc.linearVelocity().x),
                                                   static_cast<double>(disc.linearVelocity().y)));
        for (const Joint& joint : joints) apart = std::max(apart, static_cast<double>(joint.reading().error));
    });
    EXPECT_LT(fastest, speed);
    EXPECT_LT(apart, 0.05) << "[m] between what is joined";
}

INSTANTIATE_TEST_SUITE_P(Joints, Nets,
                         testing::Values(NetCase{3, 20, 0}, NetCase{4, 20, 9.81}, NetCase{5, 20, 0},
                                         NetCase{5, 20, 9.81}, NetCase{5, 40, 9.81}, NetCase{6, 20, 9.81},
                                         NetCase{6, 40, 0}, NetCase{8, 20, 9.81}));

// What ties the bodies of a net to their neighbors.
enum class Tie { Hinge, Rod, Rope, HingedBox, Weld };

struct StruckCase {
    Tie tie;
    const char* name;
};
void PrintTo(const StruckCase& c, std::ostream* out)
{
    *out << c.name;
}

class StruckNets : public testing::TestWithParam<StruckCase> {};

// A net of up to seven by six, free, or on one pin or two, that a disc strikes from anywhere.
double partOfEnergyMade(Tie tie, std::uint32_t seed)
{
    Random random(seed);
    World world(withGravity(0, random.between(0, 1) < 0.5 ? 0 : -kGravity));
    const Body ground = addGround(world, -100, 400);
    const auto integer = [&](int low, int high) { return static_cast<int>(random.between(low, high + 1)); };
    const int wide = integer(2, 7), high = integer(1, 6), pins = integer(0, 2);
    const auto join = [&](const Body& a, const Body& b, Position at) {
        JointDef def = revoluteAt(a, b, at);
        if (tie == Tie::Rod) def.kind = DistanceJoint{.length = 1};
        if (tie == Tie::Rope) def.kind = DistanceJoint{.limits = JointLimits{0, toReal(1.05)}};
        if (tie == Tie::Weld) def = weldAt(a, b, at);
        world.createJoint(def);
    };
    std::vector<Body> net;
    for (int row = 0; row < high; ++row) {
        for (int column = 0; column < wide; ++column) {
            const Position at{1.0 * column, 1.0 * (high - row)};
            const bool isBox = tie == Tie::HingedBox || tie == Tie::Weld;
            net.push_back(isBox ? addBox(world, at, 0.8, 0.6) : addDisc(world, at, 0.3));
            if (column > 0) join(net[net.size() - 2], net.back(), {at.x - 0.5, at.y});
            if (row > 0)
                join(net[net.size() - 1 - static_cast<std::size_t>(wide)], net.back(), {at.x, at.y + 0.5});
        }
    }
    const auto pin = [&](const Body& body) { world.createJoint(revoluteAt(ground, body, body.position())); };
    if (pins > 0) pin(net.front());
    if (pins > 1) pin(net[static_cast<std::size_t>(wide) - 1]);
    const double speed = random.between(2, 40), from = random.between(0, 2 * std::numbers::pi);
    const Position start{(wide - 1) / 2.0 - 8 * std::cos(from), (high + 1) / 2.0 - 8 * std::sin(from)};
    const Body disc = addDisc(world, start, 0.5,
                              {.velocity = vec(speed * std::cos(from), speed * std::sin(from)),
                               .density = std::exp(random.between(-1, 3))});
    const double begun = world.energy().total(), blow = disc.energy().kinetic();
    return (runSeconds(world, 5).highestEnergy - begun) / blow;
}

TEST_P(StruckNets, MakeNoEnergy)
{
    TRACES("LC3", "DD15", "DD16");
    for (std::uint32_t seed = 1; seed <= 20; ++seed)
        EXPECT_LT(partOfEnergyMade(GetParam().tie, seed), 2e-3)
            << "of the energy of the blow, in net " << seed;
}

INSTANTIATE_TEST_SUITE_P(Joints, StruckNets,
                         testing::Values(StruckCase{Tie::Hinge, "discs on hinges"},
                                         StruckCase{Tie::Rod, "discs on rods"},
                                         StruckCase{Tie::Rope, "discs on ropes"},
                                         StruckCase{Tie::HingedBox, "boxes on hinges"},
                                         StruckCase{Tie::Weld, "welded boxes"}));

}  // namespace
}  // namespace tamias2d
