// SPDX-License-Identifier: MIT
// A bridge of planks, straight between two banks: next to nothing holds its joints apart across it.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

struct Bridge {
    World world;
    std::vector<Joint> joints;

    explicit Bridge(int planks)
    {
        constexpr double kPlank = 0.9;
        const double half = planks * kPlank / 2;
        Body banks = addBox(world, {0, -20}, 1, 1, {.type = BodyType::Static});
        Body last = banks;
        for (int i = 0; i < planks; ++i) {
            Body plank = addBox(world, {kPlank * (i + 0.5) - half, 0}, kPlank, 0.2, {.friction = 0.7});
            joints.push_back(world.createJoint(revoluteAt(last, plank, {kPlank * i - half, 0})));
            last = plank;
        }
        joints.push_back(world.createJoint(revoluteAt(last, banks, {half, 0})));
    }
    double greatestError() const
    {
        double greatest = 0;
        for (const Joint& joint : joints)
            greatest = std::max(greatest, static_cast<double>(joint.reading().error));
        return greatest;
    }
};

TEST(Bridge, OfPlanksIsNotThrownByTheBoxesThatFallOnIt)
{
    TRACES("LC3", "NFR2", "R8");
    Bridge bridge(30);
    for (int i = 0; i < 5; ++i) addBox(bridge.world, {-8.0 + 4 * i, 3 + 1.2 * i}, 1, 1, {.density = 0.6});
    const double start = bridge.world.energy().total();
    double highest = start, error = 0;
    const RunTotals totals = runSeconds(bridge.world, 10, 60, 4, [&] {
        highest = std::max(highest, bridge.world.energy().total());
        error = std::max(error, bridge.greatestError());
    });
    EXPECT_EQ(totals.faults, 0u);
    EXPECT_LT(highest - start, 1) << "of " << start << " J";
    EXPECT_LT(error, 0.05);
}

}  // namespace
}  // namespace tamias2d
