// SPDX-License-Identifier: MIT
// A cloud of bodies alone in space, falling in on itself: what it cannot do is gain momentum or energy.
#include <support/build.hpp>
#include <support/random.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

Body addKind(World& world, int kind, Position at, const Options& options)
{
    Options rounded = options;
    rounded.rounding = 0.05;
    switch (kind % 5) {
    case 0:
        return addDisc(world, at, 0.3, options);
    case 1:
        return addBox(world, at, 0.6, 0.6, options);
    case 2:
        return addCapsule(world, at, 0.9, 0.2, options);
    case 3:
        return addRegular(world, at, 6, 0.35, options);
    default:
        return addBox(world, at, 0.8, 0.4, rounded);
    }
}

// A hundred bodies of five kinds, one metre apart, each flying towards the middle with some disorder.
void fill(World& world, double friction, std::uint32_t seed)
{
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
        const double x = i % 10 - 4.5, y = i / 10 - 4.5;
        const double vx = -0.5 * x + random.between(-1, 1), vy = -0.5 * y + random.between(-1, 1);
        Options options{.velocity = vec(vx + 0.3, vy), .friction = friction, .restitution = 0.5};
        options.spin = random.between(-2, 2);
        options.angle = random.between(0, kTwoPi);
        options.density = random.between(0.5, 2);
        addKind(world, i, {x, y}, options);
    }
}

void expectIsolated(double friction, std::uint32_t seed)
{
    SCOPED_TRACE(testing::Message() << "friction " << friction << ", seed " << seed);
    World world(weightless());
    fill(world, friction, seed);
    double linear = 0, angular = 0;  // sums of magnitudes
    for (const BodyId id : world.bodies()) {
        const Momentum m = world.body(id).momentum();
        linear += length(m.linear);
        angular += std::abs(m.angular);
    }
    const Momentum start = world.momentum();
    const double energy = world.energy().kinetic();
    double worstLinear = 0, worstAngular = 0, worstRise = 0, lowest = energy;
    const RunTotals totals = runSeconds(world, 20, 60, 4, [&] {
        const Momentum now = world.momentum();
        worstLinear = std::max(worstLinear, length(now.linear - start.linear) / linear);
        worstAngular = std::max(worstAngular, std::abs(now.angular - start.angular) / angular);
        worstRise = std::max(worstRise, (world.energy().kinetic() - lowest) / energy);
        lowest = std::min(lowest, world.energy().kinetic());
    });
    EXPECT_LE(worstLinear, byPrecision(1e-12, 1e-5));
    EXPECT_LE(worstAngular, byPrecision(1e-6, 1e-4));
    EXPECT_LE(worstRise, byPrecision(1e-6, 1e-4)) << "of " << energy << " J";
    EXPECT_GT(totals.impacts, 300u);
    EXPECT_LT(world.energy().kinetic(), 0.7 * energy);
    EXPECT_EQ(totals.clampedBodies + totals.faults, 0u);
}

TEST(Cluster, WithoutFrictionKeepsItsMomentum)
{
    TRACES("R8", "IM3", "T2", "GD1", "DD10", "DD15");
    for (const std::uint32_t seed : {1u, 2u, 3u}) expectIsolated(0, seed);
}

TEST(Cluster, WithFrictionKeepsItsMomentum)
{
    TRACES("R8", "IM3", "T2", "GD1", "DD10", "DD15", "LC2");
    for (const std::uint32_t seed : {1u, 2u, 3u}) expectIsolated(0.5, seed);
}

}  // namespace
}  // namespace tamias2d::test
