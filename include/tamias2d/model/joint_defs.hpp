// SPDX-License-Identifier: MIT
// What joints are like. Every kind is plain data; all of it may be changed while the joint is at work.
#pragma once

#include <tamias2d/base/ids.hpp>
#include <tamias2d/math/transform.hpp>
#include <tamias2d/model/constraint.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

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
    int turns = 0;  ///< whole ones that the angle begins with, beside what lies within half a turn
                    ///< of the reference; -100000 to 100000

    friend constexpr bool operator==(const RevoluteJoint&, const RevoluteJoint&) noexcept = default;
};

/// Two points stay at a distance: a rod. With limits a rope or a strut, with a spring a spring, with both a
/// spring that has stops.
struct DistanceJoint {
    Vec2 anchorA = {};  ///< in each body's frame   [m]
    Vec2 anchorB = {};
    real length = 1;  ///< of the rod; no rod if there are limits, a motor or a spring    [m]   > 0
    std::optional<JointLimits> limits = {};  ///< of the distance; upper may be kUnlimited   [m]   >= 0
    std::optional<JointMotor> motor = {};  ///< speed > 0 lengthens                        [m/s], [N]
    std::optional<JointSpring> spring = {};  ///< towards the length `rest`                  [m]

    friend constexpr bool operator==(const DistanceJoint&, const DistanceJoint&) noexcept = default;
};

/// B slides along an axis fixed in A and does not turn against it.
struct PrismaticJoint {
    Vec2 anchorA = {};  ///< in each body's frame                               [m]
    Vec2 anchorB = {};
    Vec2 axis = {1, 0};  ///< in A's frame, of any length but 0                  [1]
    double referenceAngle = 0;  ///< of B against A                                     [rad]
    std::optional<JointLimits> limits = {};  ///< of the way along the axis             [m]
    std::optional<JointMotor> motor = {};  ///< [m/s], [N]
    std::optional<JointSpring> spring = {};  ///< towards the place `rest`              [m]

    friend constexpr bool operator==(const PrismaticJoint&, const PrismaticJoint&) noexcept = default;
};

/// Two bodies as one. With springs it gives way: `linear` to forces, `angular` to torques.
struct WeldJoint {
    Vec2 anchorA = {};  ///< in each body's frame   [m]
    Vec2 anchorB = {};
    double referenceAngle = 0;  ///< of B against A         [rad]
    std::optional<JointSpring> linear = {};  ///< none: stiff. Its `rest` must be 0
    std::optional<JointSpring> angular = {};  ///< none: stiff. Its `rest` must be 0

    friend constexpr bool operator==(const WeldJoint&, const WeldJoint&) noexcept = default;
};

/// Pulls a point of B to a place in the world, and B to an angle if there is one, by a damped spring of
/// limited force: for dragging. A bears the reaction; take a static body for a hand.
struct TargetJoint {
    Vec2 anchor = {};  ///< in B's frame                            [m]
    Position target = {};  ///< in the world                            [m]
    std::optional<double> angle = {};  ///< of B, by the shorter way                [rad]
    real frequency = 5;  ///< of B on the spring                      [Hz]   > 0
    real dampingRatio = 1;  ///< [1]   >= 0
    real maxForce = kUnlimited;  ///< [N]   >= 0
    real maxTorque = kUnlimited;  ///< [N*m] >= 0

    friend constexpr bool operator==(const TargetJoint&, const TargetJoint&) noexcept = default;
};

/// B rolls on an axle that slides along an axis fixed in A: a suspension. The axis usually points from the
/// chassis (A) down to the wheel (B), or up.
struct WheelJoint {
    Vec2 anchorA = {};  ///< in each body's frame; B's is its hub                         [m]
    Vec2 anchorB = {};
    Vec2 axis = {0, 1};  ///< of the way, in A's frame, of any length but 0                [1]
    std::optional<JointLimits> limits = {};  ///< of the way of the hub along the axis        [m]
    std::optional<JointMotor> motor = {};  ///< turns the wheel against A                   [rad/s], [N*m]
    std::optional<JointSpring> spring = JointSpring{4, real(0.7), 0};  ///< along the axis    [m]

    friend constexpr bool operator==(const WheelJoint&, const WheelJoint&) noexcept = default;
};

