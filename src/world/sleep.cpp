// SPDX-License-Identifier: MIT
// Falling asleep: bodies, shapes and contacts leave the tables of the step. docs/theory/sleep.md.

#include "base/disjoint_sets.hpp"
#include "joints/kinds.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Contacts that tie bodies for sleep: all that would wake one by the other.
bool isBond(const Contact& c)
{
    return c.count > 0 || c.swept;
}

bool hasRunningMotor(const JointKind& kind)
{
    return std::visit(
        [](const auto& k) {
            if constexpr (HasMotor<decltype(k)>)
                return k.motor && k.motor->speed != 0;
            else if constexpr (std::is_same_v<decltype(k), const MotorJoint&>)
                return (!k.linear && k.velocity != Vec2{} && k.maxForce > 0) ||
                       (!k.angular && k.spin != 0 && k.maxTorque > 0);
            else
                return false;
        },
        kind);
}

// Of a joint of one's own.
bool hasRunningMotor(const JointRows& joint)
{
    for (int i = 0; i < joint.count; ++i)
        if (joint.rows[i].kind == RowKind::Motor && joint.rows[i].speed != 0 && joint.rows[i].most > 0)
            return true;
    return false;
}

// Of its fastest point: as it moves now, and as it went in the step. What is pushed out of an overlap goes
// without a velocity.   [m/s]
real speedOf(const BodyRow& b, real extent)
{
    return length(b.velocity) + absolute(b.spin) * extent;
}
real paceOf(const BodyRow& b, const MoverRow& before, real extent, double dt)
{
    double turn = absolute(b.angle - before.previousAngle);
    turn = minimum(turn, kTwoPi - turn);
    const double way = length(b.center - before.previousCenter);
    return static_cast<real>((way + turn * static_cast<double>(extent)) / dt);
}

// Who has been still, and for how long; is that long enough for anyone?
bool noteStillness(BodyTable& bodies, const Table<Motion>& motions, const StepContext& context)
{
    const Tuning& tuning = context.tuning;
    const real limit = tuning.sleepSpeed * context.lengthUnit, nothing = limit / 100;
    bool any = false;
    for (const Motion& m : motions) {
        BodyRow& b = bodies.rows[m.body];
        if (!b.isDynamic() || !b.takesPart) continue;

        // Still is what is slow and does not get faster: what begins to slide or to topple is left alone.
        MoverRow& mover = bodies.moverFor(b);
        const real speed = maximum(speedOf(b, m.extent), paceOf(b, mover, m.extent, context.dt));
        const bool still = speed <= limit && speed <= maximum(mover.stillSpeed, nothing);
        mover.stillTime = still ? mover.stillTime + static_cast<real>(context.dt) : real(0);
        if (!still) mover.stillSpeed = speed <= limit ? speed : real(0);
        // A swing slows down to its turning point and no further.
        if (mover.stillTime >= tuning.sleepTime && mover.stillSpeed - speed > limit / 4) {
            mover.stillTime = 0;
            mover.stillSpeed = speed;
        }
        any = any || (b.allowSleep && mover.stillTime >= tuning.sleepTime);
    }
    return any;
}

// Who would fall asleep together, and what keeps them awake.
class SleepGroups {
public:
    SleepGroups(SleepScratch& scratch, const Table<Motion>& motions)
        : sets_(scratch.parent), verdicts_(scratch.verdicts), motions_(motions)
    {
        sets_.reset(motions.size());
        verdicts_.assign(motions.size(), {});
    }

    SleepScratch::Verdict& of(std::uint32_t row) { return verdicts_[sets_.leader(row)]; }

    void join(const Table<Contact>& contacts, const JointSystem& system)
    {
        for (const Contact& c : contacts)
            if (isBond(c) && motions_[c.rowA].moves() && motions_[c.rowB].moves()) sets_.join(c.rowA, c.rowB);
        for (const JointTie& joint : system.ties)
            joint.eachRow([&](std::uint32_t row) {
                if (motions_[row].moves()) sets_.join(joint.movingRow(motions_), row);
            });
    }
    void judge(const JointTable& joints, const JointSystem& system);
    void judge(const Table<Contact>& contacts);
    void judge(const BodyTable& bodies, const Tuning& tuning);

private:
    DisjointSets sets_;
    std::vector<SleepScratch::Verdict>& verdicts_;
    const Table<Motion>& motions_;
};

