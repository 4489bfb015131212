// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A vector in the plane, x to the right and y up [A2-A4].
template <class T>
struct BasicVec2 {
    T x = 0;
    T y = 0;

    friend constexpr bool operator==(const BasicVec2&, const BasicVec2&) noexcept = default;

    constexpr BasicVec2& operator+=(BasicVec2 b) noexcept { return x += b.x, y += b.y, *this; }
    constexpr BasicVec2& operator-=(BasicVec2 b) noexcept { return x -= b.x, y -= b.y, *this; }
    constexpr BasicVec2& operator*=(T s) noexcept { return x *= s, y *= s, *this; }

    friend constexpr BasicVec2 operator+(BasicVec2 a, BasicVec2 b) noexcept { return a += b; }
    friend constexpr BasicVec2 operator-(BasicVec2 a, BasicVec2 b) noexcept { return a -= b; }
    friend constexpr BasicVec2 operator-(BasicVec2 a) noexcept { return {-a.x, -a.y}; }
    friend constexpr BasicVec2 operator*(T s, BasicVec2 a) noexcept { return a *= s; }
    friend constexpr BasicVec2 operator*(BasicVec2 a, T s) noexcept { return a *= s; }
};

using Vec2 = BasicVec2<real>;     ///< of the build's precision
using DVec2 = BasicVec2<double>;  ///< the difference of two Positions

template <class T>
constexpr T dot(BasicVec2<T> a, BasicVec2<T> b) noexcept
{
    return a.x * b.x + a.y * b.y;
}

/// The z component of the cross product: positive when b is counter-clockwise of a.
template <class T>
constexpr T cross(BasicVec2<T> a, BasicVec2<T> b) noexcept
{
    return a.x * b.y - a.y * b.x;
}

/// omega x r: the velocity of a point at r on a body that turns at omega [DD9].
template <class T>
constexpr BasicVec2<T> cross(T omega, BasicVec2<T> r) noexcept
{
    return {-omega * r.y, omega * r.x};
}

/// a turned by +90 degrees.
template <class T>
constexpr BasicVec2<T> perpendicular(BasicVec2<T> a) noexcept
{
    return {-a.y, a.x};
}

template <class T>
inline T length(BasicVec2<T> a) noexcept
{
    return std::sqrt(dot(a, a));
}

constexpr Vec2 toVec2(DVec2 a) noexcept
{
    return {static_cast<real>(a.x), static_cast<real>(a.y)};
}
constexpr DVec2 toDVec2(Vec2 a) noexcept
{
    return {static_cast<double>(a.x), static_cast<double>(a.y)};
}

template <class T>
inline bool isFinite(BasicVec2<T> a) noexcept
{
    return std::isfinite(a.x) && std::isfinite(a.y);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
