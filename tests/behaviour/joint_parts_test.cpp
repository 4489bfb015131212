// SPDX-License-Identifier: MIT
// Springs, motors, limits and reactions of joints, against closed forms.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

// Two bodies without gravity: one static at the origin, one of 1 kg, and 1 kg*m^2.
struct Jointed {
    World world{weightless()};
    Body base = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body mass;

    explicit Jointed(Position place = {1, 0}) : mass(addDisc(world, place, 0.1)) { mass.setMass({1, {}, 1}); }
    Joint join(const JointKind& kind)
    {
        JointDef def;
        def.bodyA = base.id();
        def.bodyB = mass.id();
        def.kind = kind;
        return world.createJoint(def);
    }
};

struct SpringCase {
    double frequency, ratio;
};
void PrintTo(const SpringCase& c, std::ostream* out)
{
    *out << c.frequency << " Hz, damping ratio " << c.ratio;
}

// x(t) of x'' + 2 z w x' + w^2 x = 0, x(0) = 1, x'(0) = 0.
double dampedSwing(double frequency, double ratio, double t)
{
    const double w = kTwoPi * frequency;
    if (ratio >= 1) return (1 + w * t) * std::exp(-w * t);
    const double d = w * std::sqrt(1 - ratio * ratio);
    return std::exp(-ratio * w * t) * (std::cos(d * t) + ratio * w / d * std::sin(d * t));
}

class SpringOf : public testing::TestWithParam<SpringCase> {
protected:
    // Swings measured for three periods: a wrong frequency or damping by 1 % would show as 0.19 or 0.04
    // there.
    template <class Measure>
    void expectSwing(World& world, Measure measure)
    {
        const auto [frequency, ratio] = GetParam();
        double worst = 0;
        const double rate = std::max(60.0, 40 * frequency);
        runSeconds(world, 3 / frequency, rate, 4, [&] {
            worst = std::max(worst, std::abs(measure() - dampedSwing(frequency, ratio, world.time())));
        });
        EXPECT_LT(worst, 0.02);
    }
    JointSpring spring(double rest) const
    {
        return {toReal(GetParam().frequency), toReal(GetParam().ratio), toReal(rest)};
    }
};

TEST_P(SpringOf, ADistanceSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM1");
    Jointed pair({3, 0});
    Joint joint = pair.join(DistanceJoint{.spring = spring(2)});
    expectSwing(pair.world, [&] { return joint.reading().position - 2; });
}

TEST_P(SpringOf, ATurnSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM2");
    Jointed pair({0, 0});
    Joint joint = pair.join(RevoluteJoint{.spring = spring(-1)});
    expectSwing(pair.world, [&] { return joint.reading().position + 1; });
}

TEST_P(SpringOf, ASlideSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM1");
    Jointed pair({0, 3});
    Joint joint = pair.join(PrismaticJoint{.axis = vec(0, 2), .spring = spring(2)});
    expectSwing(pair.world, [&] { return joint.reading().position - 2; });
}

TEST_P(SpringOf, AWheelSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM1");
    Jointed pair({0, 3});
    Joint joint = pair.join(WheelJoint{.axis = vec(0, 0.5), .spring = spring(2)});
    expectSwing(pair.world, [&] { return joint.reading().position - 2; });
}

TEST_P(SpringOf, ARotarySpringSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM2");
    Jointed pair({5, 0});
    Joint joint = pair.join(RotaryJoint{.spring = spring(-1)});
    expectSwing(pair.world, [&] { return joint.reading().position + 1; });
}

TEST_P(SpringOf, AMotorWithSpringsSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM1");
    Jointed pair({1, 0});
    pair.join(MotorJoint{.linear = spring(0), .angular = spring(0)});
    expectSwing(pair.world, [&] { return centerOf(pair.mass).x; });
}

TEST_P(SpringOf, ASoftWeldSwingsAsItsFrequencySays)
{
    TRACES("LC3", "IM1");
    Jointed pair({1, 0});
    pair.join(WeldJoint{.linear = spring(0), .angular = spring(0)});
    expectSwing(pair.world, [&] { return centerOf(pair.mass).x; });
}

TEST_P(SpringOf, ASoftWeldTurnsAsItsFrequencySays)
{
    TRACES("LC3", "IM2");
    Jointed pair({0, 0});
    pair.mass.setTransform({0, 0}, 1);
    pair.join(WeldJoint{.linear = spring(0), .angular = spring(0)});
    expectSwing(pair.world, [&] { return angleDifference(pair.mass.angle(), 0); });
}

INSTANTIATE_TEST_SUITE_P(Joints, SpringOf,
                         testing::Values(SpringCase{0.5, 0}, SpringCase{2, 0}, SpringCase{10, 0},
                                         SpringCase{0.5, 0.3}, SpringCase{3, 0.7}, SpringCase{10, 1}));

