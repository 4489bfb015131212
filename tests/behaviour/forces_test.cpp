// SPDX-License-Identifier: MIT
// Forces, torques and impulses, for a step or lasting, against closed forms.
#include <support/build.hpp>
#include <support/closed_form.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>

namespace tamias2d::test {
namespace {

constexpr double kOnce = byPrecision(1e-14, 1e-6);   // after one rounding or two
constexpr double kStep = 1.0 / 60;

TEST(LastingForce, WithAConstantArmGivesConstantAccelerations)
{
    TRACES("R2", "R5", "R6", "IM1", "IM2", "T1", "DD13");
    World world(weightless());
    Body body = addBox(world, {5, 5}, 2, 1, {.velocity = vec(-1, 0), .spin = 0.5});
    body.addForce({.force = vec(0.5, -0.25), .point = vec(0.5, 0.75), .pointTurns = false});
    runSeconds(world, kTenSeconds);

    const double mass = 2, inertia = 2 * (4 + 1) / 12.0;
    const DVec2 a{0.5 / mass, -0.25 / mass};
    const double alpha = (0.5 * -0.25 - 0.75 * 0.5) / inertia;
    EXPECT_LE(relativeError(velocityOf(body), DVec2{-1, 0} + kTenSeconds * a), kExactAfterTenSeconds);
    const DVec2 place = DVec2{5 - kTenSeconds, 5} + kTenSeconds * kTenSeconds / 2 * a;
    EXPECT_LE(relativeError(centerOf(body), place), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(spinOf(body), 0.5 + alpha * kTenSeconds), kExactAfterTenSeconds);
    const double turned = 0.5 * kTenSeconds + alpha * kTenSeconds * kTenSeconds / 2;
    EXPECT_LE(std::abs(angleDifference(body.angle(), turned)), kExactAfterTenSeconds * std::abs(turned));
}

// A box turned by a force, of fixed direction, on a point fixed in it is a pendulum.
struct Turning {
    double angle, spin;
    DVec2 center, velocity;
};

Turning simulatedTurning(bool forceTurns, int substeps)
{
    World world(weightless());
    Body body = addBox(world, {0, 0}, 2, 1, {.spin = 0.25, .angle = 1});
    body.addForce({.force = vec(0, -1), .point = vec(0.25, -0.5), .forceTurns = forceTurns});
    double turned = 1, last = body.angle();
    runSeconds(world, kTenSeconds, 60, substeps, [&] {
        turned += angleDifference(body.angle(), last);
        last = body.angle();
    });
    return {turned, spinOf(body), centerOf(body), velocityOf(body)};
}

Turning expectedTurning(bool forceTurns)
{
    const double mass = 2, inertia = 2 * (4 + 1) / 12.0;
    // y = angle, spin, x, y, vx, vy
    const auto rate = [&](double, const std::array<double, 6>& y) {
        const double c = std::cos(y[0]), s = std::sin(y[0]);
        const DVec2 arm{c * 0.25 + s * 0.5, s * 0.25 - c * 0.5};
        const DVec2 force = forceTurns ? DVec2{s, -c} : DVec2{0, -1};
        return std::array<double, 6>{y[1],          cross(arm, force) / inertia, y[4], y[5], force.x / mass,
                                     force.y / mass};
    };
    const auto y = integrated<6>({1, 0.25, 0, 0, 0, 0}, kTenSeconds, 20000, rate);
    return {y[0], y[1], {y[2], y[3]}, {y[4], y[5]}};
}

double turningError(const Turning& got, const Turning& expected)
{
    return std::max({relativeError(got.angle, expected.angle), relativeError(got.spin, expected.spin, 1),
                     relativeError(got.center, expected.center),
                     relativeError(got.velocity, expected.velocity, 1)});
}

TEST(LastingForce, OnAPointOfTheBodySwingsItLikeAPendulum)
{
    TRACES("R5", "R6", "IM1", "IM2", "DD13");
    const Turning expected = expectedTurning(false);
    const double error = turningError(simulatedTurning(false, 4), expected);
    EXPECT_LE(error, 1e-4);
    const double halved = turningError(simulatedTurning(false, 8), expected);
    if (kDouble) {
        EXPECT_NEAR(orderOf(error, halved), 2, 0.1) << error << " to " << halved;
    }
}

TEST(LastingForce, ThatTurnsWithTheBodyDrivesItLikeARocket)
{
    TRACES("R5", "R6", "IM1", "IM2", "DD13");
    const Turning expected = expectedTurning(true);
    const double error = turningError(simulatedTurning(true, 4), expected);
    EXPECT_LE(error, 1e-4);
    const double halved = turningError(simulatedTurning(true, 8), expected);
    if (kDouble) {
        EXPECT_NEAR(orderOf(error, halved), 2, 0.1) << error << " to " << halved;
    }
}

TEST(LastingForce, StaysUntilItIsTakenAway)
{
    TRACES("R2", "R5");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 1, 1);
    const std::size_t place = body.addForce({.force = vec(2, 0)});
    ASSERT_EQ(body.lastingForces().size(), 1u);
    runSeconds(world, 1);
    EXPECT_LE(relativeError(velocityOf(body).x, 2), kExactAfterTenSeconds);
    body.setForce(place, {.force = vec(0, 4)});
    runSeconds(world, 1);
    EXPECT_LE(relativeError(velocityOf(body), DVec2{2, 4}), kExactAfterTenSeconds);
    body.clearForces();
    EXPECT_TRUE(body.lastingForces().empty());
    const Vec2 before = body.linearVelocity();
    runSeconds(world, 1);
    EXPECT_EQ(body.linearVelocity(), before);
}

TEST(OneStepForce, ActsForExactlyOneStep)
{
    TRACES("R2", "R5", "IM1", "T1");
    for (const int substeps : {1, 4, 7}) {
        World world(weightless());
        Body body = addBox(world, {0, 0}, 2, 1);
        body.applyForceToCenter(vec(6, -8));
        EXPECT_EQ(body.linearVelocity(), Vec2{});
        world.step(kStep, substeps);
        const DVec2 expected = kStep / 2 * DVec2{6, -8};
        EXPECT_LE(relativeError(velocityOf(body), expected), 10 * kOnce);
        EXPECT_LE(relativeError(centerOf(body), kStep / 2 * expected), 10 * kOnce);
        const Vec2 before = body.linearVelocity();
        world.step(kStep, substeps);
        EXPECT_EQ(body.linearVelocity(), before);
    }
}

TEST(OneStepForce, AddsUpAndTurnsTheBody)
{
    TRACES("R2", "R6", "IM2", "DD13");
    World world(weightless());
    Body body = addBox(world, {3, 3}, 2, 1);
    body.applyForce(vec(0, 1e-4), {4, 3});
    body.applyForce(vec(0, 2e-4), {3.5, 3});
    body.applyTorque(toReal(3e-4));
    world.step(kStep);

    const double inertia = 2 * (4 + 1) / 12.0;
    EXPECT_LE(relativeError(velocityOf(body).y, kStep * 3e-4 / 2), 10 * kOnce);
    EXPECT_LE(relativeError(spinOf(body), kStep * (1e-4 + 1e-4 + 3e-4) / inertia), byPrecision(1e-9, 1e-6));
}

TEST(OneStepForce, CanBeTakenBack)
{
    TRACES("R2");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 1, 1);
    body.applyForceToCenter(vec(100, 0));
    body.applyTorque(100);
    body.clearForces();
    world.step();
    EXPECT_EQ(body.linearVelocity(), Vec2{});
    EXPECT_EQ(body.angularVelocity(), 0);
}

