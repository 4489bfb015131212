// SPDX-License-Identifier: MIT
// Joints of one's own against closed forms, the built-in kinds and what must be conserved.
#include "support/build.hpp"
#include "support/closed_form.hpp"
#include "support/own_joints.hpp"
#include "support/pendulum.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

double number(real x)
{
    return static_cast<double>(x);
}

enum class OwnHung { ByRod, ByHinge };
class OwnPendulum : public testing::TestWithParam<OwnHung> {};

TEST_P(OwnPendulum, KeepsItsEnergyAndItsPeriodForAHundredSeconds)
{
    TRACES("LC3", "IM1", "IM2");
    LevelPendulum p;
    Joint joint = GetParam() == OwnHung::ByRod
                      ? p.world.createJoint(OwnRod{}, p.pivot, p.bob)
                      : p.world.createJoint(OwnHinge{{}, vec(-1, 0)}, p.pivot, p.bob);
    const Swings swings = swingForAHundredSeconds(p);
    EXPECT_LT(swings.mostEnergy / kGravity, byPrecision(0.001, 0.005));
    EXPECT_GT(swings.count, 40);
    EXPECT_LT(relativeError(swings.period, p.exactPeriod(GetParam() == OwnHung::ByHinge)), 1e-4);
    EXPECT_LT(number(joint.reading().error), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Both, OwnPendulum, testing::Values(OwnHung::ByRod, OwnHung::ByHinge),
                         [](const auto& given) {
                             return std::string(given.param == OwnHung::ByRod ? "ByRod" : "ByHinge");
                         });

TEST(OwnJoints, ARodMovesAsTheBuiltInOneDoes)
{
    TRACES("LC3");
    LevelPendulum mine, built;
    Joint own = mine.world.createJoint(OwnRod{}, mine.pivot, mine.bob);
    Joint rod = built.world.createJoint(rodBetween(built.pivot, built.bob, {0, 0}, {1, 0}));
    double apart = 0, forces = 0;
    for (int step = 0; step < 600; ++step) {
        mine.world.step();
        built.world.step();
        apart = std::max(apart, length(centerOf(mine.bob) - centerOf(built.bob)));
        forces = std::max(forces, number(length(own.reading().force - rod.reading().force)));
    }
    EXPECT_LT(apart, byPrecision(1e-9, 1e-4));
    EXPECT_LT(forces, byPrecision(1e-6, 1e-2));
    EXPECT_NEAR(own.reading().position, 1, 1e-5);
    EXPECT_NEAR(number(own.reading().speed), number(rod.reading().speed), 1e-4);
}

// Energy and x(t) of a bead on y = x^2/2, released at x = 1: (1 + x^2) x'' + x x'^2 + g x = 0.
TEST(OwnJoints, ABeadStaysOnItsWireAndKeepsItsEnergy)
{
    TRACES("LC3", "IM1", "IM2");
    World world;
    Body bead = addDisc(world, {1, 0.5}, 0.05);
    Joint wire = world.createJoint(OnParabola{}, bead);
    const double start = world.energy().total();
    const double scale = number(bead.mass()) * kGravity * 0.5;
    double most = 0, off = 0;
    runSeconds(world, 100, 60, 4, [&] {
        most = std::max(most, std::abs(world.energy().total() - start));
        const DVec2 p = centerOf(bead);
        off = std::max(off, std::abs(p.y - p.x * p.x / 2));
        const double seconds = world.time();
        if (seconds > 9.999 && seconds < 10.001) {
            const auto exact = integrated(
                std::array<double, 2>{1, 0}, seconds, 20000, [](double, const std::array<double, 2>& y) {
                    return std::array<double, 2>{y[1],
                                                 -(y[0] * y[1] * y[1] + kGravity * y[0]) / (1 + y[0] * y[0])};
                });
            EXPECT_NEAR(p.x, exact[0], 2e-3);
            EXPECT_NEAR(wire.reading().position, p.x, 1e-9);
            EXPECT_NEAR(number(wire.reading().speed), exact[1], 1e-2);
        }
    });
    EXPECT_LT(most / scale, byPrecision(0.001, 0.005));
    EXPECT_LT(off, 1e-4);
    // The wire bears at the lowest point m g + m v^2/r, with r = 1 and v^2 = g: twice the weight.
    for (int step = 0; step < 300 && std::abs(centerOf(bead).x) > 0.03; ++step) world.step();
    EXPECT_LT(relativeError(number(wire.rowReadings()[0].force), 2 * number(bead.mass()) * kGravity), 0.01);
}

// J M^-1 J^T lambda = - J M^-1 tau.
TEST(OwnJoints, ADifferentialSharesATorqueAsItsRatiosSay)
{
    TRACES("LC3", "T4");
    for (const double heavy : {1.0, 1000.0}) {
        World world(weightless());
        Body post = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        std::vector<Body> wheels;
        const double inertias[] = {0.5, heavy, 2};
        const double ratios[] = {1, 1, -2};
        for (int i = 0; i < 3; ++i) {
            wheels.push_back(addDisc(world, {3.0 * i, 0}, 0.5, {.angle = 6 - 0.1 * i}));  // it turns over
            wheels.back().setMass({1, {}, toReal(inertias[i])});
            world.createJoint(revoluteAt(post, wheels.back(), {3.0 * i, 0}));
        }
        Joint joint = world.createJoint(Differential{}, wheels[0], wheels[1], wheels[2]);
        double sum = 0, turned[3] = {};
        for (int i = 0; i < 3; ++i) sum += ratios[i] * ratios[i] / inertias[i];
        const double torque = 2, lambda = -(ratios[0] * torque / inertias[0]) / sum;
        for (int step = 0; step < 120; ++step) {
            wheels[0].applyTorque(toReal(torque));
            world.step();
            for (int i = 0; i < 3; ++i)
                turned[i] += number(wheels[static_cast<std::size_t>(i)].angularVelocity()) / 60;
            EXPECT_LT(number(joint.reading().angularError), 1e-4) << "step " << step;
        }
        for (int i = 0; i < 3; ++i) {
            const double rate = ((i == 0 ? torque : 0) + ratios[i] * lambda) / inertias[i];
            EXPECT_NEAR(number(wheels[static_cast<std::size_t>(i)].angularVelocity()), 2 * rate,
                        1e-3 * std::abs(2 * rate) + 1e-5)
                << "wheel " << i << ", heavy " << heavy;
        }
        EXPECT_LT(relativeError(number(joint.rowReadings()[0].force), lambda), 0.01);
        EXPECT_LT(std::abs(turned[0] + turned[1] - 2 * turned[2]), 1e-4 * std::abs(turned[0]));
    }
}

// Two ends of a rod that turn about each other, of uneven masses, and a body that has to stay midway: it is
// pulled about by forces of its own joint alone.
TEST(OwnJoints, ABodyMidwayBetweenTwoOthersKeepsMomentumAndEnergy)
{
    TRACES("LC3", "T2", "DD15", "DD16");
    World world(weightless());
    const double masses[] = {1, 3, 5};
    const Vec2 velocities[] = {vec(0, 3), vec(0, 0.5), vec(0, -2)};
    std::vector<Body> all;
    for (int i = 0; i < 3; ++i) {
        all.push_back(addDisc(world, {2.0 * i, 0}, 0.1, {.velocity = velocities[i]}));
        all.back().setMass({toReal(masses[i]), {}, toReal(0.01)});
    }
    Joint midway = world.createJoint(Midway{}, all[0], all[1], all[2]);
    Joint rod = world.createJoint(OwnRod{{}, {}, 4}, all[0], all[2]);
    const Momentum before = world.momentum();
    const double energy = world.energy().total();
    double off = 0, most = 0;
    runSeconds(world, 20, 60, 4, [&] {
        off = std::max({off, number(midway.reading().error), number(rod.reading().error)});
        most = std::max(most, number(length(midway.reading().force)));
    });
    const Momentum after = world.momentum();
    EXPECT_GT(most, 1);  // it does bear something
    EXPECT_LT(length(after.linear - before.linear) / 10, byPrecision(1e-6, 1e-5));
    EXPECT_LT(std::abs(after.angular - before.angular) / std::abs(before.angular), byPrecision(1e-4, 2e-4));
    EXPECT_LT(std::abs(world.energy().total() - energy) / energy, 1e-3);
    EXPECT_LT(off, 1e-5);
}

// a_i = -g + lambda/(n m_i) with a mean of 0.
TEST(OwnJoints, TheMeanHeightOfManyIsKept)
{
    TRACES("LC3", "T2", "T1");
    World world;
    const double masses[] = {1, 2, 4, 0.5, 8, 1, 3, 0.25};
    std::vector<Body> all;
    double inverse = 0;
    for (int i = 0; i < 8; ++i) {
        all.push_back(addDisc(world, {2.0 * i, 0}, 0.1, {.velocity = vec(0.1 * i, 0)}));
        all.back().setMass({toReal(masses[i]), {}, toReal(0.01)});
        inverse += 1 / masses[i];
    }
    Joint joint =
        world.createJoint(MeanHeight<8>{}, all[0], all[1], all[2], all[3], all[4], all[5], all[6], all[7]);
    const double lambda = 64 * kGravity / inverse;
    runSeconds(world, 1);
    for (int i = 0; i < 8; ++i) {
        const double rate = -kGravity + lambda / (8 * masses[i]);
        const DVec2 c = centerOf(all[static_cast<std::size_t>(i)]);
        EXPECT_NEAR(c.y, rate / 2, 1e-3) << "body " << i;
        EXPECT_NEAR(c.x, 2.1 * i, 1e-4) << "body " << i;
    }
    EXPECT_LT(relativeError(number(joint.rowReadings()[0].force), lambda), 0.01);
    EXPECT_LT(number(joint.reading().error), 1e-4);
}

TEST(OwnJoints, AMotorReachesItsSpeedAndStallsAtItsForce)
{
    TRACES("LC3");
    for (const double strength : {1.5, 0.5}) {
        World world;
        Body cabin = addBox(world, {0, 0}, 1, 1);
        const double weight = number(cabin.mass()) * kGravity;
        Joint lift = world.createJoint(Lift{2, toReal(strength * weight)}, cabin);
        runSeconds(world, 1);
        const double force = number(lift.rowReadings()[0].force);
        if (strength > 1) {
            EXPECT_LT(relativeError(velocityOf(cabin).y, 2), 0.01);
            EXPECT_LT(relativeError(force, weight), 0.01);
            EXPECT_LT(relativeError(number(lift.reading().motorPower), 2 * weight), 0.01);
        } else {
            EXPECT_LT(relativeError(velocityOf(cabin).y, -kGravity / 2), 0.01);
            EXPECT_LT(relativeError(force, weight / 2), 0.01);
        }
        EXPECT_LT(relativeError(number(lift.reading().motorForce), force), 1e-5);
    }
}

// x = x0 exp(-z w t) cos(...): one of no damping, whose period and energy are known.
TEST(OwnJoints, ASpringSwingsAtItsFrequencyAndItsEnergyIsCounted)
{
    TRACES("LC3", "IM2");
    World world(weightless());
    Body bob = addDisc(world, {1, 0}, 0.2);
    const double stiffness = number(bob.mass()) * 4 * kPi * kPi * 4;  // 2 Hz
    Joint joint = world.createJoint(saying<1>([stiffness](ConstraintBodies at, ConstraintRows& rows) {
                                        rows.spring(at[0].center.x, toReal(stiffness)).move(0, {1, 0});
                                    }),
                                    bob);
    const double start = world.energy().total();
    EXPECT_LT(relativeError(start, stiffness / 2), 1e-5);
    EXPECT_LT(relativeError(joint.reading().springEnergy, stiffness / 2), 1e-5);
    int crossings = 0;
    double before = 1, first = 0, last = 0, most = 0;
    runSeconds(world, 20, 60, 4, [&] {
        const double x = centerOf(bob).x;
        if (before > 0 && x <= 0) {
            last = world.time() - x / (x - before) / 60;
            if (++crossings == 1) first = last;
        }
        before = x;
        most = std::max(most, std::abs(world.energy().total() - start) / start);
    });
    EXPECT_LT(relativeError((last - first) / (crossings - 1), 0.5), 0.01);
    EXPECT_LT(most, byPrecision(1e-3, 5e-3));
}

TEST(OwnJoints, ALoadOnARodAndOnARopeIsReadAsStaticsSays)
{
    TRACES("LC3", "T1");
    for (const double ratio : {1.0, 100.0, 1000.0}) {
        for (const bool isRope : {false, true}) {
            World world;
            Body last = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
            std::vector<Joint> joints;
            double hung = 0;
            for (int i = 1; i <= 4; ++i) {
                Body disc = addDisc(world, {0, -1.0 * i}, 0.1);
                disc.setMass({toReal(i == 4 ? ratio : 1), {}, toReal(0.01)});
                hung += number(disc.mass());
                joints.push_back(world.createJoint(OwnRod{{}, {}, 1, isRope}, last, disc));
                last = disc;
            }
            runSeconds(world, 3);
            for (std::size_t i = 0; i < joints.size(); ++i) {
                EXPECT_LT(relativeError(number(joints[i].reading().force.y), hung * kGravity), 0.01)
                    << "link " << i << ", ratio " << ratio << (isRope ? ", rope" : ", rod");
                EXPECT_LT(relativeError(std::abs(number(joints[i].rowReadings()[0].force)), hung * kGravity),
                          0.01);
                hung -= 1;
            }
        }
    }
}

// Released level, as the chains of built-in kinds are.
TEST(OwnJoints, ChainsOfRodsHoldLoadsAsTheBuiltInOnesDo)
{
    TRACES("LC3");
    for (const double ratio : {1.0, 100.0, 1000.0}) {
        double worst[2] = {};
        for (const bool own : {true, false}) {
            World world;
            Body last = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
            std::vector<Joint> joints;
            for (int i = 1; i <= 20; ++i) {
                Body disc = addDisc(world, {0.5 * i, 0}, 0.1);
                disc.setMass({toReal(i == 20 ? ratio : 1), {}, toReal(0.005 * (i == 20 ? ratio : 1))});
                joints.push_back(
                    own ? world.createJoint(OwnRod{{}, {}, 0.5}, last, disc)
                        : world.createJoint(rodBetween(last, disc, {0.5 * i - 0.5, 0}, {0.5 * i, 0})));
                last = disc;
            }
            double& most = worst[own ? 0 : 1];
            runSeconds(world, 10, 60, 4, [&] {
                double stretch = 0;
                for (const Joint& joint : joints) stretch += number(joint.reading().error);
                most = std::max(most, stretch / 10);
            });
        }
        EXPECT_LT(worst[0], ratio > 1 ? 0.0015 : 0.0025) << "ratio " << ratio << ": built-in " << worst[1];
        RecordProperty("stretch" + std::to_string(static_cast<int>(ratio)), std::to_string(worst[0]));
    }
}

// Bars of three points each: 3-body joints share bodies, and are solved at once.
TEST(OwnJoints, JointsOfThreeBodiesTakeTurnsUnderHeavyLoads)
{
    TRACES("LC3");
    for (const double ratio : {1.0, 1000.0}) {
        World world;
        Body first = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        std::vector<Body> all{first};
        std::vector<Joint> joints;
        for (int i = 1; i <= 8; ++i) {
            all.push_back(addDisc(world, {0.5 * i, 0}, 0.05));
            const double mass = i == 8 ? ratio : 1;
            all.back().setMass({toReal(mass), {}, toReal(0.01 * mass)});
        }
        for (std::size_t i = 0; i + 2 < all.size(); ++i)
            joints.push_back(world.createJoint(Midway{}, all[i], all[i + 1], all[i + 2]));
        joints.push_back(world.createJoint(OwnRod{{}, {}, 0.5}, all[0], all[1]));
        double most = 0;
        const double start = world.energy().total();
        double gained = 0;
        runSeconds(world, 10, 60, 4, [&] {
            for (const Joint& joint : joints) most = std::max(most, number(joint.reading().error));
            gained = std::max(gained, world.energy().total() - start);
        });
        EXPECT_LT(most, 1e-3) << "ratio " << ratio;
        EXPECT_LT(gained / (number(all.back().mass()) * kGravity), 0.005) << "ratio " << ratio;
        EXPECT_TRUE(world.validate().empty());
    }
}

TEST(OwnJoints, HaveTheSameBitsOnAnyNumberOfThreads)
{
    TRACES("LC3", "ADR6", "ADR28");
    const auto hashOf = [](int threads) {
        WorldDef def;
        def.threads = threads;
        World world(def);
        addGround(world);
        std::vector<Body> all;
        for (int i = 0; i < 30; ++i) all.push_back(addBox(world, {0.6 * i - 9, 3 + 0.1 * i}, 0.5, 0.4));
        for (std::size_t i = 0; i + 2 < all.size(); i += 3)
            world.createJoint(Midway{}, all[i], all[i + 1], all[i + 2]);
        for (std::size_t i = 0; i + 4 < all.size(); i += 4)
            world.createJoint(OwnRod{{}, {}, 2.4}, all[i], all[i + 4]);
        runSeconds(world, 3);
        return world.stateHash();
    };
    const std::uint64_t one = hashOf(1);
    EXPECT_EQ(hashOf(2), one);
    EXPECT_EQ(hashOf(4), one);
}

}  // namespace
}  // namespace tamias2d
