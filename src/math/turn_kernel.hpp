// SPDX-License-Identifier: MIT
// Sine and cosine, and angles brought into a turn, for one double (T = double) and for several at once
// (T = DoubleLane): the same operations in the same order, so the same bits.
#pragma once

#include "math/double_lane.hpp"

#include <tamias2d/math/scalar.hpp>

#include <bit>

namespace tamias2d::inline TAMIAS_PRECISION {

inline constexpr double kHalfPi = 1.57079632679489661923;
inline constexpr double kMostShortAngle = 1e5;  // |angle| below which reduceShort is exact   [rad]

/// An angle as quarter turns plus a rest in about [-pi/4, pi/4].
template <class T, class Mask>
struct QuarterTurns {
    Mask odd, half;  // the quarter turns modulo 4, as bits
    T rest;          // [rad]
};

/// The two lowest bits of whole numbers that have been added to 1.5 * 2^52, where a double counts by ones.
inline bool lowBit(double shifted, int bit)
{
    return (std::bit_cast<std::uint64_t>(shifted) >> bit & 1u) != 0;
}
template <int W>
DoubleMask<W> lowBit(DoubleLane<W> shifted, int bit)
{
    DoubleMask<W> mask;
    if constexpr (W == 1) {
        mask.v = lowBit(shifted.v, bit);
    } else {
        using Integers = typename DoubleMask<W>::Vector;
        for (int i = 0; i < DoubleLane<W>::kVectors; ++i)
            mask.v[i] = ((Integers)shifted.v[i] & (std::int64_t{1} << bit)) != 0;
    }
    return mask;
}

/// For |angle| < kMostShortAngle. pi/2 is a sum of three, the first two of 33 bits, so that n times each is
/// exact for |n| < 2^20.
template <class T>
TAMIAS_INLINE auto reduceShort(T angle)
{
    constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1, kShift = 0x1.8p+52;
    constexpr double kHalfPi1 = 0x1.921fb544p+0, kHalfPi2 = 0x1.0b4611a6p-34,
                     kHalfPi3 = 0x1.3198a2e037073p-69;
    const T shifted = angle * T(kTwoOverPi) + T(kShift);
    const T n = shifted - T(kShift);
    const T rest = ((angle - n * T(kHalfPi1)) - n * T(kHalfPi2)) - n * T(kHalfPi3);
    const auto odd = lowBit(shifted, 0), half = lowBit(shifted, 1);
    return QuarterTurns<T, std::remove_const_t<decltype(odd)>>{odd, half, rest};
}

// x - x^3/3! + ... - x^15/15!; what is left out is below 2^-54 for |x| <= pi/4.
template <class T>
TAMIAS_INLINE T sineSeries(T x)
{
    const T z = x * x;
    T sum(-1.0 / 1307674368000.0);
    sum = sum * z + T(1.0 / 6227020800.0);
    sum = sum * z - T(1.0 / 39916800.0);
    sum = sum * z + T(1.0 / 362880.0);
    sum = sum * z - T(1.0 / 5040.0);
    sum = sum * z + T(1.0 / 120.0);
    sum = sum * z - T(1.0 / 6.0);
    return x + x * (z * sum);
}

// 1 - x^2/2! + ... + x^16/16!; what is left out is below 2^-58 for |x| <= pi/4.
template <class T>
TAMIAS_INLINE T cosineSeries(T x)
{
    const T z = x * x;
    T sum(1.0 / 20922789888000.0);
    sum = sum * z - T(1.0 / 87178291200.0);
    sum = sum * z + T(1.0 / 479001600.0);
    sum = sum * z - T(1.0 / 3628800.0);
    sum = sum * z + T(1.0 / 40320.0);
    sum = sum * z - T(1.0 / 720.0);
    sum = sum * z + T(1.0 / 24.0);
    sum = sum * z - T(0.5);
    return T(1.0) + z * sum;
}

template <class T>
struct SineCosine {
    T sine, cosine;
};

template <class T, class Mask>
TAMIAS_INLINE SineCosine<T> sineCosineOf(const QuarterTurns<T, Mask>& a)
{
    const T s = sineSeries(a.rest), c = cosineSeries(a.rest);
    const T sine = select(a.odd, c, s), cosine = select(a.odd, -s, c);
    return {select(a.half, -sine, sine), select(a.half, -cosine, cosine)};
}

/// An angle that quarter turns and a rest make, in [0, 2 pi): rounding may have put it on 2 pi, which is 0.
template <class T, class Mask>
TAMIAS_INLINE T wrappedOf(const QuarterTurns<T, Mask>& a)
{
    const T zero(0.0), one(1.0), two(2.0), turn(kTwoPi);
    const T quarter = select(a.half, two, zero) + select(a.odd, one, zero);
    const T wrapped = quarter * T(kHalfPi) + a.rest;
    const T positive = select(wrapped < zero, wrapped + turn, wrapped);
    return select(positive < turn, positive, zero);
}

/// Is the angle in [0, 2 pi) already?
template <class T>
TAMIAS_INLINE auto isWrapped(T angle)
{
    return (angle >= T(0.0)) & (angle < T(kTwoPi));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
