// SPDX-License-Identifier: MIT
// Body: what pushes it: forces and impulses, those that last, laws, gravity and damping.

#include "world/body_row.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

Vec2 velocityAfter(const BodyRow& b, Vec2 impulse)
{
    const Vec2 invMass = b.invMass();
    return b.velocity + Vec2{invMass.x * impulse.x, invMass.y * impulse.y};
}

// An impulse may not do what setLinearVelocity and setAngularVelocity may not.
template <class T>
Complaint checkImpulse(const T& impulse, Vec2 velocity, real spin, real lengthUnit)
{
    const bool slow = !checkVelocity("", velocity, lengthUnit) && !checkSpin("", spin);
    return checkThat(slow, "impulse", impulse, "must leave the body within 1e6 lengthUnit/s and 1e6 rad/s");
}

}  // namespace

void Body::applyForce(Vec2 force, Position at)
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    if (Checks().finite("force", force, "must be finite N").add(checkPosition("at", at, unit)).refuse())
        return;
    if (!w) return;
    if (force != Vec2{}) w->impl_->forceComes(id_.index);
    MoverRow& mover = w->impl_->bodies.moverFor(b);
    mover.stepForce += force;
    mover.stepTorque += cross(toVec2(at - b.center), force);
}

void Body::applyForceToCenter(Vec2 force)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkFinite("force", force, "must be finite N"))) return;
    if (!w) return;
    if (force != Vec2{}) w->impl_->forceComes(id_.index);
    w->impl_->bodies.moverFor(b).stepForce += force;
}

void Body::applyTorque(real torque)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkFinite("torque", torque, "must be finite N*m"))) return;
    if (!w) return;
    if (torque != 0) w->impl_->forceComes(id_.index);
    w->impl_->bodies.moverFor(b).stepTorque += torque;
}

void Body::applyImpulse(Vec2 impulse, Position at)
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    if (Checks().finite("impulse", impulse, "must be finite N*s").add(checkPosition("at", at, unit)).refuse())
        return;
    const Vec2 velocity = velocityAfter(b, impulse);
    const real spin = b.spin + b.invInertia() * cross(toVec2(at - b.center), impulse);
    if (refuse(checkImpulse(impulse, velocity, spin, unit))) return;
    if (w && (velocity != b.velocity || spin != b.spin)) w->impl_->disturb(id_.index);
    b.velocity = velocity;
    b.spin = spin;
}

void Body::applyImpulseToCenter(Vec2 impulse)
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    const Vec2 velocity = velocityAfter(b, impulse);
    if (Checks()
            .finite("impulse", impulse, "must be finite N*s")
            .add(checkImpulse(impulse, velocity, b.spin, unit))
            .refuse())
        return;
    if (w && velocity != b.velocity) w->impl_->disturb(id_.index);
    b.velocity = velocity;
}

void Body::applyAngularImpulse(real impulse)
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    const real spin = b.spin + b.invInertia() * impulse;
    if (Checks()
            .finite("impulse", impulse, "must be finite N*m*s")
            .add(checkImpulse(impulse, b.velocity, spin, unit))
            .refuse())
        return;
    if (w && spin != b.spin) w->impl_->disturb(id_.index);
    b.spin = spin;
}

std::size_t Body::addForce(const LastingForce& force)
{
    TAMIAS_BODY_ROW(b);
    if (!w || refuse(check(force, w->impl_->settings.lengthUnit))) return 0;
    w->impl_->disturb(id_.index);
    std::vector<LastingForce>& lasting = w->impl_->bodies.extraFor(b).lasting;
    lasting.push_back(force);
    return lasting.size() - 1;
}

std::span<const LastingForce> Body::lastingForces() const
{
    TAMIAS_BODY_ROW(b);
    return table.extra(b).lasting;
}

void Body::setForce(std::size_t place, const LastingForce& force)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkThat(place < table.extra(b).lasting.size(), "place", place,
                         "must be one that addForce returned")))
        return;
    if (!w || refuse(check(force, w->impl_->settings.lengthUnit))) return;
    w->impl_->disturb(id_.index);
    w->impl_->bodies.extraFor(b).lasting[place] = force;
}

void Body::clearForces()
{
    TAMIAS_BODY_ROW(b);
    if (!w) return;
    if (!table.extra(b).lasting.empty()) {
        w->impl_->disturb(id_.index);
        w->impl_->bodies.extraFor(b).lasting.clear();
    }
    if (b.mover == BodyRow::kNone) return;
    MoverRow& mover = w->impl_->bodies.moverFor(b);
    mover.stepForce = {};
    mover.stepTorque = 0;
}

ForceLawId Body::addForceLaw(ForceLaw law)
{
    World* const w = alive();
    if (!w) return {};
    const ForceLawId id = w->addForceLaw(std::move(law));
    if (!id.isNull()) w->impl_->laws.back().body = id_;
    return id;
}

real Body::linearDamping() const
{
    TAMIAS_BODY_ROW(b);
    return table.mover(b).linearDamping;
}

void Body::setLinearDamping(real damping)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkRange("linearDamping", damping, 0, 1e30, "must be finite and >= 0 1/s"))) return;
    if (!w || damping == table.mover(b).linearDamping) return;
    w->impl_->disturb(id_.index);
    w->impl_->bodies.moverFor(b).linearDamping = damping;
}

real Body::angularDamping() const
{
    TAMIAS_BODY_ROW(b);
    return table.mover(b).angularDamping;
}

void Body::setAngularDamping(real damping)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkRange("angularDamping", damping, 0, 1e30, "must be finite and >= 0 1/s"))) return;
    if (!w || damping == table.mover(b).angularDamping) return;
    w->impl_->disturb(id_.index);
    w->impl_->bodies.moverFor(b).angularDamping = damping;
}

real Body::gravityScale() const
{
    TAMIAS_BODY_ROW(b);
    return table.mover(b).gravityScale;
}

void Body::setGravityScale(real scale)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkFinite("gravityScale", scale))) return;
    if (!w || scale == table.mover(b).gravityScale) return;
    w->impl_->disturb(id_.index);
    w->impl_->bodies.moverFor(b).gravityScale = scale;
}

std::optional<Vec2> Body::ownGravity() const
{
    TAMIAS_BODY_ROW(b);
    return table.extra(b).gravity;
}

void Body::setOwnGravity(std::optional<Vec2> gravity)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkFinite("gravity", gravity.value_or(Vec2{}), "must be finite m/s^2"))) return;
    if (!w || gravity == table.extra(b).gravity) return;
    w->impl_->disturb(id_.index);
    w->impl_->bodies.extraFor(b).gravity = gravity;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
