// SPDX-License-Identifier: MIT
// Which joints act, in what order, which bodies they tie together, and who visits them: the lists of
// JointSystem.
#include "base/disjoint_sets.hpp"
#include "joints/softness.hpp"
#include "joints/stiff_groups.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Joints in the order of their bodies, whoever was made first.
void sortJoints(const JointTable& table, const MotionTable& motions, std::vector<std::uint32_t>& order)
{
    order.clear();
    for (const Motion& m : motions.rows) {
        const bool ground = !m.moves() && m.velocity == Vec2{} && m.spin == 0;
        if (ground) continue;  // its joints are found at their other bodies
        for (const std::uint32_t slot : table.of(m.body)) {
            const JointRow& joint = table.rows[slot];
            if (!joint.ties()) continue;
            bool areHere = true, moves = false;
            joint.eachBody([&](std::uint32_t body) {
                const std::uint32_t row = motions.rowOf[body];
                areHere = areHere && row != MotionTable::kNone;
                moves = moves || (areHere && motions.rows[row].moves());
            });
            if (areHere && moves) order.push_back(slot);
        }
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
        const JointRow &p = table.rows[i], &q = table.rows[k];
        const auto pLow = minimum(p.bodyA, p.bodyB), qLow = minimum(q.bodyA, q.bodyB);
        const auto pHigh = maximum(p.bodyA, p.bodyB), qHigh = maximum(q.bodyA, q.bodyB);
        return pLow != qLow ? pLow < qLow : pHigh != qHigh ? pHigh < qHigh : i < k;
    });
    order.erase(std::unique(order.begin(), order.end()), order.end());
}

// Bodies that can be pushed, tied together by joints.
void groupBodies(const MotionTable& motions, JointSystem& system)
{
    std::vector<std::uint32_t>& group = system.groupOf;
    group.assign(motions.rows.size(), JointSystem::kNone);
    DisjointSets sets(group);
    for (const JointTie& joint : system.ties) {
        const std::uint32_t first = joint.movingRow(motions.rows);
        joint.eachRow([&](std::uint32_t row) {
            if (!motions.rows[row].moves()) return;
            if (group[row] == JointSystem::kNone) group[row] = row;
            if (group[first] == JointSystem::kNone) group[first] = first;
            sets.join(first, row);
        });
    }

    // A leader stands before all it leads, so its number is known when they ask for it.
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < group.size(); ++i)
        if (group[i] != JointSystem::kNone) group[i] = sets.leader(i);
    std::vector<std::uint32_t>& numbers = system.numbers;
    numbers.assign(group.size(), 0);
    for (std::uint32_t i = 0; i < group.size(); ++i) {
        if (group[i] == JointSystem::kNone) continue;
        if (group[i] == i) numbers[i] = count++;
    }
    for (std::uint32_t& g : group)
        if (g != JointSystem::kNone) g = numbers[g];
    system.wholeGroups.assign(count, 0);
    for (JointTie& joint : system.ties) joint.group = group[joint.movingRow(motions.rows)];
}

// What lanes can take: a hinge of two bodies that the passes visit softly, and that have few enough of them
// for each to have a color of its own. Not where a target pulls: such a group may be solved at once from
// within a tick on.
void choosePlain(const JointTable& table, const Table<Motion>& motions, JointSystem& system)
{
    constexpr std::uint8_t kMostAt = 32;
    std::vector<std::uint8_t>& at = system.hingesAt;
    at.assign(motions.size(), 0);
    const auto mayBePlain = [&](const JointTie& tie) {
        return std::holds_alternative<RevoluteJoint>(table.rows[tie.joint].def.kind) &&
               tie.rowA != tie.rowB && !system.stiffGroups[tie.group] && !system.pulledGroups[tie.group] &&
               system.members[tie.group] > 1;
    };
    for (const JointTie& tie : system.ties)
        if (mayBePlain(tie))
            for (const std::uint32_t row : {tie.rowA, tie.rowB})
                if (motions[row].moves() && at[row] <= kMostAt) ++at[row];
    system.joints.clear();
    system.hinges.clear();
    for (const JointTie& tie : system.ties) {
        if (mayBePlain(tie) && at[tie.rowA] <= kMostAt && at[tie.rowB] <= kMostAt) {
            system.hinges.push_back(tie);
            system.lanedGroups[tie.group] = 1;
            continue;
        }
        system.joints.emplace_back();
        static_cast<JointTie&>(system.joints.back()) = tie;
    }
}

