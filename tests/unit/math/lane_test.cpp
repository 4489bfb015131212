// SPDX-License-Identifier: MIT
#include "math/lane_rows.hpp"
#include "support/same_bits.hpp"
#include "support/traces.hpp"

#include <tamias2d/math/scalar.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tamias2d {
namespace {

using test::sameBits;

constexpr real kInfinity = std::numeric_limits<real>::infinity();

// Numbers of all kinds, one to each lane.
template <int W>
Lane<W> anyNumbers(std::mt19937& random)
{
    const real special[] = {0,
                            real(-0.0),
                            1,
                            -1,
                            kInfinity,
                            -kInfinity,
                            std::numeric_limits<real>::quiet_NaN(),
                            std::numeric_limits<real>::denorm_min()};
    std::uniform_real_distribution<real> ordinary(-10, 10);
    Lane<W> wide;
    for (int i = 0; i < W; ++i) wide.v[i] = random() % 3 == 0 ? special[random() % 8] : ordinary(random);
    return wide;
}

TEST(Lanes, AreReadAndWrittenBitForBit)
{
    TRACES("ADR6");
    using Wide = Lane<kLanes>;
    std::mt19937 random(2);
    for (int trial = 0; trial < 500; ++trial) {
        Vec2 vectors[kLanes];
        real reals[kLanes], written[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const Wide any = anyNumbers<kLanes>(random);
            vectors[i] = {any.v[0], any.v[1]};
            reals[i] = any.v[0];
        }
        const BasicVec2<Wide> apart = loadVectors<kLanes>(vectors);
        storeLane(loadLane(reals), written);
        for (int i = 0; i < kLanes; ++i) {
            EXPECT_TRUE(sameBits(apart.x.v[i], vectors[i].x)) << i;
            EXPECT_TRUE(sameBits(apart.y.v[i], vectors[i].y)) << i;
            EXPECT_TRUE(sameBits(written[i], reals[i])) << i;
            EXPECT_TRUE(sameBits(Wide(reals[0]).v[i], reals[0])) << i << ": " << reals[0];
        }
    }
}

template <int W>
void expectTheBitsOfOneReal()
{
    using Wide = Lane<W>;
    std::mt19937 random(1);
    for (int trial = 0; trial < 5000; ++trial) {
        const Wide a = anyNumbers<W>(random), b = anyNumbers<W>(random), c = anyNumbers<W>(random);
        const std::pair<const char*, Wide> results[] = {{"sum", a + b},
                                                        {"difference", a - b},
                                                        {"product", a * b},
                                                        {"quotient", a / b},
                                                        {"opposite", -a},
                                                        {"minimum", minimum(a, b)},
                                                        {"maximum", maximum(a, b)},
                                                        {"absolute", absolute(a)},
                                                        {"square root", squareRoot(a)},
                                                        {"clamp", clamp(a, b, c)},
                                                        {"select", select(a < b, a, c)},
                                                        {"select both", select((a > b) & (b >= c), a, c)},
                                                        {"select none", select(!((a > b) | (b > c)), a, c)}};
        for (int i = 0; i < W; ++i) {
            const real x = a.v[i], y = b.v[i], z = c.v[i];
            const real expected[] = {x + y,
                                     x - y,
                                     x * y,
                                     x / y,
                                     -x,
                                     minimum(x, y),
                                     maximum(x, y),
                                     absolute(x),
                                     std::sqrt(x),
                                     clamp(x, y, z),
                                     select(x < y, x, z),
                                     select((x > y) & (y >= z), x, z),
                                     select(!((x > y) | (y > z)), x, z)};
            for (std::size_t k = 0; k < std::size(results); ++k)
                EXPECT_TRUE(sameBits(results[k].second.v[i], expected[k]))
                    << results[k].first << " of " << x << ", " << y << ", " << z << ": "
                    << results[k].second.v[i] << " instead of " << expected[k];
        }
    }
}

TEST(Lanes, OfAnyWidthReckonAsOneRealDoes)
{
    TRACES("ADR5", "ADR6");
    expectTheBitsOfOneReal<1>();
    expectTheBitsOfOneReal<16 / sizeof(real)>();
    expectTheBitsOfOneReal<32 / sizeof(real)>();
    expectTheBitsOfOneReal<64 / sizeof(real)>();
}

template <int W>
void expectMasksThatHold()
{
    Lane<W> a;
    EXPECT_FALSE(any(a < Lane<W>(real(0)))) << W;
    a.v[W - 1] = -1;
    EXPECT_TRUE(any(a < Lane<W>(real(0)))) << W;
    EXPECT_EQ(bitsOf(a < Lane<W>(real(0))), 1u << (W - 1)) << W;
    for (const std::uint32_t bits : {0u, 1u, 1u << (W - 1), (1u << W) - 1})
        EXPECT_EQ(bitsOf(maskOf<W>(bits)), bits);
}

TEST(Lanes, MasksTellWhereSomethingHolds)
{
    TRACES("ADR5", "ADR6");
    expectMasksThatHold<1>();
    expectMasksThatHold<16 / sizeof(real)>();
    expectMasksThatHold<32 / sizeof(real)>();
    expectMasksThatHold<64 / sizeof(real)>();
}

template <int W>
void expectRowsComeOutAgain()
{
    std::mt19937 random(W);
    LaneRow rows[40];
    for (int i = 0; i < 40; ++i) rows[i] = {real(i), real(100 + i), real(200 + i), real(300 + i)};
    std::uint32_t at[W];
    for (int i = 0; i < W; ++i) at[i] = static_cast<std::uint32_t>((7 * i + 3) % 40);
    FourLanes<W> lanes = gatherRows<W>(rows, at);
    for (int i = 0; i < W; ++i) {
        EXPECT_EQ(lanes.x.v[i], real(at[i])) << W;
        EXPECT_EQ(lanes.y.v[i], real(100 + at[i])) << W;
        EXPECT_EQ(lanes.z.v[i], real(200 + at[i])) << W;
        EXPECT_EQ(lanes.w.v[i], real(300 + at[i])) << W;
    }
    const std::uint32_t written = static_cast<std::uint32_t>(random());
    lanes.x += Lane<W>(real(1000));
    lanes.w += Lane<W>(real(2000));
    scatterRows<W>(lanes, rows, at, written);
    for (std::uint32_t i = 0; i < 40; ++i) {
        bool isWritten = false;
        for (int lane = 0; lane < W; ++lane)
            isWritten = isWritten || (at[lane] == i && (written >> lane & 1u) != 0);
        EXPECT_EQ(rows[i].x, real(i + (isWritten ? 1000 : 0))) << "row " << i << " of width " << W;
        EXPECT_EQ(rows[i].y, real(100 + i)) << "row " << i << " of width " << W;
        EXPECT_EQ(rows[i].z, real(200 + i)) << "row " << i << " of width " << W;
        EXPECT_EQ(rows[i].w, real(300 + i + (isWritten ? 2000 : 0))) << "row " << i << " of width " << W;
    }
}

TEST(Lanes, RowsGoInAndComeOutAgain)
{
    TRACES("ADR5", "ADR6");
    expectRowsComeOutAgain<1>();
    expectRowsComeOutAgain<16 / sizeof(real)>();
    expectRowsComeOutAgain<32 / sizeof(real)>();
    expectRowsComeOutAgain<64 / sizeof(real)>();
}

}  // namespace
}  // namespace tamias2d
