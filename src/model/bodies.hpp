// SPDX-License-Identifier: MIT
#pragma once

#include "base/id_pool.hpp"
#include "base/side_table.hpp"
#include "model/motion.hpp"

#include <tamias2d/model/defs.hpp>

#include <string>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The shapes of a body: a ring through the ShapeTable, in order of creation.
struct ShapeList {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t first = kNone;  // slot
    std::uint32_t count = 0;

    bool empty() const { return count == 0; }
    std::uint32_t size() const { return count; }
};

/// What the world remembers of every body between steps, and every stage asks for.
struct BodyRow {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint32_t kNoGroup = 0xffffffffu;

    // Pose and motion of the center of mass.
    Position center;                   // [m]
    double angle = 0;                  // in [0, 2 pi)   [rad]
    Rot rotation;                      // of that angle
    Vec2 velocity;                     // [m/s]
    real spin = 0;                     // [rad/s]

    // Mass. localCenter is where the center of mass lies in the body's frame.
    real mass = 0;                     // [kg]      0 unless dynamic
    real inertia = 0;                  // [kg*m^2]  0: cannot turn
    Vec2 localCenter;                  // [m]
    real extent = 0;  // farthest point of its shapes from the center   [m]

    ShapeList shapes;
    std::uint32_t group = kNoGroup;  // in the SleepTable; kNoGroup: awake. docs/theory/sleep.md
    std::uint32_t mover = kNone;     // in BodyTable::movers
    std::uint32_t extra = kNone;     // in BodyTable::extras

    BodyType type = BodyType::Dynamic;
    bool enabled : 1 = true;
    bool lockX : 1 = false, lockY : 1 = false, lockRotation : 1 = false;
    bool massIsSet : 1 = false;     // by hand: shapes do not change it
    bool massIsStale : 1 = false;  // not summed up yet since shapes came or went; never of a dynamic body
    bool allowSleep : 1 = true;
    bool takesPart : 1 = false;  // in steps: enabled, and dynamic and awake or kinematic and moving

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

/// What bodies that may move have beside it, and grounds that these have met; all others are as here.
struct MoverRow {
    // Before the last step, for interpolation. docs/theory/integration.md
    Position previousCenter;           // [m]
    double previousAngle = 0;
    Vec2 previousLocalCenter;

    Vec2 stepForce;                    // for the next step only   [N]
    real stepTorque = 0;               // [N*m]
    real linearDamping = 0, angularDamping = 0;   // [1/s]
    real gravityScale = 1;

    // docs/theory/sleep.md
    real stillTime = 0;                // for how long it has been still           [s]
    real stillSpeed = 0;               // of its fastest point, at most, since it is   [m/s]
};

/// What few bodies have.
struct BodyExtra {
    std::string name;
    std::uint64_t userData = 0;
    std::vector<LastingForce> lasting;
    std::optional<Vec2> gravity;       // its own   [m/s^2]
};

/// The bodies of a world; a row is the slot of the body's id.
struct BodyTable {
    explicit BodyTable(std::uint32_t world, MemorySource memory = nullptr)
        : ids(world, memory), rows(sourceOr(memory)), movers(memory), extras(memory)
    {
    }

    IdPool<BodyId> ids;
    Column<BodyRow> rows;
    SideTable<MoverRow> movers;
    SideTable<BodyExtra> extras;
    std::vector<std::uint32_t> parts;  // slots of those that take part, and of some that no longer do

    const MoverRow& mover(const BodyRow& b) const
    {
        static const MoverRow kNothing;
        return b.mover != BodyRow::kNone ? movers[b.mover] : kNothing;
    }
    const BodyExtra& extra(const BodyRow& b) const
    {
        static const BodyExtra kNothing;
        return b.extra != BodyRow::kNone ? extras[b.extra] : kNothing;
    }
    /// The row to write to, made if need be.
    MoverRow& moverFor(BodyRow& b)
    {
        if (b.mover == BodyRow::kNone) {
            b.mover = movers.take();
            rememberPose(b);
        }
        return movers[b.mover];
    }
    BodyExtra& extraFor(BodyRow& b)
    {
        if (b.extra == BodyRow::kNone) b.extra = extras.take();
        return extras[b.extra];
    }
    /// What was before is as it is now.
    void rememberPose(const BodyRow& b)
    {
        if (b.mover == BodyRow::kNone) return;
        MoverRow& mover = movers[b.mover];
        mover.previousCenter = b.center;
        mover.previousAngle = b.angle;
        mover.previousLocalCenter = b.localCenter;
    }
    void beginStillness(const BodyRow& b)
    {
        if (b.mover != BodyRow::kNone) movers[b.mover].stillTime = 0;
    }
    void forgetStillness(const BodyRow& b)
    {
        beginStillness(b);
        if (b.mover != BodyRow::kNone) movers[b.mover].stillSpeed = 0;
    }
    /// As no body: its rows are free for others.
    void clear(BodyRow& b)
    {
        movers.giveBack(b.mover);
        extras.giveBack(b.extra);
        b = {};
    }
};

/// The body as it goes into a step.
inline Motion motionOf(const BodyTable& bodies, std::uint32_t slot)
{
    const BodyRow& b = bodies.rows[slot];
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
        const MoverRow& mover = bodies.mover(b);
        m.damping = mover.linearDamping;
        m.spinDamping = mover.angularDamping;
    }
    return m;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
