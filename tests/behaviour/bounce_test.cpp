// SPDX-License-Identifier: MIT
// Restitution: bounces that keep their height, and walls that give back the speed they should.
#include <support/build.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

constexpr double kBallRadius = 0.5;
constexpr double kDrop = 5;  // height of the first fall, above where the ball would rest   [m]

struct Ball {
    World world;
    Body body;
    double floor;  // height of the center at rest   [m]

    explicit Ball(double restitution, const WorldDef& def = {})
        : world(def), floor(kBallRadius + restGapFor(world, 2 * kBallRadius))
    {
        addGround(world);
        body = addDisc(world, {0, floor + kDrop}, kBallRadius, {.restitution = restitution});
    }

    /// How high it gets above where it would rest, as seen from any point of its flight [m].
    double peak() const
    {
        const double v = velocityOf(body).y, g = -static_cast<double>(world.definition().gravity.y);
        return body.position().y - floor + v * v / (2 * g);
    }
};

// The height reached after `bounces` bounces.
double peakAfter(int bounces, double rate, int substeps)
{
    Ball ball(1);
    int hits = 0;
    while (hits < bounces && ball.world.time() < 3.0 * bounces + 10) {
        ball.world.step(1 / rate, substeps);
        hits += static_cast<int>(ball.world.events().hits.size());
    }
    EXPECT_EQ(hits, bounces) << "after " << ball.world.time() << " s";
    return ball.peak();
}

void expectAThousandBounces(double rate)
{
    constexpr double kKept = byPrecision(1e-9, 1e-3);
    for (const int substeps : {1, 2, 4, 8}) {
        const double peak = peakAfter(1000, rate, substeps);
        EXPECT_LE(relativeError(peak, kDrop), kKept) << rate << " Hz x " << substeps << ": " << peak << " m";
    }
}

TEST(Bounce, APerfectBallKeepsItsHeightAt30Hz)
{
    TRACES("R3", "R8", "IM3", "DD12", "DD16", "A6", "ADR7");
    expectAThousandBounces(30);
}
TEST(Bounce, APerfectBallKeepsItsHeightAt60Hz)
{
    TRACES("R3", "R8", "IM3", "DD12", "DD16", "A6", "ADR7");
    expectAThousandBounces(60);
}
TEST(Bounce, APerfectBallKeepsItsHeightAt120Hz)
{
    TRACES("R3", "R8", "IM3", "DD12", "DD16", "A6", "ADR7");
    expectAThousandBounces(120);
}
TEST(Bounce, APerfectBallKeepsItsHeightAt240Hz)
{
    TRACES("R3", "R8", "IM3", "DD12", "DD16", "A6", "ADR7");
    expectAThousandBounces(240);
}

TEST(Bounce, APerfectFlatBoxKeepsItsHeightAndDoesNotTurn)
{
    TRACES("R3", "R8", "IM3", "DD12");
    World world;
    addGround(world);
    const double rest = 0.5 + restGapFor(world, 1);
    const Body box = addBox(world, {0, rest + kDrop}, 2, 1, {.restitution = 1});
    int impacts = 0;
    runSeconds(world, 200, 60, 4, [&] { impacts += world.events().hits.empty() ? 0 : 1; });
    const double v = velocityOf(box).y;
    EXPECT_LE(relativeError(box.position().y - rest + v * v / (2 * 9.81), kDrop), byPrecision(1e-9, 1e-3));
    EXPECT_LE(std::abs(angleDifference(box.angle(), 0)), byPrecision(1e-9, 1e-3));
    EXPECT_NEAR(impacts, 99, 1);  // one each 2.02 s
}

TEST(Bounce, TheFirstHeightIsTheSquareOfTheRestitution)
{
    TRACES("R3", "R8", "DD12");
    for (int tenths = 1; tenths <= 9; ++tenths) {
        for (const int substeps : {1, 4}) {
            const double e = tenths / 10.0;
            Ball ball(e);
            while (ball.world.events().hits.empty() && ball.world.time() < 2)
                ball.world.step(1.0 / 60, substeps);
            EXPECT_LE(relativeError(ball.peak(), e * e * kDrop), 1e-3) << "C_R " << e << " x " << substeps;
        }
    }
}

