// SPDX-License-Identifier: MIT
// Slack ropes that snap taut, from random beginnings. Nothing drives them, so the energy they begin with is
// all that there ever is.
#include "support/build.hpp"
#include "support/random.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tamias2d {
namespace {

using namespace test;

// Discs in a line from a static hook, nearer to each other than the ropes between them are long, thrown
// about; the last one is heavy.
struct SlackRope {
    World world;
    std::vector<Joint> joints;
    double weight = 0, length = 0;  // [N], [m]

    // `leastRatio` and `mostRatio` are powers of ten, of the last disc's mass to that of the others.
    SlackRope(std::uint32_t seed, double leastRatio, double mostRatio)
    {
        constexpr double kLink = 0.5, kRadius = 0.1, kLoad = 0.3;
        Random random(seed);
        const int links = static_cast<int>(random.between(3, 30));
        const double ratio = std::pow(10, random.between(leastRatio, mostRatio));
        const double heading = random.between(0, 2 * kPi), slack = random.between(0.6, 1);
        Body last = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        for (int i = 1; i <= links; ++i) {
            const bool isLoad = i == links;
            const double away = kLink * slack * i;
            Options options;
            options.density = isLoad ? ratio * kRadius * kRadius / (kLoad * kLoad) : 1;
            options.velocity = vec(random.between(-3, 3), random.between(-3, 3));
            Body disc = addDisc(world, {away * std::cos(heading), away * std::sin(heading)},
                                isLoad ? kLoad : kRadius, options);
            for (Shape shape : disc.shapes()) shape.setFilter({1, 1, -1});
            DistanceJoint rope;
            rope.length = toReal(kLink);
            rope.limits = JointLimits{.lower = 0, .upper = toReal(kLink)};
            JointDef def;
            def.bodyA = last.id();
            def.bodyB = disc.id();
            def.kind = rope;
            joints.push_back(world.createJoint(def));
            weight += 9.81 * static_cast<double>(disc.mass());
            length += kLink;
            last = disc;
        }
    }
};

struct RopeCase {
    double leastRatio, mostRatio;
    int scenes;
};
void PrintTo(const RopeCase& c, std::ostream* out)
{
    *out << c.scenes << " ropes of 3 to 29 discs, one of 1e" << c.leastRatio << " to 1e" << c.mostRatio
         << " times their mass at the end";
}

class SlackRopes : public testing::TestWithParam<RopeCase> {};

TEST_P(SlackRopes, NeverGainEnergyNorStretchAsTheySnapTaut)
{
    TRACES("LC3", "NFR2");
    for (int scene = 0; scene < GetParam().scenes; ++scene) {
        SlackRope rope(static_cast<std::uint32_t>(scene) + 1, GetParam().leastRatio, GetParam().mostRatio);
        const double begun = rope.world.energy().total(), scale = rope.weight * rope.length;
        double above = 0, stretch = 0;
        runSeconds(rope.world, 2.5, 60, 4, [&] {
            above = std::max(above, rope.world.energy().total() - begun);
            for (const Joint& joint : rope.joints)
                stretch = std::max(stretch, static_cast<double>(joint.reading().error) / 0.5);
        });
        EXPECT_LT(above / scale, 1e-6) << "scene " << scene;
        EXPECT_LT(stretch, 1e-3) << "scene " << scene;
    }
}

INSTANTIATE_TEST_SUITE_P(Joints, SlackRopes, testing::Values(RopeCase{0, 4, 30}, RopeCase{4, 5, 8}));

}  // namespace
}  // namespace tamias2d
