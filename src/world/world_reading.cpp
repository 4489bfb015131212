// SPDX-License-Identifier: MIT
// World: what it tells: contacts, events, energy, and what is where.

#include "diagnostics/energy.hpp"
#include "diagnostics/validate.hpp"
#include "joints/reading.hpp"
#include "queries/search.hpp"
#include "world/check_alive.hpp"
#include "world/impl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

StepEvents World::events() const noexcept
{
    return {impl_->begins, impl_->ends, impl_->hits, impl_->breaks};
}

ContactView World::Impl::view(const Contact& c) const
{
    const TouchEvent pair = touchEvent(c);
    ContactView view;
    view.shapeA = pair.shapeA;
    view.shapeB = pair.shapeB;
    view.bodyA = pair.bodyA;
    view.bodyB = pair.bodyB;
    view.normal = c.normal;
    view.pointCount = c.count;
    view.touching = c.touching;
    view.impulse = c.stepImpulse;
    view.restGap = c.restGap;
    view.friction = c.friction;
    view.restitution = c.restitution;
    const Position centerA = bodies.rows[shapes.rows[c.shapeA].body].center;
    for (int i = 0; i < c.count; ++i) {
        const ContactPointRow& point = c.points[i];
        view.points[static_cast<std::size_t>(i)] = {centerA + toDVec2(point.armA), point.gap + c.restGap,
                                                    point.stepNormal, point.stepTangent,
                                                    point.anchor.feature};
    }
    return view;
}

std::vector<ContactView> World::contacts() const
{
    std::vector<const Contact*> rows;
    impl_->solverScratch.passes.tell(impl_->contacts);
    for (const Contact& c : impl_->contacts.rows)
        if (c.count > 0 || c.stepImpulse != Vec2{}) rows.push_back(&c);
    for (const SleepGroup& group : impl_->asleep.groups)
        for (const Contact& c : group.contacts) rows.push_back(&c);
    std::sort(rows.begin(), rows.end(), [](const Contact* a, const Contact* b) {
        return a->shapeA != b->shapeA ? a->shapeA < b->shapeA : a->shapeB < b->shapeB;
    });
    std::vector<ContactView> all;
    for (const Contact* c : rows) all.push_back(impl_->view(*c));
    return all;
}

// Is there such a contact of the body? Those of one that sleeps are in its group.
template <class Holds>
bool World::Impl::anyContact(std::uint32_t bodyA, std::uint32_t bodyB, Holds holds) const
{
    for (const std::uint32_t body : {bodyA, bodyB}) {
        if (!bodies.rows[body].isAsleep()) continue;
        const auto& all = asleep.groups[bodies.rows[body].group].contacts;
        if (std::any_of(all.begin(), all.end(), holds)) return true;
    }
    return std::any_of(contacts.rows.begin(), contacts.rows.end(), holds);
}

bool World::touching(BodyId a, BodyId b) const
{
    if (refuse(checkAlive("a", impl_->bodies.ids.owns(a), a, "body"))) return false;
    if (refuse(checkAlive("b", impl_->bodies.ids.owns(b), b, "body"))) return false;
    return impl_->anyContact(a.index, b.index, [&](const Contact& c) {
        const std::uint32_t first = impl_->shapes.rows[c.shapeA].body,
                            second = impl_->shapes.rows[c.shapeB].body;
        return c.touching &&
               ((first == a.index && second == b.index) || (first == b.index && second == a.index));
    });
}

bool World::touching(ShapeId a, ShapeId b) const
{
    if (refuse(checkAlive("a", impl_->shapes.ids.owns(a), a, "shape"))) return false;
    if (refuse(checkAlive("b", impl_->shapes.ids.owns(b), b, "shape"))) return false;
    const std::uint32_t bodyA = impl_->shapes.rows[a.index].body, bodyB = impl_->shapes.rows[b.index].body;
    return impl_->anyContact(bodyA, bodyB, [&](const Contact& c) {
        return c.touching && c.shapeA == minimum(a.index, b.index) && c.shapeB == maximum(a.index, b.index);
    });
}

Energy World::energy() const
{
    Energy sum = totalEnergy(impl_->bodies, impl_->field(), impl_->time);
    sum.potential += springEnergy(impl_->joints, impl_->bodies);
    return sum;
}
Momentum World::momentum() const
{
    return totalMomentum(impl_->bodies);
}

std::vector<std::string> World::validate() const
{
    Faults faults;
    impl_->solverScratch.passes.tell(impl_->contacts);
    impl_->validate(faults);
    return faults.found();
}

// --- queries

std::vector<ShapeId> World::queryPoint(Position point, const Filter& filter) const
{
    if (refuse(checkFinite("point", point, "must be finite m"))) return {};
    impl_->settle();
    return shapesAt({impl_->bodies, impl_->shapes, impl_->resting, filter}, point);
}

std::vector<ShapeId> World::queryBox(const Aabb& box, const Filter& filter) const
{
    if (Checks()
            .finite("box.lower", box.lower, "must be finite m")
            .finite("box.upper", box.upper, "must be finite m")
            .that(box.lower.x <= box.upper.x && box.lower.y <= box.upper.y, "box.lower", box.lower,
                  "must not exceed box.upper")
            .refuse())
        return {};
    impl_->settle();
    return shapesIn({impl_->bodies, impl_->shapes, impl_->resting, filter}, box);
}

std::optional<RayHit> World::castRay(Position from, Position to, const Filter& filter) const
{
    const std::vector<RayHit> hits = castRayAll(from, to, filter);
    if (hits.empty()) return std::nullopt;
    return hits.front();
}

std::vector<RayHit> World::castRayAll(Position from, Position to, const Filter& filter) const
{
    if (Checks().finite("from", from, "must be finite m").finite("to", to, "must be finite m").refuse())
        return {};
    impl_->settle();
    return shapesAlong({impl_->bodies, impl_->shapes, impl_->resting, filter}, from, to);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
