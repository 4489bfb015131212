// SPDX-License-Identifier: MIT
#pragma once

#include "base/id_pool.hpp"
#include "model/motion.hpp"

#include <tamias2d/model/defs.hpp>

#include <string>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Everything the world remembers of a body between steps.
struct BodyRow {
    BodyType type = BodyType::Dynamic;
    bool enabled = true;
    bool lockX = false, lockY = false, lockRotation = false;
    bool massIsSet = false;            // by hand: shapes do not change it

    // Pose and motion of the center of mass.
    Position center;                   // [m]
    double angle = 0;                  // in [0, 2 pi)   [rad]
    Rot rotation;                      // of that angle
    Vec2 velocity;                     // [m/s]
    real spin = 0;                     // [rad/s]
    Position previousCenter;           // before the last step, for interpolation
    double previousAngle = 0;
    Vec2 previousLocalCenter;

    // Mass. localCenter is where the center of mass lies in the body's frame.
    real mass = 0;                     // [kg]      0 unless dynamic
    real inertia = 0;                  // [kg*m^2]  0: cannot turn
    Vec2 localCenter;                  // [m]
    bool massIsStale = false;  // not summed up yet since shapes came or went; never of a dynamic body
    real extent = 0;  // farthest point of its shapes from the center   [m]

    // Forces.
    Vec2 stepForce;  // for the next step only   [N]
    real stepTorque = 0;  // [N*m]
    std::vector<LastingForce> lasting;
    real linearDamping = 0, angularDamping = 0;  // [1/s]
    real gravityScale = 1;
    std::optional<Vec2> gravity;  // its own   [m/s^2]

    // Sleep. docs/theory/sleep.md.
    static constexpr std::uint32_t kNoGroup = 0xffffffffu;
    bool allowSleep = true;
    bool takesPart = false;  // in steps: enabled, and dynamic and awake or kinematic and moving
    std::uint32_t group = kNoGroup;  // in the SleepTable; kNoGroup: awake
    real stillTime = 0;  // for how long it has been still           [s]
    real stillSpeed = 0;  // of its fastest point, at most, since it is   [m/s]

    std::vector<std::uint32_t> shapes;  // slots, in order of creation
    std::string name;
    std::uint64_t userData = 0;

    bool isDynamic() const { return type == BodyType::Dynamic; }
    bool isAsleep() const { return group != kNoGroup; }
    bool hasVelocity() const { return velocity != Vec2{} || spin != 0; }
    Position originOf(Position c, Rot q, Vec2 local) const { return c - toDVec2(rotate(q, local)); }
    Position origin() const { return originOf(center, rotation, localCenter); }
    Vec2 invMass() const
    {
        if (!isDynamic()) return {};
        return {lockX ? real(0) : 1 / mass, lockY ? real(0) : 1 / mass};
    }
    real invInertia() const { return isDynamic() && !lockRotation && inertia > 0 ? 1 / inertia : real(0); }
    /// Can anything push it?
    bool canMove() const
    {
        const Vec2 inverse = invMass();
        return inverse.x + inverse.y > 0 || invInertia() > 0;
    }
};

/// The body as it goes into a step.
inline Motion motionOf(const BodyRow& b, std::uint32_t slot)
{
    Motion m;
    m.center = b.center;
    m.angle = b.angle;
    m.rotation = b.rotation;
    m.velocity = b.velocity;
    m.spin = b.spin;
    m.invMass = b.invMass();
    m.invInertia = b.invInertia();
    m.body = slot;
    m.extent = b.extent;
    if (b.isDynamic()) {
        if (b.lockX) m.velocity.x = 0;
        if (b.lockY) m.velocity.y = 0;
        if (b.lockRotation) m.spin = 0;
    }
    if (m.moves()) {
        m.damping = b.linearDamping;
        m.spinDamping = b.angularDamping;
    }
    return m;
}

/// The bodies of a world; a row is the slot of the body's id.
struct BodyTable {
    explicit BodyTable(std::uint32_t world) : ids(world) {}

    IdPool<BodyId> ids;
    std::vector<BodyRow> rows;
    std::vector<std::uint32_t> parts;  // slots of those that take part, and of some that no longer do
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
