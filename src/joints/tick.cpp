// SPDX-License-Identifier: MIT
// The stages of a tick: where joints are, what they are asked for, what they did.

#include "joints/tick.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
std::uint32_t JointSystem::countFaults() const
{
    std::uint32_t sum = ownFaults;
    for (const JointRows& joint : joints) sum += joint.faults;
    return sum;
}

void measureJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                   JointSystem& system, std::size_t first)
{
    for (std::size_t j = first; j < system.joints.size(); ++j) {
        JointRows& rows = system.joints[j];
        JointRow& joint = table.rows[rows.joint];
        const Motion &a = motions.rows[rows.rowA], &b = motions.rows[rows.rowB];
        if (rows.own) {
            followOwnCount(joint, motions);
            if (!measureOwnNow(joint, bodies, motions, rows)) ++rows.faults;
            prepareRows(rows, motions.rows);
            continue;
        }
        followCount(joint, a.angle, b.angle);
        const JointPose pose = poseOf(joint, bodies, a, b, placeOf(a), placeOf(b), joint.angle);
        measureJoint(joint.def.kind, pose, rows);
        prepareRows(rows, motions.rows);
    }
}

void startJoints(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                 const StepContext& context, JointSystem& system)
{
    for (std::size_t d = 0; d < system.directCount; ++d) system.direct[d].begins = true;
    system.lostGroups.assign(system.wholeGroups.size(), 0);
    for (JointRows& rows : system.joints) {
        startRows(rows, table.rows[rows.joint], context);
        const auto velocityOf = [&](std::uint32_t row) {
            return BodyMotion<real>{motions.rows[row].velocity, motions.rows[row].spin};
        };
        aimJoint(table, bodies, motions, velocityOf, context, rows);
    }
}

real aimPair(const JointTable& table, const BodyTable& bodies, const BodyPair& pair,
             const StepContext& context, JointRows& rows)
{
    return aimRows(rows, jointAhead(table.rows[rows.joint], bodies, pair, context), pair, context);
}

real aimOwn(const JointTable& table, const BodyTable& bodies, const BodySet& set, const StepContext& context,
            JointRows& rows)
{
    JointRows ahead;
    if (!measureOwnAhead(table.rows[rows.joint], bodies, set, context.h, ahead)) {
        ++rows.faults;
        for (int i = 0; i < rows.count; ++i)  // straight on
            ahead.rows[i].error = rows.rows[i].error + context.h * speedOf(rows, i, set);
    }
    return aimRows(rows, ahead, set, context);
}

JointRows jointAhead(const JointRow& joint, const BodyTable& bodies, const BodyPair& pair,
                     const StepContext& context)
{
    const Motion &a = pair.a, &b = pair.b;
    const BodyPlace placeA = placeAhead(a, pair.va, context.h), placeB = placeAhead(b, pair.vb, context.h);
    const double turned = joint.angle + (placeB.angle - b.angle) - (placeA.angle - a.angle);
    JointRows ahead;
    measureJoint(joint.def.kind, poseOf(joint, bodies, a, b, placeA, placeB, turned), ahead);
    return ahead;
}

namespace {

// What a visited joint did, added to the sums of the step.
void tally(JointRow& joint, const JointRows& rows, const Table<Motion>& motions,
           const Table<LaneRow>& velocities)
{
    const auto velocityOf = [&](std::uint32_t row) {
        const LaneRow& v = velocities[row];
        return BodyMotion<real>{{v.x, v.y}, v.z};
    };
    const auto speedOfRow = [&](int i) {
        if (rows.more) return speedOf(rows, i, bodySetOf(rows, motions, velocityOf));
        return speedAlong(rows.rows[i].j, velocityOf(rows.rowA), velocityOf(rows.rowB));
    };
    for (int i = 0; i < rows.count; ++i) {
        const ConstraintRow& row = rows.rows[i];
        const real impulse = rows.visits[i].impulse;
        joint.stepSums[row.slot] += impulse;
        joint.stepImpulse += impulse * row.j.linearB;
        joint.stepTurn += impulse * (row.j.turnB - cross(rows.armB, row.j.linearB));
        if (row.kind == RowKind::Motor)
            joint.stepWork += static_cast<double>(impulse) * static_cast<double>(speedOfRow(i));
    }
}

}  // namespace

void tallyJoints(JointTable& table, const JointSystem& system, const Table<Motion>& rows,
                 const Table<LaneRow>& velocities)
{
    for (const JointRows& joint : system.joints) tally(table.rows[joint.joint], joint, rows, velocities);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
