// SPDX-License-Identifier: MIT
#include "solver/body_kernels.hpp"
#include "solver/integrate.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace tamias2d {
namespace {

constexpr double kStepTolerance = std::is_same_v<real, double> ? 1e-13 : 1e-5;

// One body that moves freely, by the kernels of a width: more copies of it than lanes, which must not differ.
class FreeBody {
public:
    FreeBody(LaneWidth width, const Motion& m, real damping, double h)
        : context_(makeStepContext({}, 1, 0, 2 * h, 1)), kernels_(bodyKernels(width)), copies_(19, m)
    {
        for (Motion& copy : copies_) {
            copy.damping = copy.spinDamping = damping;
            startDamping(copy, context_.h);
        }
        rows_.origins.resize(copies_.size());
        rows_.poses.resize(copies_.size());
        rows_.velocities.resize(copies_.size());
        rows_.pushes.resize(copies_.size());
        rows_.changes.resize(copies_.size());
        rows_.kicks.resize(copies_.size());
        rows_.ways.resize(copies_.size());
    }

    void tick()
    {
        kickFirst();
        for (Motion& copy : copies_) copy.steady = {}, copy.steadySpin = 0;  // it touches nothing
        kernels_.drift(all(), context_, false, false, false);
        kickSecond();
    }
    void kickFirst() { kernels_.kick(all(), context_, false); }
    void kickSecond() { kernels_.kickAfterDrift(all(), context_, false, false); }
    template <class Change>
    void change(Change make)
    {
        for (Motion& copy : copies_) make(copy);
    }
    const Motion& motion() const
    {
        for (const Motion& copy : copies_) {
            EXPECT_EQ(copy.velocity, copies_[0].velocity);
            EXPECT_EQ(copy.spin, copies_[0].spin);
            EXPECT_EQ(copy.center, copies_[0].center);
            EXPECT_EQ(copy.angle, copies_[0].angle);
        }
        return copies_[0];
    }

private:
    StepContext context_;
    const BodyKernels& kernels_;
    std::vector<Motion> copies_;
    TickRows rows_;

