// SPDX-License-Identifier: MIT
// Waking: what is touched, what is met, what is changed, what laws push in another way. docs/theory/sleep.md.

#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Each group once.
void sortGroups(std::vector<std::uint32_t>& groups)
{
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
}

}  // namespace

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
    sortGroups(near);
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
    sortGroups(near);
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

}  // namespace tamias2d::inline TAMIAS_PRECISION
