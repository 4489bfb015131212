// SPDX-License-Identifier: MIT
// Bodies that nothing touches, against closed forms.
#include <support/build.hpp>
#include <support/closed_form.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

// What holds after ten seconds, relative to how far or fast the body went.

TEST(FreeFlight, KeepsItsVelocityAndItsLine)
{
    TRACES("R5", "R6", "IM1", "IM2", "DD2", "DD3", "DD5", "DD6", "A2", "A3");
    World world(weightless());
    const Body body = addBox(world, {1, -2}, 1, 0.5, {.velocity = vec(3, -4), .spin = 2.5, .angle = 0.5});
    const RunTotals totals = runSeconds(world, kTenSeconds);

    EXPECT_LE(relativeError(velocityOf(body), DVec2{3, -4}), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(centerOf(body), DVec2{31, -42}), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(spinOf(body), 2.5), kExactAfterTenSeconds);
    EXPECT_LE(std::abs(angleDifference(body.angle(), 25.5)), kExactAfterTenSeconds * 25.5);
    EXPECT_EQ(totals.clampedBodies, 0u);
    EXPECT_NEAR(world.time(), kTenSeconds, 1e-12 * kTenSeconds);
}

TEST(FreeFlight, FollowsTheParabolaOfAProjectile)
{
    TRACES("R5", "IM1", "GD2", "DD4", "A4");
    for (const int substeps : {1, 2, 4, 8}) {
        World world;
        const Body body = addDisc(world, {0, 100}, 0.5, {.velocity = vec(12, 30)});
        runSeconds(world, kTenSeconds, 60, substeps);

        const double g = static_cast<double>(world.definition().gravity.y);
        EXPECT_LE(relativeError(velocityOf(body), DVec2{12, 30 + g * kTenSeconds}), kExactAfterTenSeconds)
            << substeps;
        const DVec2 expected{12 * kTenSeconds, 100 + 30 * kTenSeconds + g * kTenSeconds * kTenSeconds / 2};
        EXPECT_LE(relativeError(centerOf(body), expected), kExactAfterTenSeconds) << substeps;
    }
}

TEST(FreeFlight, ANewWorldPullsDownwardsAsOnEarth)
{
    TRACES("GD2", "A3", "A4");
    World world;
    EXPECT_EQ(world.definition().gravity, vec(0, -9.81));
    const Body body = addDisc(world, {0, 0}, 0.5);
    runSeconds(world, 1);
    EXPECT_LE(relativeError(body.position().y, -9.81 / 2), byPrecision(1e-12, 1e-5));
}

TEST(FreeFlight, AConstantTorqueSpinsUpEvenly)
{
    TRACES("R6", "IM2", "T4", "DD7", "DD13");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 2, 1, {.spin = -1, .angle = 1});
    body.addForce({.torque = toReal(0.75)});
    runSeconds(world, kTenSeconds);

    const double inertia = 2 * (4 + 1) / 12.0;  // m (w^2 + h^2) / 12 of a plate of 2 kg
    const double alpha = 0.75 / inertia;
    EXPECT_LE(relativeError(static_cast<double>(body.inertia()), inertia), byPrecision(1e-14, 1e-6));
    EXPECT_LE(relativeError(spinOf(body), -1 + alpha * kTenSeconds), kExactAfterTenSeconds);
    const double turned = 1 - kTenSeconds + alpha * kTenSeconds * kTenSeconds / 2;
    EXPECT_LE(std::abs(angleDifference(body.angle(), turned)), kExactAfterTenSeconds * turned);
    EXPECT_LE(length(velocityOf(body)), kExactAfterTenSeconds);
    EXPECT_LE(length(centerOf(body)), kExactAfterTenSeconds);
}

TEST(FreeFlight, DampingFadesExponentially)
{
    TRACES("R5", "R6", "LC2");
    World world(weightless());
    Body body = addDisc(world, {0, 0}, 0.5, {.velocity = vec(20, -10), .spin = 8});
    body.setLinearDamping(toReal(0.25));
    body.setAngularDamping(toReal(0.5));
    runSeconds(world, kTenSeconds);

    EXPECT_LE(relativeError(velocityOf(body), std::exp(-2.5) * DVec2{20, -10}), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(spinOf(body), 8 * std::exp(-5.0)), kExactAfterTenSeconds);
}

TEST(FreeFlight, ADampedBodyGetsAsFarAsTheClosedFormSays)
{
    TRACES("R5", "R6", "LC2");
    World world(weightless());
    Body body = addDisc(world, {0, 0}, 0.5, {.velocity = vec(20, -10), .spin = 8});
    body.setLinearDamping(toReal(0.25));
    body.setAngularDamping(toReal(0.5));
    runSeconds(world, kTenSeconds);

    const double distance = (1 - std::exp(-2.5)) / 0.25;
    EXPECT_LE(relativeError(centerOf(body), distance * DVec2{20, -10}), kExactAfterTenSeconds);
    const double turned = 8 * (1 - std::exp(-5.0)) / 0.5;
    EXPECT_LE(std::abs(angleDifference(body.angle(), turned)), kExactAfterTenSeconds * turned);
}

