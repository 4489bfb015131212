// SPDX-License-Identifier: MIT
// Chains that are pulled about much faster than they are long in a step.
#include "support/build.hpp"
#include "support/random.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tamias2d {
namespace {

using namespace test;

// A chain of links that do not meet each other, laid anyhow through the origin, and a target that pulls at
// its first one.
struct DraggedChain {
    static constexpr double kLink = 0.5;  // the length of a link   [m]

    double heading;   // the direction to drag it in   [rad]
    std::vector<Body> links;
    std::vector<Joint> joints;
    Joint drag;
    Position start;

    DraggedChain(World& world, int count, Random& random)
    {
        const double lay = random.between(0, 2 * kPi);
        heading = random.between(0, 2 * kPi);
        const Vec2 along = vec(std::cos(lay), std::sin(lay));
        const Body hand = addDisc(world, {1e4, 1e4}, 1, {.type = BodyType::Static});
        const double width = random.between(0.1, 0.3), frequency = random.between(2, 10);
        const auto at = [&](double way) {
            return Position{way * static_cast<double>(along.x), way * static_cast<double>(along.y)};
        };
        for (int i = 0; i < count; ++i) {
            Body link = addBox(world, at(kLink * i), kLink, width, {.angle = lay});
            for (Shape shape : link.shapes()) shape.setFilter({1, 1, -1});
            if (i > 0)
                joints.push_back(world.createJoint(revoluteAt(links.back(), link, at(kLink * (i - 0.5)))));
            links.push_back(link);
        }
        start = links.front().position();
        TargetJoint target;
        target.target = start;
        target.frequency = toReal(frequency);
        JointDef def;
        def.bodyA = hand.id();
        def.bodyB = links.front().id();
        def.kind = target;
        drag = world.createJoint(def);
    }

    void dragTo(double way)
    {
        drag.setTarget({start.x + way * std::cos(heading), start.y + way * std::sin(heading)});
    }
};

struct DragCase {
    int links, trials;
};
void PrintTo(const DragCase& c, std::ostream* out)
{
    *out << c.links << " links, " << c.trials << " trials";
}

class DraggedChains : public testing::TestWithParam<DragCase> {};

// A target goes there, back, and beyond at 1000 m/s, more than 16 m a step, and turns round twice.
TEST_P(DraggedChains, AtAThousandMetersASecondStretchByLessThanAHundredth)
{
    TRACES("LC3");
    constexpr double kSpeed = 1000, kTurn = 0.1;
    const auto [links, trials] = GetParam();
    Random random(7);
    for (int trial = 0; trial < trials; ++trial) {
        World world;
        DraggedChain chain(world, links, random);
        double time = 0, stretch = 0;
        runSeconds(world, 4 * kTurn, 60, 4, [&] {
            double sum = 0;
            for (const Joint& joint : chain.joints) sum += static_cast<double>(joint.reading().error);
            stretch = std::max(stretch, sum / (DraggedChain::kLink * links));
            time += 1.0 / 60;
            const double way = kSpeed * (time < kTurn       ? time
                                         : time < 3 * kTurn ? 2 * kTurn - time
                                                            : time - 4 * kTurn);
            chain.dragTo(way);
        });
        EXPECT_LT(stretch, 0.01) << "trial " << trial;
    }
}

struct WallCase {
    int links, trials;
    double speed;   // [m/s]
};
void PrintTo(const WallCase& c, std::ostream* out)
{
    *out << c.links << " links at " << c.speed << " m/s, " << c.trials << " trials";
}

class ChainsDraggedAtWalls : public testing::TestWithParam<WallCase> {};

// In a room of 40 m by 40 m with walls of 10 cm a target goes 60 m away, beyond the walls, back through the
// room and as far beyond the other ones. It pulls as hard as it takes: up to ten thousand times the weight.
TEST_P(ChainsDraggedAtWalls, NeverCrossThem)
{
    TRACES("LC3", "ADR7");
    constexpr double kHalf = 20, kThick = 0.1, kFar = 60;
    const auto [links, trials, speed] = GetParam();
    Random random(7);
    for (int trial = 0; trial < trials; ++trial) {
        World world;
        for (const double side : {-1.0, 1.0}) {
            addBox(world, {0, side * (kHalf + kThick / 2)}, 2 * kHalf + 2 * kThick, kThick,
                   {.type = BodyType::Static});
            addBox(world, {side * (kHalf + kThick / 2), 0}, kThick, 2 * kHalf, {.type = BodyType::Static});
        }
        DraggedChain chain(world, links, random);
        const double leg = kFar / speed;
        double time = 0, farthest = 0;
        runSeconds(world, 4 * leg + 0.5, 60, 4, [&] {
            for (const Body& body : chain.links) {
                const Position p = body.position();
                farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
            }
            time = std::min(time + 1.0 / 60, 4 * leg);
            const double way = speed * (time < leg ? time : time < 3 * leg ? 2 * leg - time : time - 4 * leg);
            chain.dragTo(way);
        });
        EXPECT_LT(farthest, kHalf + kThick) << "trial " << trial;
    }
}

INSTANTIATE_TEST_SUITE_P(Joints, ChainsDraggedAtWalls,
                         testing::Values(WallCase{2, 6, 5}, WallCase{2, 40, 300}, WallCase{2, 40, 1000},
                                         WallCase{8, 3, 5}, WallCase{8, 20, 300}, WallCase{8, 20, 1000},
                                         WallCase{20, 2, 20}, WallCase{20, 10, 300}, WallCase{20, 10, 1000}));

INSTANTIATE_TEST_SUITE_P(Joints, DraggedChains,
                         testing::Values(DragCase{2, 40}, DragCase{8, 20}, DragCase{20, 6}));

}  // namespace
}  // namespace tamias2d
