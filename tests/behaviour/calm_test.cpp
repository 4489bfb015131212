// SPDX-License-Identifier: MIT
// Stacks, pyramids and piles stand, keep their shape and come to rest, without sleeping. Bars are asserted;
// how far each scene is from its goal arrives in the report of the run.
#include <support/overlap.hpp>
#include <support/run.hpp>
#include <support/scenes.hpp>

namespace tamias2d::test {
namespace {

constexpr double kStands = 0.3;     // no center goes further sideways   [m]
constexpr double kAtRest = 1e-3;    // speed of the fastest body         [m/s]
constexpr double kEnergyRises = 3e-4;  // all rises together, of the drop

// Runs for a minute and returns the largest way any center ever was from its place, sideways [m].
double sidewaysInAMinute(World& world, const std::vector<Placed>& boxes)
{
    double furthest = 0;
    runSeconds(world, 60, 60, 4, [&] { furthest = std::max(furthest, furthestSideways(boxes)); });
    return furthest;
}

// The fastest body of the next second [m/s].
double fastestInASecond(World& world)
{
    double fastest = 0;
    runSeconds(world, 1, 60, 4, [&] { fastest = std::max(fastest, fastestBody(world)); });
    return fastest;
}

// Stacks `count` boxes, asserts that they stand for a minute and returns how far the top has sunk [m].
double standsAMinute(int count)
{
    World world;
    addGround(world);
    const std::vector<Placed> boxes = addStack(world, count);
    const double sideways = sidewaysInAMinute(world, boxes);
    EXPECT_LE(sideways, kStands);
    record("sideways_m", sideways);
    record("sunk_m", boxes.back().sunk());
    record("fastest_mps", fastestBody(world));
    return std::abs(boxes.back().sunk());
}

TEST(Calm, TenStackedBoxesStandForAMinute)
{
    TRACES("R8", "R5");
    const double sunk = standsAMinute(10);
    EXPECT_LE(sunk, 0.020);
    record("goal_sunk_m", 0.010);
}

TEST(Calm, TwentyStackedBoxesStandForAMinute)
{
    TRACES("R8", "R5");
    standsAMinute(20);
}

TEST(Calm, FiftyStackedBoxesStandForAMinute)
{
    TRACES("R8", "R5");
    const double sunk = standsAMinute(50);
    EXPECT_LE(sunk, 0.45);
    record("goal_sunk_m", 0.05);
}

TEST(Calm, AHundredStackedBoxesStandForAMinute)
{
    TRACES("R8", "R5", "ADR19");
    standsAMinute(100);
}

TEST(Calm, TwentyBoxesStackedCarelesslyStandForAMinute)
{
    TRACES("R8", "R5");
    for (const std::uint32_t seed : {100u, 101u, 102u, 103u}) {
        World world;
        addGround(world);
        const std::vector<Placed> boxes = addStack(world, 20, 0, 0.05, seed);
        const double sideways = sidewaysInAMinute(world, boxes);
        EXPECT_LE(sideways, kStands) << "seed " << seed;
        record("sideways_m_" + std::to_string(seed), sideways);
        record("fastest_mps_" + std::to_string(seed), fastestBody(world));
    }
}

TEST(Calm, APyramidOfFortyRowsComesToRestInItsShape)
{
    TRACES("R8", "R5", "ADR19");
    World world;
    addGround(world);
    const std::vector<Placed> boxes = addPyramid(world, 40);
    const RunTotals totals = runSeconds(world, 10);
    const double fastest = fastestInASecond(world), overlap = deepestOverlap(world),
                 drift = furthestSideways(boxes);
    EXPECT_LE(fastest, kAtRest);
    EXPECT_LE(overlap, 0.005);
    EXPECT_LE(drift, 0.070);
    record("fastest_mps", fastest);
    record("overlap_m", overlap);
    record("drift_m", drift);
    record("goal_drift_m", 0.010);
    record("sunk_m", boxes.back().sunk());
    record("deepestEver_m", totals.deepestOverlap);
}

// A new pyramid of a hundred rows, of which no contact carries anything yet, on a ground that goes at `lift`
// [m/s]: how fast its fastest body is against it in the next steps, a second later [m/s].
double fastestOfANewPyramid(double lift)
{
    World world;
    Body ground = world.createBody({.type = BodyType::Kinematic, .linearVelocity = vec(0, lift)});
    ground.createShape({.geometry = makeBox(400, 2), .offset = vec(0, -1)});
    std::vector<Placed> boxes = addPyramid(world, 100);
    for (Placed& box : boxes) box.body.setLinearVelocity(vec(0, lift));
    for (int i = 0; i < 60; ++i) world.step();
    double fastest = 0;
    for (int i = 0; i < 10; ++i) {
        world.step();
        for (const Placed& box : boxes)
            fastest =
                std::max(fastest, static_cast<double>(length(box.body.linearVelocity() - vec(0, lift))));
    }
    record("fastest_mps", fastest);
    return fastest;
}

TEST(Calm, ANewPyramidOfAHundredRowsFindsItsLoadsInASecond)
{
    TRACES("R8", "R5", "NFR1", "ADR19");
    EXPECT_LE(fastestOfANewPyramid(0), 0.02);
}

TEST(Calm, ANewPyramidOnALiftFindsItsLoadsAsFast)
{
    TRACES("R8", "R5", "ADR19");
    EXPECT_LE(fastestOfANewPyramid(2), 0.02);
}

TEST(Calm, APileOfAHundredBoxesComesToRest)
{
    TRACES("R8", "R5");
    World world;
    addBin(world, {});
    const std::vector<Body> boxes = addHail(world, 100, false, 5, {});
    const RunTotals totals = runSeconds(world, 20);
    const double fastest = fastestInASecond(world), overlap = deepestOverlap(world);
    EXPECT_LE(fastest, kAtRest);
    EXPECT_LE(overlap, 0.010);
    for (const Body& box : boxes) {
        EXPECT_GT(box.position().y, 0);
        EXPECT_LT(std::abs(box.position().x), 5);
    }
    record("fastest_mps", fastest);
    record("overlap_m", overlap);
    record("deepestEver_m", totals.deepestOverlap);
    record("energyRises_of_drop", totals.sumOfEnergyRises / (totals.highestEnergy - world.energy().total()));
}

// Lying capsules fall on each other end to end. Where they meet at the one end they rock about it: they must
// not sink into each other at the far one.
TEST(Calm, CapsulesThatFallEndToEndDoNotSinkIntoEachOther)
{
    TRACES("R8", "R5");
    World world;
    addBin(world, {});
    Random random(11);
    for (int row = 0; row < 25; ++row)
        for (int column = 0; column < 8; ++column)
            addCapsule(world, {-3.85 + 1.1 * column + random.between(-0.04, 0.04), 0.55 + 1.05 * row}, 1.0,
                       0.25);
    double deepest = 0;
    for (int i = 0; i < 240; ++i) {
        world.step();
        if (i % 4 == 3) deepest = std::max(deepest, deepestOverlap(world));
    }
    EXPECT_LE(deepest, 0.015);
    record("deepest_m", deepest);
}

// Boxes and discs fall into the bin; they may only lose energy.
void expectNoEnergyFromNowhere(double restitution)
{
    double worst = 0;
    for (const std::uint32_t seed : {5u, 6u, 7u}) {
        World world;
        const Options surface{.restitution = restitution};
        addBin(world, surface);
        const std::vector<Body> bodies = addHail(world, 100, true, seed, surface);
        const double before = world.energy().total();
        const RunTotals totals = runSeconds(world, 20);
        const double drop = before - world.energy().total();
        const double rises = totals.sumOfEnergyRises / drop;
        EXPECT_LE(rises, kEnergyRises) << "seed " << seed << ": " << totals.sumOfEnergyRises << " J of "
                                       << drop << " J, highest in one step " << totals.highestEnergyRise;
        for (const Body& body : bodies) {
            EXPECT_GT(body.position().y, 0);
            EXPECT_LT(std::abs(body.position().x), 5);
        }
        worst = std::max(worst, rises);
        record("fastest_mps_" + std::to_string(seed), fastestBody(world));
        record("deepestEver_m_" + std::to_string(seed), totals.deepestOverlap);
    }
    record("worstRises_of_drop", worst);
}

TEST(Calm, APlasticPileGainsNoEnergy)
{
    TRACES("R8", "DD15", "DD16", "ADR18");
    expectNoEnergyFromNowhere(0);
}

TEST(Calm, AHalfElasticPileGainsNoEnergy)
{
    TRACES("R8", "DD15", "DD16", "ADR18");
    expectNoEnergyFromNowhere(0.5);
}

TEST(Calm, ABouncyPileGainsNoEnergy)
{
    TRACES("R8", "DD15", "DD16", "ADR18");
    expectNoEnergyFromNowhere(0.9);
}

// A row that stops stops the next, and so on up. As one impact after another that takes ten times as many of
// them as there are contacts.
TEST(Calm, ACrowdThatSetsDownIsStoppedByFewImpacts)
{
    TRACES("R8", "NFR1", "ADR21");
    World world;
    addGround(world);
    const std::vector<Placed> boxes = addPyramid(world, 20);
    for (const Placed& box : boxes) {
        Body body = box.body;
        body.setTransform(body.position() + DVec2{0, 0.005}, 0);
        body.setLinearVelocity(vec(0, -0.5));
    }
    const double before = world.energy().total();
    std::uint32_t impacts = 0;
    for (int i = 0; i < 60; ++i) {
        const StepReport report = world.step();
        impacts += report.impacts;
        EXPECT_EQ(report.deepestOverlap, 0) << "step " << i;
    }
    EXPECT_LT(impacts, world.contacts().size() / 10);
    EXPECT_LT(world.energy().total(), before);
    EXPECT_LE(fastestInASecond(world), kAtRest);
    record("impacts", impacts);
}

// What meets alone is stopped at its time, to the last digit, however slowly.
TEST(Calm, ABodyAloneIsStoppedByAnImpact)
{
    TRACES("R8", "DD8", "ADR21");
    World world;
    addGround(world);
    const Body body = addBox(world, {0, 0.5 + restGapFor(world, 1) + 0.001}, 1, 1);
    std::uint32_t impacts = 0;
    for (int i = 0; i < 10; ++i) impacts += world.step().impacts;
    EXPECT_GE(impacts, 1u);
    EXPECT_LE(std::abs(velocityOf(body).y), 1e-6);
}

}  // namespace
}  // namespace tamias2d::test
