// SPDX-License-Identifier: MIT
// Forces that depend on state and time, against closed forms.
#include <support/build.hpp>
#include <support/closed_form.hpp>
#include <support/run.hpp>
#include <support/traces.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace tamias2d::test {
namespace {

constexpr double kStiffness = kTwoPi * kTwoPi;  // with 1 kg: one swing a second

// Position after 15 swings and a bit, started 1 m off the spring's end; and the worst energy on the way.
struct Swing {
    double error = 0;   // of the place    [m]
    double energy = 0;  // relative
};

Swing swing(int substeps, const ForceLaw& law)
{
    World world(weightless());
    Body body = addBox(world, {1, 0}, 1, 1);
    body.addForceLaw(law);
    const double start = world.energy().total();
    Swing result;
    runSeconds(world, 15.25, 60, substeps, [&] {
        result.energy = std::max(result.energy, relativeError(world.energy().total(), start));
    });
    result.error = std::abs(body.position().x - std::cos(kTwoPi * 15.25));
    return result;
}

TEST(Oscillator, KeepsItsEnergyForFifteenPeriods)
{
    TRACES("R5", "IM1", "DD15", "DD16", "ADR16");
    for (const int substeps : {2, 4, 8}) {
        EXPECT_LE(swing(substeps, springTo({0, 0}, kStiffness)).energy, 1e-3) << substeps;
    }
}

TEST(Oscillator, IsSecondOrder)
{
    TRACES("R5", "IM1");
    const ForceLaw law = springTo({0, 0}, kStiffness);
    double coarser = swing(1, law).error;
    for (const int substeps : {2, 4, 8}) {
        const double finer = swing(substeps, law).error;
        EXPECT_NEAR(orderOf(coarser, finer), 2, byPrecision(0.02, 0.1)) << substeps << ": " << finer;
        coarser = finer;
    }
}

TEST(Oscillator, ALawWrittenByHandIsAsGoodAsTheBuiltInOne)
{
    TRACES("R5", "IM1");
    ForceLaw own;
    own.name = "own spring";
    own.force = [](const BodyView& b, double) {
        return Wrench{{-kStiffness * b.center.x, -kStiffness * b.center.y}, 0};
    };
    own.potential = [](const BodyView& b, double) {
        return kStiffness / 2 * (b.center.x * b.center.x + b.center.y * b.center.y);
    };
    const Swing built = swing(4, springTo({0, 0}, kStiffness)), mine = swing(4, own);
    EXPECT_NEAR(mine.error, built.error, byPrecision(1e-12, 1e-4));
    EXPECT_LE(mine.energy, 1e-3);
}

TEST(Oscillator, ATorsionSpringSwingsTheSame)
{
    TRACES("R6", "IM2");
    double error[2] = {};
    for (const int halved : {0, 1}) {
        World world(weightless());
        Body body = addBox(world, {0, 0}, 1, 1, {.angle = 2});
        body.addForceLaw(torsionSpring(1, kStiffness * static_cast<double>(body.inertia())));
        const double start = world.energy().total();
        runSeconds(world, 15.25, 60, halved ? 8 : 4,
                   [&] { EXPECT_LE(relativeError(world.energy().total(), start), 1e-3); });
        error[halved] = std::abs(angleDifference(body.angle(), 1 + std::cos(kTwoPi * 15.25)));
    }
    EXPECT_NEAR(orderOf(error[0], error[1]), 2, byPrecision(0.02, 0.1)) << error[0] << " " << error[1];
}

TEST(Oscillator, ADamperSlowsItAsTheClosedFormSays)
{
    TRACES("R5", "IM1");
    const double k = 25, c = 1;  // with 1 kg: omega^2 = k - c^2 / 4
    const double omega = std::sqrt(k - c * c / 4), t = 4;
    const double expected =
        std::exp(-c * t / 2) * (std::cos(omega * t) + c / (2 * omega) * std::sin(omega * t));
    double error[2] = {};
    for (const int halved : {0, 1}) {
        World world(weightless());
        Body body = addBox(world, {1, 0}, 1, 1);
        body.addForceLaw(springTo({0, 0}, k, c));
        runSeconds(world, t, 60, halved ? 8 : 4);
        error[halved] = std::abs(body.position().x - expected);
    }
    EXPECT_LE(error[0], 1e-3);
    if (kDouble) {
        EXPECT_GT(orderOf(error[0], error[1]), 1.9) << error[0] << " " << error[1];
    }
}

TEST(ForceLaw, QuadraticDragFadesAsTheClosedFormSays)
{
    TRACES("R5", "IM1");
    double error[2] = {};
    const double k = 0.5, v = 10, t = 5;  // v' = -k v^2: v0 / (1 + k v0 t)
    for (const int halved : {0, 1}) {
        World world(weightless());
        Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(v, 0)});
        body.addForceLaw(drag(0, k));
        runSeconds(world, t, 60, halved ? 8 : 4);
        EXPECT_LE(relativeError(velocityOf(body).x, v / (1 + k * v * t)), 1e-3);
        error[halved] = std::abs(body.position().x - std::log(1 + k * v * t) / k);
    }
    EXPECT_LE(error[0], 1e-3 * std::log(1 + k * v * t) / k);
    if (kDouble) {
        EXPECT_GT(orderOf(error[0], error[1]), 1.9) << error[0] << " " << error[1];
    }
}

