// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 6.28318530717958647692;

struct SinCos {
    double sin;
    double cos;
};

/// Sine and cosine of any finite angle [rad], within 2 ulp near the unit circle's scale; built
/// from + - * / alone, so that every platform gives the same bits [ADR6].
SinCos sinCos(double angle) noexcept;

/// e^x for finite x, within 2 ulp; the same bits on every platform [ADR6].
double exponential(double x) noexcept;

/// The angle brought into [0, 2 pi) [rad].
double wrapAngle(double angle) noexcept;

template <class T>
constexpr T minimum(T a, T b) noexcept
{
    return a < b ? a : b;
}
template <class T>
constexpr T maximum(T a, T b) noexcept
{
    return a > b ? a : b;
}
template <class T>
constexpr T absolute(T a) noexcept
{
    return a < T(0) ? -a : a;
}
template <class T>
constexpr T clamp(T a, T low, T high) noexcept
{
    return a < low ? low : (a > high ? high : a);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
