// SPDX-License-Identifier: MIT
// Nets of discs: more joints than the discs can move in ways, so that loads can cancel each other in many.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace tamias2d
