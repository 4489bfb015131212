// SPDX-License-Identifier: MIT
// Nothing passes through anything, however fast and thin. Each scene is 200 pairs in lanes of their own,
// started a little differently, so that the moment of meeting falls anywhere within a step.
#include <support/run.hpp>
#include <support/scenes.hpp>

#include <functional>

namespace tamias2d::test {
namespace {

constexpr int kTrials = 200;
constexpr double kLane = 8;  // from one lane to the next   [m]

// Runs for `seconds` and counts the lanes in which, at the end of any step, `passed` was true.
int countPasses(World& world, double seconds, const std::function<bool(int)>& passed)
{
    std::vector<char> seen(kTrials, 0);
    const RunTotals totals = runSeconds(world, seconds, 60, 4, [&] {
        for (int i = 0; i < kTrials; ++i)
            if (passed(i)) seen[static_cast<std::size_t>(i)] = 1;
    });
    EXPECT_EQ(totals.faults, 0u);
    EXPECT_EQ(totals.clampedBodies, 0u);
    return static_cast<int>(std::count(seen.begin(), seen.end(), 1));
}

using Make = std::function<Body(World&, Position, const Options&)>;

// Two bodies of a kind run at each other, each at `speed`. Returns in how many lanes they changed sides.
int headOn(const Make& make, double speed, double restitution)
{
    World world(weightless());
    std::vector<std::pair<Body, Body>> lanes;
    for (int i = 0; i < kTrials; ++i) {
        const double y = kLane * i, phase = 0.0137 * i;
        Options options{.velocity = vec(speed, 0), .friction = 0, .restitution = restitution};
        const Body left = make(world, {-5 - phase, y}, options);
        options.velocity = vec(-speed, 0);
        lanes.emplace_back(left, make(world, {5 + 0.7 * phase, y}, options));
    }
    return countPasses(world, 8 / speed + 0.05, [&](int i) {
        const auto& [left, right] = lanes[static_cast<std::size_t>(i)];
        return left.position().x >= right.position().x;
    });
}

// A body runs at a static wall 1 cm thick. Returns in how many lanes its center got behind the middle of it.
int againstTheWall(double width, double height, double speed, double spin, double restitution)
{
    World world(weightless());
    std::vector<Body> runners;
    for (int i = 0; i < kTrials; ++i) {
        const double y = kLane * i;
        addBox(world, {0, y}, 0.01, 4, {.type = BodyType::Static, .friction = 0, .restitution = restitution});
        runners.push_back(addBox(world, {-3 - 0.0537 * (i % 40), y + 0.002 * i}, width, height,
                                 {.velocity = vec(speed, 0),
                                  .spin = spin,
                                  .angle = 0.1 * i,
                                  .friction = 0,
                                  .restitution = restitution}));
    }
    return countPasses(world, 12 / speed + 0.05,
                       [&](int i) { return runners[static_cast<std::size_t>(i)].position().x > 0; });
}

TEST(Passing, DiscsThatMeetHeadOnNeverChangeSides)
{
    TRACES("R7", "R8", "T5");
    const Make disc = [](World& w, Position p, const Options& o) { return addDisc(w, p, 0.1, o); };
    for (const double restitution : {0.0, 1.0})
        for (const double speed : {20.0, 200.0, 2000.0})
            EXPECT_EQ(headOn(disc, speed, restitution), 0) << speed << " m/s, C_R " << restitution;
}

TEST(Passing, ThinRodsThatMeetHeadOnNeverChangeSides)
{
    TRACES("R7", "R8", "T5");
    const Make rod = [](World& w, Position p, const Options& o) { return addBox(w, p, 0.02, 1, o); };
    for (const double restitution : {0.0, 1.0})
        for (const double speed : {20.0, 200.0, 2000.0})
            EXPECT_EQ(headOn(rod, speed, restitution), 0) << speed << " m/s, C_R " << restitution;
}

TEST(Passing, AThinWallHoldsBoxesUpToTwoThousandMetresASecond)
{
    TRACES("R7", "R8", "T5");
    for (const double restitution : {0.0, 1.0})
        for (const double speed : {10.0, 100.0, 500.0, 2000.0})
            EXPECT_EQ(againstTheWall(0.5, 0.5, speed, 0, restitution), 0)
                << speed << " m/s, C_R " << restitution;
}

TEST(Passing, AThinWallHoldsSpinningRodsUpToFiveHundredMetresASecond)
{
    TRACES("R7", "R8", "T5");
    for (const double restitution : {0.0, 1.0}) {
        for (const double speed : {10.0, 100.0, 500.0})
            EXPECT_EQ(againstTheWall(1, 0.05, speed, 30, restitution), 0)
                << speed << " m/s, C_R " << restitution;
        record("passes_2000mps_CR" + std::to_string(int(restitution)),
               againstTheWall(1, 0.05, 2000, 30, restitution));
    }
}

}  // namespace
}  // namespace tamias2d::test
