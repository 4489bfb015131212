// SPDX-License-Identifier: MIT
// Newton's cradle: a row of equal discs hands the blow on, one by one.
#include <support/build.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace tamias2d::test {
namespace {

constexpr double kRadius = 0.5;
constexpr double kSpeed = 2;

struct Blow {
    double time;
    std::pair<int, int> balls;
};

// Five discs; the first `moving` fly at the others, who rest `gap` beyond the rest gap apart.
struct Cradle {
    World world{weightless()};
    std::vector<Body> balls;
    std::vector<Blow> blows;  // in order

    Cradle(int moving, double gap)
    {
        const double pitch = 2 * kRadius + restGapFor(world, 2 * kRadius) + gap;
        for (int i = 0; i < 5; ++i) {
            const bool moves = i < moving;
            balls.push_back(addDisc(world, {i * pitch - (moves ? 1.0 : 0.0), 0}, kRadius,
                                    {.velocity = vec(moves ? kSpeed : 0, 0), .restitution = 1}));
        }
    }

    int indexOf(BodyId id) const
    {
        int i = 0;
        while (balls[static_cast<std::size_t>(i)].id() != id) ++i;
        return i;
    }

    void run(double seconds, int substeps)
    {
        runSeconds(world, seconds, 60, substeps, [&] {
            for (const HitEvent& hit : world.events().hits) {
                blows.push_back({hit.time, std::minmax({indexOf(hit.bodyA), indexOf(hit.bodyB)})});
            }
        });
    }
};

// Each ball that comes in sends a wave through those ahead of it; its time at each pair is known.
void expectWaves(const Cradle& cradle, int moving, double gap)
{
    std::vector<Blow> expected;
    for (int wave = 0; wave < moving; ++wave) {
        for (int i = moving - 1 - wave; i < 4 - wave; ++i) {
            const double steps = i - (moving - 1) + 2.0 * wave;
            expected.push_back({(1 + gap + steps * gap) / kSpeed, {i, i + 1}});
        }
    }
    std::sort(expected.begin(), expected.end(), [](const Blow& a, const Blow& b) { return a.time < b.time; });
    ASSERT_EQ(cradle.blows.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const Blow& blow = cradle.blows[i];
        EXPECT_NEAR(blow.time, expected[i].time, byPrecision(1e-9, 1e-5)) << "blow " << i;
        // Of those due at the same moment, any may come first.
        const bool due = std::any_of(expected.begin(), expected.end(), [&](const Blow& e) {
            return e.balls == blow.balls && std::abs(e.time - blow.time) < byPrecision(1e-9, 1e-5);
        });
        EXPECT_TRUE(due) << "blow " << i << " of balls " << blow.balls.first << " and " << blow.balls.second;
    }
}

void expectHandedOn(int moving, double gap, int substeps)
{
    SCOPED_TRACE(testing::Message() << moving << " moving, gap " << gap << " x " << substeps);
    Cradle cradle(moving, gap);
    cradle.run(2, substeps);
    for (int i = 0; i < 5; ++i) {
        const DVec2 expected{i >= 5 - moving ? kSpeed : 0, 0};
        EXPECT_LE(length(velocityOf(cradle.balls[static_cast<std::size_t>(i)]) - expected), kExact * kSpeed)
            << "ball " << i << " moves at " << velocityOf(cradle.balls[static_cast<std::size_t>(i)]).x;
        EXPECT_EQ(cradle.balls[static_cast<std::size_t>(i)].angularVelocity(), 0);
    }
    if (gap > 0) expectWaves(cradle, moving, gap);
}

TEST(Cradle, OneBallInOneBallOut)
{
    TRACES("R8", "IM3", "GD1", "DD12");
    for (const int substeps : {1, 2, 4, 8}) {
        for (const double gap : {0.0, 1e-6, 1e-3, 0.1}) expectHandedOn(1, gap, substeps);
    }
}

TEST(Cradle, TwoBallsInTwoBallsOut)
{
    TRACES("R8", "IM3", "GD1", "DD12");
    for (const int substeps : {1, 2, 4, 8}) {
        for (const double gap : {0.0, 1e-6, 1e-3, 0.1}) expectHandedOn(2, gap, substeps);
    }
}

TEST(Cradle, ThreeBallsInThreeBallsOut)
{
    TRACES("R8", "IM3", "GD1", "DD12");
    for (const double gap : {0.0, 1e-3}) expectHandedOn(3, gap, 4);
}

TEST(Cradle, OnAFloorItWorksTheSame)
{
    TRACES("R8", "IM3", "GD1", "DD12");
    World world;
    addGround(world, 0, 100, {.friction = 0});
    const double rest = restGapFor(world, 2 * kRadius), pitch = 2 * kRadius + rest;
    std::vector<Body> balls;
    for (int i = 0; i < 5; ++i) {
        balls.push_back(addDisc(world, {i * pitch - (i == 0 ? 1.0 : 0.0), kRadius + rest}, kRadius,
                                {.velocity = vec(i == 0 ? kSpeed : 0, 0), .friction = 0, .restitution = 1}));
    }
    runSeconds(world, 2);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(velocityOf(balls[i]).x, i == 4 ? kSpeed : 0, 1e-3 * kSpeed) << i;
        EXPECT_LE(std::abs(balls[i].position().y - kRadius - rest), 1e-4);
    }
}

}  // namespace
}  // namespace tamias2d::test
