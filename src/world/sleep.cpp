// SPDX-License-Identifier: MIT
// Falling asleep and waking: bodies, shapes and contacts change tables. docs/theory/sleep.md.

#include "contacts/rows.hpp"
#include "joints/kinds.hpp"
#include "solver/finalize.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Contacts that tie bodies for sleep: all that would wake one by the other.
bool isBond(const Contact& c)
{
    return c.count > 0 || c.swept;
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

// Disjoint sets of numbers; the lowest of each leads.
class Sets {
public:
    explicit Sets(std::vector<std::uint32_t>& parent, std::size_t count) : parent_(parent)
    {
        parent_.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
    }
    std::uint32_t leader(std::uint32_t i)
    {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = leader(a);
        b = leader(b);
        if (a != b) parent_[maximum(a, b)] = minimum(a, b);
    }

private:
    std::vector<std::uint32_t>& parent_;
};

}  // namespace

// Makes a body that is awake and alone sleep.
void World::Impl::makeAsleep(std::uint32_t slot)
{
    const std::uint32_t group = asleep.take();
    asleep.groups[group].bodies.push_back(slot);
    bodies.rows[slot].group = group;
    ++asleep.bodies;
    refreshPart(slot);
}

void World::Impl::wake(std::uint32_t slot)
{
    if (bodies.rows[slot].isAsleep()) wakeGroup(bodies.rows[slot].group);
}

void World::Impl::wakeGroup(std::uint32_t number, bool withContacts)
{
    SleepGroup& group = asleep.groups[number];
    for (const std::uint32_t slot : group.bodies) {
        BodyRow& b = bodies.rows[slot];
        b.group = BodyRow::kNoGroup;
        bodies.forgetStillness(b);
        refreshPart(slot);
    }
    asleep.bodies -= static_cast<std::uint32_t>(group.bodies.size());
    for (const Contact& c : group.contacts) asleep.touching -= c.touching ? 1 : 0;
    asleep.contacts -= static_cast<std::uint32_t>(group.contacts.size());
    if (withContacts && !group.contacts.empty()) {
        contactsAreSorted = pairsAreCurrent = false;
        contacts.rows.insert(contacts.rows.end(), group.contacts.begin(), group.contacts.end());
    }
    group.clear();
    asleep.free.push_back(number);
}

void World::Impl::wakeAll()
{
    for (std::uint32_t i = 0; i < asleep.groups.size(); ++i)
        if (!asleep.groups[i].bodies.empty()) wakeGroup(i);
    for (const std::uint32_t slot : bodies.parts) bodies.beginStillness(bodies.rows[slot]);
}

// Wakes the groups that touch a body that holds still itself, or one shape of it.
void World::Impl::wakeTouching(std::uint32_t slot, std::uint32_t only)
{
    if (asleep.isEmpty()) return;
    settle();
    std::vector<std::uint32_t> near;
    const ContactWorld world = contactWorld();
    const auto lookAround = [&](std::uint32_t shape) {
        resting.eachOverlapping(restingBounds(world, shape), [&](std::uint32_t other) {
            const std::uint32_t group = bodies.rows[shapes.rows[other].body].group;
            if (group != BodyRow::kNoGroup) near.push_back(group);
        });
    };
    if (only != kNoShape)
        lookAround(only);
    else
        for (const std::uint32_t shape : shapes.of(bodies.rows[slot])) lookAround(shape);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t group : near) {
        const Table<Contact>& theirs = asleep.groups[group].contacts;
        const bool touches = std::any_of(theirs.begin(), theirs.end(), [&](const Contact& c) {
            if (only != kNoShape) return c.shapeA == only || c.shapeB == only;
            return shapes.rows[c.shapeA].body == slot || shapes.rows[c.shapeB].body == slot;
        });
        if (touches) wakeGroup(group);
    }
}

