// SPDX-License-Identifier: MIT
// What joints are like. Every kind is plain data; all of it may be changed while the joint is at work.
#pragma once

#include <tamias2d/base/ids.hpp>
#include <tamias2d/math/transform.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace tamias2d::inline TAMIAS_PRECISION {

/// No bound: of a force, a length or a threshold. So much of anything is as good as without end.
inline constexpr real kUnlimited = real(1e30);

/// How far a joint may go. In radians for a turning joint (several turns are counted), in metres along an
/// axis.
struct JointLimits {
    real lower = 0;   ///< [m] or [rad]   <= upper
    real upper = 0;   ///< [m] or [rad]

    friend constexpr bool operator==(const JointLimits&, const JointLimits&) noexcept = default;
};

/// Drives a joint at a speed, with no more than a force.
struct JointMotor {
    real speed = 0;      ///< of B against A; counter-clockwise, or along the axis   [m/s] or [rad/s]
    real maxForce = 0;   ///< either way                                             [N] or [N*m]   >= 0

    friend constexpr bool operator==(const JointMotor&, const JointMotor&) noexcept = default;
};

/// A damped spring between the two bodies: as stiff and as damped as that these would swing, by their masses
/// (a turning one: by their moments of inertia) alone, at `frequency`. It conserves energy if it is not
/// damped, and is stable at any frequency.
struct JointSpring {
    real frequency = 1;      ///< [Hz]   >= 0; 0 is a damper that is none
    real dampingRatio = 0;   ///< [1]    >= 0; 1 comes to rest soonest
    real rest = 0;           ///< where it pulls to: length, place along the axis, or angle   [m] or [rad]

    friend constexpr bool operator==(const JointSpring&, const JointSpring&) noexcept = default;
};

/// Two points stay together; the bodies may turn about them.
struct RevoluteJoint {
    Vec2 anchorA = {};           ///< in each body's frame                            [m]
    Vec2 anchorB = {};
    double referenceAngle = 0;   ///< of B against A where the joint's angle is 0     [rad]
    std::optional<JointLimits> limits = {};   ///< of the joint's angle               [rad]
    std::optional<JointMotor> motor = {};     ///< [rad/s], [N*m]
    std::optional<JointSpring> spring = {};   ///< towards the angle `rest`           [rad]

    friend constexpr bool operator==(const RevoluteJoint&, const RevoluteJoint&) noexcept = default;
};

/// Two points stay at a distance: a rod. With limits a rope or a strut, with a spring a spring, with both a
/// spring that has stops.
struct DistanceJoint {
    Vec2 anchorA = {};   ///< in each body's frame   [m]
    Vec2 anchorB = {};
    real length = 1;     ///< of the rod; no rod if there are limits, a motor or a spring    [m]   > 0
    std::optional<JointLimits> limits = {};   ///< of the distance; upper may be kUnlimited   [m]   >= 0
    std::optional<JointMotor> motor = {};     ///< speed > 0 lengthens                        [m/s], [N]
    std::optional<JointSpring> spring = {};   ///< towards the length `rest`                  [m]

    friend constexpr bool operator==(const DistanceJoint&, const DistanceJoint&) noexcept = default;
};

/// B slides along an axis fixed in A and does not turn against it.
struct PrismaticJoint {
    Vec2 anchorA = {};           ///< in each body's frame                               [m]
    Vec2 anchorB = {};
    Vec2 axis = {1, 0};          ///< in A's frame, of any length but 0                  [1]
    double referenceAngle = 0;   ///< of B against A                                     [rad]
    std::optional<JointLimits> limits = {};   ///< of the way along the axis             [m]
    std::optional<JointMotor> motor = {};     ///< [m/s], [N]
    std::optional<JointSpring> spring = {};   ///< towards the place `rest`              [m]

    friend constexpr bool operator==(const PrismaticJoint&, const PrismaticJoint&) noexcept = default;
};

/// Two bodies as one. With springs it gives way: `linear` to forces, `angular` to torques.
struct WeldJoint {
    Vec2 anchorA = {};           ///< in each body's frame   [m]
    Vec2 anchorB = {};
    double referenceAngle = 0;   ///< of B against A         [rad]
    std::optional<JointSpring> linear = {};    ///< none: stiff. Its `rest` must be 0
    std::optional<JointSpring> angular = {};   ///< none: stiff. Its `rest` must be 0

    friend constexpr bool operator==(const WeldJoint&, const WeldJoint&) noexcept = default;
};

/// Pulls a point of B to a place in the world, and B to an angle if there is one, by a damped spring of
/// limited force: for dragging. A bears the reaction; take a static body for a hand.
struct TargetJoint {
    Vec2 anchor = {};                       ///< in B's frame                            [m]
    Position target = {};                   ///< in the world                            [m]
    std::optional<double> angle = {};       ///< of B, by the shorter way                [rad]
    real frequency = 5;                     ///< of B on the spring                      [Hz]   > 0
    real dampingRatio = 1;                  ///< [1]   >= 0
    real maxForce = kUnlimited;             ///< [N]   >= 0
    real maxTorque = kUnlimited;            ///< [N*m] >= 0

    friend constexpr bool operator==(const TargetJoint&, const TargetJoint&) noexcept = default;
};

/// One of the kinds.
using JointKind = std::variant<RevoluteJoint, DistanceJoint, PrismaticJoint, WeldJoint, TargetJoint>;

/// When a joint breaks: by what it bears on average over a step, or by how far it has given way.
struct JointBreaking {
    real force = kUnlimited;    ///< [N]     > 0
    real torque = kUnlimited;   ///< [N*m]   > 0
    real error = kUnlimited;    ///< [m]     > 0

    friend constexpr bool operator==(const JointBreaking&, const JointBreaking&) noexcept = default;
};

/// What a new joint is like.
struct JointDef {
    BodyId bodyA = {}, bodyB = {};    ///< two bodies of the world, at least one of them dynamic
    JointKind kind = RevoluteJoint{};
    bool collideConnected = false;    ///< may the two bodies touch each other?
    bool enabled = true;              ///< a joint that is not does nothing
    JointBreaking breaking = {};
    std::string name = {};            ///< for messages and scene files; need not be unique
    std::uint64_t userData = 0;       ///< yours
};

/// At which of its limits a joint is.
enum class LimitState : std::uint8_t { Free, AtLower, AtUpper };

/// What a joint did in the last step, and where it is now.
struct JointReading {
    Vec2 force;               ///< on B at its anchor (-force on A), averaged over the step          [N]
    real torque = 0;          ///< on B beside that force, averaged likewise                        [N*m]
    double position = 0;  ///< angle, length or way along the axis: the one that the kind has    [m] or [rad]
    real speed = 0;  ///< its rate                                                          [m/s] or [rad/s]
    real error = 0;  ///< distance of what should be together                               [m]   >= 0
    real angularError = 0;  ///< likewise, of angles                                               [rad] >= 0
    LimitState limit = LimitState::Free;
    real limitForce = 0;  ///< > 0 away from the lower limit, averaged             [N] or [N*m]
    real motorForce = 0;  ///< averaged                                            [N] or [N*m]
    real motorPower = 0;  ///< given to the bodies, averaged                       [W]
    real springForce = 0;  ///< averaged                                            [N] or [N*m]
    double springEnergy = 0;  ///< stored now                                          [J]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