TEST(FreeFlight, ADampedFallSettlesAtItsTerminalSpeed)
{
    TRACES("R5", "IM1", "LC2");
    const double c = 0.5, g = 10;
    double error[2] = {};
    for (const int halved : {0, 1}) {
        World world(withGravity(0, -g));
        Body body = addDisc(world, {0, 0}, 0.5);
        body.setLinearDamping(toReal(c));
        runSeconds(world, kTenSeconds, 60, halved ? 8 : 4);
        const double fallen = -g / c * (kTenSeconds - (1 - std::exp(-c * kTenSeconds)) / c);
        EXPECT_LE(relativeError(velocityOf(body).y, -g / c * (1 - std::exp(-c * kTenSeconds))), 1e-4);
        EXPECT_LE(relativeError(body.position().y, fallen), 1e-4);
        error[halved] = std::abs(body.position().y - fallen);
    }
    if (kDouble && error[0] > 1e-10) {
        EXPECT_GT(orderOf(error[0], error[1]), 1.9);
    }
}

TEST(FreeSpin, IsExactAfterAnHour)
{
    TRACES("R6", "IM2", "DD5");
    World world(weightless());
    const double spin = 7.3;
    const Body body = addBox(world, {0, 0}, 2, 1, {.spin = spin});
    const double kept = spinOf(body);  // the float nearest to it, in the float build
    const RunTotals totals = runSeconds(world, 3600);

    EXPECT_EQ(spinOf(body), kept);
    EXPECT_LE(std::abs(angleDifference(body.angle(), kept * 3600)), byPrecision(1e-6, 1e-2));
    EXPECT_EQ(totals.clampedBodies, 0u);
}

TEST(FreeSpin, TheAngleStaysInOneTurn)
{
    TRACES("R6", "DD5");
    World world(weightless());
    for (const double spin : {1.0, -1.0, 100.0, -100.0}) {
        addBox(world, {spin * 10, 0}, 2, 1, {.spin = spin, .angle = spin});
    }
    runSeconds(world, 20, 60, 4, [&] {
        for (const BodyId id : world.bodies()) {
            EXPECT_GE(world.body(id).angle(), 0);
            EXPECT_LT(world.body(id).angle(), kTwoPi);
        }
    });
}

TEST(Bounds, FastBodiesAreNotSlowedDown)
{
    TRACES("R5", "R6");
    World world(weightless());
    const Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(9e5, 0), .spin = 9e5});
    const RunTotals totals = runSeconds(world, kTenSeconds);

    EXPECT_LE(relativeError(velocityOf(body).x, 9e5), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(spinOf(body), 9e5), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(body.position().x, 9e6), kExactAfterTenSeconds);
    EXPECT_EQ(totals.clampedBodies, 0u);
}

TEST(Bounds, ACapIsNeverSilent)
{
    TRACES("R4", "R5");
    World world(weightless());
    Body pushed = addBox(world, {0, 0}, 1, 1, {.velocity = vec(9.99e5, 0)});
    Body turned = addBox(world, {0, 10}, 1, 1, {.spin = 9.99e5});
    pushed.addForce({.force = vec(1e6, 0)});
    turned.addForce({.torque = toReal(1e6)});
    const RunTotals totals = runSeconds(world, 1);

    EXPECT_GT(totals.clampedBodies, 0u);
    EXPECT_LE(velocityOf(pushed).x, kMaxSpeed);
    EXPECT_LE(spinOf(turned), kMaxSpin);
    EXPECT_EQ(totals.faults, 0u);
}

TEST(Bounds, ABodyStopsCountedAtTheEdgeOfTheWorld)
{
    TRACES("R4", "R5");
    World world(weightless());
    const Body body = addDisc(world, {kMaxPosition - 100, 0}, 0.5, {.velocity = vec(1000, 0)});
    const RunTotals totals = runSeconds(world, 1);

    EXPECT_GT(totals.clampedBodies, 0u);
    EXPECT_LE(body.position().x, kMaxPosition);
}

TEST(FreeMotion, DoesNotDependOnHowFarOutItIs)
{
    TRACES("R5", "IM1");
    World world;
    const Body near = addDisc(world, {0, 0}, 0.5, {.velocity = vec(3, 4)});
    const Body far = addDisc(world, {1e6, -1e6}, 0.5, {.velocity = vec(3, 4)});
    runSeconds(world, kTenSeconds);

    const DVec2 apart = far.position() - near.position();
    EXPECT_LE(length(apart - DVec2{1e6, -1e6}), 1e-6);  // the last digit of a double out there is 1e-10 m
    EXPECT_EQ(near.linearVelocity(), far.linearVelocity());
}

