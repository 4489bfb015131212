// SPDX-License-Identifier: MIT
// Joints come and go, and the calls of World and Body that say so.

#include "joints/own.hpp"
#include "world/check_alive.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

JointId World::Impl::createJoint(const JointDef& def, std::uint32_t layout)
{
    const JointId joint = joints.ids.take();
    if (joint.index == joints.rows.size()) joints.rows.emplace_back();
    JointRow& j = joints.rows[joint.index];
    j = {};
    j.def = def;
    j.bodyA = def.bodyA.index;
    j.bodyB = def.bodyB.index;
    for (const BodyId body : def.moreBodies) j.more.push_back(body.index);
    j.layout = layout;
    beginCount(j, bodies.rows[j.bodyA].angle, bodies.rows[j.bodyB].angle);
    if (layout != 0) beginOwnCount(j, bodies);
    j.eachBody([&](std::uint32_t body) { joints.tie(body, joint.index); });
    disturbJoint(joint.index);
    return joint;
}

// Something about the joint changes: its bodies wake.
void World::Impl::disturbJoint(std::uint32_t slot)
{
    uncoupledIsStale = true;
    ++joints.changes;
    joints.rows[slot].eachBody([&](std::uint32_t body) {
        bodies.beginStillness(bodies.rows[body]);
        wake(body);
    });
}

void World::Impl::listUncoupled()
{
    if (!uncoupledIsStale) return;
    uncoupledIsStale = false;
    pairsAreCurrent = false;
    uncoupled.clear();
    for (std::uint32_t slot = 0; slot < joints.rows.size(); ++slot) {
        const JointRow& joint = joints.rows[slot];
        if (!joints.ids.isAlive(slot) || !joint.acts() || joint.def.collideConnected) continue;
        joint.eachBody([&](std::uint32_t a) {
            joint.eachBody([&](std::uint32_t b) {
                if (a < b) uncoupled.emplace_back(a, b);
            });
        });
    }
    std::sort(uncoupled.begin(), uncoupled.end());
}

void World::Impl::destroyJoint(std::uint32_t slot)
{
    disturbJoint(slot);
    joints.rows[slot].eachBody([&](std::uint32_t body) { std::erase(joints.ofBody[body], slot); });
    joints.rows[slot] = {};
    joints.ids.giveBack(slot);
}

Joint World::createJoint(const JointDef& def)
{
    std::uint32_t layout = 0;
    if (refuse(impl_->check(def, layout))) return {};
    return {this, impl_->createJoint(def, layout)};
}

void World::destroyJoint(JointId id)
{
    if (refuse(checkAlive("JointId", impl_->joints.ids.owns(id), id, "joint"))) return;
    impl_->destroyJoint(id.index);
}

Joint World::joint(JointId id)
{
    if (refuse(checkAlive("JointId", impl_->joints.ids.owns(id), id, "joint"))) return {};
    return {this, id};
}

std::optional<Joint> World::findJoint(JointId id) noexcept
{
    if (!impl_->joints.ids.owns(id)) return std::nullopt;
    return Joint(this, id);
}

std::optional<Joint> World::findJoint(std::string_view name) noexcept
{
    for (std::uint32_t slot = 0; slot < impl_->joints.rows.size(); ++slot)
        if (impl_->joints.ids.isAlive(slot) && impl_->joints.rows[slot].def.name == name)
            return Joint(this, impl_->joints.ids.id(slot));
    return std::nullopt;
}

std::vector<JointId> World::joints() const
{
    std::vector<JointId> all;
    for (std::uint32_t slot = 0; slot < impl_->joints.rows.size(); ++slot)
        if (impl_->joints.ids.isAlive(slot)) all.push_back(impl_->joints.ids.id(slot));
    return all;
}

std::size_t World::jointCount() const noexcept
{
    return impl_->joints.ids.alive();
}

std::vector<Joint> Body::joints() const
{
    std::vector<Joint> all;
    World* const w = alive();
    if (!w) return all;
    for (const std::uint32_t slot : w->impl_->joints.of(id_.index))
        all.push_back(Joint(w, w->impl_->joints.ids.id(slot)));
    return all;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
