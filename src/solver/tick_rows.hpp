// SPDX-License-Identifier: MIT
#pragma once

#include "math/lane_rows.hpp"
#include "model/motion.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the lanes read and write of bodies in a tick, four numbers a row, beside each other in memory. All by
/// row of the MotionTable.
struct TickRows {
    std::vector<Position> origins;  // centers at the start of the step   [m]
    std::vector<LaneRow> poses;  // way of the center since then [m], cosine and sine
    std::vector<LaneRow> velocities;  // of the center [m/s], spin [rad/s]
    std::vector<LaneRow> steady;  // Motion::steady [m/s], steadySpin [rad/s]; w is 1 where a load is
    std::vector<LaneRow> expected;  // accelerations of a flight [m/s^2], [rad/s^2]; w: see fastestPoint
    std::vector<LaneRow> outside;  // Motion::acceleration [m/s^2]; z, w mean nothing
    std::vector<LaneRow> pushes;  // displacements, as velocities over a tick [m/s], [rad/s]
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

/// What rows of TickRows::steady say of a body, and the reverse.
inline void takeSteady(Motion& m, const LaneRow& row)
{
    m.steady = {row.x, row.y};
    m.steadySpin = row.z;
    m.loaded = row.w > 0;
}
inline LaneRow steadyRow(const Motion& m)
{
    return {m.steady.x, m.steady.y, m.steadySpin, m.loaded ? real(1) : real(0)};
}
inline LaneRow poseRow(const Motion& m, Position origin)
{
    const Vec2 way = toVec2(m.center - origin);
    return {way.x, way.y, m.rotation.c, m.rotation.s};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
