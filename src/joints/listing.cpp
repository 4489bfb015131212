// SPDX-License-Identifier: MIT
// Which joints act, in what order, which bodies they tie together, and who solves them: the lists of
// JointSystem.
#include "joints/softness.hpp"
#include "joints/tick.hpp"

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
    const auto root = [&](std::uint32_t i) {
        while (group[i] != i) i = group[i] = group[group[i]];
        return i;
    };
    for (const JointTie& joint : system.ties) {
        const std::uint32_t first = joint.movingRow(motions.rows);
        joint.eachRow([&](std::uint32_t row) {
            if (!motions.rows[row].moves()) return;
            if (group[row] == JointSystem::kNone) group[row] = row;
            if (group[first] == JointSystem::kNone) group[first] = first;
            const std::uint32_t a = root(first), b = root(row);
            if (a != b) group[maximum(a, b)] = minimum(a, b);
        });
    }

    // A leader stands before all it leads, so its number is known when they ask for it.
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < group.size(); ++i)
        if (group[i] != JointSystem::kNone) group[i] = root(i);
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

// --- which groups are solved at once: docs/theory/joints.md, section 7

constexpr std::size_t kFew = 4;       // bodies of which solving at once costs no more
constexpr std::size_t kFill = 4;      // blocks for each body, likewise

bool isUneven(const JointTie& joint, const Table<Motion>& motions)
{
    if (!joint.more) return areUneven(motions[joint.rowA], motions[joint.rowB], kUnevenTies);
    return joint.anyRow([&](std::uint32_t a) {
        return joint.anyRow([&](std::uint32_t b) { return areUneven(motions[a], motions[b], kUnevenTies); });
    });
}

// Does one visit leave something to another one, even where there is no other joint? A pulley has stops
// beside its rope; one's own rows may be any.
bool isOfSeveral(const JointRow& joint)
{
    return std::holds_alternative<PulleyJoint>(joint.def.kind) || blocksOf(joint.layout) > 1;
}

