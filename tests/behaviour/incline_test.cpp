// SPDX-License-Identifier: MIT
// Sliding, sticking and rolling on a slope, against Coulomb's law and the rolling disc of the textbooks.
#include <support/run.hpp>
#include <support/scenes.hpp>

namespace tamias2d::test {
namespace {

constexpr double kAcceleration = 0.005;  // of the closed form
constexpr double kCreep = 1e-3;          // [m]

double g(const World& world)
{
    return -static_cast<double>(world.definition().gravity.y);
}

// A slope through the origin that falls to the right by `angle`, and points given along and over it.
class Slope {
public:
    Slope(World& world, double angle, double friction) : angle_(angle)
    {
        const Position middle = at(200, -0.5);
        addBox(world, middle, 600, 1, {.type = BodyType::Static, .angle = -angle, .friction = friction});
    }

    Position at(double along, double over) const
    {
        return {std::cos(angle_) * along + std::sin(angle_) * over,
                -std::sin(angle_) * along + std::cos(angle_) * over};
    }
    double along(DVec2 v) const { return std::cos(angle_) * v.x - std::sin(angle_) * v.y; }

private:
    double angle_;
};

double radians(double degrees)
{
    return degrees * kPi / 180;
}

struct Case {
    double degrees, friction;
};

TEST(Incline, ABoxSlidesWithTheAccelerationOfCoulombsLaw)
{
    TRACES("R8", "R5", "GD2");
    for (const Case c : {Case{17.2, 0.3}, Case{20, 0.3}, Case{30, 0.2}, Case{45, 0.6}, Case{35, 0}}) {
        World world;
        const double angle = radians(c.degrees);
        const Slope slope(world, angle, c.friction);
        const Body box = addBox(world, slope.at(0, 0.5 + restGapFor(world, 1)), 1, 1,
                                {.angle = -angle, .friction = c.friction});
        const DVec2 start = centerOf(box);
        runSeconds(world, 1);
        const double early = slope.along(velocityOf(box));
        runSeconds(world, 4);
        const double late = slope.along(velocityOf(box));
        const double expected = g(world) * (std::sin(angle) - c.friction * std::cos(angle));
        const double inMotion = (late - early) / 4, fromRest = late / 5;
        EXPECT_LE(relativeError(inMotion, expected), kAcceleration) << c.degrees << " deg: " << inMotion;
        EXPECT_LE(relativeError(fromRest, expected), kAcceleration) << c.degrees << " deg: " << fromRest;
        record("inMotion_" + std::to_string(int(10 * c.degrees)), inMotion / expected - 1);
        record("byWay_" + std::to_string(int(10 * c.degrees)),
               slope.along(centerOf(box) - start) / (12.5 * expected) - 1);
        record("fromRest_" + std::to_string(int(10 * c.degrees)), fromRest / expected - 1);
    }
}

TEST(Incline, BelowTheAngleOfFrictionABoxCreepsLessThanAMillimetreInTenMinutes)
{
    TRACES("R8", "R5");
    for (const Case c : {Case{16, 0.3}, Case{30, 0.6}, Case{10, 0.6}}) {
        World world;
        const double angle = radians(c.degrees);
        const Slope slope(world, angle, c.friction);
        const Body box = addBox(world, slope.at(0, 0.5 + restGapFor(world, 1)), 1, 1,
                                {.angle = -angle, .friction = c.friction});
        const DVec2 start = centerOf(box);
        runSeconds(world, 600);
        const double creep = std::abs(slope.along(centerOf(box) - start));
        EXPECT_LE(creep, kCreep) << c.degrees << " deg";
        EXPECT_LE(std::abs(spinOf(box)), 1e-6);
        record("creep_m_" + std::to_string(int(c.degrees)), creep);
    }
}

TEST(Incline, ADiscRollsWithTwoThirdsOfGSine)
{
    TRACES("R8", "R6", "DD14");
    for (const Case c : {Case{5, 0.6}, Case{20, 0.6}, Case{30, 0.6}, Case{45, 0.6}}) {
        World world;
        const double angle = radians(c.degrees);
        const Slope slope(world, angle, c.friction);
        const Body disc =
            addDisc(world, slope.at(0, 0.5 + restGapFor(world, 1)), 0.5, {.friction = c.friction});
        const double seconds = 5;
        runSeconds(world, seconds);
        const double expected = 2.0 / 3 * g(world) * std::sin(angle);
        const double speed = slope.along(velocityOf(disc));
        EXPECT_LE(relativeError(speed / seconds, expected), kAcceleration) << c.degrees << " deg";
        EXPECT_LE(relativeError(-spinOf(disc) * 0.5, speed), kAcceleration) << c.degrees << " deg";
        record("relativeError_" + std::to_string(int(c.degrees)), speed / seconds / expected - 1);
    }
}

}  // namespace
}  // namespace tamias2d::test
