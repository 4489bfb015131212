// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/ids.hpp>
#include <tamias2d/math/transform.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Two shapes began or stopped touching: gap <= Tuning::touchingFactor x the rest gap at the end
/// of a step. Ids of destroyed shapes stay readable here.
struct TouchEvent {
    ShapeId shapeA, shapeB;
    BodyId bodyA, bodyB;
};

/// One impulse of an impact. Most act alone, at their time: velocities after them follow DD8 with exactly
/// these figures. Slow impacts in crowds, of C_R < 1, are `simultaneous`: stopped plastically, together
/// with all around them, within one tick [ADR21]. The contact changed the momenta of its two bodies in that
/// tick by exactly these impulses at these arms; so did other contacts and forces, and velocities after the
/// tick are the sum of all. What is still to close as the tick begins closes with its end, and the speed
/// left until then is stopped as a load of the next: two bodies alone get (1 - t/h) of the whole impulse,
/// with t the time in the tick of length h. The approach speed is always whole.
struct HitEvent {
    ShapeId shapeA, shapeB;
    BodyId bodyA, bodyB;
    double time = 0;            ///< of the world's clock                          [s]
    Position point;             ///< where it acted                                [m]
    Vec2 normal;                ///< from A to B, length 1                         [1]
    Vec2 armA, armB;            ///< from each center of mass to the point: r_AP, r_BP  [m]
    real approachSpeed = 0;     ///< -n . (v_B - v_A) at the point, before; > 0    [m/s]
    real restitution = 0;       ///< that acted: of the pair, or 0 where a crowd ended it   [1]
    real normalImpulse = 0;     ///< j along the normal on B, -j on A              [N*s]
    real tangentImpulse = 0;    ///< friction, along the normal turned by +90 degrees, on B   [N*s]
    Vec2 velocityA, velocityB;            ///< of the centers, just before             [m/s]
    real angularVelocityA = 0, angularVelocityB = 0;  ///< just before                 [rad/s]
    std::uint32_t group = 0;    ///< impulses of one two-point impact share a number (they act at once)
    bool simultaneous = false;  ///< stopped in one tick with all around it: see above
};

/// A joint that broke at the end of the step: from now on it is disabled.
struct BreakEvent {
    JointId joint;
    BodyId bodyA, bodyB;
    Vec2 force;          ///< on B, averaged over the step   [N]
    real torque = 0;     ///< likewise                       [N*m]
    real error = 0;      ///< [m]
};

/// What one step reports. Sorted, always complete, valid until the next step.
struct StepEvents {
    std::span<const TouchEvent> begins;  ///< sorted by shape ids
    std::span<const TouchEvent> ends;    ///< sorted by shape ids; includes those of destroyed shapes
    std::span<const HitEvent> hits;      ///< in order of time, then shape ids
    std::span<const BreakEvent> breaks = {};  ///< sorted by joint id
};

/// One point of a contact.
struct ContactPoint {
    Position position;          ///< between the two surfaces                        [m]
    real separation = 0;        ///< gap between the surfaces, < 0 is overlap        [m]
    real normalImpulse = 0;     ///< summed over the last step, impacts included     [N*s]
    real tangentImpulse = 0;    ///< likewise, along the normal turned by +90 degrees   [N*s]
    std::uint32_t feature = 0;  ///< which corner or edge; stays the same while it touches
};

/// Two shapes near each other, as of the last step.
struct ContactView {
    ShapeId shapeA, shapeB;
    BodyId bodyA, bodyB;
    Vec2 normal;                ///< from A to B
    int pointCount = 0;         ///< 0 to 2
    std::array<ContactPoint, 2> points;
    Vec2 impulse;               ///< on B, summed over the last step, impacts included: the whole change of
                   ///< momentum this contact made [DD10], also by points that have gone since   [N*s]
    bool touching = false;
    real restGap = 0;  ///< [m]
    real friction = 0, restitution = 0;  ///< of the pair   [1]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
