// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/geometry/aabb.hpp>
#include <tamias2d/math/scalar.hpp>

#include <bit>
#include <cstdint>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The greatest float below a finite one.
inline float nextBelow(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    if (x == 0) return -std::numeric_limits<float>::denorm_min();
    return std::bit_cast<float>(x > 0 ? bits - 1 : bits + 1);
}

/// The greatest float at most `x`. What is no number is bounded by the greatest ones, so that an order of
/// boxes stays one.
inline float floatBelow(double x)
{
    constexpr float kFloatMax = std::numeric_limits<float>::max();
    constexpr double kMost = static_cast<double>(kFloatMax);
    if (!(x > -kMost)) return -kFloatMax;
    const float rounded = static_cast<float>(minimum(x, kMost));
    return static_cast<double>(rounded) <= x ? rounded : nextBelow(rounded);
}
inline float floatAbove(double x)
{
    return -floatBelow(-x);
}

/// A box in half the room, its bounds rounded outwards.
struct FloatBox {
    float left, bottom, right, top;   // [m]

    static FloatBox of(const Aabb& box)
    {
        return {floatBelow(box.lower.x), floatBelow(box.lower.y), floatAbove(box.upper.x),
                floatAbove(box.upper.y)};
    }
};

inline bool overlaps(const FloatBox& a, const FloatBox& b)
{
    return a.left <= b.right && b.left <= a.right && a.bottom <= b.top && b.bottom <= a.top;
}
inline bool holds(const FloatBox& outer, const FloatBox& inner)
{
    return outer.left <= inner.left && inner.right <= outer.right && outer.bottom <= inner.bottom &&
           inner.top <= outer.top;
}
inline FloatBox merged(const FloatBox& a, const FloatBox& b)
{
    return {minimum(a.left, b.left), minimum(a.bottom, b.bottom), maximum(a.right, b.right),
            maximum(a.top, b.top)};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