// Wakes what a shape that has come to lie at a new place may meet there.
void World::Impl::wakeNear(std::uint32_t slot)
{
    if (asleep.isEmpty() || !resting.holds(slot)) return;
    const ContactWorld world = contactWorld();
    const ShapeRow& shape = shapes.rows[slot];
    std::vector<std::uint32_t> near;
    resting.eachOverlapping(restingBounds(world, slot), [&](std::uint32_t other) {
        const std::uint32_t body = shapes.rows[other].body, group = bodies.rows[body].group;
        if (group == BodyRow::kNoGroup || body == shape.body) return;
        if (mayCollide(world, {minimum(slot, other), maximum(slot, other)})) near.push_back(group);
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t group : near) wakeGroup(group);
}

// The same for several shapes. Where these are many and sleepers few, the sleepers look who has come.
void World::Impl::wakeAmong(std::vector<std::uint32_t>& comers)
{
    if (comers.size() <= asleep.bodies) {
        for (const std::uint32_t shape : comers) wakeNear(shape);
        return;
    }
    std::sort(comers.begin(), comers.end());
    const ContactWorld world = contactWorld();
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < asleep.groups.size(); ++i) {
        bool isMet = false;
        for (const std::uint32_t body : asleep.groups[i].bodies) {
            for (const std::uint32_t shape : shapes.of(bodies.rows[body])) {
                resting.eachOverlapping(restingBounds(world, shape), [&](std::uint32_t other) {
                    if (isMet || !std::binary_search(comers.begin(), comers.end(), other)) return;
                    isMet = shapes.rows[other].body != body &&
                            mayCollide(world, {minimum(shape, other), maximum(shape, other)});
                });
            }
        }
        if (isMet) near.push_back(i);
    }
    for (const std::uint32_t group : near) wakeGroup(group);
}

// Something about the body is about to change: it wakes with all that slept with it; and if nothing can push
// it, so do those that rest on it.
void World::Impl::disturb(std::uint32_t slot)
{
    BodyRow& b = bodies.rows[slot];
    if (!b.enabled) return;
    bodies.beginStillness(b);
    if (!b.canMove()) {
        wakeTouching(slot);
        for (const std::uint32_t joint : joints.of(slot))
            joints.rows[joint].eachBody([&](std::uint32_t body) { wake(body); });
    }
    wake(slot);
}

// Something about one shape is about to change.
void World::Impl::disturbShape(std::uint32_t shape)
{
    const std::uint32_t slot = shapes.rows[shape].body;
    BodyRow& b = bodies.rows[slot];
    if (!b.enabled) return;
    bodies.beginStillness(b);
    if (!b.canMove()) wakeTouching(slot, shape);
    wake(slot);
}

// A force for the next step. It is over then, whether or not the body takes part in it.
void World::Impl::forceComes(std::uint32_t slot)
{
    disturb(slot);
    if (!bodies.rows[slot].takesPart) leavers.push_back(slot);
}

