// SPDX-License-Identifier: MIT
#include "joints/stiff_groups.hpp"

#include "joints/softness.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

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

// Where loops tie many bodies errors come back slowly. What rows of one's own repeat nobody knows.
void markMild(JointSystem& system, const DirectGroup& group)
{
    if (!group.loops || group.rows.size() <= kFew) return;
    if (system.ownGroups[system.joints[group.joints.front()].group] != 0) return;
    for (const std::uint32_t j : group.joints) system.joints[j].mildly = true;
}

}  // namespace

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
        if (joint.stiffSteps < 0) {
            ++joint.stiffSteps;
            system.softenedGroups[tie.group] = 1;
        }
        if (joint.stiffSteps > 0) {
            if (--joint.stiffSteps == 0) system.isAltered = true;  // the last one
            system.stiffGroups[tie.group] = 1;
        }
    }
    for (std::size_t g = 0; g < groups; ++g) {
        if (bodies[g] <= kFew) system.stiffGroups[g] = 1;
        if (!hasStiffSize(system, static_cast<std::uint32_t>(g)) || system.softenedGroups[g])
            system.stiffGroups[g] = 0;
    }
    // Those that count their steps are looked at again in the next one.
    for (const JointTie& tie : system.ties) {
        const bool counts =
            system.stiffGroups[tie.group] && !tie.uneven && table.rows[tie.joint].stiffSteps > 0;
        if (counts || system.softenedGroups[tie.group]) system.isAltered = true;
    }
}

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
    for (JointRows& rows : system.joints) {
        rows.rigidly = system.members[rows.group] == 1 || system.stiffGroups[rows.group];
        rows.mildly = false;
    }
    for (std::size_t d = 0; d < kept; ++d) markMild(system, system.direct[d]);
}

bool hasStiffSize(const JointSystem& system, std::uint32_t group)
{
    constexpr std::size_t kMany = 300;  // bodies from which solving at once costs too much
    return system.members[group] >= 2 && system.bodies[group] <= kMany;
}

bool mayBeStiffened(const JointSystem& system, std::uint32_t group)
{
    return !system.stiffGroups[group] && !system.piledGroups[group] && !system.softenedGroups[group] &&
           !system.ownGroups[group] && !system.lanedGroups[group] && hasStiffSize(system, group);
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

bool areUneven(const Motion& a, const Motion& b, double ratio)
{
    const auto p = static_cast<double>(a.greatestInvMass()), q = static_cast<double>(b.greatestInvMass());
    return p > 0 && q > 0 && (p > ratio * q || q > ratio * p);
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
    markMild(system, direct);
    return true;
}

void soften(JointSystem& system, std::size_t direct)
{
    for (const std::uint32_t j : system.direct[direct].joints) {
        system.joints[j].rigidly = system.joints[j].mildly = false;
        system.stiffGroups[system.joints[j].group] = 0;
        system.softenedGroups[system.joints[j].group] = 1;
    }
    system.isAltered = true;
    --system.directCount;
    if (direct != system.directCount) std::swap(system.direct[direct], system.direct[system.directCount]);
    ++system.fallbacks;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
