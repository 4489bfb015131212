// SPDX-License-Identifier: MIT
#include "joints/tick.hpp"

#include "joints/softness.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>

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
constexpr std::size_t kMany = 300;    // bodies from which it costs too much
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
    for (const JointTie& tie : system.ties) {
        JointRow& joint = table.rows[tie.joint];
        members[tie.group] += isOfSeveral(joint) ? 2 : 1;
        if (std::holds_alternative<OwnJoint>(joint.def.kind)) system.ownGroups[tie.group] = 1;
        if (std::holds_alternative<TargetJoint>(joint.def.kind)) system.pulledGroups[tie.group] = 1;
        if (isUneven(tie, motions)) {
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
        if (members[g] < 2 || bodies[g] > kMany) system.stiffGroups[g] = 0;
    }
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

// Adds the velocity changes of impulses, one for each row of the joint, to the steady ones of its bodies.
template <class ImpulseOf>
void addSteadyOf(const JointRows& joint, Table<Motion>& rows, ImpulseOf impulseOf)
{
    Motion &a = rows[joint.rowA], &b = rows[joint.rowB];
    BodyMotion<real> va{a.steady, a.steadySpin}, vb{b.steady, b.steadySpin};
    for (int i = 0; i < joint.count; ++i) applyAlong(joint.rows[i].j, impulseOf(i), a, b, va, vb);
    if (a.moves()) a.steady = va.velocity, a.steadySpin = va.spin;
    if (b.moves()) b.steady = vb.velocity, b.steadySpin = vb.spin;
    for (int k = 0; joint.more && k < joint.more->count; ++k) {
        Motion& m = rows[joint.more->rows[k]];
        for (int i = 0; i < joint.count; ++i) {
            const ConstraintRows::Part& part = joint.more->parts[i][k];
            const real impulse = impulseOf(i);
            m.steady += {m.invMass.x * impulse * part.linear.x, m.invMass.y * impulse * part.linear.y};
            m.steadySpin += m.invInertia * impulse * part.turn;
        }
    }
}

void addSteadyJoint(const JointTable& table, const JointRows& joint, Table<Motion>& rows)
{
    const JointRow& carried = table.rows[joint.joint];
    addSteadyOf(joint, rows, [&](int i) { return carried.impulses[joint.rows[i].slot]; });
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
    measureJoints(table, bodies, motions, system);
}

}  // namespace

std::uint32_t JointSystem::countFaults() const
{
    std::uint32_t sum = ownFaults;
    for (const JointRows& joint : joints) sum += joint.faults;
    return sum;
}

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
    --system.directCount;
    if (direct != system.directCount) std::swap(system.direct[direct], system.direct[system.directCount]);
    ++system.fallbacks;
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

bool mayBeStiffened(const JointSystem& system, std::uint32_t group)
{
    return !system.stiffGroups[group] && !system.piledGroups[group] && !system.softenedGroups[group] &&
           !system.ownGroups[group] && !system.lanedGroups[group] && system.members[group] >= 2 &&
           system.bodies[group] <= kMany;
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
    ++system.directCount;
    system.stiffGroups[group] = 1;
    for (const std::uint32_t j : direct.joints) system.joints[j].rigidly = true;
    return true;
}

void gatherJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions, JointSystem& system)
{
    // Those that have left did nothing in this step, but what sleeps goes on to bear what it bore.
    for (const JointTie& old : system.ties) {
        JointRow& joint = table.rows[old.joint];
        if (!bodies.rows[joint.bodyA].isAsleep() && !bodies.rows[joint.bodyB].isAsleep()) forgetSums(joint);
    }
    system.ownFaults = 0;
    listJoints(table, bodies, motions, system);
    for (const JointTie& tie : system.ties) forgetSums(table.rows[tie.joint]);
}

