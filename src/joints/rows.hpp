// SPDX-License-Identifier: MIT
// What all joints share: rows, each of which asks one thing of the velocities of the two bodies, and how
// their impulses answer it. Derivation: docs/theory/joints.md.
#pragma once

#include "model/joints.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// A direction in the space of the two bodies' velocities, and the speed along it [eq. 1].
struct Jacobian {
    Vec2 linearA, linearB;
    real turnA = 0, turnB = 0;

    Jacobian operator-() const { return {-linearA, -linearB, -turnA, -turnB}; }
};

enum class RowKind : std::uint8_t { Rigid, Spring, Motor, Limit };

/// What a row is asked in the visits of the moment, and what it has answered.
struct RowVisit {
    real bias = 0;               // the row asks for J v + bias = 0
    bool soft = false;           // and gives way a little
    real push = 0, give = 0;     // of a spring: its impulse is -push - give J v
    real low = 0, high = 0;      // bounds of the impulse
    real impulse = 0;            // [N*s] or [N*m*s]
    real first = 0;              // of the visits before the drift
};

/// One row: its direction J, the error C of which J v is the rate, and the impulse along it.
struct ConstraintRow {
    RowKind kind = RowKind::Rigid;
    std::uint8_t slot = 0;       // its place among the joint's impulses
    bool angular = false;        // J v is a speed of turning
    bool bears = false;          // a limit that bears loads as rigid rows do: the end of a rope
    bool pairBound = false;      // it and the row before it are bounded together, as a vector
    Jacobian j;
    real error = 0;              // C   [m] or [rad]
    real stiffness = 0, damping = 0;   // of a spring    [N/m], [N*s/m] or [N*m/rad], [N*m*s/rad]
    real speed = 0;              // of a motor           [m/s] or [rad/s]
    real most = kUnlimited;      // of a motor or spring   [N] or [N*m]
    real mass = 0;               // J M^-1 J^T             [1/kg] or [1/(kg*m^2)]
};

/// The rows of one joint in a tick. Rigid ones come first and are solved together.
struct JointRows {
    static constexpr int kMost = 6;

    std::uint32_t joint = 0;             // slot
    std::uint32_t rowA = 0, rowB = 0;    // of its bodies in the MotionTable
    std::uint32_t group = 0;             // of bodies that joints tie together
    bool rigidly = false;  // one visit settles it: alone in its group, or solved with it at once
    bool lost = false;                   // the passes did not find where it goes in this tick
    bool whole = false;  // solved once a tick: a body of the group bears a contact's load
    int count = 0, rigid = 0;
    ConstraintRow rows[kMost];
    RowVisit visits[kMost];
    real inverse[3][3] = {};  // of the rigid rows' J M^-1 J^T
    real reach = 0;  // how far the bodies extend   [m]
    Vec2 armA, armB;  // to the anchors              [m]
    real distance = 0;  // between the anchors, of what ties them over it; else 0   [m]
    Jacobian across;  // what turns the line between them
    real turnMass = 0;  // with which that resists in this tick   [kg]   [eq. 13]

    ConstraintRow& add(RowKind kind, int slot, const Jacobian& j, real error, bool angular);
};

inline real speedAlong(const Jacobian& j, const BodyMotion<real>& a, const BodyMotion<real>& b)
{
    return dot(j.linearA, a.velocity) + j.turnA * a.spin + dot(j.linearB, b.velocity) + j.turnB * b.spin;
}

inline void applyAlong(const Jacobian& j, real impulse, const Motion& a, const Motion& b,
                       BodyMotion<real>& va, BodyMotion<real>& vb)
{
    va.velocity += {a.invMass.x * impulse * j.linearA.x, a.invMass.y * impulse * j.linearA.y};
    va.spin += a.invInertia * impulse * j.turnA;
    vb.velocity += {b.invMass.x * impulse * j.linearB.x, b.invMass.y * impulse * j.linearB.y};
    vb.spin += b.invInertia * impulse * j.turnB;
}

/// Effective masses for the Jacobians at hand.
void prepareRows(JointRows& joint, const Motion& a, const Motion& b);

/// Impulses and bounds as a tick begins.
void startRows(JointRows& joint, const JointRow& carried, const StepContext& context);

/// What the rows ask for before the drift: that their errors have faded at its end, where without further
/// impulses they would be those of `ahead`, and the velocities are `va` and `vb` [eq. 4-9].
/// Returns by how much that differs from what they were last asked for.   [m/s]
real aimRows(JointRows& joint, const JointRows& ahead, const BodyMotion<real>& va, const BodyMotion<real>& vb,
             const StepContext& context);

/// What they ask for where the way ahead is not to be trusted: J v = 0.
void flattenRows(JointRows& joint, const StepContext& context);

/// How far a rigid row gives way that carries an impulse in every tick, when it is soft.   [m] or [rad]
real predictedGive(const ConstraintRow& row, real impulse, real h);

/// What they ask for after it: that nothing goes on moving apart [eq. 10].
void settleRows(JointRows& joint, const StepContext& context);

/// One visit; returns the greatest change of speed it made.   [m/s]
real solveRows(JointRows& joint, const Motion& a, const Motion& b, BodyMotion<real>& va,
               BodyMotion<real>& vb);

}  // namespace tamias2d::inline TAMIAS_PRECISION