// For what guardLightBodies asks in every tick.
void noteInertias(const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    system.ownInvInertia.assign(motions.rows.size(), 0);
    for (std::size_t i = 0; i < motions.rows.size(); ++i)
        if (system.isTied(i)) system.ownInvInertia[i] = bodies.rows[motions.rows[i].body].invInertia();
}

void forgetSums(JointRow& joint)
{
    joint.stepImpulse = {};
    joint.stepTurn = 0;
    joint.stepWork = 0;
    std::fill(std::begin(joint.stepSums), std::end(joint.stepSums), real(0));
}

void listJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    ++system.listing;
    system.isAltered = false;
    system.ties.clear();
    system.fallbacks = 0;
    sortJoints(table, motions, system.order);
    const auto hasMore = [&](std::uint32_t slot) { return !table.rows[slot].more.empty(); };
    system.more.assign(
        static_cast<std::size_t>(std::count_if(system.order.begin(), system.order.end(), hasMore)), {});
    std::size_t more = 0;
    for (const std::uint32_t slot : system.order) {
        const JointRow& joint = table.rows[slot];
        JointTie tie;
        tie.joint = slot;
        tie.rowA = motions.rowOf[joint.bodyA];
        tie.rowB = motions.rowOf[joint.bodyB];
        tie.own = std::holds_alternative<OwnJoint>(joint.def.kind);
        if (hasMore(slot)) {
            tie.more = &system.more[more++];
            for (const std::uint32_t body : joint.more)
                tie.more->rows[tie.more->count++] = motions.rowOf[body];
        }
        system.ties.push_back(tie);
    }
    groupBodies(motions, system);
    chooseStiff(table, motions.rows, system);
    choosePlain(table, motions.rows, system);
    orderStiff(motions.rows, system);
    noteInertias(bodies, motions, system);
    measureJoints(table, bodies, motions, system);
}

ListedRow listedRow(const Motion& m)
{
    return {m.body, m.isDamped(), m.invMass, m.invInertia};
}

bool areListed(const JointTable& table, const MotionTable& motions, const JointSystem& system)
{
    if (system.isAltered || system.changes != table.changes) return false;
    if (table.ids.alive() == 0 && system.ties.empty()) return true;  // whoever takes part
    return std::equal(system.listed.begin(), system.listed.end(), motions.rows.begin(), motions.rows.end(),
                      [](const ListedRow& listed, const Motion& m) { return listed == listedRow(m); });
}

// The lists of the step before for another one.
void keepLists(JointTable& table, const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    system.fallbacks = 0;
    system.groupOf.resize(motions.rows.size(), JointSystem::kNone);
    for (JointRows& joint : system.joints) {
        JointRows fresh;
        static_cast<JointTie&>(fresh) = joint;
        fresh.rigidly = joint.rigidly;
        fresh.mildly = joint.mildly;
        joint = fresh;
    }
    for (std::size_t d = 0; d < system.directCount; ++d) system.direct[d].build(system.joints, motions.rows);
    measureJoints(table, bodies, motions, system);
}

}  // namespace

void gatherJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    system.ownFaults = 0;
    if (areListed(table, motions, system)) {
        for (const JointTie& tie : system.ties) {
            JointRow& joint = table.rows[tie.joint];
            forgetSums(joint);
            if (joint.stiffSteps > 0) joint.stiffSteps = tie.uneven ? kHold - 1 : joint.stiffSteps - 1;
            if (joint.stiffSteps < 0) ++joint.stiffSteps;
        }
        return keepLists(table, bodies, motions, system);
    }
    // Those that have left did nothing in this step, but what sleeps goes on to bear what it bore.
    for (const JointTie& old : system.ties) {
        JointRow& joint = table.rows[old.joint];
        if (!bodies.rows[joint.bodyA].isAsleep() && !bodies.rows[joint.bodyB].isAsleep()) forgetSums(joint);
    }
    listJoints(table, bodies, motions, system);
    system.changes = table.changes;
    system.listed.clear();
    for (const Motion& m : motions.rows) system.listed.push_back(listedRow(m));
    for (const JointTie& tie : system.ties) forgetSums(table.rows[tie.joint]);
}

void bringInJoints(JointTable& table, const BodyTable& bodies, MotionTable& motions, JointSystem& system,
                   std::size_t firstRow)
{
    system.ownFaults = system.countFaults();
    listJoints(table, bodies, motions, system);
    system.isAltered = true;
    for (const JointTie& tie : system.ties)
        if (tie.rowA >= firstRow || tie.rowB >= firstRow) forgetSums(table.rows[tie.joint]);
    addSteadyJoints(table, system, motions.rows, firstRow);
    addSteadyHinges(table, bodies, system, motions.rows, firstRow);
    spreadLoad(system, motions.rows);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
