// SPDX-License-Identifier: MIT
// Sine, cosine and e^x from + - * / alone. The system's maths library differs in the last bit from
// platform to platform, and one bit is enough to send a pile of boxes another way [ADR6].
//
// Each function first brings its argument into a short interval and then sums the Taylor series
// there, long enough that what is left out lies below half a unit in the last place.

#include "math/turn_kernel.hpp"

#include <tamias2d/math/scalar.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The bits of 2 / pi behind the binary point, enough for the largest double.
constexpr std::array<std::uint32_t, 37> kTwoOverPiBits = {
    0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u, 0x3c439041u, 0xfe5163abu, 0xdebbc561u,
    0xb7246e3au, 0x424dd2e0u, 0x06492eeau, 0x09d1921cu, 0xfe1deb1cu, 0xb129a73eu, 0xe88235f5u, 0x2ebb4484u,
    0xe99c7026u, 0xb45f7e41u, 0x3991d639u, 0x835339f4u, 0x9c845f8bu, 0xbdf9283bu, 0x1ff897ffu, 0xde05980fu,
    0xef2f118bu, 0x5a0a6d1fu, 0x6d367ecfu, 0x27cb09b7u, 0x4f463f66u, 0x9e5fea2du, 0x7527bac7u, 0xebe5f17bu,
    0x3d0739f7u, 0x8a5292eau, 0x6bfb5fb1u, 0x1f8d5d08u, 0x56033046u};

using Reduced = QuarterTurns<double, bool>;

// The 32 bits of 2 / pi that follow bit `first`, counted from the binary point; before it all are 0.
std::uint32_t bitsAfter(int first) noexcept
{
    constexpr int kWordsBefore = 2;  // `first` is never below -64
    const auto word = [](int i) {
        const bool stored = i >= 0 && i < static_cast<int>(kTwoOverPiBits.size());
        return stored ? kTwoOverPiBits[static_cast<std::size_t>(i)] : 0u;
    };
    const auto place = static_cast<unsigned>(first + 32 * kWordsBefore);
    const int index = static_cast<int>(place / 32) - kWordsBefore;
    const std::uint64_t two = (std::uint64_t{word(index)} << 32) | word(index + 1);
    return static_cast<std::uint32_t>((two << (place % 32)) >> 32);
}

// Long angles: angle = m 2^e with a whole m. Of 2 / pi only those bits matter which, times m 2^e,
// give less than four quarter turns; six words of them leave 2^-137 quarter turns of error.
Reduced reduceLong(double angle) noexcept
{
    constexpr int kWords = 6;
    const auto bits = std::bit_cast<std::uint64_t>(angle);
    const std::uint64_t m = (bits & 0xfffffffffffffu) | 0x10000000000000u;
    const int e = static_cast<int>((bits >> 52) & 0x7ff) - 1075;

    // product = m x (the words as a whole number), modulo 2^192; word 0 is the highest.
    std::array<std::uint32_t, kWords> product{};
    const std::uint64_t mLow = m & 0xffffffffu, mHigh = m >> 32;
    std::uint64_t carry = 0, highBefore = 0;
    for (int i = kWords - 1; i >= 0; --i) {
        const std::uint64_t word = bitsAfter(e - 2 + 32 * i);
        const std::uint64_t low = word * mLow;
        const std::uint64_t sum = (low & 0xffffffffu) + (highBefore & 0xffffffffu) + carry;
        product[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(sum);
        carry = (sum >> 32) + (low >> 32) + (highBefore >> 32);
        highBefore = word * mHigh;
    }

    // The top two bits are quarter turns, the others a part of one: taken from -1/2 to 1/2.
    int quarter = static_cast<int>(product[0] >> 30);
    const bool roundUp = (product[0] & 0x20000000u) != 0;
    product[0] &= 0x3fffffffu;
    double part = 0;
    for (int i = kWords - 1; i >= 0; --i) {
        std::uint32_t word = product[static_cast<std::size_t>(i)];
        if (roundUp) word = (i == 0 ? 0x3fffffffu : 0xffffffffu) - word;  // 1 - part, but for the last bit
        part = (part + word) * 0x1p-32;
    }
    part *= 4;
    if (roundUp) {
        part = -part;
        ++quarter;
    }
    const bool negative = angle < 0;
    const int turned = negative ? -quarter : quarter;
    return {(turned & 1) != 0, (turned & 2) != 0, (negative ? -part : part) * kHalfPi};
}

Reduced reduce(double angle) noexcept
{
    return absolute(angle) < kMostShortAngle ? reduceShort(angle) : reduceLong(angle);
}

// 2^k for -1022 <= k <= 1023.
double powerOfTwo(int k) noexcept
{
    return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

}  // namespace

SinCos sinCos(double angle) noexcept
{
    if (!std::isfinite(angle)) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        return {nan, nan};
    }
    const SineCosine<double> both = sineCosineOf(reduce(angle));
    return {both.sine, both.cosine};
}

double exponential(double x) noexcept
{
    constexpr double kLog2E = 0x1.71547652b82fep+0;
    constexpr double kLn2High = 0x1.62e42fefap-1;  // k times this is exact
    constexpr double kLn2Low = 0x1.cf79abc9e3b3ap-40;

    if (std::isnan(x)) return x;
    if (x > 710.0) return std::numeric_limits<double>::infinity();
    if (x < -746.0) return 0.0;

    // e^x = 2^k e^r with |r| <= ln(2) / 2, where the series to r^13 / 13! leaves out less than 2^-57.
    const double scaled = x * kLog2E;
    const int k = static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5));
    const double r = (x - k * kLn2High) - k * kLn2Low;
    double sum = 1.0 / 6227020800.0;
    sum = sum * r + 1.0 / 479001600.0;
    sum = sum * r + 1.0 / 39916800.0;
    sum = sum * r + 1.0 / 3628800.0;
    sum = sum * r + 1.0 / 362880.0;
    sum = sum * r + 1.0 / 40320.0;
    sum = sum * r + 1.0 / 5040.0;
    sum = sum * r + 1.0 / 720.0;
    sum = sum * r + 1.0 / 120.0;
    sum = sum * r + 1.0 / 24.0;
    sum = sum * r + 1.0 / 6.0;
    sum = sum * r + 0.5;
    const double e = 1.0 + (r + r * r * sum);

    // In two factors, as 2^k alone may overflow where e^x does not.
    const int half = k / 2;
    return e * powerOfTwo(half) * powerOfTwo(k - half);
}

double wrapAngle(double angle) noexcept
{
    if (angle >= 0 && angle < kTwoPi) return angle + 0.0;  // makes 0 of -0
    if (!std::isfinite(angle)) return std::numeric_limits<double>::quiet_NaN();

    return wrappedOf(reduce(angle));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
