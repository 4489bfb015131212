// SPDX-License-Identifier: MIT
#pragma once

#include "base/pages.hpp"
#include "math/lane_rows.hpp"
#include "model/motion.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

// What kernels read and write in groups of four; where the fourth has no name it has no meaning.
inline constexpr std::size_t kRowBytes = 4 * sizeof(real);

/// Velocity change of one body by contacts and forces in a tick.
struct alignas(kRowBytes) TickChange {
    Vec2 velocity;   // [m/s]
    real spin = 0;   // [rad/s]
};

/// The share of an impact's velocity change that comes before the drift of its tick, and after it:
/// so placed, the position at the end is that of a body hit at the right time.
struct ImpactKick {
    alignas(kRowBytes) Vec2 before;   // [m/s]
    real spinBefore = 0;              // [rad/s]
    alignas(kRowBytes) Vec2 after;
    real spinAfter = 0;
};

/// How a body went: the way of its center, and at most how much more any point of it by turning.   [m]
struct alignas(kRowBytes) Way {
    Vec2 shift;
    real turn = 0;
    real turning = 0; // at most how fast any point of it turns in the tick that follows   [m/s]
};

/// How far a body goes in the step at most, as it is expected to.   [m]
struct alignas(kRowBytes) Travel {
    real turn = 0;   // any point, by turning
    real whole = 0;  // any point
    real free = 0;   // any point, by what contacts do not balance of all that acts on it
};

/// The way that the box of a body in the broad phase was made for, and how far the body may leave it.
struct PredictedWay {
    alignas(kRowBytes) Vec2 velocity;  // at the start of the step, or as if it had been so since then   [m/s]
    real spin = 0;  // [rad/s]
    real slack = 0;  // [m]
    alignas(kRowBytes) Vec2 acceleration;  // all along it   [m/s^2]
    real spinRate = 0;  // [rad/s^2]
    real strayed = 0;  // by turning, so far: no point of it by more   [m]
    alignas(kRowBytes) Vec2 offset;  // at the start of the step   [m]
    real width = 0;  // of its narrowest shape; 0: it has no box   [m]
};

/// Where a body's center is at the start of the step.   [m]
struct alignas(4 * sizeof(double)) StartPlace {
    Position center;
};

/// What the lanes read and write of bodies in a tick, four numbers a row, beside each other in memory. All by
/// row of the MotionTable.
struct TickRows {
    Table<StartPlace> origins;
    Table<LaneRow> poses;  // way of the center since then [m], cosine and sine
    Table<LaneRow> starts;  // velocities as the tick begins, of the center [m/s], spin [rad/s]
    Table<LaneRow> velocities;  // those that passes work on
    Table<LaneRow> steady;  // Motion::steady [m/s], steadySpin [rad/s]; w is 1 where a load is
    Table<LaneRow> expected;  // accelerations of a flight [m/s^2], [rad/s^2]; w: see fastestPoint
    Table<LaneRow> loads;  // Motion::steady [m/s], Motion::acceleration [m/s^2], as the tick begins
    Table<LaneRow>
        turned;  // steady after the drift, of what joints alone hold; w is 1 where joints tie, else 0
    Table<LaneRow> pushes;  // displacements, as velocities over a tick [m/s], [rad/s]
    Table<TickChange> changes;
    Table<ImpactKick> kicks;
    Table<PredictedWay> predicted;  // of the step
    Table<Way> ways;  // in the last tick
    Table<Travel> travels;  // before the first tick
    Table<LaneRow> spans;  // velocities as a tick begins and, if nothing happens, as it ends   [m/s]
};

inline LaneRow laneRow(const BodyMotion<real>& motion, real w = 0)
{
    return {motion.velocity.x, motion.velocity.y, motion.spin, w};
}
inline BodyMotion<real> velocityOf(const LaneRow& row)
{
    return {{row.x, row.y}, row.z};
}
inline BodyMotion<real> velocityOf(const Motion& m)
{
    return {m.velocity, m.spin};
}
inline void setVelocity(LaneRow& row, const BodyMotion<real>& motion)
{
    row = laneRow(motion);
}
inline void setVelocity(Motion& m, const BodyMotion<real>& motion)
{
    m.velocity = motion.velocity;
    m.spin = motion.spin;
}

inline Motion motionWith(const Motion& m, const LaneRow& velocity)
{
    Motion with = m;
    setVelocity(with, velocityOf(velocity));
    return with;
}

/// What rows of TickRows::steady say of a body, and the reverse.
inline void takeSteady(Motion& m, const LaneRow& row)
{
    m.steady = {row.x, row.y};
    m.steadySpin = row.z;
    m.load = row.w;
}
inline LaneRow steadyRow(const Motion& m)
{
    return {m.steady.x, m.steady.y, m.steadySpin, m.load};
}
/// From where the way of A's center is counted to where that of B's is.   [m]
inline Vec2 startBetween(const TickRows& rows, std::uint32_t a, std::uint32_t b)
{
    return toVec2(rows.origins[b].center - rows.origins[a].center);
}
inline LaneRow poseRow(const Motion& m, Position origin)
{
    const Vec2 way = toVec2(m.center - origin);
    return {way.x, way.y, m.rotation.c, m.rotation.s};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