void SleepGroups::judge(const JointTable& joints, const JointSystem& system)
{
    for (const JointTie& joint : system.ties) {
        SleepScratch::Verdict& verdict = of(joint.movingRow(motions_));
        const bool runs = hasRunningMotor(joints.rows[joint.joint].def.kind);
        verdict.restless = verdict.restless || runs;
        verdict.grounded = verdict.grounded || joint.rowA == joint.rowB;  // it is held by the world
        joint.eachRow([&](std::uint32_t row) {
            const Motion& other = motions_[row];
            if (other.moves()) return;
            verdict.restless = verdict.restless || other.velocity != Vec2{} || other.spin != 0;
            verdict.grounded = true;
        });
    }
    for (const JointRows& joint : system.joints)
        if (joint.own && hasRunningMotor(joint)) of(joint.movingRow(motions_)).restless = true;
}

void SleepGroups::judge(const Table<Contact>& contacts)
{
    for (const Contact& c : contacts) {
        if (!isBond(c)) continue;
        const std::uint32_t pair[2] = {c.rowA, c.rowB};
        for (const int side : {0, 1}) {
            const std::uint32_t one = pair[side], other = pair[1 - side];
            const Motion& ground = motions_[other];
            if (!motions_[one].moves() || ground.moves()) continue;
            SleepScratch::Verdict& verdict = of(one);
            const bool runs = ground.velocity != Vec2{} || ground.spin != 0 || c.surfaceSpeed != 0;
            verdict.restless = verdict.restless || runs;
            verdict.grounded = verdict.grounded || c.touching;
        }
    }
}

void SleepGroups::judge(const BodyTable& bodies, const Tuning& tuning)
{
    for (std::uint32_t row = 0; row < motions_.size(); ++row) {
        const BodyRow& b = bodies.rows[motions_[row].body];
        if (!b.isDynamic() || !b.takesPart) continue;
        SleepScratch::Verdict& verdict = of(row);
        const bool ready = b.allowSleep && bodies.mover(b).stillTime >= tuning.sleepTime;
        verdict.restless = verdict.restless || !ready;
        verdict.drifts = verdict.drifts || b.hasVelocity();
    }
}

}  // namespace

// Who has been still for long enough, with all they are tied to.
void World::Impl::fallAsleep(const StepContext& context)
{
    if (!noteStillness(bodies, motions.rows, context) || !maySleep()) return;
    SleepGroups groups(sleepScratch, motions.rows);
    groups.join(contacts.rows, jointSystem);
    groups.judge(joints, jointSystem);
    groups.judge(contacts.rows);
    groups.judge(bodies, context.tuning);

    // What stands on nothing keeps its momentum, however slow: it sleeps only if it has none.
    bool fell = false;
    for (std::uint32_t row = 0; row < motions.rows.size(); ++row) {
        const std::uint32_t slot = motions.rows[row].body;
        if (!bodies.rows[slot].isDynamic() || !bodies.rows[slot].takesPart) continue;
        SleepScratch::Verdict& verdict = groups.of(row);
        if (verdict.restless || (!verdict.grounded && verdict.drifts)) continue;
        if (verdict.group == BodyRow::kNoGroup) verdict.group = asleep.take();
        bodies.rows[slot].group = verdict.group;
        asleep.groups[verdict.group].bodies.push_back(slot);
        ++asleep.bodies;
        fell = true;
    }
    if (!fell) return;
    storeContacts();
    for (const SleepScratch::Verdict& verdict : sleepScratch.verdicts)
        if (verdict.group != BodyRow::kNoGroup) noteLaws(verdict.group, time + context.dt);
}

// Makes a body that is awake and alone sleep.
void World::Impl::makeAsleep(std::uint32_t slot)
{
    const std::uint32_t group = asleep.take();
    asleep.groups[group].bodies.push_back(slot);
    bodies.rows[slot].group = group;
    ++asleep.bodies;
    refreshPart(slot);
}

