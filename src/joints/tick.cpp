// SPDX-License-Identifier: MIT
#include "joints/tick.hpp"

#include "joints/softness.hpp"

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

std::uint32_t JointSystem::countFaults() const
{
    std::uint32_t sum = ownFaults;
    for (const JointRows& joint : joints) sum += joint.faults;
    return sum;
}

bool mayBeStiffened(const JointSystem& system, std::uint32_t group)
{
    return !system.stiffGroups[group] && !system.piledGroups[group] && !system.softenedGroups[group] &&
           !system.ownGroups[group] && !system.lanedGroups[group] && hasStiffSize(system, group);
}

bool hasStiffSize(const JointSystem& system, std::uint32_t group)
{
    constexpr std::size_t kMany = 300;  // bodies from which solving at once costs too much
    return system.members[group] >= 2 && system.bodies[group] <= kMany;
}

bool mayProject(const JointSystem& system)
{
    if (system.directCount > 0) return true;
    for (std::uint32_t group = 0; group < system.wholeGroups.size(); ++group)
        if (mayBeStiffened(system, group)) return true;
    return false;
}

void findTorn(JointSystem& system, const StepContext& context, std::vector<std::uint8_t>& groups)
{
    constexpr real kTorn = real(1e-2);  // of the arms
    for (const JointRows& joint : system.joints) {
        if (groups[joint.group] != 0 || !mayBeStiffened(system, joint.group)) continue;
        if (joint.anyRow([&](std::uint32_t row) { return system.hit[row] != 0; })) continue;
        const real arms = length(joint.armA) + length(joint.armB), part = joint.whole ? real(1) : real(2);
        for (int i = 0; i < joint.count; ++i) {
            const ConstraintRow& row = joint.rows[i];
            if (row.angular || (row.kind != RowKind::Rigid && !row.bears)) continue;
            const real give = predictedGive(row, part * joint.visits[i].impulse, context.h);
            if (!(give <= kTorn * arms)) groups[joint.group] = 1;
        }
    }
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

namespace {

// Another moment of inertia, and the spin that has the same energy with it: with the same spin, or the same
// angular momentum, each change would do work.
void takeInertia(Motion& m, real invInertia)
{
    if (m.invInertia > 0 && invInertia > 0) m.spin *= std::sqrt(invInertia / m.invInertia);
    m.invInertia = invInertia;
}

}  // namespace

namespace {

// What resists the turning of a tie at a distance in the tick [eq. 13]. `pull` is its impulse in the last
// one.
real turnMassOf(const JointRows& joint, real pull, const Motion& a, const Motion& b,
                const StepContext& context)
{
    constexpr real kOwn = real(0.1);  // of the lighter mass: up to there nothing is done
    const real inverse = maximum(a.greatestInvMass(), b.greatestInvMass());
    if (!(joint.distance > 0) || !(inverse > 0)) return 0;
    return maximum(real(0), context.h * pull / joint.distance - kOwn / inverse);
}

}  // namespace

namespace {

constexpr real kStiff = 4;  // a body may turn by 1/sqrt(this) radians of its swing in a tick

// What a joint pulls at its bodies, by the impulse of each row. Returns its impulse on B.
template <class ImpulseOf>
Vec2 addPull(const JointRows& joint, ImpulseOf impulseOf, std::vector<real>& pull)
{
    Vec2 onA, onB;
    for (int i = 0; i < joint.count; ++i) {
        onA += impulseOf(i) * joint.rows[i].j.linearA;
        onB += impulseOf(i) * joint.rows[i].j.linearB;
    }
    pull[joint.rowA] += length(joint.armA) * length(onA);
    pull[joint.rowB] += length(joint.armB) * length(onB);
    for (int k = 0; joint.more && k < joint.more->count; ++k) {
        Vec2 on;
        for (int i = 0; i < joint.count; ++i) on += impulseOf(i) * joint.more->parts[i][k].linear;
        pull[joint.more->rows[k]] += length(joint.more->arms[k]) * length(on);
    }
    return onB;
}

}  // namespace

bool guardLightBodies(const JointTable& table, JointSystem& system, Table<Motion>& rows,
                      const StepContext& context)
{
    for (JointRows& joint : system.joints) {
        const JointRow& carried = table.rows[joint.joint];
        const Vec2 onB =
            addPull(joint, [&](int i) { return carried.impulses[joint.rows[i].slot]; }, system.pull);
        joint.turnMass = turnMassOf(joint, dot(onB, perpendicular(joint.across.linearB)), rows[joint.rowA],
                                    rows[joint.rowB], context);
    }
    bool changed = false;
    const real share = kStiff * context.h;
    const real *const own = system.ownInvInertia.data(), *const pull = system.pull.data();
    const auto guard = [&](std::uint32_t row) {
        const real needed = share * pull[row];
        const real used = own[row] * needed > 1 ? 1 / needed : own[row];
        if (used == rows[row].invInertia) return;
        changed = true;
        takeInertia(rows[row], used);
    };
    for (const std::uint32_t row : system.guarded) guard(row);
    system.guarded.clear();
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
        if (!(own[row] * (share * pull[row]) > 1)) continue;
        guard(row);
        system.guarded.push_back(row);
    }
    if (changed)
        for (JointRows& joint : system.joints) prepareRows(joint, rows);
    return changed;
}

void findOutgrown(JointSystem& system, const Table<Motion>& rows, const StepContext& context,
                  std::vector<std::uint8_t>& groups)
{
    constexpr real kOutgrown = 2;  // times what the tick was begun with
    if (system.directCount == 0) return;
    system.pull.assign(rows.size(), 0);
    for (const JointRows& joint : system.joints) {
        if (!system.stiffGroups[joint.group]) continue;
        const real part = joint.whole ? real(1) : real(2);
        const Vec2 onB = addPull(joint, [&](int i) { return part * joint.visits[i].impulse; }, system.pull);
        if (!(joint.distance > 0)) continue;
        const real inverse = maximum(rows[joint.rowA].greatestInvMass(), rows[joint.rowB].greatestInvMass());
        const real needed = context.h * dot(onB, perpendicular(joint.across.linearB)) / joint.distance;
        if (inverse > 0 && !(needed <= kOutgrown * (joint.turnMass + 1 / inverse))) groups[joint.group] = 1;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::uint32_t group = system.groupOf[i];
        if (group == JointSystem::kNone || !system.stiffGroups[group]) continue;
        if (!(kStiff * context.h * system.pull[i] * rows[i].invInertia <= kOutgrown)) groups[group] = 1;
    }
}

void releaseGuard(JointSystem& system, Table<Motion>& rows)
{
    for (const std::uint32_t row : system.guarded)
        if (rows[row].invInertia != system.ownInvInertia[row])
            takeInertia(rows[row], system.ownInvInertia[row]);
    system.guarded.clear();
}

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

void startJoints(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                 const StepContext& context, JointSystem& system)
{
    for (std::size_t d = 0; d < system.directCount; ++d) system.direct[d].begins = true;
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
        if (kept.strainedTicks < kLasting) continue;
        kept.stiffSteps = kHold;
        if (hasStiffSize(system, joint.group) && !system.stiffGroups[joint.group]) ++table.changes;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
