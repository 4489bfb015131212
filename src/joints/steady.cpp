// SPDX-License-Identifier: MIT
// What joints carry from tick to tick: its share in the steady changes of velocity, whom it loads, and what
// is kept of a tick.

#include "joints/softness.hpp"
#include "joints/tick.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

BodyMotion<real> steadyOf(const Motion& m)
{
    return {m.steady, m.steadySpin};
}
BodyMotion<real> steadyOf(const LaneRow& row)
{
    return {{row.x, row.y}, row.z};
}
void setSteady(Motion& m, const BodyMotion<real>& steady)
{
    m.steady = steady.velocity;
    m.steadySpin = steady.spin;
}
void setSteady(LaneRow& row, const BodyMotion<real>& steady)
{
    row = {steady.velocity.x, steady.velocity.y, steady.spin, row.w};
}

// Adds the velocity changes of impulses, one for each row of the joint, to the steady ones of its bodies.
template <class Steady, class ImpulseOf>
void addSteadyOf(const JointRows& joint, const Table<Motion>& rows, Table<Steady>& steady,
                 ImpulseOf impulseOf)
{
    const Motion &a = rows[joint.rowA], &b = rows[joint.rowB];
    BodyMotion<real> va = steadyOf(steady[joint.rowA]), vb = steadyOf(steady[joint.rowB]);
    for (int i = 0; i < joint.count; ++i) applyAlong(joint.rows[i].j, impulseOf(i), a, b, va, vb);
    if (a.moves()) setSteady(steady[joint.rowA], va);
    if (b.moves()) setSteady(steady[joint.rowB], vb);
    for (int k = 0; joint.more && k < joint.more->count; ++k) {
        const std::uint32_t row = joint.more->rows[k];
        const Motion& m = rows[row];
        BodyMotion<real> v = steadyOf(steady[row]);
        for (int i = 0; i < joint.count; ++i) {
            const ConstraintRows::Part& part = joint.more->parts[i][k];
            const real impulse = impulseOf(i);
            v.velocity += {m.invMass.x * impulse * part.linear.x, m.invMass.y * impulse * part.linear.y};
            v.spin += m.invInertia * impulse * part.turn;
        }
        setSteady(steady[row], v);
    }
}

template <class Steady>
void addSteadyJoint(const JointTable& table, const JointRows& joint, const Table<Motion>& rows,
                    Table<Steady>& steady)
{
    const JointRow& carried = table.rows[joint.joint];
    addSteadyOf(joint, rows, steady, [&](int i) { return carried.impulses[joint.rows[i].slot]; });
}

}  // namespace

void addSteadyJoints(const JointTable& table, const JointSystem& system, Table<Motion>& rows,
                     std::size_t firstRow)
{
    for (const JointRows& joint : system.joints)
        if (joint.rowA >= firstRow || joint.rowB >= firstRow) addSteadyJoint(table, joint, rows, rows);
}

void addSteadyJoints(const JointTable& table, const JointSystem& system, const Table<Motion>& rows,
                     Table<LaneRow>& steady)
{
    for (const JointRows& joint : system.joints) addSteadyJoint(table, joint, rows, steady);
}

void addSteadyHinges(const JointTable& table, const BodyTable& bodies, const JointSystem& system,
                     Table<Motion>& rows, std::size_t firstRow)
{
    for (const JointTie& tie : system.hinges) {
        if (tie.rowA < firstRow && tie.rowB < firstRow) continue;
        const JointRow& joint = table.rows[tie.joint];
        const auto& hinge = std::get<RevoluteJoint>(joint.def.kind);
        const real* const carried = joint.impulses;
        const Vec2 impulse{carried[JointSlot::kBlock], carried[JointSlot::kBlock + 1]};
        const real turn = carried[JointSlot::kSpring] + carried[JointSlot::kMotor] +
                          carried[JointSlot::kLower] - carried[JointSlot::kUpper];
        const auto add = [&](Motion& m, std::uint32_t body, Vec2 anchor, real sign) {
            if (!m.moves()) return;
            const Vec2 arm = rotate(m.rotation, anchor - bodies.rows[body].localCenter);
            m.steady += {sign * m.invMass.x * impulse.x, sign * m.invMass.y * impulse.y};
            m.steadySpin += sign * m.invInertia * (turn + cross(arm, impulse));
        };
        add(rows[tie.rowA], joint.bodyA, hinge.anchorA, -1);
        add(rows[tie.rowB], joint.bodyB, hinge.anchorB, 1);
    }
}