TEST(JointSpring, KeepsItsEnergyUndamped)
{
    TRACES("LC3", "NFR2");
    Jointed pair({3, 0});
    pair.mass.setLinearVelocity(vec(0, 2));  // around as well as to and fro
    pair.join(DistanceJoint{.spring = JointSpring{3, 0, 2}});
    const double start = pair.world.energy().total();
    EXPECT_GT(start, 100);
    double most = 0;
    runSeconds(pair.world, 60, 60, 4,
               [&] { most = std::max(most, std::abs(pair.world.energy().total() - start)); });
    EXPECT_LT(most / start, 0.005);
}

TEST(JointSpring, OfAnyFrequencyIsStable)
{
    TRACES("LC3", "R4");
    for (const double frequency : {30.0, 100.0, 1000.0, 1e6}) {
        for (const double ratio : {0.0, 1.0}) {
            Jointed pair({3, 0});
            Joint joint =
                pair.join(DistanceJoint{.spring = JointSpring{toReal(frequency), toReal(ratio), 2}});
            const double start = pair.world.energy().total();
            const RunTotals totals = runSeconds(pair.world, 5);
            EXPECT_LE(totals.highestEnergy, start * 1.01) << frequency << " Hz, " << ratio;
            EXPECT_EQ(totals.faults, 0u);
            EXPECT_LE(joint.reading().position, 3.01) << frequency << " Hz, " << ratio;
        }
    }
}

TEST(JointMotor, ReachesItsSpeedAtTheRateOfItsTorque)
{
    TRACES("LC3", "DD13");
    Jointed pair({0, 0});
    Joint joint = pair.join(RevoluteJoint{.motor = JointMotor{10, 5}});
    runSeconds(pair.world, 1);
    EXPECT_LT(relativeError(spinOf(pair.mass), 5), 0.01);  // 5 N*m on 1 kg*m^2 for 1 s
    EXPECT_LT(relativeError(static_cast<double>(joint.reading().motorForce), 5), 0.01);
    EXPECT_LT(relativeError(static_cast<double>(joint.reading().motorPower), 25), 0.02);
    runSeconds(pair.world, 2);
    EXPECT_NEAR(spinOf(pair.mass), 10, 1e-4);
    EXPECT_NEAR(static_cast<double>(joint.reading().motorForce), 0, 1e-3);
}

TEST(JointMotor, StallsAtItsForce)
{
    TRACES("LC3", "DD13");
    for (const double load : {0.98, 1.02}) {  // of what the motor can lift
        World world;
        Body base = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
        Body lift = addDisc(world, {0, 1}, 0.1);
        lift.setMass({2, {}, 1});
        JointDef def = slideAlong(base, lift, {0, 0}, vec(0, 1));
        std::get<PrismaticJoint>(def.kind).motor = JointMotor{0, toReal(2 * 9.81 / load)};
        world.createJoint(def);
        runSeconds(world, 2);
        if (load < 1)
            EXPECT_NEAR(centerOf(lift).y, 1, 1e-3);
        else
            EXPECT_LT(centerOf(lift).y, 0.99);
    }
}

TEST(JointMotor, CanBeTurnedWhileItRuns)
{
    TRACES("LC3", "R4");
    Jointed pair({0, 0});
    Joint joint = pair.join(RevoluteJoint{.motor = JointMotor{3, 100}});
    runSeconds(pair.world, 1);
    EXPECT_NEAR(spinOf(pair.mass), 3, 1e-4);
    joint.setMotorSpeed(-2);
    runSeconds(pair.world, 1);
    EXPECT_NEAR(spinOf(pair.mass), -2, 1e-4);
    RevoluteJoint kind = std::get<RevoluteJoint>(joint.kind());
    kind.motor.reset();
    joint.setKind(kind);
    EXPECT_THROW(joint.setMotorSpeed(1), InputError);
}

TEST(JointLimits, HoldAtFiftyRadiansASecond)
{
    TRACES("LC3", "DD6");
    for (const double range : {0.5, 2.0, 20.0}) {  // the last is more than three turns
        Jointed pair({0, 0});
        Joint joint = pair.join(RevoluteJoint{.limits = JointLimits{toReal(-range / 2), toReal(range / 2)}});
        double over = 0;
        for (int i = 0; i < 90; ++i) {
            if (i % 30 == 0) pair.mass.setAngularVelocity(toReal(i % 60 == 0 ? 50 : -50));
            pair.world.step();
            over = std::max(over, std::abs(joint.reading().position) - range / 2);
        }
        EXPECT_LT(over, 1e-3 * range) << "range " << range;
        EXPECT_EQ(joint.reading().limit, LimitState::AtUpper);
        EXPECT_NEAR(spinOf(pair.mass), 0, 1e-3);
    }
}

