// SPDX-License-Identifier: MIT
// A gas of discs and boxes in a closed room: elastic, so it must never cool, warm up or leak.
#include <support/build.hpp>
#include <support/overlap.hpp>
#include <support/probe.hpp>
#include <support/random.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

constexpr double kRoom = 20;        // side of the room                   [m]
constexpr double kDiscRadius = 0.25;
constexpr double kBoxSide = 0.5;
constexpr double kKept = byPrecision(1e-9, 2e-3);  // of the kinetic energy
constexpr double kDepth = 0.02;                    // overlap of the size

// Discs and boxes on a grid, with random velocities and spins.
void fill(World& world, int discs, int boxes, double friction, std::uint32_t seed)
{
    Random random(seed);
    const Options walls{.friction = friction, .restitution = 1};
    addWalls(world, {0, 0}, {kRoom, kRoom}, walls);
    const int count = discs + boxes, columns = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; ++i) {
        const Position at{(i % columns + 0.5) * kRoom / columns, (i / columns + 0.5) * kRoom / columns};
        const double vx = random.between(-5, 5), vy = random.between(-5, 5);
        Options options{.velocity = vec(vx, vy), .friction = friction, .restitution = 1};
        options.spin = random.between(-3, 3);
        options.angle = random.between(0, kTwoPi);
        const bool disc = i * discs / count != (i + 1) * discs / count;  // the kinds take turns
        if (disc)
            addDisc(world, at, kDiscRadius, options);
        else
            addBox(world, at, kBoxSide, kBoxSide, options);
    }
}

int outside(World& world)
{
    int count = 0;
    for (const BodyId id : world.bodies()) {
        const Body body = world.body(id);
        const Position p = body.position();
        const bool inside = p.x > 0 && p.x < kRoom && p.y > 0 && p.y < kRoom;
        if (body.type() == BodyType::Dynamic && !inside) ++count;
    }
    return count;
}

void expectSteadyGas(int discs, int boxes, double seconds, double rate, int substeps)
{
    World world(weightless());
    fill(world, discs, boxes, 0, 7);
    SubstepProbe probe(world);
    const double start = world.energy().kinetic();
    double worst = 0;
    int lost = 0;
    const RunTotals totals = runSeconds(world, seconds, rate, substeps, [&] {
        worst = std::max(worst, relativeError(world.energy().kinetic(), start));
        lost = std::max(lost, outside(world));
    });
    EXPECT_LE(worst, kKept);
    EXPECT_EQ(lost, 0);
    EXPECT_LE(probe.deepestOfSize(), kDepth) << probe.deepest() << " m";
    EXPECT_LE(totals.deepestOverlap, kDepth * kBoxSide);
    EXPECT_LE(deepestOverlap(world), kDepth * kBoxSide);
    EXPECT_GE(probe.looks(), static_cast<std::uint64_t>(totals.steps * substeps - 1));
    EXPECT_GT(totals.impacts, static_cast<std::uint64_t>(20 * seconds));
    EXPECT_EQ(totals.clampedBodies + totals.faults, 0u);
    testing::Test::RecordProperty("energyError", std::to_string(worst));
    testing::Test::RecordProperty("deepestOverlap", std::to_string(probe.deepest()));
    testing::Test::RecordProperty("impacts", std::to_string(totals.impacts));
}

TEST(Gas, OfDiscsAndBoxesStaysWarmForTenMinutes)
{
    TRACES("R7", "R8", "IM3", "GD1", "DD12", "DD15", "A1", "A6", "ADR7");
    expectSteadyGas(100, 50, 600, 60, 4);
}

TEST(Gas, StaysWarmAtOtherRatesAndSubsteps)
{
    TRACES("R8", "IM3", "DD12", "DD15");
    expectSteadyGas(100, 50, 30, 60, 1);
    expectSteadyGas(100, 50, 30, 60, 8);
    expectSteadyGas(100, 50, 30, 30, 4);
    expectSteadyGas(100, 50, 30, 240, 2);
}

TEST(Gas, WithFrictionNeverWarmsUp)
{
    TRACES("R8", "LC2", "DD15", "ADR16");
    World world(weightless());
    fill(world, 50, 100, 0.5, 11);
    const double start = world.energy().kinetic();
    const RunTotals totals = runSeconds(world, 60);
    // Friction turns speed into heat and spin into speed; from the slip before the blow it would add 24 %.
    EXPECT_LE(totals.highestEnergyRise, byPrecision(1e-9, 1e-5) * start);
    EXPECT_LE(totals.highestEnergy, start * (1 + byPrecision(1e-9, 2e-3)));
    EXPECT_LT(world.energy().kinetic(), 0.9 * start);
    EXPECT_EQ(outside(world), 0);
    EXPECT_GT(totals.impacts, 2000u);
}

}  // namespace
}  // namespace tamias2d::test
