// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/math/vec2.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A place in the world [m]. Always double, so that a world of a thousand kilometres still
/// resolves micrometres; the solver works on differences, which are Vec2 [ADR3].
struct Position {
    double x = 0;
    double y = 0;

    friend constexpr bool operator==(const Position&, const Position&) noexcept = default;
    friend constexpr Position operator+(Position p, DVec2 d) noexcept { return {p.x + d.x, p.y + d.y}; }
    friend constexpr Position operator-(Position p, DVec2 d) noexcept { return {p.x - d.x, p.y - d.y}; }
    friend constexpr DVec2 operator-(Position a, Position b) noexcept { return {a.x - b.x, a.y - b.y}; }
};

inline bool isFinite(Position p) noexcept
{
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// An orientation as its cosine and sine.
struct Rot {
    real c = 1;  ///< cosine
    real s = 0;  ///< sine

    /// The rotation by `angle` [rad], the same bits on every platform.
    static Rot ofAngle(double angle) noexcept
    {
        const SinCos sc = sinCos(angle);
        return {static_cast<real>(sc.cos), static_cast<real>(sc.sin)};
    }
};

/// v turned by the angle whose cosine is c and whose sine is s.
template <class T>
constexpr BasicVec2<T> rotate(T c, T s, BasicVec2<T> v) noexcept
{
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}
template <class T>
constexpr BasicVec2<T> inverseRotate(T c, T s, BasicVec2<T> v) noexcept
{
    return {c * v.x + s * v.y, c * v.y - s * v.x};
}
constexpr Vec2 rotate(Rot q, Vec2 v) noexcept
{
    return rotate(q.c, q.s, v);
}
constexpr Vec2 inverseRotate(Rot q, Vec2 v) noexcept
{
    return inverseRotate(q.c, q.s, v);
}

/// Where a body is: the place of its origin [m] and its orientation, with the angle in [0, 2 pi).
struct Transform {
    Position position = {};
    double angle = 0;  ///< [rad]
    Rot rotation = {};

    static Transform at(Position position, double angle) noexcept
    {
        const double phi = wrapAngle(angle);
        return {position, phi, Rot::ofAngle(phi)};
    }
};

/// A point of the body's frame, in the world.
constexpr Position toWorld(const Transform& t, Vec2 local) noexcept
{
    return t.position + toDVec2(rotate(t.rotation, local));
}
/// A point of the world, in the body's frame.
constexpr Vec2 toLocal(const Transform& t, Position world) noexcept
{
    return inverseRotate(t.rotation, toVec2(world - t.position));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
