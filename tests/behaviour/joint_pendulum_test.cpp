// SPDX-License-Identifier: MIT
// Pendulums against their closed forms: energy, period, reaction.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

constexpr double kGravity = 9.81;              // [m/s^2]
constexpr double kQuarterPeriod = 1.8540746773013719;  // K(sin 45 degrees): released from level

enum class Hung { ByPivot, ByRod };

// A disc of 1 kg, its center 1 m from a static pivot, released from level.
struct Pendulum {
    World world;
    Body pivot = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body bob = addDisc(world, {1, 0}, 0.1, {.density = 1 / (kPi * 0.01)});
    Joint joint;

    explicit Pendulum(Hung hung)
        : joint(world.createJoint(hung == Hung::ByPivot ? revoluteAt(pivot, bob, {0, 0})
                                                        : rodBetween(pivot, bob, {0, 0}, {1, 0})))
    {
    }

    /// On a pivot the disc turns with the swing, on a rod it need not.
    double exactPeriod(Hung hung) const
    {
        const double turning = hung == Hung::ByPivot ? static_cast<double>(bob.inertia()) : 0;
        return 4 * kQuarterPeriod * std::sqrt((1 + turning) / kGravity);
    }
};

class PendulumOf : public testing::TestWithParam<Hung> {};

TEST_P(PendulumOf, KeepsItsEnergyAndItsPeriodForAHundredSeconds)
{
    TRACES("LC3", "IM1", "IM2", "DD15", "DD16");
    Pendulum p(GetParam());
    const double start = p.world.energy().total();
    double most = 0, first = 0, last = 0, angle = -1;
    int swings = 0;
    runSeconds(p.world, 100, 60, 4, [&] {
        most = std::max(most, std::abs(p.world.energy().total() - start));
        const DVec2 c = centerOf(p.bob);
        const double now = std::atan2(c.x, -c.y);
        if (angle < 0 && now >= 0 && now < 1) {  // through the lowest point, from left to right
            last = p.world.time() - now / (now - angle) / 60;
            if (++swings == 1) first = last;
        }
        angle = now;
    });
    EXPECT_LT(most / kGravity, byPrecision(0.001, 0.005));
    EXPECT_GT(swings, 40);
    EXPECT_LT(relativeError((last - first) / (swings - 1), p.exactPeriod(GetParam())), 1e-4);
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
