// SPDX-License-Identifier: MIT
#pragma once

#include "base/pages.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/math/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How damping changes a kick and a drift, exactly: docs/theory/integration.md, eq. 5-7.
struct alignas(32) Damping {
    double keep = 1;         // E = exp(-c h/2): of the velocity, over half a tick
    double kickTime = 0;     // (1 - E)/c: what an acceleration adds in half a tick      [s]
    double excessTime = 0;   // q = (1 - E^2)/c - h E: of the drift beyond h v_h         [s]
    double excessAccel = 0;  // q/c                                                      [s^2]
};

/// How a body moves, or changes its motion.
template <class T>
struct BodyMotion {
    BasicVec2<T> velocity;  // of the center of mass   [m/s]
    T spin = T(real(0));    // [rad/s]
};

/// One body while it is being solved. Bodies that cannot move have no inverse mass. Groups of four numbers
/// that kernels read and write at once are aligned to such a group; what of it has no name has no meaning.
struct alignas(64) Motion {
    static constexpr std::size_t kGroup = 4 * sizeof(real);

    Position center;           // [m]
    double angle = 0;          // in [0, 2 pi)   [rad]
    std::uint32_t body = 0;    // slot in the BodyTable

    alignas(kGroup) Vec2 invMass;   // along x and y: a locked axis has 0   [1/kg]
    real invInertia = 0;       // [1/(kg*m^2)]
    real extent = 0;           // farthest point of its shapes from the center   [m]

    alignas(kGroup) Rot rotation;   // of `angle`
    real damping = 0, spinDamping = 0;   // [1/s]

    alignas(kGroup) Vec2 velocity;   // [m/s]
    real spin = 0;             // [rad/s]

    // Velocity change by the steady contact impulses of the previous tick: the warm start of all
    // contacts at once, and what makes the prediction of a resting body rest.
    alignas(kGroup) Vec2 steady;     // [m/s]
    real steadySpin = 0;       // [rad/s]
    real load = 0;             // 1 if some contact of it carries a load or it cannot move, else 0

    alignas(kGroup) Vec2 acceleration;   // by forces from outside, damping left out   [m/s^2]
    real spinRate = 0;         // [rad/s^2]

    // Thousands of small kicks, each rounded, would add up to more than a free flight may err. What
    // `velocity` and `spin` are the rounding of is kept beside them, and counts until they are changed.
    alignas(32) DVec2 fineVelocity;  // [m/s]
    double fineSpin = 0;       // [rad/s]

    // Of those that are damped.
    alignas(32) DVec2 excess;  // of the drift of this tick, by damping   [m]
    double excessTurn = 0;     // [rad]
    Damping dampedTick, dampedTurn;  // of the velocity, of the spin

    /// Of the axis along which it moves more easily: one may be locked.   [1/kg]
    real greatestInvMass() const { return maximum(invMass.x, invMass.y); }
    bool isLoaded() const { return load > 0; }
    bool isDamped() const { return damping > 0 || spinDamping > 0; }
    bool isFree() const { return invMass.x > 0 && invMass.x == invMass.y; }   ///< no locked axis
    bool moves() const { return invMass.x + invMass.y > 0 || invInertia > 0; }
};

/// Where the center of a body is, and what takes it on within the step.
struct CenterWay {
    Position center;   // [m]
    Vec2 glide, bend;  // by its velocity, by twice its acceleration: dt v, dt^2 a   [m]
};

/// A bound on how far a center goes in the step, or goes against another: by its velocity and by twice its
/// acceleration, see CenterWay. T is real, or a Lane.   [m]
template <class T>
inline T travelBy(BasicVec2<T> glide, BasicVec2<T> bend)
{
    return absolute(glide.x) + absolute(glide.y) + (absolute(bend.x) + absolute(bend.y));
}

/// The bodies of a step, and which row each one has: first those that take part, then the still ones that
/// they may meet (static, or kinematic at rest); each sorted by slot, but for those that come in mid-step.
struct MotionTable {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    Table<Motion> rows;
    std::vector<std::uint32_t> rowOf;  // by body slot; kNone for those that are not here
    std::uint32_t parts = 0;           // how many of the rows took part from the start
    std::vector<std::uint32_t> versions;   // by row: of the angle that manifolds of it are kept for
    std::vector<Position> origins;         // near the center: where lanes count its way from   [m]
    Table<CenterWay> centers;              // by row
    std::vector<real> rooms;  // how far beyond their expected ways boxes made in this step reach at least [m]
    std::vector<std::uint8_t> slow;  // does no point of it go farther than what is quiet?

    std::uint32_t rowFor(std::uint32_t body) const { return body < rowOf.size() ? rowOf[body] : kNone; }
};

/// The deceleration -c v of damping holds for times well below 1/c only. Held at what takes all speed away in
/// a tick, it leaves the path of a strongly damped body longer than it is, rather than backwards without end.
/// An acceleration a body is expected to have: forces from `outside`, damping and steady contacts. T is real,
/// or a Lane.   [m/s^2] or [rad/s^2]
template <class T>
inline T expectedRate(T outside, T damping, T velocity, T steady, T invH)
{
    return outside - minimum(damping, invH) * velocity + invH * steady;
}

/// A bound on the speed of any point of a body within a tick of length `h`. Points lie a little beyond the
/// extent, on the other surface.   [m/s]
template <class T>
inline T fastestPoint(BasicVec2<T> velocity, T spin, BasicVec2<T> acceleration, T spinRate, T extent, T h)
{
    const auto sum = [](BasicVec2<T> v) { return absolute(v.x) + absolute(v.y); };  // at least its length
    return sum(velocity) + h * sum(acceleration) +
           T(real(1.5)) * extent * (absolute(spin) + h * absolute(spinRate));
}

/// n . M^-1 n for an impulse along `n` at `arm`: how easily the point gives way.   [1/kg]
inline real compliance(const Motion& m, Vec2 arm, Vec2 n)
{
    const real turn = cross(arm, n);
    return m.invMass.x * n.x * n.x + m.invMass.y * n.y * n.y + m.invInertia * turn * turn;
}

/// The same between two points of a pair along one `n`: how an impulse at one moves the other.   [1/kg]
inline real crossCompliance(const Motion& a, const Motion& b, Vec2 n, Vec2 armA, Vec2 armB, Vec2 otherArmA,
                            Vec2 otherArmB)
{
    return (a.invMass.x + b.invMass.x) * n.x * n.x + (a.invMass.y + b.invMass.y) * n.y * n.y +
           a.invInertia * cross(armA, n) * cross(otherArmA, n) +
           b.invInertia * cross(armB, n) * cross(otherArmB, n);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
