// SPDX-License-Identifier: MIT
// What all joints share: rows, each of which asks one thing of the velocities of the two bodies, and how
// their impulses answer it. Derivation: docs/theory/joints.md.
#pragma once

#include "joints/softness.hpp"
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
    bool touches = false;        // a limit that is the normal of a contact
    std::uint8_t pressedBy =
        0;  // of its friction, as bits: rows that bound it by `most` times their impulses
    bool pairBound = false;      // it and the row before it are bounded together, as a vector
    Jacobian j;
    real error = 0;              // C   [m] or [rad]
    real stiffness = 0, damping = 0;   // of a spring    [N/m], [N*s/m] or [N*m/rad], [N*m*s/rad]
    real speed = 0;              // of a motor           [m/s] or [rad/s]
    real most = kUnlimited;      // of a motor or spring   [N] or [N*m]; of friction, its coefficient
    real mass = 0;               // J M^-1 J^T             [1/kg] or [1/(kg*m^2)]
};

/// What a joint of one's own holds beyond two bodies, and its rows' directions there.
struct MoreBodies {
    static constexpr int kMost = ConstraintRows::kMostBodies - 2;

    int count = 0;
    std::uint32_t rows[kMost] = {};  // in the MotionTable
    Vec2 arms[kMost];                // from the centers of mass to where it holds them   [m]
    ConstraintRows::Part parts[ConstraintRows::kMostRows][kMost];
};

/// The bodies that a joint ties: rows of the MotionTable.
struct JointTie {
    std::uint32_t joint = 0;             // slot
    std::uint32_t rowA = 0, rowB = 0;    // of its bodies in the MotionTable
    std::uint32_t group = 0;             // of bodies that joints tie together
    bool own = false;                    // of a joint of one's own
    bool uneven = false;                 // are masses among them that soft rows cannot be trusted with?
    MoreBodies* more = nullptr;          // beyond two

    /// Each of its bodies, once: rows of the MotionTable.
    template <class Visit>
    void eachRow(Visit visit) const
    {
        visit(rowA);
        if (rowB != rowA) visit(rowB);
        for (int k = 0; more && k < more->count; ++k) visit(more->rows[k]);
    }
    /// Is there a body of which this is true?
    template <class Test>
    bool anyRow(Test test) const
    {
        bool found = false;
        eachRow([&](std::uint32_t row) { found = found || test(row); });
        return found;
    }
    /// The first of its bodies that can be pushed; there is one.
    std::uint32_t movingRow(const Table<Motion>& motions) const
    {
        if (motions[rowA].moves()) return rowA;
        for (int k = 0; more && k < more->count; ++k)
            if (!motions[rowB].moves() && motions[more->rows[k]].moves()) return more->rows[k];
        return rowB;
    }
};

/// The rows of one joint in a tick. Rigid ones come first and are solved together.
struct JointRows : JointTie {
    static constexpr int kMost = ConstraintRows::kMostRows;

    bool rigidly = false;  // one visit settles it: alone in its group, or solved with it at once
    bool mildly = false;  // what has come apart comes back slowly
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
    std::uint32_t faults = 0;  // of a joint of one's own, in this step

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

/// The two bodies of a joint, and their velocities at hand.
struct BodyPair {
    const Motion &a, &b;
    BodyMotion<real> va, vb;
};

/// The bodies of a joint of more than two, likewise.
struct BodySet {
    static constexpr int kMost = ConstraintRows::kMostBodies;

    int count = 0;
    const Motion* motions[kMost] = {};
    BodyMotion<real> velocities[kMost];
};

/// `velocityOf` says the velocity of a row.
template <class VelocityOf>
BodySet bodySetOf(const JointRows& joint, const Table<Motion>& motions, VelocityOf velocityOf)
{
    BodySet set;
    const auto add = [&](std::uint32_t row) {
        set.motions[set.count] = &motions[row];
        set.velocities[set.count++] = velocityOf(row);
    };
    add(joint.rowA);
    add(joint.rowB);
    for (int k = 0; joint.more && k < joint.more->count; ++k) add(joint.more->rows[k]);
    return set;
}

inline real speedOf(const JointRows& joint, int i, const BodyPair& bodies)
{
    return speedAlong(joint.rows[i].j, bodies.va, bodies.vb);
}
inline real speedOf(const JointRows& joint, int i, const BodySet& bodies)
{
    real speed = speedAlong(joint.rows[i].j, bodies.velocities[0], bodies.velocities[1]);
    for (int k = 2; k < bodies.count; ++k) {
        const ConstraintRows::Part& part = joint.more->parts[i][k - 2];
        speed += dot(part.linear, bodies.velocities[k].velocity) + part.turn * bodies.velocities[k].spin;
    }
    return speed;
}

/// The impulse of a row, added to the velocities of its bodies.
inline void applyTo(const JointRows& joint, int i, real impulse, BodyPair& bodies)
{
    applyAlong(joint.rows[i].j, impulse, bodies.a, bodies.b, bodies.va, bodies.vb);
}
inline void applyTo(const JointRows& joint, int i, real impulse, BodySet& bodies)
{
    applyAlong(joint.rows[i].j, impulse, *bodies.motions[0], *bodies.motions[1], bodies.velocities[0],
               bodies.velocities[1]);
    for (int k = 2; k < bodies.count; ++k) {
        const ConstraintRows::Part& part = joint.more->parts[i][k - 2];
        const Motion& m = *bodies.motions[k];
        bodies.velocities[k].velocity +=
            {m.invMass.x * impulse * part.linear.x, m.invMass.y * impulse * part.linear.y};
        bodies.velocities[k].spin += m.invInertia * impulse * part.turn;
    }
}

/// Effective masses for the Jacobians at hand.
void prepareRows(JointRows& joint, const Table<Motion>& motions);

/// Impulses and bounds as a tick begins.
void startRows(JointRows& joint, const JointRow& carried, const StepContext& context);

/// What the rows ask for before the drift: that their errors have faded at its end, where without further
/// impulses they would be those of `ahead`, and the velocities are those of `bodies` [eq. 4-9].
/// Returns by how much that differs from what they were last asked for.   [m/s]
template <class Bodies>
real aimRows(JointRows& joint, const JointRows& ahead, const Bodies& bodies, const StepContext& context);

/// What they ask for where the way ahead is not to be trusted: J v = 0.
void flattenRows(JointRows& joint, const StepContext& context);

/// How far a rigid row gives way that carries an impulse in every tick, when it is soft.   [m] or [rad]
real predictedGive(const ConstraintRow& row, real impulse, real h);

/// What they ask for after it: that nothing goes on moving apart [eq. 10].
void settleRows(JointRows& joint, const StepContext& context);

/// One visit, of BodyPair or BodySet; returns the greatest change of speed it made.   [m/s]
template <class Bodies>
real solveRows(JointRows& joint, Bodies& bodies);

}  // namespace tamias2d::inline TAMIAS_PRECISION
