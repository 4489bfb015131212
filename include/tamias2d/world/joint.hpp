// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/model/joint_defs.hpp>

#include <string_view>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

class Body;
class World;

/// A reference to one joint of one World, cheap to copy; the twin of Body. Store a JointId.
///
/// On a dead handle every call but id() and isAlive() raises InputError and changes nothing. Every setter
/// refuses what createJoint would refuse.
class Joint {
public:
    Joint() = default;  ///< a null handle

    JointId id() const noexcept { return id_; }
    bool isAlive() const noexcept;

    /// Everything about the joint, such that createJoint with it makes its twin.
    JointDef definition() const;
    BodyId bodyA() const;
    BodyId bodyB() const;
    std::vector<BodyId> bodies() const;  ///< all, in the order in which they were given
    const std::string& name() const;
    void setName(std::string_view name);
    std::uint64_t userData() const;
    void setUserData(std::uint64_t value);

    const JointKind& kind() const;
    /// Other parameters, or even another kind for as many bodies; what the joint bears goes on where it can.
    void setKind(const JointKind& kind);
    bool isEnabled() const;  ///< a joint that broke is not
    void setEnabled(bool enabled);  ///< mends a broken joint, where its bodies are now
    bool isBroken() const;
    bool collidesConnected() const;
    void setCollideConnected(bool collide);  ///< from the next step on
    const JointBreaking& breaking() const;
    void setBreaking(const JointBreaking& breaking);

    // Shorthands for one number of the kind; refused by a kind that has no such thing.
    void setMotorSpeed(real speed);  ///< [m/s] or [rad/s]   the motor must be there
    void setTarget(Position target);  ///< of a TargetJoint                  [m]

    Position anchorA() const;  ///< where it holds A now; a target's place   [m]
    Position anchorB() const;  ///< where it holds B now                     [m]
    JointReading reading() const;  ///< forces of the last step; the rest as it is now
    /// The same of each of its rows: rigid ones first, else in the order in which a constraint of your own
    /// takes them down. Empty if it does not act.
    std::vector<JointRowReading> rowReadings() const;

    void destroy();

private:
    friend class World;
    friend class Body;
    Joint(World* world, JointId id) noexcept : world_(world), id_(id) {}
    World* alive() const;  // refuses a dead handle; null then, in builds without exceptions

    World* world_ = nullptr;
    JointId id_;
};

// Definitions of joints between two bodies as they are now: what is meant to stay as it is, stays.

/// Turns about a place in the world; the angle counts from now.
JointDef revoluteAt(const Body& a, const Body& b, Position anchor);
/// A rod between two places, one on each body, of the length they are apart.
JointDef rodBetween(const Body& a, const Body& b, Position onA, Position onB);
/// Slides along an axis in the world; the way counts from now.
JointDef slideAlong(const Body& a, const Body& b, Position anchor, Vec2 axis);
/// Holds the two as they are.
JointDef weldAt(const Body& a, const Body& b, Position anchor);
/// Drags B by one of its points, from where that is.
JointDef dragAt(const Body& hand, const Body& b, Position point);
/// A wheel (B) on its hub, sprung along an axis in the world; the way counts from now.
JointDef wheelAt(const Body& chassis, const Body& wheel, Position hub, Vec2 axis);
/// A point of B slides on A from one place in the world to another; it need not be there yet.
JointDef grooveBetween(const Body& a, const Body& b, Position start, Position end, Position onB);
/// B turns `ratio` times as far as A from now on.
JointDef gearBetween(const Body& a, const Body& b, real ratio);
/// A pinion (B) about its center of mass on a rack (A) along an axis in the world, from now on.
JointDef rackAlong(const Body& rack, const Body& pinion, Vec2 axis, real radius);
/// A rope from a place on A over two wheels to a place on B, as long as it has to be.
JointDef pulleyOver(const Body& a, const Body& b, Position onA, Position onB, Position wheelA,
                    Position wheelB, real ratio = 1);
/// Any kind between two bodies.
JointDef jointOf(const Body& a, const Body& b, const JointKind& kind);

}  // namespace tamias2d::inline TAMIAS_PRECISION