// Puts the body and all it is tied to to sleep, if all of them may.
bool World::Impl::sleepNow(std::uint32_t slot)
{
    settle();
    BodyRow& body = bodies.rows[slot];
    if (body.isAsleep()) return true;
    if (!maySleep() || !body.isDynamic() || !body.enabled) return false;

    std::vector<std::uint32_t> parent;
    Sets sets(parent, bodies.rows.size());
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

// What the laws do to a group. Nothing to write down as long as there are none.
void World::Impl::askLaws(const SleepGroup& group, double at, std::vector<std::array<double, 3>>& answers,
                          std::uint32_t& faults) const
{
    answers.clear();
    if (laws.empty()) return;
    const ForceField forces = field();
    for (const std::uint32_t slot : group.bodies) {
        const Wrench w = wrenchOfLaws(bodies.rows[slot], bodies.ids.id(slot), forces, at, faults);
        answers.push_back({w.force.x, w.force.y, w.torque});
    }
}

// Notes down what the laws do to a group that falls asleep, at the time at which they are asked again.
void World::Impl::noteLaws(std::uint32_t number, double at)
{
    SleepGroup& group = asleep.groups[number];
    std::uint32_t ignored = 0;  // faults are told when the laws are asked again
    askLaws(group, at, group.lawForces, ignored);
    group.lawsWereAsked = true;
    lawsHeldSleepers = lawsHeldSleepers || !laws.empty();
}

// Laws may depend on time, and come and go: they are asked of what sleeps, too, and a new answer wakes it.
void World::Impl::wakeByLaws(std::uint32_t& faults)
{
    if (asleep.isEmpty() || (laws.empty() && !lawsHeldSleepers)) return;
    lawsHeldSleepers = !laws.empty();
    const auto same = [](const auto& a, const auto& b) {
        constexpr std::array<double, 3> kNothing = {};
        for (std::size_t i = 0; i < maximum(a.size(), b.size()); ++i)
            if ((i < a.size() ? a[i] : kNothing) != (i < b.size() ? b[i] : kNothing)) return false;
        return true;
    };
    std::vector<std::array<double, 3>> now;
    for (std::uint32_t i = 0; i < asleep.groups.size(); ++i) {
        SleepGroup& group = asleep.groups[i];
        if (group.bodies.empty()) continue;
        askLaws(group, time, now, faults);
        if (group.lawsWereAsked && !same(now, group.lawForces)) {
            wakeGroup(i);
            continue;
        }
        group.lawsWereAsked = true;
        group.lawForces = now;
    }
}

// Who has been still for long enough, with all they are tied to.
void World::Impl::fallAsleep(const StepContext& context)
{
    const Tuning& tuning = context.tuning;
    const real limit = tuning.sleepSpeed * context.lengthUnit, nothing = limit / 100;
    bool any = false;
    for (const Motion& m : motions.rows) {
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
    if (!any || !maySleep()) return;

    // Groups, and what keeps each of them awake.
    const auto rows = static_cast<std::uint32_t>(motions.rows.size());
    Sets sets(sleepScratch.parent, rows);
    for (const Contact& c : contacts.rows)
        if (isBond(c) && motions.rows[c.rowA].moves() && motions.rows[c.rowB].moves())
            sets.join(c.rowA, c.rowB);
    for (const JointTie& joint : jointSystem.ties)
        joint.eachRow([&](std::uint32_t row) {
            if (motions.rows[row].moves()) sets.join(joint.movingRow(motions.rows), row);
        });
    std::vector<SleepScratch::Verdict>& verdicts = sleepScratch.verdicts;
    verdicts.assign(rows, {});
    for (const JointTie& joint : jointSystem.ties) {
        SleepScratch::Verdict& verdict = verdicts[sets.leader(joint.movingRow(motions.rows))];
        const bool runs = hasRunningMotor(joints.rows[joint.joint].def.kind);
        verdict.restless = verdict.restless || runs;
        verdict.grounded = verdict.grounded || joint.rowA == joint.rowB;  // it is held by the world
        joint.eachRow([&](std::uint32_t row) {
            const Motion& other = motions.rows[row];
            if (other.moves()) return;
            verdict.restless = verdict.restless || other.velocity != Vec2{} || other.spin != 0;
            verdict.grounded = true;
        });
    }
    for (const JointRows& joint : jointSystem.joints)
        if (joint.own && hasRunningMotor(joint))
            verdicts[sets.leader(joint.movingRow(motions.rows))].restless = true;
    for (const Contact& c : contacts.rows) {
        if (!isBond(c)) continue;
        const std::uint32_t pair[2] = {c.rowA, c.rowB};
        for (const int side : {0, 1}) {
            const std::uint32_t one = pair[side], other = pair[1 - side];
            const Motion& ground = motions.rows[other];
            if (!motions.rows[one].moves() || ground.moves()) continue;
            SleepScratch::Verdict& verdict = verdicts[sets.leader(one)];
            const bool runs = ground.velocity != Vec2{} || ground.spin != 0 || c.surfaceSpeed != 0;
            verdict.restless = verdict.restless || runs;
            verdict.grounded = verdict.grounded || c.touching;
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        const BodyRow& b = bodies.rows[motions.rows[row].body];
        if (!b.isDynamic() || !b.takesPart) continue;
        SleepScratch::Verdict& verdict = verdicts[sets.leader(row)];
        const bool ready = b.allowSleep && bodies.mover(b).stillTime >= tuning.sleepTime;
        verdict.restless = verdict.restless || !ready;
        verdict.drifts = verdict.drifts || b.hasVelocity();
    }

    // What stands on nothing keeps its momentum, however slow: it sleeps only if it has none.
    bool fell = false;
    for (std::uint32_t row = 0; row < rows; ++row) {
        const std::uint32_t slot = motions.rows[row].body;
        if (!bodies.rows[slot].isDynamic() || !bodies.rows[slot].takesPart) continue;
        SleepScratch::Verdict& verdict = verdicts[sets.leader(row)];
        if (verdict.restless || (!verdict.grounded && verdict.drifts)) continue;
        if (verdict.group == BodyRow::kNoGroup) verdict.group = asleep.take();
        bodies.rows[slot].group = verdict.group;
        asleep.groups[verdict.group].bodies.push_back(slot);
        ++asleep.bodies;
        fell = true;
    }
    if (!fell) return;
    storeContacts();
    for (std::uint32_t row = 0; row < rows; ++row)
        if (verdicts[row].group != BodyRow::kNoGroup) noteLaws(verdicts[row].group, time + context.dt);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
