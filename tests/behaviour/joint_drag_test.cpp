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
    constexpr double kLink = 0.5, kSpeed = 1000, kTurn = 0.1;
    const auto [links, trials] = GetParam();
    Random random(7);
    for (int trial = 0; trial < trials; ++trial) {
        const double lay = random.between(0, 2 * kPi), heading = random.between(0, 2 * kPi);
        const Vec2 along = vec(std::cos(lay), std::sin(lay));
        World world;
        const Body ground = addDisc(world, {1e4, 1e4}, 1, {.type = BodyType::Static});
        const double width = random.between(0.1, 0.3), frequency = random.between(2, 10);
        std::vector<Body> bodies;
        std::vector<Joint> joints;
        const auto at = [&](double way) {
            return Position{way * static_cast<double>(along.x), way * static_cast<double>(along.y)};
        };
        for (int i = 0; i < links; ++i) {
            Body link = addBox(world, at(kLink * i), kLink, width, {.angle = lay});
            for (Shape shape : link.shapes()) shape.setFilter({1, 1, -1});
            if (i > 0)
                joints.push_back(world.createJoint(revoluteAt(bodies.back(), link, at(kLink * (i - 0.5)))));
            bodies.push_back(link);
        }
        const Position start = bodies.front().position();
        TargetJoint target;
        target.target = start;
        target.frequency = toReal(frequency);
        JointDef def;
        def.bodyA = ground.id();
        def.bodyB = bodies.front().id();
        def.kind = target;
        Joint drag = world.createJoint(def);
        double time = 0, stretch = 0;
        runSeconds(world, 4 * kTurn, 60, 4, [&] {
            double sum = 0;
            for (const Joint& joint : joints) sum += static_cast<double>(joint.reading().error);
            stretch = std::max(stretch, sum / (kLink * links));
            time += 1.0 / 60;
            const double way = kSpeed * (time < kTurn       ? time
                                         : time < 3 * kTurn ? 2 * kTurn - time
                                                            : time - 4 * kTurn);
            drag.setTarget({start.x + way * std::cos(heading), start.y + way * std::sin(heading)});
        });
        EXPECT_LT(stretch, 0.01) << "trial " << trial;
    }
}

INSTANTIATE_TEST_SUITE_P(Joints, DraggedChains,
                         testing::Values(DragCase{2, 40}, DragCase{8, 20}, DragCase{20, 6}));

}  // namespace
}  // namespace tamias2d