void bringInJoints(JointTable& table, const BodyTable& bodies, MotionTable& motions, JointSystem& system,
                   std::size_t firstRow)
{
    system.ownFaults = system.countFaults();
    listJoints(table, bodies, motions, system);
    for (const JointRows& joint : system.joints) {
        if (joint.rowA < firstRow && joint.rowB < firstRow) continue;
        forgetSums(table.rows[joint.joint]);
        addSteadyJoint(table, joint, motions.rows);
    }
    for (const JointTie& tie : system.hinges)
        if (tie.rowA >= firstRow || tie.rowB >= firstRow) forgetSums(table.rows[tie.joint]);
    addSteadyHinges(table, bodies, system, motions.rows, firstRow);
    spreadLoad(system, motions.rows);
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

void guardLightBodies(const JointTable& table, const BodyTable& bodies, JointSystem& system,
                      Table<Motion>& rows, const StepContext& context)
{
    for (JointRows& joint : system.joints) {
        const JointRow& carried = table.rows[joint.joint];
        const Vec2 onB =
            addPull(joint, [&](int i) { return carried.impulses[joint.rows[i].slot]; }, system.pull);
        joint.turnMass = turnMassOf(joint, dot(onB, perpendicular(joint.across.linearB)), rows[joint.rowA],
                                    rows[joint.rowB], context);
    }
    bool changed = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (system.groupOf[i] == JointSystem::kNone) continue;
        const real own = bodies.rows[rows[i].body].invInertia(), needed = kStiff * context.h * system.pull[i];
        const real used = own * needed > 1 ? 1 / needed : own;
        if (used == rows[i].invInertia) continue;
        changed = true;
        takeInertia(rows[i], used);
    }
    if (!changed) return;
    for (JointRows& joint : system.joints) prepareRows(joint, rows);
}

void findOutgrown(JointSystem& system, const Table<Motion>& rows, const StepContext& context,
                  std::vector<std::uint8_t>& groups)
{
    constexpr real kOutgrown = 2;  // times what the tick was begun with
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

void releaseGuard(const BodyTable& bodies, Table<Motion>& rows)
{
    for (Motion& m : rows) {
        const real own = bodies.rows[m.body].invInertia();
        if (own != m.invInertia) takeInertia(m, own);
    }
}

void addSteadyJoints(const JointTable& table, const JointSystem& system, Table<Motion>& rows)
{
    for (const JointRows& joint : system.joints) addSteadyJoint(table, joint, rows);
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

void spreadLoad(JointSystem& system, Table<Motion>& rows)
{
    if (system.empty()) return;
    std::fill(system.wholeGroups.begin(), system.wholeGroups.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].isLoaded() && system.groupOf[i] != JointSystem::kNone)
            system.wholeGroups[system.groupOf[i]] = 1;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (system.groupOf[i] != JointSystem::kNone && system.wholeGroups[system.groupOf[i]])
            rows[i].load = 1;
    for (JointRows& joint : system.joints) joint.whole = system.wholeGroups[joint.group] != 0;
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
void tally(JointRow& joint, const JointRows& rows, const Table<Motion>& motions)
{
    const auto velocityOf = [&](std::uint32_t row) {
        return BodyMotion<real>{motions[row].velocity, motions[row].spin};
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

void tallyJoints(JointTable& table, const JointSystem& system, const Table<Motion>& rows)
{
    for (const JointRows& joint : system.joints) tally(table.rows[joint.joint], joint, rows);
}

void turnSteadyJoints(JointSystem& system, Table<Motion>& rows, const StepContext& context)
{
    for (std::size_t d = 0; d < system.directCount; ++d) system.direct[d].begins = true;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!system.isHalved(i)) continue;
        rows[i].steady = {};
        rows[i].steadySpin = 0;
    }
    for (JointRows& joint : system.joints) {
        settleRows(joint, context);
        if (joint.whole) continue;
        addSteadyOf(joint, rows, [&](int k) { return 2 * joint.visits[k].impulse; });
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
        if (kept.strainedTicks >= kLasting) kept.stiffSteps = kHold;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
