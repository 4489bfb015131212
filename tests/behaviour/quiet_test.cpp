// SPDX-License-Identifier: MIT
// Bodies at rest make a step in one tick: that changes nothing that can be seen, and holds nothing back.
#include <support/build.hpp>
#include <support/closed_form.hpp>
#include <support/scenes.hpp>
#include <support/traces.hpp>

#include <gtest/gtest.h>

namespace tamias2d::test {
namespace {

WorldDef awake(bool quiet = true)
{
    WorldDef def;
    def.allowSleep = false;
    if (!quiet) def.tuning.quiet = 0;
    return def;
}

double furthestApart(const std::vector<Placed>& a, const std::vector<Placed>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, length(a[i].body.centerOfMass() - b[i].body.centerOfMass()));
    return most;
}

}  // namespace

TEST(Quiet, StacksAndPyramidsStandWhereTheyStandWithoutIt)
{
    TRACES("T2", "R3", "NFR1", "ADR31");
    World world(awake()), other(awake(false));
    std::vector<Placed> boxes, others;
    for (auto [each, into] : {std::pair{&world, &boxes}, std::pair{&other, &others}}) {
        addGround(*each, 0, 400);
        *into = addPyramid(*each, 10);
        for (const Placed& box : addStack(*each, 12, 30)) into->push_back(box);
        for (const Placed& box : addStack(*each, 5, 40, 0.05, 3)) into->push_back(box);
    }
    std::uint32_t quiet = 0;
    double fastest = 0;
    for (int i = 0; i < 1200; ++i) {
        quiet = std::max(quiet, world.step().quiet);
        EXPECT_EQ(other.step().quiet, 0u);
        if (i < 600) continue;
        for (const Placed& box : boxes)
            fastest = std::max(fastest, static_cast<double>(length(box.body.linearVelocity())));
    }
    record("bodies quiet at once, at most", quiet);
    record("apart", furthestApart(boxes, others));
    record("fastest", fastest);
    EXPECT_EQ(quiet, boxes.size());
    EXPECT_LE(furthestApart(boxes, others), 2e-4);
    EXPECT_LE(fastest, 1e-3);
}

// What a contact says of a step is what it does in all ticks of it.
TEST(Quiet, GroundsBearTheWholeWeight)
{
    TRACES("R1", "DD8", "ADR31");
    World world(awake());
    Body ground = addGround(world);
    addStack(world, 4);
    StepReport report;
    for (int i = 0; i < 300; ++i) report = world.step();
    ASSERT_EQ(report.quiet, 4u);
    const double weight = 4 * 9.81;
    double borne = 0;
    for (const ContactView& contact : ground.contacts())
        borne += std::abs(static_cast<double>(contact.impulse.y)) * 60;
    EXPECT_NEAR(borne, weight, 1e-4 * weight);
}

// Forces that hardly move a body move it as they should.
TEST(Quiet, NoForceIsTooWeakToMoveABody)
{
    TRACES("R1", "DD3", "ADR31");
    for (const double acceleration : {1e-4, 1e-3, 1e-2, 0.1}) {
        World world(awake());
        addGround(world, 0, 400);
        Body box = addBox(world, {0, 0.501}, 1, 1, {.friction = 0});
        StepReport report;
        for (int i = 0; i < 200; ++i) report = world.step();
        ASSERT_EQ(report.quiet, 1u);
        const double start = box.centerOfMass().x;
        const Vec2 force = vec(acceleration * static_cast<double>(box.mass()), 0);
        for (int i = 0; i < 600; ++i) {
            box.applyForceToCenter(force);
            world.step();
        }
        const double way = box.centerOfMass().x - start, expected = acceleration * 100 / 2;
        record("way, of what it should be", way / expected);
        EXPECT_NEAR(way, expected, 2e-3 * expected) << acceleration << " m/s^2";
    }
}

// A disc that nothing was expected to bring there, thrown up by a wall in mid-step, hits the lower of two
// boxes at rest: they go as they do where none is quiet, and not a step later.
TEST(Quiet, ABlowInMidStepIsFeltAtOnce)
{
    TRACES("R3", "T1", "GD1", "ADR31");
    for (const double gravity : {0.0, -9.81}) {
        BodyState after[2][3];
        for (const bool quiet : {false, true}) {
            WorldDef def = awake(quiet);
            def.gravity = vec(0, gravity);
            World world(def);
            const Options smooth{.friction = 0, .restitution = 1}, rough{.restitution = 1};
            Options fixed{.type = BodyType::Static, .restitution = 1};
            addBox(world, {-0.45, 3.45}, 0.1, 0.1, fixed);  // two ledges
            addBox(world, {0.45, 3.45}, 0.1, 0.1, fixed);
            fixed.angle = -kPi / 4;
            fixed.friction = 0;
            addBox(world, {0.8, 0}, 1, 40, fixed);
            Body lower = addBox(world, {0, 4.001}, 1, 1, rough), upper = addBox(world, {0, 5.002}, 1, 1);
            for (int i = 0; i < 200; ++i) world.step();
            EXPECT_EQ(world.lastReport().quiet, quiet ? 2u : 0u);
            Body disc = addDisc(world, {-3, 0}, 0.2, smooth);
            disc.setLinearVelocity(vec(600, 0));
            const StepReport report = world.step();
            EXPECT_GE(report.repaired, 1u);
            const std::vector<BodyId> ids{lower.id(), upper.id(), disc.id()};
            world.readStates(ids, after[quiet ? 1 : 0]);
        }
        for (int i = 0; i < 3; ++i) {
            const BodyState &with = after[1][i], &without = after[0][i];
            EXPECT_LE(length(with.position - without.position), 1e-4)
                << "body " << i << ", gravity " << gravity;
            EXPECT_LE(static_cast<double>(length(with.linearVelocity - without.linearVelocity)), 0.03)
                << "body " << i << ", gravity " << gravity;
        }
        EXPECT_GT(static_cast<double>(after[1][1].linearVelocity.y), 10) << "the upper one";
    }
}

}  // namespace tamias2d::test