TEST(ForceLaw, LinearDragFadesExponentially)
{
    TRACES("R5", "IM1");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 2, 1, {.velocity = vec(10, -5)});
    body.addForceLaw(drag(1));
    runSeconds(world, 4);
    EXPECT_LE(relativeError(velocityOf(body), std::exp(-2.0) * DVec2{10, -5}), 1e-3);
}

TEST(ForceLaw, MayDependOnTime)
{
    TRACES("R5", "IM1", "T1");
    double error[2] = {};
    const double t = 10.1, w = 3;  // a = sin(w t): x = t / w - sin(w t) / w^2
    for (const int halved : {0, 1}) {
        World world(weightless());
        Body body = addBox(world, {0, 0}, 1, 1);
        ForceLaw law;
        law.force = [w](const BodyView&, double at) { return Wrench{{std::sin(w * at), 0}, 0}; };
        body.addForceLaw(law);
        runSeconds(world, t, 60, halved ? 8 : 4);
        error[halved] = std::abs(body.position().x - (t / w - std::sin(w * t) / (w * w)));
        EXPECT_LE(std::abs(velocityOf(body).x - (1 - std::cos(w * t)) / w), 1e-4);
    }
    EXPECT_LE(error[0], 1e-3);
    if (kDouble) {
        EXPECT_NEAR(orderOf(error[0], error[1]), 2, 0.1) << error[0] << " " << error[1];
    }
}

TEST(ForceLaw, SeesTheBodyAsItIs)
{
    TRACES("R2", "R5");
    World world(weightless());
    Body body = addBox(world, {3, 4}, 2, 1, {.velocity = vec(1, 2), .spin = 0.5, .angle = 0.25});
    BodyView seen;
    double first = -1;
    ForceLaw law;
    law.force = [&](const BodyView& view, double t) {
        if (first < 0) seen = view, first = t;
        return Wrench{};
    };
    body.addForceLaw(law);
    world.step();
    EXPECT_EQ(seen.id, body.id());
    EXPECT_LE(std::abs(seen.center.x - (3 + first)), 1e-6);  // wherever in the step it looked first
    EXPECT_LE(std::abs(seen.center.y - (4 + 2 * first)), 1e-6);
    EXPECT_LE(std::abs(seen.angle - (0.25 + 0.5 * first)), 1e-6);
    EXPECT_EQ(seen.velocity, (DVec2{1, 2}));
    EXPECT_EQ(seen.spin, 0.5);
    EXPECT_EQ(seen.mass, 2);
    EXPECT_LE(relativeError(seen.inertia, 2 * 5 / 12.0), byPrecision(1e-14, 1e-6));
}

