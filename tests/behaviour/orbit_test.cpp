// SPDX-License-Identifier: MIT
// Universal gravitation between bodies [T3], against Kepler.
#include <support/build.hpp>
#include <support/closed_form.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

constexpr double kPeriod = 4;         // of the orbits below            [s]
constexpr double kEccentricity = 0.5;
constexpr double kLongAxis = 10;      // semi-major, of the distance    [m]

// Two discs of 1 and 3 kg on ellipses about their common center, starting at the nearest point.
struct Orbiters {
    World world;
    Body light, heavy;
    double g;  // of gravitation

    static WorldDef definition(double g)
    {
        WorldDef def = weightless();
        def.gravitationConstant = toReal(g);
        return def;
    }

    explicit Orbiters(DVec2 drift = {})
        : world(definition(kTwoPi * kTwoPi * kLongAxis * kLongAxis * kLongAxis / (kPeriod * kPeriod * 4))),
          g(static_cast<double>(world.definition().gravitationConstant))
    {
        const double near = kLongAxis * (1 - kEccentricity);
        const double speed = std::sqrt(g * 4 * (2 / near - 1 / kLongAxis));
        light = addDisc(world, {0.75 * near, 0}, 0.1);
        heavy = addDisc(world, {-0.25 * near, 0}, 0.1);
        light.setMass({1, {}, 1});
        heavy.setMass({3, {}, 1});
        light.setLinearVelocity(vec(drift.x, drift.y + 0.75 * speed));
        heavy.setLinearVelocity(vec(drift.x, drift.y - 0.25 * speed));
    }

    double distance() const { return length(light.position() - heavy.position()); }
};

TEST(Gravitation, PullsAsNewtonSays)
{
    TRACES("T3", "T2", "GD2", "IM1");
    WorldDef def = weightless();
    def.gravitationConstant = 2;
    World world(def);
    Body a = addDisc(world, {0, 0}, 0.5), b = addDisc(world, {3, 4}, 0.5);
    a.setMass({7, {}, 1});
    b.setMass({11, {}, 1});
    EXPECT_LE(relativeError(world.energy().potential, -2.0 * 7 * 11 / 5), byPrecision(1e-14, 1e-6));
    const double dt = 1e-4;  // too short to get anywhere
    world.step(dt, 1);
    const DVec2 along{0.6, 0.8};
    EXPECT_LE(relativeError(velocityOf(a), dt * 2 * 11 / 25 * along), 1e-6);
    EXPECT_LE(relativeError(velocityOf(b), -dt * 2 * 7 / 25 * along), 1e-6);
    EXPECT_DOUBLE_EQ(kGravitationConstant, 6.673e-11);
}

TEST(Gravitation, AnOrbitKeepsItsEnergyForAHundredPeriods)
{
    TRACES("T3", "R5", "IM1", "DD15", "DD16", "GD1");
    Orbiters pair;
    const double start = pair.world.energy().total();
    const double angular = pair.world.momentum().angular;
    const double size = length(pair.light.momentum().linear) + length(pair.heavy.momentum().linear);
    double energy = 0, momentum = 0, nearest = kLongAxis, farthest = 0;
    runSeconds(pair.world, 100 * kPeriod, 60, 4, [&] {
        energy = std::max(energy, relativeError(pair.world.energy().total(), start));
        momentum = std::max(momentum, length(pair.world.momentum().linear) / size);
        nearest = std::min(nearest, pair.distance());
        farthest = std::max(farthest, pair.distance());
    });
    EXPECT_LE(relativeError(start, -pair.g * 3 / (2 * kLongAxis)), byPrecision(1e-12, 1e-5));
    EXPECT_LE(energy, 1e-3);
    EXPECT_LE(momentum, byPrecision(1e-12, 1e-4));
    EXPECT_LE(relativeError(pair.world.momentum().angular, angular), byPrecision(1e-10, 1e-4));
    EXPECT_LE(relativeError(nearest, kLongAxis * (1 - kEccentricity)), 1e-3);
    EXPECT_LE(relativeError(farthest, kLongAxis * (1 + kEccentricity)), 1e-3);
}

