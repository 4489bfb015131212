// SPDX-License-Identifier: MIT
// Pendulums against their closed forms: energy, period, reaction.
#include "support/pendulum.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

enum class Hung { ByPivot, ByRod };

struct Pendulum : LevelPendulum {
    Joint joint;

    explicit Pendulum(Hung hung)
        : joint(world.createJoint(hung == Hung::ByPivot ? revoluteAt(pivot, bob, {0, 0})
                                                        : rodBetween(pivot, bob, {0, 0}, {1, 0})))
    {
    }
};

class PendulumOf : public testing::TestWithParam<Hung> {};

TEST_P(PendulumOf, KeepsItsEnergyAndItsPeriodForAHundredSeconds)
{
    TRACES("LC3", "IM1", "IM2", "DD15", "DD16");
    Pendulum p(GetParam());
    const Swings swings = swingForAHundredSeconds(p);
    EXPECT_LT(swings.mostEnergy / kGravity, byPrecision(0.001, 0.005));
    EXPECT_GT(swings.count, 40);
    EXPECT_LT(relativeError(swings.period, p.exactPeriod(GetParam() == Hung::ByPivot)), 1e-4);
    EXPECT_LT(static_cast<double>(p.joint.reading().error), 1e-5);
}

// At the lowest point the pivot bears the weight and turns the bob's momentum: m g + 2 g m in all for a
// point; T = m g + m v^2 / l, with v^2 from the energy.
TEST_P(PendulumOf, ItsPivotBearsWeightAndCentripetalForce)
{
    TRACES("LC3", "T2", "DD10");
    Pendulum p(GetParam());
    const double turning = GetParam() == Hung::ByPivot ? static_cast<double>(p.bob.inertia()) : 0;
    const double speedSquared = 2 * kGravity / (1 + turning);
    double greatest = 0;
    runSeconds(p.world, 3, 60, 4,
               [&] { greatest = std::max(greatest, length(toDVec2(p.joint.reading().force))); });
    EXPECT_LT(relativeError(greatest, kGravity + speedSquared), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Joints, PendulumOf, testing::Values(Hung::ByPivot, Hung::ByRod));

TEST(Pendulum, ErrorsFallWithTheSquareOfTheStep)
{
    TRACES("LC3", "NFR2");
    const auto driftAt = [](int substeps) {
        Pendulum p(Hung::ByRod);
        const double start = p.world.energy().total();
        double most = 0;
        runSeconds(p.world, 10, 60, substeps,
                   [&] { most = std::max(most, std::abs(p.world.energy().total() - start)); });
        return most;
    };
    const double coarse = driftAt(1), fine = driftAt(2);
    EXPECT_GT(coarse / fine, 3.5) << coarse << " J and " << fine << " J";
}

TEST(Pendulum, AnHourOfTurnsIsCounted)
{
    TRACES("LC3", "DD5");
    World world(weightless());
    Body pivot = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body wheel = addDisc(world, {0, 0.5}, 0.2, {.spin = 9});
    Joint joint = world.createJoint(revoluteAt(pivot, wheel, {0, 0.5}));
    runSeconds(world, 60);
    EXPECT_NEAR(joint.reading().position, 540, byPrecision(1e-6, 1e-2));
    EXPECT_NEAR(static_cast<double>(joint.reading().speed), 9, 1e-5);
}

}  // namespace
}  // namespace tamias2d