TEST(Bounce, EachHeightIsTheSquareOfTheRestitutionTimesTheLast)
{
    TRACES("R3", "R8", "DD12");
    Ball ball(0.8);
    double expected = kDrop;
    for (int bounce = 0; bounce < 12; ++bounce) {
        do ball.world.step();
        while (ball.world.events().hits.empty() && ball.world.time() < 20);
        expected *= 0.64;
        EXPECT_EQ(ball.world.events().hits.size(), 1u);
        EXPECT_LE(relativeError(ball.peak(), expected), 1e-3) << "bounce " << bounce;
    }
}

TEST(Bounce, AnInelasticBallStaysDown)
{
    TRACES("R3", "R8", "DD12");
    Ball ball(0);
    runSeconds(ball.world, 3);
    EXPECT_LE(std::abs(ball.peak()), 1e-4);
    EXPECT_LE(std::abs(velocityOf(ball.body).y), 1e-6);
}

TEST(Bounce, EnergyNeverRisesWhateverTheRestitution)
{
    TRACES("R8", "DD15", "DD16");
    for (int tenths = 0; tenths <= 10; ++tenths) {
        Ball ball(tenths / 10.0);
        const double drop = static_cast<double>(ball.body.mass()) * 9.81 * kDrop;
        const RunTotals totals = runSeconds(ball.world, 20);
        EXPECT_LE(totals.sumOfEnergyRises, byPrecision(1e-9, 1e-3) * drop) << "C_R " << tenths / 10.0;
    }
}

// Speeds after and before a body flies straight at a wall.
template <class Make>
void expectExitSpeeds(double restitution, Make&& make)
{
    for (const double speed :
         {0.01, 0.02, 0.05, 0.1, 0.2, 0.25, 0.5, 0.9, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
        for (const int substeps : {1, 2, 4, 8}) {
            World world(weightless());
            addBox(world, {1, 0}, 1, 100, {.type = BodyType::Static, .friction = 0});
            const double start = 0.5 - 1.25 * speed / 60;  // the second step brings it to the wall
            const Body body = make(
                world, start, Options{.velocity = vec(speed, 0), .friction = 0, .restitution = restitution});
            for (int i = 0; i < 20; ++i) world.step(1.0 / 60, substeps);
            EXPECT_LE(std::abs(-velocityOf(body).x / speed - restitution), 1e-3)
                << speed << " m/s, C_R " << restitution << " x " << substeps;
        }
    }
}

TEST(Wall, GivesABallBackItsSpeedFromACreepToARace)
{
    TRACES("R3", "R8", "IM3", "DD12");
    const auto ball = [](World& w, double right, const Options& o) {
        return addDisc(w, {right - 0.5, 0}, 0.5, o);
    };
    for (const double e : {1.0, 0.5, 0.1}) expectExitSpeeds(e, ball);
}

TEST(Wall, GivesAFlatBoxBackItsSpeed)
{
    TRACES("R3", "R8", "IM3", "DD12");
    const auto box = [](World& w, double right, const Options& o) {
        return addBox(w, {right - 0.5, 0}, 1, 1, o);
    };
    for (const double e : {1.0, 0.5}) expectExitSpeeds(e, box);
}

TEST(Wall, TwoOfThemKeepABallGoingForAThousandBounces)
{
    TRACES("R8", "DD12");
    for (const double speed : {0.5, 10.0, 100.0}) {
        World world(weightless());
        addWalls(world, {0, 0}, {2, 2}, {.friction = 0});
        const Body ball =
            addDisc(world, {1, 1}, 0.25, {.velocity = vec(speed, 0), .friction = 0, .restitution = 1});
        std::size_t hits = 0;
        while (hits < 1000 && world.time() < 3000 / speed) {
            world.step();
            hits += world.events().hits.size();
        }
        EXPECT_GE(hits, 1000u) << speed;
        EXPECT_LE(relativeError(length(velocityOf(ball)), speed), byPrecision(1e-9, 1e-3)) << speed;
    }
}

}  // namespace
}  // namespace tamias2d::test
