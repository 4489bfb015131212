// SPDX-License-Identifier: MIT
// The reference is the system's maths library in long double, good to 2^-64.
#include "support/traces.hpp"

#include <tamias2d/math/scalar.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace tamias2d::test {
namespace {

constexpr double kUlp = 0x1p-52;  // of 1
constexpr int kSamples = 100000;

// The larger of the two errors, in units of the last place of 1.
double errorOfSinCos(double angle)
{
    const SinCos sc = sinCos(angle);
    const long double exact = angle;
    const long double s = std::fabs(sc.sin - std::sin(exact)), c = std::fabs(sc.cos - std::cos(exact));
    return static_cast<double>(std::max(s, c)) / kUlp;
}

double worstOfSinCos(double range)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> angles(-range, range);
    double worst = 0;
    for (int i = 0; i < kSamples; ++i) worst = std::max(worst, errorOfSinCos(angles(random)));
    return worst;
}

TEST(SineAndCosine, AreWithinTwoUlpOverOneTurn)
{
    TRACES("ADR6");
    EXPECT_LE(worstOfSinCos(kTwoPi), 2.0);
}

TEST(SineAndCosine, AreWithinTwoUlpHoweverLongTheAngle)
{
    TRACES("ADR6");
    for (const double range : {1e-300, 1e-8, 1.0, 100.0, 9.9e4, 1.1e5, 1e9, 1e15, 1e18})
        EXPECT_LE(worstOfSinCos(range), 2.0) << "angles up to " << range;
}

// Long double keeps too few bits for these. The values were computed with 1500 bits; the last angle is
// among those that come nearest to a multiple of pi / 2.
TEST(SineAndCosine, AreRightForTheLongestAngles)
{
    TRACES("ADR6");
    struct Known {
        double angle, sin, cos;
    };
    const Known table[] = {
        {1e22, -0.85220084976718880177, 0.5232147853951389455},
        {-3.5e40, 0.61069756917981830396, -0.79186392707198187965},
        {6.02e123, 0.47144521651493371128, -0.88189534970153191882},
        {1e300, -0.81788191211590859705, -0.57538611195754904669},
        {1.7976931348623157e308, 0.0049619547891840617905, -0.99998768942655993746},
        {5.319372648326541e255, 1.0, -4.6871659242546276111e-19},
    };
    for (const Known& known : table) {
        EXPECT_NEAR(sinCos(known.angle).sin, known.sin, 2 * kUlp) << known.angle;
        EXPECT_NEAR(sinCos(known.angle).cos, known.cos, 2 * kUlp) << known.angle;
    }
}

TEST(SineAndCosine, AreExactAtZeroAndMirrored)
{
    TRACES("ADR6");
    EXPECT_EQ(sinCos(0).sin, 0);
    EXPECT_EQ(sinCos(0).cos, 1);
    for (double angle = 0.01; angle < 1e6; angle *= 1.37) {
        EXPECT_EQ(sinCos(-angle).sin, -sinCos(angle).sin) << angle;
        EXPECT_EQ(sinCos(-angle).cos, sinCos(angle).cos) << angle;
    }
}

TEST(SineAndCosine, OfWhatIsNoNumberAreNoNumber)
{
    TRACES("R4");
    for (const double angle :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_TRUE(std::isnan(sinCos(angle).sin)) << angle;
        EXPECT_TRUE(std::isnan(sinCos(angle).cos)) << angle;
        EXPECT_TRUE(std::isnan(wrapAngle(angle))) << angle;
    }
}

TEST(Exponential, IsWithinTwoUlp)
{
    TRACES("ADR6");
    std::mt19937_64 random(3);
    for (const double range : {1e-9, 0.1, 1.0, 20.0, 708.0}) {
        std::uniform_real_distribution<double> exponents(-range, range);
        double worst = 0;
        for (int i = 0; i < kSamples; ++i) {
            const double x = exponents(random);
            const long double exact = std::exp(static_cast<long double>(x));
            worst = std::max(worst, static_cast<double>(std::fabs(exponential(x) - exact) / exact) / kUlp);
        }
        EXPECT_LE(worst, 2.0) << "exponents up to " << range;
    }
}

TEST(Exponential, MeetsItsEndsWithoutSurprise)
{
    TRACES("ADR6");
    EXPECT_EQ(exponential(0), 1);
    EXPECT_NEAR(exponential(709.7) / std::exp(709.7), 1, 2 * kUlp);
    EXPECT_GT(exponential(-745), 0);  // a subnormal
    EXPECT_EQ(exponential(-800), 0);
    EXPECT_EQ(exponential(-1e300), 0);
    EXPECT_EQ(exponential(1e300), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(exponential(std::numeric_limits<double>::quiet_NaN())));
}

TEST(WrappedAngles, LieInOneTurnAndPointTheSameWay)
{
    TRACES("ADR6", "R4");
    std::mt19937_64 random(4);
    for (const double range : {1e-20, 1.0, 7.0, 1e3, 1e6, 1e12}) {
        std::uniform_real_distribution<double> angles(-range, range);
        for (int i = 0; i < 10000; ++i) {
            const double angle = angles(random), wrapped = wrapAngle(angle);
            ASSERT_GE(wrapped, 0) << angle;
            ASSERT_LT(wrapped, kTwoPi) << angle;
            const long double far = angle, near = wrapped;
            ASSERT_NEAR(static_cast<double>(std::sin(far) - std::sin(near)), 0, 8 * kUlp) << angle;
            ASSERT_NEAR(static_cast<double>(std::cos(far) - std::cos(near)), 0, 8 * kUlp) << angle;
        }
    }
}

TEST(WrappedAngles, NeverReachTheFullTurn)
{
    TRACES("R4");
    const double justBelow = std::nextafter(kTwoPi, 0.0);
    EXPECT_EQ(wrapAngle(justBelow), justBelow);
    for (const double angle : {-1e-20, -0x1p-1074, kTwoPi, -kTwoPi, 1e300, -1e300,
                               std::nextafter(kTwoPi, 7.0), 1.7976931348623157e308}) {
        EXPECT_GE(wrapAngle(angle), 0) << angle;
        EXPECT_LT(wrapAngle(angle), kTwoPi) << angle;
    }
    EXPECT_FALSE(std::signbit(wrapAngle(-0.0)));
}

TEST(WrappedAngles, StayAsTheyAreWithinTheTurn)
{
    TRACES("R4");
    for (double angle = 0; angle < kTwoPi; angle += 0.013) EXPECT_EQ(wrapAngle(angle), angle);
}

// The value was computed once with g++ -O0; any other compiler, optimisation or processor must agree.
TEST(MathBits, AreTheSameOnEveryPlatform)
{
    TRACES("ADR6");
    std::uint64_t hash = 14695981039346656037u;
    const auto mix = [&](double value) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
    };
    for (int i = -20000; i <= 20000; ++i) {
        const double x = i * 0.0007 + i * (i % 7) * 31.0;
        const SinCos sc = sinCos(x);
        mix(sc.sin);
        mix(sc.cos);
        mix(exponential(i * 0.035));
        mix(wrapAngle(x * x * x));
    }
    EXPECT_EQ(hash, 0x1c787f1143d74cdau);
}

}  // namespace
}  // namespace tamias2d::test
