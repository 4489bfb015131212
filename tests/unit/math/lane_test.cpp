// SPDX-License-Identifier: MIT
#include "math/lane.hpp"
#include "support/traces.hpp"

#include <tamias2d/math/scalar.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tamias2d {
namespace {

using Wide = Lane<kLanes>;

constexpr real kInfinity = std::numeric_limits<real>::infinity();

// Equal in all bits; two NaN count as equal.
bool sameBits(real a, real b)
{
    return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

// Numbers of all kinds, one to each lane.
Wide anyNumbers(std::mt19937& random)
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
    Wide wide;
    for (int i = 0; i < kLanes; ++i) wide.v[i] = random() % 3 == 0 ? special[random() % 8] : ordinary(random);
    return wide;
}

TEST(Lanes, AreReadAndWrittenBitForBit)
{
    TRACES("ADR6");
    std::mt19937 random(2);
    for (int trial = 0; trial < 500; ++trial) {
        Vec2 vectors[kLanes];
        real reals[kLanes], written[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            const Wide any = anyNumbers(random);
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

TEST(Lanes, ReckonAsOneRealDoes)
{
    TRACES("ADR5", "ADR6");
    std::mt19937 random(1);
    for (int trial = 0; trial < 5000; ++trial) {
        const Wide a = anyNumbers(random), b = anyNumbers(random), c = anyNumbers(random);
        const std::pair<const char*, Wide> results[] = {{"sum", a + b},
                                                        {"difference", a - b},
                                                        {"product", a * b},
                                                        {"quotient", a / b},
                                                        {"opposite", -a},
                                                        {"minimum", minimum(a, b)},
                                                        {"maximum", maximum(a, b)},
                                                        {"absolute", absolute(a)},
                                                        {"clamp", clamp(a, b, c)},
                                                        {"select", select(a < b, a, c)},
                                                        {"select both", select((a > b) & (b >= c), a, c)},
                                                        {"select none", select(!((a > b) | (b > c)), a, c)}};
        for (int i = 0; i < kLanes; ++i) {
            const real x = a.v[i], y = b.v[i], z = c.v[i];
            const real expected[] = {x + y,
                                     x - y,
                                     x * y,
                                     x / y,
                                     -x,
                                     minimum(x, y),
                                     maximum(x, y),
                                     absolute(x),
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

TEST(Lanes, AnyTellsWhetherSomeLaneHolds)
{
    TRACES("ADR5", "ADR6");
    Wide a;
    EXPECT_FALSE(any(a < Wide(real(0))));
    a.v[kLanes - 1] = -1;
    EXPECT_TRUE(any(a < Wide(real(0))));
}

TEST(Lanes, RowsGoInAndComeOutAgain)
{
    TRACES("ADR5", "ADR6");
    LaneRow rows[8] = {};
    for (int i = 0; i < 8; ++i) rows[i] = {real(i), real(10 + i), real(20 + i), real(-1)};
    const LaneRow* from[kLanes];
    LaneRow* to[kLanes];
    for (int i = 0; i < kLanes; ++i) from[i] = &rows[7 - 2 * i], to[i] = i == 1 ? nullptr : &rows[7 - 2 * i];
    Wide x, y, z;
    gatherRows(from, x, y, z);
    for (int i = 0; i < kLanes; ++i) {
        EXPECT_EQ(x.v[i], real(7 - 2 * i));
        EXPECT_EQ(y.v[i], real(17 - 2 * i));
        EXPECT_EQ(z.v[i], real(27 - 2 * i));
    }
    scatterRows(x + Wide(real(100)), y + Wide(real(100)), z + Wide(real(100)), to);
    for (int i = 0; i < 8; ++i) {
        const bool written = i % 2 == 1 && i != 5 && (7 - i) / 2 < kLanes;
        EXPECT_EQ(rows[i].x, real(i + (written ? 100 : 0))) << "row " << i;
        EXPECT_EQ(rows[i].y, real(10 + i + (written ? 100 : 0))) << "row " << i;
        EXPECT_EQ(rows[i].z, real(20 + i + (written ? 100 : 0))) << "row " << i;
    }
}

}  // namespace
}  // namespace tamias2d
