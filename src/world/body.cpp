// SPDX-License-Identifier: MIT
#include "diagnostics/energy.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

const std::string kNoName;

BodyRow& deadBodyRow()
{
    static thread_local BodyRow row;
    return row = {};
}

const BodyTable& noBodies()
{
    static const BodyTable none(0);
    return none;
}

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

// The row, or a fresh one that nobody keeps when a dead handle was let pass by the error handler.
#define TAMIAS_BODY_ROW(name)                                                                                \
    World* const w = alive();                                                                                \
    if (w) w->impl_->settleMass(id_.index);                                                                  \
    [[maybe_unused]] const BodyTable& table = w ? w->impl_->bodies : noBodies();                             \
    BodyRow& name = w ? w->impl_->row(id_) : deadBodyRow()

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

// --- sleep

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

// --- where it is and how it moves

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

// --- mass

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

// --- forces

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

// --- shapes and results

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

#undef TAMIAS_BODY_ROW

}  // namespace tamias2d::inline TAMIAS_PRECISION