/// A point of B slides on a segment fixed in A, and stops at its ends; B may turn about it.
struct GrooveJoint {
    Vec2 start = {-1, 0};  ///< of the groove, in A's frame; not where it ends   [m]
    Vec2 end = {1, 0};  ///< likewise                                         [m]
    Vec2 anchorB = {};  ///< the point, in B's frame                          [m]

    friend constexpr bool operator==(const GrooveJoint&, const GrooveJoint&) noexcept = default;
};

/// Holds the angle of B against A, and leaves their places free. With limits, a motor or a spring it is not
/// held but bounded, driven or pulled: a rotary limit, a rotary motor, a damped rotary spring.
struct RotaryJoint {
    double referenceAngle = 0;  ///< of B against A where the joint's angle is 0   [rad]
    std::optional<JointLimits> limits = {};  ///< of the joint's angle, several turns           [rad]
    std::optional<JointMotor> motor = {};  ///< [rad/s], [N*m]
    std::optional<JointSpring> spring = {};  ///< towards the angle `rest`                      [rad]
    int turns = 0;  ///< whole ones that the angle begins with, as of a RevoluteJoint

    friend constexpr bool operator==(const RotaryJoint&, const RotaryJoint&) noexcept = default;
};

/// B turns against A one way only: it may go back no farther than to the last tooth it passed.
struct RatchetJoint {
    double referenceAngle = 0;  ///< of B against A where a tooth is                              [rad]
    real tooth =
        real(0.5);  ///< angle from tooth to tooth; < 0 turns clockwise   [rad]   1e-3 to 1e3 either way

    friend constexpr bool operator==(const RatchetJoint&, const RatchetJoint&) noexcept = default;
};

/// Two wheels that turn together: angle of B = ratio * angle of A + phase, turns counted. Wheels that mesh
/// have a negative ratio, - radius of A/radius of B; wheels on a belt a positive one. What holds their axles
/// is not part of it: a gear passes on torques, the difference of which the ground bears.
struct GearJoint {
    real ratio = 1;  ///< turns of B for a turn of A             [1]     1e-3 to 1e3 either way
    double phase = 0;  ///< angle of B where that of A is 0        [rad]

    friend constexpr bool operator==(const GearJoint&, const GearJoint&) noexcept = default;
};

/// A rack (A) and a pinion (B): the way of the pinion's center along the rack = radius * the angle of the
/// pinion against the rack + offset, turns counted. It keeps nothing else: what guides the two are other
/// joints.
struct RackJoint {
    Vec2 anchorA = {};  ///< in each body's frame; B's is the pinion's center            [m]
    Vec2 anchorB = {};
    Vec2 axis = {1, 0};  ///< of the rack, in A's frame, of any length but 0              [1]
    real radius = 1;  ///< of the pinion; < 0 if it is on the rack's other side        [m]   not 0
    double offset = 0;  ///< the way where the angle is 0                                [m]

    friend constexpr bool operator==(const RackJoint&, const RackJoint&) noexcept = default;
};

/// A rope from A over two wheels in the world to B: lengthA + ratio * lengthB <= length, where the lengths
/// are those from the wheels to the anchors. With a ratio other than 1 it is a block and tackle. The wheels
/// are fixed and weigh nothing; the ground bears them.
struct PulleyJoint {
    Vec2 anchorA = {};  ///< in each body's frame                                       [m]
    Vec2 anchorB = {};
    Position wheelA = {-1, 0};  ///< in the world                                               [m]
    Position wheelB = {1, 0};
    real ratio = 1;  ///< pull on B over pull on A                         [1]     1e-3 to 1e3
    real length = 2;  ///< of the rope: lengthA + ratio * lengthB           [m]     > 0
    bool taut = false;  ///< it pushes as well as pulls, and is never slack
    real stopA = real(0.05);  ///< A comes no nearer to its wheel                             [m]     > 0
    real stopB = real(0.05);  ///< likewise                                                   [m]     > 0

    friend constexpr bool operator==(const PulleyJoint&, const PulleyJoint&) noexcept = default;
};

