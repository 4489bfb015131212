// SPDX-License-Identifier: MIT
// Body: where it is, how it moves, and its mass.

#include "world/body_row.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

Transform Body::transform() const
{
    TAMIAS_BODY_ROW(b);
    return {b.origin(), b.angle, b.rotation};
}

Position Body::position() const
{
    TAMIAS_BODY_ROW(b);
    return b.origin();
}

Position Body::centerOfMass() const
{
    TAMIAS_BODY_ROW(b);
    return b.center;
}

double Body::angle() const
{
    TAMIAS_BODY_ROW(b);
    return b.angle;
}

Vec2 Body::linearVelocity() const
{
    TAMIAS_BODY_ROW(b);
    return b.velocity;
}

real Body::angularVelocity() const
{
    TAMIAS_BODY_ROW(b);
    return b.spin;
}

Vec2 Body::velocityAt(Position point) const
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    if (refuse(checkPosition("point", point, unit))) return {};
    return b.velocity + cross(b.spin, toVec2(point - b.center));
}

void Body::setTransform(Position position, double angle)
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    if (Checks()
            .add(checkPosition("position", position, unit))
            .finite("angle", angle, "must be finite rad")
            .refuse())
        return;
    const bool moves = w && (position != b.origin() || wrapAngle(angle) != b.angle);
    if (moves) w->impl_->disturb(id_.index);
    b.angle = wrapAngle(angle);
    b.rotation = Rot::ofAngle(b.angle);
    b.center = position + toDVec2(rotate(b.rotation, b.localCenter));
    if (w) w->impl_->bodies.rememberPose(b);
    if (moves && b.enabled && !b.takesPart) w->impl_->placeAll(id_.index, true);
}

void Body::setLinearVelocity(Vec2 velocity)
{
    TAMIAS_BODY_ROW(b);
    const real unit = w ? w->impl_->settings.lengthUnit : real(1);
    if (refuse(checkVelocity("linearVelocity", velocity, unit))) return;
    if (!w || b.type == BodyType::Static || velocity == b.velocity) return;
    w->impl_->disturb(id_.index);
    b.velocity = velocity;
    w->impl_->refreshPart(id_.index);
}

void Body::setAngularVelocity(real velocity)
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkSpin("angularVelocity", velocity))) return;
    if (!w || b.type == BodyType::Static || velocity == b.spin) return;
    w->impl_->disturb(id_.index);
    b.spin = velocity;
    w->impl_->refreshPart(id_.index);
}

Transform Body::interpolated(double alpha) const
{
    TAMIAS_BODY_ROW(b);
    if (refuse(checkRange("alpha", alpha, 0, 1, "must be in [0, 1]"))) return {};
    if (b.mover == BodyRow::kNone) return {b.origin(), b.angle, b.rotation};
    const MoverRow& last = table.mover(b);
    const Position before =
        b.originOf(last.previousCenter, Rot::ofAngle(last.previousAngle), last.previousLocalCenter);
    double turn = b.angle - last.previousAngle;  // the short way round
    if (turn > kPi) turn -= kTwoPi;
    if (turn < -kPi) turn += kTwoPi;
    return Transform::at(before + alpha * (b.origin() - before), last.previousAngle + alpha * turn);
}

void Body::setLocks(bool x, bool y, bool rotation)
{
    TAMIAS_BODY_ROW(b);
    if (w && (x != b.lockX || y != b.lockY || rotation != b.lockRotation)) {
        w->impl_->disturb(id_.index);
        w->impl_->pairsAreCurrent = false;
    }
    b.lockX = x;
    b.lockY = y;
    b.lockRotation = rotation;
}

real Body::mass() const
{
    TAMIAS_BODY_ROW(b);
    return b.isDynamic() ? b.mass : real(0);
}

real Body::inertia() const
{
    TAMIAS_BODY_ROW(b);
    return b.isDynamic() ? b.inertia : real(0);
}

Vec2 Body::localCenter() const
{
    TAMIAS_BODY_ROW(b);
    return b.localCenter;
}

void Body::setMass(const MassProperties& mass)
{
    TAMIAS_BODY_ROW(b);
    if (!w || refuse(check(mass, w->impl_->settings.lengthUnit))) return;
    w->impl_->disturb(id_.index);
    const Position origin = b.origin();
    const Vec2 before = b.localCenter;
    b.massIsSet = true;
    b.mass = mass.mass;
    b.inertia = mass.inertia;
    w->impl_->moveCenter(id_.index, origin, before, mass.center);
}

void Body::resetMass()
{
    TAMIAS_BODY_ROW(b);
    if (!w) return;
    const MassSum sum = w->impl_->massOfShapes(b);
    if (b.isDynamic() && refuse(checkMass("mass", textOf(sum.mass), sum))) return;
    w->impl_->disturb(id_.index);
    b.massIsSet = false;
    w->impl_->updateMass(id_.index);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