void turnSteadyJoints(JointSystem& system, const Table<Motion>& rows, Table<LaneRow>& turned,
                      const StepContext& context)
{
    for (std::size_t d = 0; d < system.directCount; ++d) system.direct[d].begins = true;
    for (JointRows& joint : system.joints) {
        settleRows(joint, context);
        if (joint.whole) continue;
        addSteadyOf(joint, rows, turned, [&](int k) { return 2 * joint.visits[k].impulse; });
    }
}

namespace {

real& loadOf(Motion& m)
{
    return m.load;
}
real& loadOf(LaneRow& row)
{
    return row.w;
}

template <class Row>
void spread(JointSystem& system, Table<Row>& rows)
{
    if (system.empty()) return;
    bool any = false;
    std::fill(system.wholeGroups.begin(), system.wholeGroups.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!(loadOf(rows[i]) > 0) || !system.isTied(i)) continue;
        system.wholeGroups[system.groupOf[i]] = 1;
        any = true;
    }
    for (std::size_t i = 0; any && i < rows.size(); ++i)
        if (system.isTied(i) && system.wholeGroups[system.groupOf[i]]) loadOf(rows[i]) = 1;
    for (JointRows& joint : system.joints) joint.whole = system.wholeGroups[joint.group] != 0;
}

}  // namespace

void spreadLoad(JointSystem& system, Table<Motion>& rows)
{
    spread(system, rows);
}

void spreadLoad(JointSystem& system, Table<LaneRow>& steady)
{
    spread(system, steady);
}

void keepJoints(JointTable& table, const JointSystem& system, const StepContext& context)
{
    for (const JointRows& joint : system.joints) {
        if (joint.anyRow([&](std::uint32_t row) { return system.hit[row] != 0; })) continue;
        JointRow& kept = table.rows[joint.joint];
        bool held[JointSlot::kLimits];
        std::copy(std::begin(kept.held), std::end(kept.held), std::begin(held));
        std::fill(std::begin(kept.impulses), std::end(kept.impulses), real(0));
        std::fill(std::begin(kept.held), std::end(kept.held), false);
        bool strained = false;
        for (int i = 0; i < joint.count; ++i) {
            const ConstraintRow& row = joint.rows[i];
            real& carried = kept.impulses[row.slot];
            const RowVisit& visit = joint.visits[i];
            carried = visit.first + visit.impulse;
            if (joint.lost || !std::isfinite(carried)) carried = 0;
            const real arms = length(joint.armA) + length(joint.armB);
            const real give = row.angular ? real(0) : predictedGive(row, carried, context.h);
            const bool bears = row.kind == RowKind::Rigid || row.bears;
            strained = strained || (bears && give > kMostGive * arms);
            if (row.kind != RowKind::Limit) continue;
            // The blow with which a limit is met is not a load it will bear.
            const int side = row.slot - JointSlot::kLower;
            kept.held[side] = carried > 0;
            if (!held[side]) carried = 0;
        }
        kept.strainedTicks = strained ? minimum(kept.strainedTicks + 1, kLasting) : 0;
        if (kept.strainedTicks < kLasting || kept.stiffSteps < 0) continue;
        kept.stiffSteps = kHold;
        if (hasStiffSize(system, joint.group) && !system.stiffGroups[joint.group]) ++table.changes;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
