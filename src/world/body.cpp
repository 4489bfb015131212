// SPDX-License-Identifier: MIT
// Body: that it lives, what it is, whether it sleeps, and what belongs to it.

#include "diagnostics/energy.hpp"
#include "world/body_row.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

const std::string kNoName;

}  // namespace

bool Body::isAlive() const noexcept
{
    return world_ != nullptr && world_->impl_->bodies.ids.owns(id_);
}

World* Body::alive() const
{
    if (isAlive()) return world_;
    fail(InputError("Body", id_.isNull() ? "null" : textOf(id_.index), "must be a live body of this world"));
    return nullptr;
}

BodyDef Body::definition() const
{
    TAMIAS_BODY_ROW(b);
    BodyDef def;
    def.type = b.type;
    def.position = b.origin();
    def.angle = b.angle;
    def.linearVelocity = b.velocity;
    def.angularVelocity = b.spin;
    if (b.massIsSet) def.mass = MassProperties{b.mass, b.localCenter, b.inertia};
    const MoverRow& mover = table.mover(b);
    def.linearDamping = mover.linearDamping;
    def.angularDamping = mover.angularDamping;
    def.gravityScale = mover.gravityScale;
    def.gravity = table.extra(b).gravity;
    def.lockX = b.lockX;
    def.lockY = b.lockY;
    def.lockRotation = b.lockRotation;
    def.enabled = b.enabled;
    def.allowSleep = b.allowSleep;
    def.awake = !b.isAsleep();
    def.name = table.extra(b).name;
    def.userData = table.extra(b).userData;
    return def;
}

BodyType Body::type() const
{
    TAMIAS_BODY_ROW(b);
    return b.type;
}

void Body::setType(BodyType type)
{
    TAMIAS_BODY_ROW(b);
    const auto number = static_cast<int>(type);
    if (refuse(checkThat(number >= 0 && number <= 2, "type", number, "must be Static, Kinematic or Dynamic")))
        return;
    if (w && type == BodyType::Dynamic && !b.massIsSet &&
        refuse(checkMass("type", textOf(number), w->impl_->massOfShapes(b))))
        return;
    if (!w || type == b.type) return;
    w->impl_->disturb(id_.index);
    w->impl_->tally(b, false);
    b.type = type;
    if (type == BodyType::Static) {
        b.velocity = {};
        b.spin = 0;
    } else {
        w->impl_->bodies.moverFor(b);
    }
    w->impl_->tally(b, true);
    w->impl_->refreshPart(id_.index);
    w->impl_->pairsAreCurrent = false;
}

const std::string& Body::name() const
{
    World* const w = alive();
    return w ? w->impl_->bodies.extra(w->impl_->row(id_)).name : kNoName;
}

void Body::setName(std::string_view name)
{
    TAMIAS_BODY_ROW(b);
    if (w && (b.extra != BodyRow::kNone || !name.empty())) w->impl_->bodies.extraFor(b).name = name;
}

std::uint64_t Body::userData() const
{
    TAMIAS_BODY_ROW(b);
    return table.extra(b).userData;
}

void Body::setUserData(std::uint64_t value)
{
    TAMIAS_BODY_ROW(b);
    if (w && (b.extra != BodyRow::kNone || value != 0)) w->impl_->bodies.extraFor(b).userData = value;
}

bool Body::isEnabled() const
{
    TAMIAS_BODY_ROW(b);
    return b.enabled;
}

void Body::setEnabled(bool enabled)
{
    TAMIAS_BODY_ROW(b);
    if (!w || enabled == b.enabled) return;
    World::Impl& impl = *w->impl_;
    impl.disturb(id_.index);
    ++impl.joints.changes;
    impl.tally(b, false);
    b.enabled = enabled;
    impl.tally(b, true);
    impl.refreshPart(id_.index);
    if (!enabled)
        impl.displaceAll(id_.index);
    else if (!b.takesPart)
        impl.placeAll(id_.index, true);
}

bool Body::isAwake() const
{
    TAMIAS_BODY_ROW(b);
    if (w) w->impl_->settle();
    return b.takesPart;
}

bool Body::isAsleep() const
{
    TAMIAS_BODY_ROW(b);
    if (w) w->impl_->settle();
    return b.isAsleep();
}

void Body::wake()
{
    TAMIAS_BODY_ROW(b);
    if (!w) return;
    w->impl_->bodies.beginStillness(b);
    w->impl_->wake(id_.index);
}

bool Body::sleep()
{
    World* const w = alive();
    return w && w->impl_->sleepNow(id_.index);
}

bool Body::allowsSleep() const
{
    TAMIAS_BODY_ROW(b);
    return b.allowSleep;
}

void Body::setAllowSleep(bool allow)
{
    TAMIAS_BODY_ROW(b);
    if (w && !allow) w->impl_->wake(id_.index);
    b.allowSleep = allow;
}

Shape Body::createShape(const ShapeDef& def)
{
    World* const w = alive();
    if (!w ||
        refuse(check(def, w->impl_->settings.lengthUnit, w->impl_->shapes.isLastGeometry(def.geometry))) ||
        refuse(w->impl_->checkMassWith("ShapeDef.density", def, id_.index)))
        return {};
    return {w, w->impl_->createShape(id_, def)};
}

std::vector<Shape> Body::shapes() const
{
    TAMIAS_BODY_ROW(b);
    std::vector<Shape> all;
    if (!w) return all;
    all.reserve(b.shapes.size());
    for (const std::uint32_t slot : w->impl_->shapes.of(b))
        all.push_back(Shape(w, w->impl_->shapes.ids.id(slot)));
    return all;
}

Energy Body::energy() const
{
    TAMIAS_BODY_ROW(b);
    return w && b.isDynamic() ? energyOf(w->impl_->bodies, id_.index, w->impl_->field(), w->impl_->time)
                              : Energy{};
}

Momentum Body::momentum() const
{
    TAMIAS_BODY_ROW(b);
    return momentumOf(b);
}

std::vector<ContactView> Body::contacts() const
{
    std::vector<ContactView> all;
    World* const w = alive();
    if (!w) return all;
    for (const ContactView& view : w->contacts())
        if (view.bodyA == id_ || view.bodyB == id_) all.push_back(view);
    return all;
}

void Body::destroy()
{
    World* const w = alive();
    if (w) w->impl_->destroyBody(id_);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