// Puts the body and all it is tied to to sleep, if all of them may.
bool World::Impl::sleepNow(std::uint32_t slot)
{
    settle();
    BodyRow& body = bodies.rows[slot];
    if (body.isAsleep()) return true;
    if (!maySleep() || !body.isDynamic() || !body.enabled) return false;

    std::vector<std::uint32_t> parent;
    DisjointSets sets(parent);
    sets.reset(bodies.rows.size());
    const auto bodyOf = [&](std::uint32_t shape) { return shapes.rows[shape].body; };
    for (const Contact& c : contacts.rows) {
        const std::uint32_t a = bodyOf(c.shapeA), b = bodyOf(c.shapeB);
        const bool takePart = bodies.rows[a].enabled && bodies.rows[b].enabled;
        if (takePart && isBond(c) && bodies.rows[a].canMove() && bodies.rows[b].canMove()) sets.join(a, b);
    }
    for (const JointRow& joint : joints.rows) {
        if (!joint.ties()) continue;
        std::uint32_t first = BodyRow::kNoGroup;
        joint.eachBody([&](std::uint32_t held) {
            if (!bodies.rows[held].canMove()) return;
            if (first == BodyRow::kNoGroup) first = held;
            sets.join(first, held);
        });
    }
    const std::uint32_t leader = sets.leader(slot);
    std::vector<std::uint32_t> members;
    for (const std::uint32_t part : bodies.parts) {
        const BodyRow& b = bodies.rows[part];
        if (!b.takesPart || !b.isDynamic() || sets.leader(part) != leader) continue;
        if (!b.allowSleep) return false;
        members.push_back(part);
    }
    for (const Contact& c : contacts.rows) {
        if (!isBond(c)) continue;
        const std::uint32_t pair[2] = {bodyOf(c.shapeA), bodyOf(c.shapeB)};
        for (const int side : {0, 1}) {
            const std::uint32_t one = pair[side], other = pair[1 - side];
            const bool ours = bodies.rows[one].canMove() && sets.leader(one) == leader;
            const BodyRow& ground = bodies.rows[other];
            if (ours && !ground.canMove() && (ground.hasVelocity() || c.surfaceSpeed != 0)) return false;
        }
    }

    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    const std::uint32_t group = asleep.take();
    for (const std::uint32_t member : members) {
        bodies.rows[member].group = group;
        asleep.groups[group].bodies.push_back(member);
    }
    asleep.bodies += static_cast<std::uint32_t>(members.size());
    storeContacts();
    noteLaws(group, time);
    return true;
}

// The contacts of bodies that have just been given a group go there; the bodies stop and leave the steps.
void World::Impl::storeContacts()
{
    leaveLanes();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < contacts.rows.size(); ++i) {
        const Contact& c = contacts.rows[i];
        const BodyRow &a = bodies.rows[shapes.rows[c.shapeA].body],
                      &b = bodies.rows[shapes.rows[c.shapeB].body];
        // It goes with a body that can move: what is locked may sleep under one that is awake.
        const std::uint32_t group = a.canMove() ? a.group : b.group;
        // With a body that has just been disabled it ends in the next step, whoever sleeps.
        if (group == BodyRow::kNoGroup || !a.enabled || !b.enabled) {
            if (kept != i) contacts.rows[kept] = c;
            ++kept;
        } else if (c.count > 0 || c.touching) {
            asleep.groups[group].contacts.push_back(c);
            asleep.mostContacts = maximum(asleep.mostContacts, ++asleep.contacts);
            asleep.touching += c.touching ? 1 : 0;
        }
    }
    contacts.rows.resize(kept);
    contacts.order.clear();  // made anew in the next step
    pairsAreCurrent = false;
    for (const std::uint32_t slot : bodies.parts) {
        BodyRow& b = bodies.rows[slot];
        if (!b.isAsleep() || !b.takesPart) continue;
        b.velocity = {};
        b.spin = 0;
        bodies.forgetStillness(b);
        refreshPart(slot);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