TEST(Impulse, ChangesMomentumAtOnce)
{
    TRACES("R2", "DD10", "DD13");
    World world(weightless());
    Body body = addBox(world, {1, 1}, 2, 1, {.velocity = vec(1, 0)});
    const double mass = 2, inertia = 2 * (4 + 1) / 12.0;
    body.applyImpulseToCenter(vec(4, 2));
    EXPECT_LE(relativeError(velocityOf(body), DVec2{3, 1}), kOnce);
    EXPECT_EQ(body.angularVelocity(), 0);
    body.applyImpulse(vec(0, -1), {1.75, 1.25});
    EXPECT_LE(relativeError(velocityOf(body), DVec2{3, 1 - 1 / mass}), kOnce);
    EXPECT_LE(relativeError(spinOf(body), 0.75 * -1 / inertia), kOnce);
    body.applyAngularImpulse(toReal(0.75));
    EXPECT_NEAR(spinOf(body), 0, kOnce);
    EXPECT_EQ(body.position(), (Position{1, 1}));
}

TEST(Impulse, MovesTheMomentumOfTheWorldByItself)
{
    TRACES("DD10", "GD1", "DD9");
    World world(weightless());
    Body body = addBox(world, {10, -5}, 2, 1, {.velocity = vec(1, 2), .spin = 3, .angle = 0.7});
    const Momentum before = world.momentum();
    const Position at{10.5, -4.75};
    body.applyImpulse(vec(2, -3), at);
    const Momentum after = world.momentum();

    EXPECT_LE(relativeError(after.linear - before.linear, DVec2{2, -3}), 10 * kOnce);
    const double angular = at.x * -3 - at.y * 2;
    EXPECT_LE(relativeError(after.angular - before.angular, angular), 100 * kOnce);
}