TEST(Gravitation, AnOrbitClosesAfterOnePeriodToSecondOrder)
{
    TRACES("T3", "R5", "IM1");
    double error[3] = {};
    for (const int i : {0, 1, 2}) {
        Orbiters pair;
        const Position start = pair.light.position();
        runSeconds(pair.world, kPeriod, 60, 2 << i);
        error[i] = length(pair.light.position() - start);
    }
    EXPECT_LE(error[1], 0.1);
    EXPECT_NEAR(orderOf(error[0], error[1]), 2, 0.1) << error[0] << " " << error[1];
    if (kDouble) {
        EXPECT_NEAR(orderOf(error[1], error[2]), 2, 0.05) << error[1] << " " << error[2];
    }
}

TEST(Gravitation, TheCommonCenterMovesOnALine)
{
    TRACES("T2", "T3", "GD1");
    Orbiters pair({1, -2});
    const auto center = [&] { return 0.25 * centerOf(pair.light) + 0.75 * centerOf(pair.heavy); };
    const DVec2 start = center();
    runSeconds(pair.world, 10 * kPeriod);
    const double t = 10 * kPeriod;
    EXPECT_LE(relativeError(center() - start, t * DVec2{1, -2}), byPrecision(1e-12, 1e-4));
}

TEST(Gravitation, ManyBodiesKeepTheirMomentum)
{
    TRACES("T2", "T3", "GD1");
    WorldDef def = weightless();
    def.gravitationConstant = 50;
    World world(def);
    double size = 0, turning = 0;
    for (int i = 0; i < 8; ++i) {
        const double phi = kTwoPi * i / 8;
        const DVec2 out{std::cos(phi), std::sin(phi)};
        const Body body = addDisc(world, {20 * out.x, 20 * out.y}, 0.3 + 0.05 * i,
                                  {.velocity = vec(-3 * out.y, 3 * out.x), .spin = 1});
        size += length(body.momentum().linear);
        turning += std::abs(body.momentum().angular);
    }
    const Momentum start = world.momentum();
    const double energy = world.energy().total();
    runSeconds(world, 5);
    EXPECT_LE(length(world.momentum().linear - start.linear), byPrecision(1e-12, 1e-4) * size);
    EXPECT_LE(std::abs(world.momentum().angular - start.angular), byPrecision(1e-12, 1e-4) * turning);
    EXPECT_LE(relativeError(world.energy().total(), energy), 1e-3);
}

TEST(Gravitation, CanBeSwitchedOnAndOff)
{
    TRACES("T3", "R2");
    World world(weightless());
    Body a = addDisc(world, {0, 0}, 0.5);
    addDisc(world, {10, 0}, 0.5);
    runSeconds(world, 1);
    EXPECT_EQ(a.linearVelocity(), Vec2{});
    world.setGravitationConstant(1);
    runSeconds(world, 1);
    EXPECT_GT(velocityOf(a).x, 0);
    world.setGravitationConstant(0);
    const Vec2 before = a.linearVelocity();
    runSeconds(world, 1);
    EXPECT_EQ(a.linearVelocity(), before);
}

TEST(Attraction, OfAPointHoldsACircleOrbit)
{
    TRACES("T3", "R5", "IM1");
    World world(weightless());
    Body body = addDisc(world, {5, 0}, 0.1, {.velocity = vec(0, 2)});
    body.addForceLaw(attractionTo({0, 0}, 2.0 * 2 * 5));  // v^2 = mu / r
    const double start = world.energy().total();
    runSeconds(world, 100, 60, 4, [&] {
        EXPECT_LE(relativeError(length(centerOf(body)), 5), 1e-3);
        EXPECT_LE(relativeError(world.energy().total(), start), 1e-3);
    });
}

}  // namespace
}  // namespace tamias2d::test