// Do its loops make it too expensive?
bool fillsUp(const DirectGroup& group)
{
    return group.matrix.fill() > kFill * group.rows.size();
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

void chooseStiff(JointTable& table, const Table<Motion>& motions, JointSystem& system)
{
    const std::size_t groups = system.wholeGroups.size();
    std::vector<std::size_t>&members = system.members, &bodies = system.bodies;
    members.assign(groups, 0);
    bodies.assign(groups, 0);
    system.stiffGroups.assign(groups, 0);
    system.unevenGroups.assign(groups, 0);
    system.piledGroups.assign(groups, 0);
    system.softenedGroups.assign(groups, 0);
    system.ownGroups.assign(groups, 0);
    system.pulledGroups.assign(groups, 0);
    system.lanedGroups.assign(groups, 0);
    for (const std::uint32_t group : system.groupOf)
        if (group != JointSystem::kNone) ++bodies[group];
    for (JointTie& tie : system.ties) {
        JointRow& joint = table.rows[tie.joint];
        members[tie.group] += isOfSeveral(joint) ? 2 : 1;
        if (std::holds_alternative<OwnJoint>(joint.def.kind)) system.ownGroups[tie.group] = 1;
        if (std::holds_alternative<TargetJoint>(joint.def.kind)) system.pulledGroups[tie.group] = 1;
        tie.uneven = isUneven(tie, motions);
        if (tie.uneven) {
            joint.stiffSteps = kHold;
            system.unevenGroups[tie.group] = 1;
        }
        if (joint.stiffSteps > 0) {
            --joint.stiffSteps;
            system.stiffGroups[tie.group] = 1;
        }
    }
    for (std::size_t g = 0; g < groups; ++g) {
        if (bodies[g] <= kFew) system.stiffGroups[g] = 1;
        if (!hasStiffSize(system, static_cast<std::uint32_t>(g))) system.stiffGroups[g] = 0;
    }
    // Those that count their steps are looked at again in the next one.
    for (const JointTie& tie : system.ties)
        if (system.stiffGroups[tie.group] && !tie.uneven && table.rows[tie.joint].stiffSteps > 0)
            system.isAltered = true;
}

// The joints of stiff groups, and the order in which their bodies are eliminated.
void orderStiff(const Table<Motion>& motions, JointSystem& system)
{
    const std::size_t groups = system.wholeGroups.size();
    std::vector<std::size_t>& placeOf = system.placeOf;
    placeOf.assign(groups, 0);
    system.directCount = 0;
    for (std::size_t g = 0; g < groups; ++g) {
        if (!system.stiffGroups[g]) continue;
        placeOf[g] = system.directCount++;
        if (system.direct.size() < system.directCount) system.direct.emplace_back();
        system.direct[placeOf[g]].joints.clear();
    }
    for (std::size_t j = 0; j < system.joints.size(); ++j)
        if (system.stiffGroups[system.joints[j].group])
            system.direct[placeOf[system.joints[j].group]].joints.push_back(static_cast<std::uint32_t>(j));
    std::size_t kept = 0;
    for (std::size_t d = 0; d < system.directCount; ++d) {
        DirectGroup& direct = system.direct[d];
        direct.build(system.joints, motions);
        if (fillsUp(direct)) {
            system.stiffGroups[system.joints[direct.joints.front()].group] = 0;
            continue;
        }
        if (kept != d) std::swap(system.direct[kept], direct);
        ++kept;
    }
    system.directCount = kept;
    for (JointRows& rows : system.joints)
        rows.rigidly = system.members[rows.group] == 1 || system.stiffGroups[rows.group];
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
    return !system.isAltered && system.changes == table.changes &&
           std::equal(system.listed.begin(), system.listed.end(), motions.rows.begin(), motions.rows.end(),
                      [](const ListedRow& listed, const Motion& m) { return listed == listedRow(m); });
}

// The lists of the step before for another one.
void keepLists(JointTable& table, const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    system.fallbacks = 0;
    system.groupOf.resize(motions.rows.size());
    for (JointRows& joint : system.joints) {
        JointRows fresh;
        static_cast<JointTie&>(fresh) = joint;
        fresh.rigidly = joint.rigidly;
        joint = fresh;
    }
    for (std::size_t d = 0; d < system.directCount; ++d) system.direct[d].build(system.joints, motions.rows);
    measureJoints(table, bodies, motions, system);
}

}  // namespace

bool areUneven(const Motion& a, const Motion& b, double ratio)
{
    const auto p = static_cast<double>(a.greatestInvMass()), q = static_cast<double>(b.greatestInvMass());
    return p > 0 && q > 0 && (p > ratio * q || q > ratio * p);
}

void soften(JointSystem& system, std::size_t direct)
{
    for (const std::uint32_t j : system.direct[direct].joints) {
        system.joints[j].rigidly = false;
        system.stiffGroups[system.joints[j].group] = 0;
        system.softenedGroups[system.joints[j].group] = 1;
    }
    system.isAltered = true;
    --system.directCount;
    if (direct != system.directCount) std::swap(system.direct[direct], system.direct[system.directCount]);
    ++system.fallbacks;
}

bool stiffen(JointSystem& system, const Table<Motion>& motions, std::uint32_t group)
{
    if (system.direct.size() == system.directCount) system.direct.emplace_back();
    DirectGroup& direct = system.direct[system.directCount];
    direct.joints.clear();
    for (std::uint32_t j = 0; j < system.joints.size(); ++j)
        if (system.joints[j].group == group) direct.joints.push_back(j);
    direct.build(system.joints, motions);
    if (fillsUp(direct)) return false;
    direct.begins = true;
    system.isAltered = true;
    ++system.directCount;
    system.stiffGroups[group] = 1;
    for (const std::uint32_t j : direct.joints) system.joints[j].rigidly = true;
    return true;
}

void gatherJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    system.ownFaults = 0;
    if (areListed(table, motions, system)) {
        for (const JointTie& tie : system.ties) {
            JointRow& joint = table.rows[tie.joint];
            forgetSums(joint);
            if (joint.stiffSteps > 0) joint.stiffSteps = tie.uneven ? kHold - 1 : joint.stiffSteps - 1;
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
