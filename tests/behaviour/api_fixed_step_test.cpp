// SPDX-License-Identifier: MIT
// FixedStepper: results that do not depend on the frame rate, long frames cut, poses between the steps.
#include "support/build.hpp"
#include "support/random.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <array>

namespace tamias2d {
namespace {

using namespace test;

void buildPlayground(World& world)
{
    addWalls(world, {-6, 0}, {6, 12}, {.restitution = 0.5});
    for (int i = 0; i < 12; ++i) {
        addBox(world, {-4.0 + 0.7 * i, 2.0 + 0.5 * (i % 5)}, 0.6, 0.6, {.spin = 1.0 * i, .restitution = 0.3});
        addDisc(world, {-4.0 + 0.7 * i, 7.0 + 0.3 * (i % 3)}, 0.3,
                {.velocity = vec(i - 6, 1), .restitution = 0.8});
    }
}

TEST(FixedStepper, GivesTheSameBitsAtEveryFrameRate)
{
    TRACES("R5", "R6", "ADR6");
    const int seconds = 5;
    World reference;
    buildPlayground(reference);
    for (int i = 0; i < seconds * 60; ++i) reference.step(1.0 / 60, 4);
    for (const double rate : {24.0, 30.0, 60.0, 75.0, 120.0, 144.0, 240.0}) {
        World world;
        buildPlayground(world);
        FixedStepper stepper;
        int steps = 0;
        for (int frame = 0; frame < seconds * rate; ++frame) steps += stepper.advance(world, 1 / rate);
        EXPECT_EQ(steps, seconds * 60) << rate << " frames a second";
        EXPECT_EQ(world.stepCount(), static_cast<std::uint64_t>(seconds * 60)) << rate << " frames a second";
        EXPECT_EQ(world.stateHash(), reference.stateHash()) << rate << " frames a second";
    }
}

TEST(FixedStepper, GivesTheSameBitsWithUnevenFrames)
{
    TRACES("R5", "ADR6");
    World even, uneven;
    buildPlayground(even);
    buildPlayground(uneven);
    FixedStepper a, b;
    Random random(1);
    double time = 0;
    while (uneven.stepCount() < 300) {
        const double frame = random.between(0, 0.05);
        time += frame;
        b.advance(uneven, frame);
        EXPECT_GE(b.alpha(), 0.0);
        EXPECT_LT(b.alpha(), 1.0);
        EXPECT_NEAR(static_cast<double>(uneven.stepCount()) + b.alpha(), time * 60, 1e-6);
    }
    while (even.stepCount() < uneven.stepCount()) a.advance(even, 1.0 / 60);
    EXPECT_EQ(even.stateHash(), uneven.stateHash());
}

TEST(FixedStepper, LosesNoTimeOverAnHourOfFrames)
{
    TRACES("R5");
    World world(weightless());
    for (const double rate : {59.94, 144.0}) {
        FixedStepper stepper(1.0 / 60, 1);
        const int frames = static_cast<int>(3600 * rate);
        long long steps = 0;
        for (int i = 0; i < frames; ++i) steps += stepper.advance(world, 1 / rate);
        EXPECT_NEAR(static_cast<double>(steps) + stepper.alpha(), frames / rate * 60, 1e-6) << rate;
    }
}

TEST(FixedStepper, CutsFramesThatAreTooLong)
{
    TRACES("R5");
    World world;
    FixedStepper stepper(0.01, 1, 0.1);
    EXPECT_EQ(stepper.step(), 0.01);
    EXPECT_EQ(stepper.advance(world, 5), 10) << "a breakpoint of 5 s is 0.1 s for the world";
    EXPECT_NEAR(stepper.dropped(), 4.9, 1e-12);
    EXPECT_EQ(stepper.advance(world, 0.02), 2);
    EXPECT_NEAR(stepper.dropped(), 4.9, 1e-12);
    EXPECT_EQ(stepper.advance(world, 0), 0);
    EXPECT_NEAR(world.time(), 0.12, 1e-12);
}

TEST(FixedStepper, MakesTheStepsItWasToldTo)
{
    TRACES("R5");
    World world(withGravity(0, -10));
    Body ball = addDisc(world, {0, 100}, 0.5);
    FixedStepper stepper(0.02, 2);
    EXPECT_EQ(stepper.advance(world, 0.05), 2);
    EXPECT_EQ(world.lastReport().substeps, 2);
    EXPECT_NEAR(stepper.alpha(), 0.5, 1e-9);
    EXPECT_NEAR(ball.linearVelocity().y, -0.4, 1e-6);
}

TEST(Interpolation, GoesEvenlyFromThePoseBeforeToThePoseAfter)
{
    TRACES("R5", "R6");
    World world(weightless());
    Body disc = addDisc(world, {0, 0}, 0.5, {.velocity = vec(6, -3), .spin = 12, .angle = 6.2});
    world.step(1.0 / 60);
    for (const double alpha : {0.0, 0.25, 0.5, 1.0}) {
        const Transform t = disc.interpolated(alpha);
        EXPECT_NEAR(t.position.x, 0.1 * alpha, 1e-6);
        EXPECT_NEAR(t.position.y, -0.05 * alpha, 1e-6);
        // 0.2 rad a step, through 2 pi: the short way round, and back into [0, 2 pi).
        EXPECT_NEAR(angleDifference(t.angle, 6.2 + 0.2 * alpha), 0, 1e-6);
        EXPECT_GE(t.angle, 0.0);
        EXPECT_LT(t.angle, kTwoPi);
        EXPECT_NEAR(t.rotation.c, std::cos(t.angle), 1e-6);
        EXPECT_NEAR(t.rotation.s, std::sin(t.angle), 1e-6);
    }
    EXPECT_EQ(disc.interpolated(1).position, disc.position());
}

TEST(Interpolation, IsSmoothAtAnyFrameRate)
{
    TRACES("R5");
    World world(weightless());
    Body disc = addDisc(world, {0, 0}, 0.5, {.velocity = vec(6, 0)});
    FixedStepper stepper;
    double before = 0;
    for (int frame = 0; frame < 144; ++frame) {
        stepper.advance(world, 1.0 / 144);
        const double x = disc.interpolated(stepper.alpha()).position.x;
        if (frame > 5) {
            EXPECT_NEAR(x - before, 6.0 / 144, 1e-5) << "frame " << frame;
        }
        before = x;
    }
}

TEST(Interpolation, DoesNotSmearATeleport)
{
    TRACES("R5");
    World world(weightless());
    Body disc = addDisc(world, {0, 0}, 0.5, {.velocity = vec(6, 0)});
    Body other = addDisc(world, {0, 5}, 0.5, {.velocity = vec(6, 0)});
    world.step(1.0 / 60);
    disc.setTransform({500, 0}, 1);
    EXPECT_EQ(disc.interpolated(0).position, (Position{500, 0}));
    world.step(1.0 / 60);
    EXPECT_NEAR(disc.interpolated(0).position.x, 500, 1e-9) << "from where it was put";
    EXPECT_NEAR(disc.interpolated(1).position.x, 500.1, 1e-5);
    EXPECT_NEAR(other.interpolated(0.5).position.x, 0.15, 1e-6);
}

TEST(Interpolation, OfABodyJustMadeIsItsPose)
{
    TRACES("R5");
    World world;
    Body body = addBox(world, {3, 4}, 1, 1, {.angle = 0.5});
    for (const double alpha : {0.0, 0.3, 1.0}) {
        EXPECT_EQ(body.interpolated(alpha).position, (Position{3, 4}));
        EXPECT_EQ(body.interpolated(alpha).angle, 0.5);
    }
    Body state = addBox(world, {0, 0}, 1, 1);
    world.step();
    const std::array<BodyId, 1> ids = {state.id()};
    const std::array<BodyState, 1> states = {BodyState{{70, 70}, 0, {}, 0}};
    world.writeStates(ids, states);
    EXPECT_EQ(state.interpolated(0.5).position, (Position{70, 70})) << "writing a state is a teleport, too";
}

}  // namespace
}  // namespace tamias2d