TEST(Velocity, OfAPointIsThatOfTheCenterAndTheTurning)
{
    TRACES("DD9", "DD11");
    World world(weightless());
    const Body body = addBox(world, {1, 2}, 2, 1, {.velocity = vec(1, 2), .spin = 3, .angle = 0.7});
    const DVec2 got = toDVec2(body.velocityAt({2, 4}));  // arm (1, 2): omega x r = (-6, 3)
    EXPECT_LE(relativeError(got, DVec2{1 - 6, 2 + 3}), kOnce);
}

TEST(Mass, GivenByHandDecidesTheAcceleration)
{
    TRACES("R2", "IM1", "IM2", "T1", "T4", "DD1", "DD14");
    World world(weightless());
    BodyDef def;
    def.mass = MassProperties{5, vec(0.5, 0), 4};
    Body body = world.createBody(def);
    EXPECT_EQ(body.mass(), 5);
    EXPECT_EQ(body.inertia(), 4);
    EXPECT_LE(length(centerOf(body) - DVec2{0.5, 0}), 1e-15);
    body.addForce({.force = vec(10, 0), .torque = 2});
    runSeconds(world, 1);
    EXPECT_LE(relativeError(velocityOf(body).x, 2), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(spinOf(body), 0.5), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(centerOf(body), DVec2{1.5, 0}), kExactAfterTenSeconds);
}

TEST(Mass, TheBodyTurnsAboutItsCenterNotItsOrigin)
{
    TRACES("DD1", "IM2", "DD9");
    World world(weightless());
    BodyDef def;
    def.angularVelocity = 2;
    Body body = world.createBody(def);
    ShapeDef shape;
    shape.geometry = Circle{vec(1, 0), toReal(0.5)};
    body.createShape(shape);
    ASSERT_LE(length(centerOf(body) - DVec2{1, 0}), 1e-15);
    body.setLinearVelocity({});
    runSeconds(world, kTenSeconds);

    EXPECT_LE(length(centerOf(body) - DVec2{1, 0}), kExactAfterTenSeconds);
    const DVec2 origin{1 - std::cos(20.0), -std::sin(20.0)};
    EXPECT_LE(length((body.position() - Position{}) - origin), 20 * kExactAfterTenSeconds);
}

TEST(Locks, HoldAnAxisAndNothingElse)
{
    TRACES("R5", "R6", "LC3");
    BodyDef def;
    def.position = {3, 4};
    def.lockX = true;
    World world;
    Body body = world.createBody(def);
    body.createShape({});
    body.addForce({.force = vec(50, 0), .torque = 1});
    runSeconds(world, 1);
    EXPECT_EQ(body.position().x, 3);
    EXPECT_EQ(body.linearVelocity().x, 0);
    EXPECT_LE(relativeError(body.position().y - 4, -9.81 / 2), byPrecision(1e-12, 1e-5));
    EXPECT_LE(relativeError(spinOf(body) * static_cast<double>(body.inertia()), 1), byPrecision(1e-12, 1e-5));
}