TEST(ForceLaw, ActsOnOneBodyOrOnAllAndCanBeRemoved)
{
    TRACES("R2", "R5");
    World world(weightless());
    Body one = addBox(world, {0, 0}, 1, 1);
    const Body other = addBox(world, {10, 0}, 1, 1);
    const Body still = addBox(world, {20, 0}, 1, 1, {.type = BodyType::Static});
    ForceLaw right, up;
    right.force = [](const BodyView& b, double) { return Wrench{{b.mass, 0}, 0}; };
    up.force = [](const BodyView& b, double) { return Wrench{{0, b.mass}, b.inertia}; };
    const ForceLawId onOne = one.addForceLaw(right);
    const ForceLawId onAll = world.addForceLaw(up);
    EXPECT_EQ(world.forceLaws().size(), 2u);
    runSeconds(world, 1);
    const double kClose = byPrecision(1e-12, 1e-5);
    EXPECT_LE(length(velocityOf(one) - DVec2{1, 1}), kClose);
    EXPECT_LE(length(velocityOf(other) - DVec2{0, 1}), kClose);
    EXPECT_LE(std::abs(spinOf(other) - 1), kClose);
    EXPECT_EQ(still.linearVelocity(), Vec2{});
    world.removeForceLaw(onOne);
    world.removeForceLaw(onAll);
    runSeconds(world, 1);
    EXPECT_LE(length(velocityOf(one) - DVec2{1, 1}), kClose);
    EXPECT_TRUE(world.forceLaws().empty());
}

TEST(ForceLaw, AFaultyOneIsCountedAndDoesNoHarm)
{
    TRACES("R4", "R5");
    World world(weightless());
    Body thrower = addBox(world, {0, 0}, 1, 1, {.velocity = vec(1, 0)});
    Body nan = addBox(world, {0, 10}, 1, 1, {.velocity = vec(1, 0)});
    ForceLaw bad, none;
    bad.force = [](const BodyView&, double) -> Wrench { throw std::runtime_error("no"); };
    none.force = [](const BodyView&, double) {
        return Wrench{{std::numeric_limits<double>::quiet_NaN(), 0}, 0};
    };
    thrower.addForceLaw(bad);
    nan.addForceLaw(none);
    const StepReport report = world.step();
    EXPECT_GE(report.forceLawFaults, 2u);
    EXPECT_EQ(report.nonFinite, 0u);
    EXPECT_EQ(thrower.linearVelocity(), vec(1, 0));
    EXPECT_EQ(nan.linearVelocity(), vec(1, 0));
}

// 1e300 N is a number in double and none in float, where it would be an infinite force.
TEST(ForceLaw, OfMoreThanThePrecisionHoldsIsAFault)
{
    TRACES("R4", "R5");
    World world(weightless());
    Body pushed = addBox(world, {0, 0}, 1, 1), turned = addBox(world, {0, 10}, 1, 1);
    pushed.addForceLaw({.force = [](const BodyView&, double) { return Wrench{{1e300, 0}, 0}; }});
    turned.addForceLaw({.force = [](const BodyView&, double) { return Wrench{{}, 1e300}; }});
    const StepReport report = world.step();
    EXPECT_EQ(report.forceLawFaults > 0, !kDouble);
    EXPECT_EQ(report.nonFinite, 0u);
    if (!kDouble) {
        EXPECT_EQ(pushed.linearVelocity(), Vec2{});
        EXPECT_EQ(turned.angularVelocity(), 0);
    }
}

TEST(ForceLaw, APotentialThatThrowsOrIsNoNumberCountsAsNone)
{
    TRACES("R4", "DD15");
    World world(weightless());
    Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(1, 0)});
    ForceLaw law = springTo({2, 0}, 3);
    body.addForceLaw(law);
    const Energy before = world.energy();
    law.potential = [](const BodyView&, double) -> double { throw std::runtime_error("no"); };
    body.addForceLaw(law);
    law.potential = [](const BodyView&, double) { return std::numeric_limits<double>::quiet_NaN(); };
    world.addForceLaw(law);
    EXPECT_EQ(world.energy().total(), before.total());
    EXPECT_EQ(body.energy().total(), before.total());
}

}  // namespace
}  // namespace tamias2d::test
