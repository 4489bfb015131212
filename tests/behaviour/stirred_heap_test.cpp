// SPDX-License-Identifier: MIT
// A dense heap that loses energy at its impacts, alone in space, with a heavy blade turning through it.
#include <support/build.hpp>
#include <support/overlap.hpp>
#include <support/random.hpp>
#include <support/run.hpp>
#include <support/scenes.hpp>
#include <support/traces.hpp>

#include <gtest/gtest.h>

namespace tamias2d::test {
namespace {

constexpr int kSide = 14;

Body addKind(World& world, int kind, Position at, const Options& options)
{
    if (kind % 3 == 0) return addDisc(world, at, 0.25, options);
    if (kind % 3 == 1) return addBox(world, at, 0.5, 0.5, options);
    return addCapsule(world, at, 0.4, 0.1, options);
}

// Bodies half a meter wide, a few rest gaps apart. From the left comes a heavy blade, but not so heavy that
// it and what it presses would be solved at once [ADR29]: that keeps momentum to 1e-9 only.
Body fill(World& world, double restitution, std::uint32_t seed)
{
    Random random(seed);
    Options options{.friction = 0.3, .restitution = restitution};
    for (int i = 0; i < kSide * kSide; ++i) {
        const double x = 0.5015 * (i % kSide) + random.between(0, 0.0003), y = 0.5015 * (i / kSide);
        addKind(world, i, {x, y}, options);
    }
    options.velocity = vec(16, 0);
    options.spin = 8;
    options.density = 1.9;
    return addBox(world, {-0.8, 0.25 * kSide}, 0.3, 0.5 * kSide, options);
}

// Where the bodies are, seen from the blade: along its width, and along its length.   [m]
std::vector<DVec2> seenFrom(World& world, const Body& blade)
{
    const double c = std::cos(blade.angle()), s = std::sin(blade.angle());
    std::vector<DVec2> places;
    for (const BodyId id : world.bodies()) {
        const DVec2 d = world.body(id).centerOfMass() - blade.centerOfMass();
        places.push_back({c * d.x + s * d.y, c * d.y - s * d.x});
    }
    return places;
}

// Those that have changed sides far from its ends, within one step.
int passedThrough(const std::vector<DVec2>& before, const std::vector<DVec2>& after)
{
    constexpr double kFar = 0.25 * kSide - 0.75;   // from the middle
    int passed = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        passed +=
            std::max(std::abs(before[i].y), std::abs(after[i].y)) < kFar && before[i].x * after[i].x < 0;
    return passed;
}

// What impacts take along the normal: on the way of an impulse the speed goes from v to -C_R v.   [J]
double lostInImpacts(const World& world)
{
    double lost = 0;
    for (const HitEvent& hit : world.events().hits)
        lost += static_cast<double>(hit.normalImpulse) * static_cast<double>(hit.approachSpeed) *
                (1 - static_cast<double>(hit.restitution)) / 2;
    return lost;
}

void expectLaws(double restitution, std::uint32_t seed)
{
    SCOPED_TRACE(testing::Message() << "C_R " << restitution << ", seed " << seed);
    World world(weightless());
    const Body blade = fill(world, restitution, seed);
    const Momentum start = world.momentum();
    const double linear = length(start.linear);
    const double angular = 0.25 * kSide * linear + static_cast<double>(blade.inertia()) * spinOf(blade);
    const double energy = world.energy().kinetic();
    double before = energy;
    double worstLinear = 0, worstAngular = 0, worstRise = 0, worstUnpaid = 0, mostEvents = 0, deepest = 0;
    int passed = 0;
    std::vector<DVec2> places = seenFrom(world, blade);
    const RunTotals totals = runSeconds(world, 1, 60, 4, [&] {
        const Momentum now = world.momentum();
        const double after = world.energy().kinetic();
        const double events = static_cast<double>(world.events().hits.size()) / (kSide * kSide);
        worstLinear = std::max(worstLinear, length(now.linear - start.linear) / linear);
        worstAngular = std::max(worstAngular, std::abs(now.angular - start.angular) / angular);
        worstRise = std::max(worstRise, (after - before) / energy);
        worstUnpaid = std::max(worstUnpaid, (lostInImpacts(world) - (before - after)) / energy);
        mostEvents = std::max(mostEvents, events);
        deepest = std::max(deepest, deepestOverlap(world));
        std::vector<DVec2> next = seenFrom(world, blade);
        passed += passedThrough(places, next);
        places.swap(next);
        before = after;
    });
    record("events", mostEvents);
    EXPECT_LE(worstLinear, byPrecision(1e-12, 1e-5));
    EXPECT_LE(worstAngular, byPrecision(1e-6, 1e-4));
    EXPECT_LE(worstRise, byPrecision(1e-6, 1e-5));
    EXPECT_LE(worstUnpaid, byPrecision(1e-6, 1e-5));
    // No more than three pairs a body touch in a plane; each is hit as a blow comes and as it comes back, at
    // no more than two points.
    EXPECT_LE(mostEvents, 3 * 2 * 2) << "a body";
    EXPECT_LE(deepest, 0.05) << "half the radius of the capsules";
    EXPECT_EQ(passed, 0);
    EXPECT_EQ(totals.clampedBodies + totals.faults, 0u);
    EXPECT_LT(world.energy().kinetic(), 0.95 * energy) << "it was to be stirred";
}

// Of each step: its impacts take no more energy than is gone.
TEST(StirredHeap, KeepsItsMomentumAndPaysForEveryImpact)
{
    TRACES("R8", "IM3", "T2", "GD1", "DD8", "DD10", "ADR21");
    for (const double restitution : {0.1, 0.3, 0.5, 0.8, 1.0})
        for (const std::uint32_t seed : {1u, 2u}) expectLaws(restitution, seed);
}

}  // namespace
}  // namespace tamias2d::test