    BodyRows all() { return {copies_.data(), rows_, 0, static_cast<std::uint32_t>(copies_.size())}; }
};

std::vector<LaneWidth> widths()
{
    std::vector<LaneWidth> here;
    for (const LaneWidth width :
         {LaneWidth::Scalar, LaneWidth::Bytes16, LaneWidth::Bytes32, LaneWidth::Bytes64})
        if (hasLanes(width)) here.push_back(width);
    return here;
}

// v' = a - c v from v0, exactly.
struct Damped {
    double c, a, v0;
    double grown(double t) const { return -std::expm1(-c * t) / c; }
    double velocity(double t) const { return v0 * std::exp(-c * t) + a * grown(t); }
    double position(double t) const { return v0 * grown(t) + a * (t - grown(t)) / c; }
};

TEST(Integration, OfExponentialDampingWithAConstantForceIsExact)
{
    TRACES("LC2", "IM1", "IM2");
    for (const double c : {1e-3, 0.1, 2.0, 24.0, 300.0}) {
        const double h = 1.0 / 240;
        Motion start;
        start.velocity = {3, 0};
        start.spin = 3;
        start.acceleration = {5, 0};
        start.spinRate = 5;
        start.invMass = {1, 1};
        start.invInertia = 1;
        for (const LaneWidth width : widths()) {
            FreeBody body(width, start, real(c), h);
            double turned = 0, before = start.angle;
            for (int i = 0; i < 240; ++i) {
                body.tick();
                const double angle = body.motion().angle;
                turned += angle - before + (angle < before ? kTwoPi : 0.0);
                before = angle;
            }
            const Motion& m = body.motion();
            const Damped exact{c, 5, 3};
            EXPECT_NEAR(m.velocity.x / exact.velocity(1), 1, 100 * kStepTolerance) << "c = " << c;
            EXPECT_NEAR(m.center.x / exact.position(1), 1, 100 * kStepTolerance) << "c = " << c;
            EXPECT_NEAR(m.spin / exact.velocity(1), 1, 100 * kStepTolerance) << "c = " << c;
            EXPECT_NEAR(turned / exact.position(1), 1, 100 * kStepTolerance) << "c = " << c;
        }
    }
}

// Of all strengths: as from v0 = 0 a body falls all the way, it must never climb.
TEST(Integration, OfATickIsExactForEveryStrengthOfDamping)
{
    TRACES("LC2", "IM1", "IM2");
    const double h = 1.0 / 512, exact = std::is_same_v<real, double> ? 1e-13 : 3e-7;
    for (const double v0 : {0.0, 3.0}) {
        for (double ch = 1e-9; ch < 2e6; ch *= 1.7) {
            const double c = static_cast<double>(real(ch / h)), a = -10;
            Motion start;
            start.velocity = {real(v0), 0};
            start.spin = real(v0);
            start.acceleration = {real(a), 0};
            start.spinRate = real(a);
            start.invMass = {1, 1};
            start.invInertia = 1;

            // The two parts of the truth, as their sum may cancel.
            const Damped slowed{c, 0, v0}, force{c, a, 0};
            double series = 1;
            for (const int n : {8, 7, 6, 5, 4, 3}) series = 1 - c * h / n * series;
            const double fall = c * h > 0.02 ? force.position(h) : a * h * h / 2 * series;
            const double speed = std::abs(slowed.velocity(h)) + std::abs(force.velocity(h));
            const double way = slowed.position(h) + std::abs(fall);
            for (const LaneWidth width : widths()) {
                FreeBody body(width, start, real(c), h);
                body.tick();
                const Motion& m = body.motion();
                EXPECT_NEAR(m.velocity.x, slowed.velocity(h) + force.velocity(h), exact * speed)
                    << "c h = " << ch;
                EXPECT_NEAR(m.center.x, slowed.position(h) + fall, exact * way) << "c h = " << ch;
                EXPECT_EQ(m.spin, m.velocity.x);
                EXPECT_EQ(m.angle, wrapAngle(m.center.x));
            }
        }
    }
}

// A kick too small to show is not lost; one that the velocity does not stem from is forgotten.
TEST(Integration, SmallKicksAddUpUntilTheVelocityIsSet)
{
    TRACES("IM1", "IM2");
    const real half = std::numeric_limits<real>::epsilon() / 4;  // a quarter of the last digit of 1
    Motion start;
    start.invMass = {1, 1};
    start.invInertia = 1;
    start.velocity = {1, 1};
    start.spin = 1;
    start.acceleration = {2 * half, 0};
    start.spinRate = 2 * half;
    for (const LaneWidth width : widths()) {
        FreeBody body(width, start, 0, 1);
        for (int i = 0; i < 8; ++i) {
            body.kickFirst();
            body.change([](Motion& m) { m.steady = {}, m.steadySpin = 0; });
            body.kickSecond();
            body.change([](Motion& m) { m.steady = {}, m.steadySpin = 0; });
        }
        const real grown = std::is_same_v<real, double> ? real(1) : 1 + 16 * half;
        EXPECT_EQ(body.motion().velocity.x, grown);
        EXPECT_EQ(body.motion().velocity.y, 1);
        EXPECT_EQ(body.motion().spin, grown);

        body.change([](Motion& m) { m.velocity.x = 2, m.acceleration = {}; });
        body.kickFirst();
        EXPECT_EQ(body.motion().velocity.x, 2);
    }
}

TEST(Integration, ClampsSpeedAtTheBoundAndSaysSo)
{
    TRACES("DC-v", "DC-omega");
    Motion m;
    m.velocity = {real(3e6), real(4e6)};
    EXPECT_TRUE(clampSpeed(m, 1));
    EXPECT_NEAR(length(m.velocity) / real(1e6), 1, 1e-6);
    EXPECT_FALSE(clampSpeed(m, 2));
}

}  // namespace
}  // namespace tamias2d