/// Drives B against A with no more than a force and a torque: at speeds, or, where there are springs, to a
/// place and an angle. For movers that push no harder than they should.
struct MotorJoint {
    Vec2 anchorA = {};  ///< in each body's frame                           [m]
    Vec2 anchorB = {};
    double referenceAngle = 0;  ///< of B against A                                 [rad]
    std::optional<JointSpring> linear = {};  ///< pulls B's anchor to A's. Its `rest` must be 0
    std::optional<JointSpring> angular = {};  ///< pulls B to the angle. Its `rest` must be 0
    Vec2 velocity = {};  ///< without `linear`: of B's anchor, in A's frame             [m/s]
    real spin = 0;  ///< without `angular`: of B against A                         [rad/s]
    real maxForce = kUnlimited;  ///< [N]   >= 0; 0: places are left alone
    real maxTorque = kUnlimited;  ///< [N*m] >= 0; 0: angles are left alone

    friend constexpr bool operator==(const MotorJoint&, const MotorJoint&) noexcept = default;
};

/// Dry friction of bodies that slide over each other in the plane, as seen from above: slows what B does
/// against A at one point, and how B turns against A, by a force and a torque, and up to these holds it
/// still.
struct FrictionJoint {
    Vec2 anchor = {};  ///< where it acts, in B's frame   [m]
    real maxForce = 0;  ///< [N]   >= 0
    real maxTorque = 0;  ///< [N*m] >= 0

    friend constexpr bool operator==(const FrictionJoint&, const FrictionJoint&) noexcept = default;
};

/// Does nothing but keep the two bodies from colliding; `collideConnected` undoes it. It ties nothing: each
/// sleeps, wakes and moves as if it were not there, it bears nothing and never breaks.
struct FilterJoint {
    friend constexpr bool operator==(const FilterJoint&, const FilterJoint&) noexcept = default;
};

/// One of the kinds.
using JointKind = std::variant<RevoluteJoint, DistanceJoint, PrismaticJoint, WeldJoint, TargetJoint,
                               WheelJoint, GrooveJoint, RotaryJoint, RatchetJoint, GearJoint, RackJoint,
                               PulleyJoint, MotorJoint, FrictionJoint, FilterJoint, OwnJoint>;

/// When a joint breaks: by what it bears on average over a step, or by how far it has given way at its end.
/// It does so at the end of the first step in which one of these has been exceeded in every step for `window`
/// seconds, that step included; with a window of 0, at the end of the first step that exceeds one.
struct JointBreaking {
    real force = kUnlimited;  ///< [N]     > 0
    real torque = kUnlimited;  ///< [N*m]   > 0
    real error = kUnlimited;  ///< [m]     > 0
    real window = 0;  ///< [s]     >= 0   a shorter blow does not break it

    friend constexpr bool operator==(const JointBreaking&, const JointBreaking&) noexcept = default;
};

/// What a new joint is like.
struct JointDef {
    BodyId bodyA = {}, bodyB = {};  ///< two bodies of the world, at least one of all dynamic
    JointKind kind = RevoluteJoint{};
    bool collideConnected = false;  ///< may the two bodies touch each other?
    bool enabled = true;  ///< a joint that is not does nothing
    JointBreaking breaking = {};
    std::string name = {};  ///< for messages and scene files; need not be unique
    std::uint64_t userData = 0;  ///< yours
    /// Of a joint of your own, those beyond two: constraintOf lists them. One on a single body has that as
    /// both A and B.
    std::vector<BodyId> moreBodies = {};
};

/// At which of its limits a joint is.
enum class LimitState : std::uint8_t { Free, AtLower, AtUpper };

/// What a joint did in the last step, and where it is now.
struct JointReading {
    Vec2 force;  ///< on B at its anchor (-force on A), averaged over the step          [N]
    real torque = 0;  ///< on B beside that force, averaged likewise                        [N*m]
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

/// What one row of a joint did in the last step, and where it is now.
struct JointRowReading {
    RowKind kind = RowKind::Rigid;
    bool angular = false;  ///< it is about angles: rad, N*m
    real error =
        0;  ///< C; of a limit the room that is left; 0 of a motor                        [m] or [rad]
    real speed =
        0;  ///< how fast C grows                                                     [m/s] or [rad/s]
    real force = 0;  ///< along the row, averaged: > 0 makes C grow; the motor's, the spring's   [N] or [N*m]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