TEST(Locks, CanBeSetAndLiftedAtAnyTime)
{
    TRACES("R5", "R6", "LC3");
    World world;
    Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(2, 0), .spin = 3});
    body.setLocks(false, true, true);
    runSeconds(world, 1);
    EXPECT_EQ(body.position().y, 0);
    EXPECT_EQ(body.angle(), 0);
    EXPECT_LE(relativeError(body.position().x, 2), kExactAfterTenSeconds);
    EXPECT_EQ(body.linearVelocity().y, 0);
    EXPECT_EQ(body.angularVelocity(), 0);
    body.setLocks(false, false, false);
    runSeconds(world, 1);
    EXPECT_LE(relativeError(body.position().y, -9.81 / 2), byPrecision(1e-12, 1e-5));
}

TEST(Gravity, IsScaledPerBody)
{
    TRACES("GD2", "IM1", "R2");
    World world(withGravity(1, -8));
    Body half = addDisc(world, {0, 0}, 0.5), up = addDisc(world, {10, 0}, 0.5),
         none = addDisc(world, {20, 0}, 0.5);
    half.setGravityScale(toReal(0.5));
    up.setGravityScale(-1);
    none.setGravityScale(0);
    runSeconds(world, 1);
    EXPECT_LE(relativeError(velocityOf(half), DVec2{0.5, -4}), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(velocityOf(up), DVec2{-1, 8}), kExactAfterTenSeconds);
    EXPECT_EQ(none.linearVelocity(), Vec2{});
}

TEST(Gravity, OfItsOwnReplacesTheWorlds)
{
    TRACES("GD2", "IM1", "R2");
    World world(withGravity(0, -8));
    Body body = addDisc(world, {0, 0}, 0.5);
    body.setOwnGravity(vec(3, 0));
    runSeconds(world, 1);
    EXPECT_LE(relativeError(velocityOf(body), DVec2{3, 0}), kExactAfterTenSeconds);
    EXPECT_LE(relativeError(body.energy().potential, -static_cast<double>(body.mass()) * 3 * 1.5),
              kExactAfterTenSeconds);
    body.setOwnGravity(std::nullopt);
    runSeconds(world, 1);
    EXPECT_LE(relativeError(velocityOf(body), DVec2{3, -8}), kExactAfterTenSeconds);
}

TEST(Gravity, OfTheWorldMayChangeAtAnyTime)
{
    TRACES("GD2", "R2");
    World world(withGravity(0, -8));
    const Body body = addDisc(world, {0, 0}, 0.5);
    runSeconds(world, 1);
    world.setGravity(vec(0, 8));
    runSeconds(world, 1);
    EXPECT_LE(length(velocityOf(body)), 8 * kExactAfterTenSeconds);
    EXPECT_LE(relativeError(body.position().y, -8), kExactAfterTenSeconds);
}

TEST(BodyType, OnlyDynamicBodiesFeelForces)
{
    TRACES("R2", "R5");
    World world;
    Body still = addBox(world, {0, 0}, 1, 1, {.type = BodyType::Static});
    Body moved =
        addBox(world, {10, 0}, 1, 1, {.type = BodyType::Kinematic, .velocity = vec(1, 2), .spin = 3});
    for (Body* body : {&still, &moved}) {
        body->applyForceToCenter(vec(10, 10));
        body->applyTorque(10);
        body->applyImpulseToCenter(vec(10, 10));
        body->addForce({.force = vec(10, 10)});
    }
    runSeconds(world, 1);
    EXPECT_EQ(still.position(), (Position{0, 0}));
    EXPECT_LE(length(centerOf(moved) - DVec2{11, 2}), 11 * kExactAfterTenSeconds);
    EXPECT_EQ(moved.linearVelocity(), vec(1, 2));
    EXPECT_LE(std::abs(angleDifference(moved.angle(), 3)), 3 * kExactAfterTenSeconds);
}

TEST(BodyType, ADisabledBodyWaits)
{
    TRACES("R5");
    World world;
    Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(1, 0)});
    body.setEnabled(false);
    runSeconds(world, 1);
    EXPECT_EQ(body.position(), (Position{0, 0}));
    body.setEnabled(true);
    runSeconds(world, 1);
    EXPECT_LE(relativeError(centerOf(body), DVec2{1, -9.81 / 2}), byPrecision(1e-12, 1e-5));
}

}  // namespace
}  // namespace tamias2d::test