TEST(FreeMotion, BodiesThatDoNotTouchDoNotFeelEachOther)
{
    TRACES("R5", "A7");
    World alone, crowd;
    const Options options{.velocity = vec(2, 3), .spin = 1.5};
    const Body single = addBox(alone, {0, 0}, 1, 1, options);
    const Body one = addBox(crowd, {0, 0}, 1, 1, options);
    for (int i = 1; i < 10; ++i) addBox(crowd, {1.5 * i, 0}, 1, 1, options);  // they fly in formation
    runSeconds(alone, kTenSeconds);
    runSeconds(crowd, kTenSeconds);
    EXPECT_EQ(one.position(), single.position());
    EXPECT_EQ(one.angle(), single.angle());
    EXPECT_EQ(one.linearVelocity(), single.linearVelocity());
}

TEST(FreeMotion, OneWorldDoesNotDisturbAnother)
{
    TRACES("R1");
    World first, second(withGravity(1, 0));
    const Body falling = addDisc(first, {0, 0}, 0.5);
    const Body resting = addDisc(second, {0, 0}, 0.5);
    runSeconds(first, 1);
    EXPECT_EQ(resting.position(), (Position{0, 0}));
    EXPECT_EQ(resting.linearVelocity(), Vec2{});
    runSeconds(second, 1);
    EXPECT_LE(relativeError(resting.position().x, 0.5), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(falling.position().y, -9.81 / 2), byPrecision(1e-12, 1e-5));
}

// Forty bodies far from each other, each on its own way. With companions each has another one beside it that
// goes the same way, near enough for their swept boxes to meet.
std::vector<Body> flock(World& world, bool companions)
{
    std::vector<Body> bodies;
    const auto add = [&](int i, double aside) {
        const DVec2 way{3.0 + 0.7 * i, 20 - 0.9 * i};
        const DVec2 beside = (aside / length(way)) * DVec2{-way.y, way.x};
        return addBox(world, Position{100.0 * i, 0} + beside, 0.6, 0.4,
                      {.velocity = vec(way.x, way.y), .spin = 0.3 * i - 5, .angle = 0.1 * i});
    };
    for (int i = 0; i < 40; ++i) bodies.push_back(add(i, 0));
    for (int i = 0; companions && i < 40; ++i) add(i, 0.75);
    return bodies;
}

TEST(FreeFlight, HasTheSameBitsAloneAndBesideAnother)
{
    TRACES("R5", "R6", "IM1");
    World lonely, shared;
    const std::vector<Body> alone = flock(lonely, false), beside = flock(shared, true);
    const RunTotals totals = runSeconds(shared, 2);
    runSeconds(lonely, 2);
    EXPECT_EQ(totals.impacts, 0u);
    EXPECT_GE(shared.lastReport().pairs, 20u) << "they are pairs";
    EXPECT_EQ(lonely.lastReport().pairs, 0u);
    for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_EQ(alone[i].position(), beside[i].position()) << i;
        EXPECT_EQ(alone[i].angle(), beside[i].angle()) << i;
        EXPECT_EQ(alone[i].linearVelocity(), beside[i].linearVelocity()) << i;
        EXPECT_EQ(alone[i].angularVelocity(), beside[i].angularVelocity()) << i;
    }
}

// A cue throws a ball at another that nothing was expected to come near in the step, in the midst of it.
// `noticed`: a companion flies beside that one, so that it has a pair from the start.
std::vector<Body> carom(World& world, bool noticed)
{
    Options options{.friction = 0, .restitution = 1};
    const auto ball = [&](Position at, DVec2 velocity) {
        options.velocity = vec(velocity.x, velocity.y);
        return addDisc(world, at, 0.5, options);
    };
    std::vector<Body> balls{ball({-5, 0}, {600, 0}), ball({0, 0.6}, {0, 0})};
    const auto others = [&](int count) {
        for (int i = 0; i < count; ++i)
            ball({1000.0 + 10 * static_cast<double>(world.bodyCount()), 0}, {0, 0});
    };
    others(20);
    balls.push_back(ball({1.8, 2.25}, {20, -15}));
    others(30);
    if (noticed) ball({2.8, 1.5}, {20, -15});
    return balls;
}

TEST(FreeFlight, EndsAtTheRightPlaceForWhoIsThrownAtABodyInMidStep)
{
    TRACES("R5", "R7", "R8", "GD1");
    World unaware(weightless()), aware(weightless());
    const std::vector<Body> balls = carom(unaware, false), same = carom(aware, true);
    unaware.step(1.0 / 60);
    aware.step(1.0 / 60);
    EXPECT_GT(length(velocityOf(balls[2]) - DVec2{20, -15}), 100) << "it was hit in the first step";
    for (std::size_t i = 0; i < balls.size(); ++i) {
        EXPECT_EQ(balls[i].position(), same[i].position()) << i;
        EXPECT_EQ(balls[i].linearVelocity(), same[i].linearVelocity()) << i;
    }
    DVec2 momentum;
    for (const Body& body : balls) momentum += velocityOf(body);
    EXPECT_LE(relativeError(momentum, DVec2{620, -15}), byPrecision(1e-12, 1e-5));
}

}  // namespace
}  // namespace tamias2d::test