TEST(JointLimits, ARopeIsSlackUntilItIsTaut)
{
    TRACES("LC3");
    World world;
    Body hook = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body load = addDisc(world, {0, -1}, 0.1, {.density = 1 / (kPi * 0.01)});
    JointDef def = rodBetween(hook, load, {0, 0}, {0, -1});
    std::get<DistanceJoint>(def.kind).limits = JointLimits{0, 2};
    Joint rope = world.createJoint(def);
    double longest = 0;
    bool wasFree = false;
    runSeconds(world, 3, 60, 4, [&] {
        longest = std::max(longest, rope.reading().position);
        if (world.time() < 0.4) {  // falls 0.78 m
            wasFree = true;
            EXPECT_NEAR(static_cast<double>(rope.reading().force.y), 0, 1e-6);
            EXPECT_NEAR(centerOf(load).y, -1 - 9.81 / 2 * world.time() * world.time(), 1e-4);
        }
    });
    EXPECT_TRUE(wasFree);
    EXPECT_LT(longest, 2.002);
    EXPECT_EQ(rope.reading().limit, LimitState::AtUpper);
    EXPECT_LT(relativeError(static_cast<double>(rope.reading().force.y), 9.81), 0.01);
}

// A load of many times its hanger's mass, on each kind: what the joint says it bears is what statics says.
TEST(JointReading, OfAHangingLoadIsWhatStaticsSays)
{
    TRACES("LC3", "T2", "DD10", "DD13");
    for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) {
        World world;
        Body wall = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
        Body arm = addDisc(world, {1, 0}, 0.1);
        arm.setMass({toReal(ratio), {}, toReal(ratio)});
        const double weight = ratio * 9.81;
        Joint weld = world.createJoint(weldAt(wall, arm, {0, 0}));
        runSeconds(world, 2);
        EXPECT_LT(relativeError(static_cast<double>(weld.reading().force.y), weight), 0.01) << ratio;
        EXPECT_LT(relativeError(static_cast<double>(weld.reading().torque), weight * 1), 0.01) << ratio;
        EXPECT_LT(static_cast<double>(weld.reading().error), 1e-3) << ratio;
        weld.destroy();

        Joint slide = world.createJoint(slideAlong(wall, arm, {0, 0}, vec(1, 0)));
        runSeconds(world, 1);
        EXPECT_LT(relativeError(static_cast<double>(slide.reading().force.y), weight), 0.01) << ratio;
        EXPECT_LT(relativeError(static_cast<double>(slide.reading().torque), weight), 0.02) << ratio;
        slide.destroy();
    }
}

TEST(TargetJoint, BringsAPointToItsPlaceAndNoFartherThanItsForce)
{
    TRACES("LC3", "DD13");
    Jointed pair({1, 0});
    Joint joint = pair.join(TargetJoint{.anchor = vec(0, 0), .target = {2, 1}, .angle = 0.5, .maxForce = 10});
    double fastest = 0;
    runSeconds(pair.world, 0.1, 60, 4, [&] { fastest = std::max(fastest, length(velocityOf(pair.mass))); });
    EXPECT_LT(fastest, 10 * 0.1 * 1.01);  // 10 N on 1 kg for 0.1 s
    runSeconds(pair.world, 3);
    EXPECT_LT(length(centerOf(pair.mass) - DVec2{2, 1}), 1e-3);
    EXPECT_NEAR(pair.mass.angle(), 0.5, 1e-3);
    joint.setTarget({-1, 0});
    runSeconds(pair.world, 10);
    EXPECT_LT(length(centerOf(pair.mass) - DVec2{-1, 0}), 1e-3);
}

TEST(JointMomentum, OfAFreeChainIsKept)
{
    TRACES("LC3", "GD1", "NFR2");
    World world(weightless());
    Body last;
    for (int i = 0; i < 10; ++i) {
        Body link = addBox(world, {0.5 * i, 0}, 0.5, 0.1, {.velocity = vec(0.3, 0.2 * i - 0.9)});
        for (Shape shape : link.shapes()) shape.setFilter({1, 1, -1});
        if (i > 0) world.createJoint(revoluteAt(last, link, {0.5 * i - 0.25, 0}));
        last = link;
    }
    const Momentum before = world.momentum();
    runSeconds(world, 20);
    const Momentum after = world.momentum();
    EXPECT_LT(relativeError(after.linear, before.linear), byPrecision(1e-6, 1e-5));
    EXPECT_LT(relativeError(after.angular, before.angular), byPrecision(1e-4, 2e-4));
}

}  // namespace
}  // namespace tamias2d
