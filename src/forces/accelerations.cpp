// SPDX-License-Identifier: MIT
#include "forces/accelerations.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

Vec2 gravityOn(const BodyTable& bodies, const BodyRow& body, Vec2 worldGravity)
{
    const Vec2 gravity = body.extra == BodyRow::kNone
                             ? worldGravity
                             : bodies.extras[body.extra].gravity.value_or(worldGravity);
    return bodies.mover(body).gravityScale * gravity;
}

BodyView viewOf(const BodyRow& body, BodyId id, Position center, double angle, Vec2 velocity, real spin)
{
    return {id,
            center,
            wrapAngle(angle),
            toDVec2(velocity),
            static_cast<double>(spin),
            static_cast<double>(body.mass),
            static_cast<double>(body.inertia)};
}

// The law's answer; nothing, and a fault, if it throws or is no number, or none of this precision.
Wrench evaluate(const ForceLaw& law, const BodyView& view, double time, std::uint32_t& faults)
{
    Wrench wrench;
#if TAMIAS_HAS_EXCEPTIONS
    try {
        wrench = law.force(view, time);
    } catch (...) {
        ++faults;
        return {};
    }
#else
    wrench = law.force(view, time);
#endif
    if (isFinite(toVec2(wrench.force)) && std::isfinite(static_cast<real>(wrench.torque))) return wrench;
    ++faults;
    return {};
}

// 0 if the law throws or says no number: a question has no report to count the fault in.
double evaluatePotential(const ForceLaw& law, const BodyView& view, double time)
{
#if TAMIAS_HAS_EXCEPTIONS
    double energy = 0;
    try {
        energy = law.potential(view, time);
    } catch (...) {
        return 0;
    }
#else
    const double energy = law.potential(view, time);
#endif
    return std::isfinite(energy) ? energy : 0;
}

// Forces held on the body: those of this step and the lasting ones, the latter at its present angle.
Wrench heldForces(const BodyTable& bodies, const BodyRow& body, const Motion& m)
{
    const MoverRow& mover = bodies.mover(body);
    Wrench sum{toDVec2(mover.stepForce), static_cast<double>(mover.stepTorque)};
    if (body.extra == BodyRow::kNone) return sum;
    for (const LastingForce& held : bodies.extras[body.extra].lasting) {
        const Vec2 force = held.forceTurns ? rotate(m.rotation, held.force) : held.force;
        const Vec2 arm = held.pointTurns ? rotate(m.rotation, held.point) : held.point;
        sum.force += toDVec2(force);
        sum.torque += static_cast<double>(cross(arm, force) + held.torque);
    }
    return sum;
}

// T3 between all pairs, by direct sum. Coincident centers pull nowhere.
void addGravitation(MotionTable& motions, const BodyTable& bodies, double constant)
{
    for (std::size_t i = 0; i < motions.rows.size(); ++i) {
        for (std::size_t k = i + 1; k < motions.rows.size(); ++k) {
            Motion &a = motions.rows[i], &b = motions.rows[k];
            const double massA = static_cast<double>(bodies.rows[a.body].mass);
            const double massB = static_cast<double>(bodies.rows[b.body].mass);
            if (massA <= 0 || massB <= 0) continue;
            const DVec2 d = b.center - a.center;
            const double squared = dot(d, d);
            if (squared <= 0) continue;
            const DVec2 pull = (constant / (squared * std::sqrt(squared))) * d;
            const Vec2 onA = toVec2(massB * pull), onB = toVec2(-massA * pull);
            if (a.invMass.x > 0) a.acceleration.x += onA.x;
            if (a.invMass.y > 0) a.acceleration.y += onA.y;
            if (b.invMass.x > 0) b.acceleration.x += onB.x;
            if (b.invMass.y > 0) b.acceleration.y += onB.y;
        }
    }
}

void addLaw(const PlacedLaw& placed, Motion& m, const BodyTable& bodies, double time, std::uint32_t& faults)
{
    const BodyRow& body = bodies.rows[m.body];
    if (!body.isDynamic()) return;
    const BodyView view = viewOf(body, bodies.ids.id(m.body), m.center, m.angle, m.velocity, m.spin);
    const Wrench wrench = evaluate(placed.law, view, time, faults);
    const Vec2 force = toVec2(wrench.force);
    m.acceleration += {m.invMass.x * force.x, m.invMass.y * force.y};
    m.spinRate += m.invInertia * static_cast<real>(wrench.torque);
}

// What is more takes the body to its greatest speed within the step, where the report counts it, but would
// first send the search for pairs along a path as long as the world, and its infinities into every body
// there.
real limited(real acceleration, double most)
{
    if (static_cast<double>(absolute(acceleration)) <= most) return acceleration;
    if (std::isnan(acceleration)) return 0;  // of two infinite forces against each other
    return static_cast<real>(clamp(static_cast<double>(acceleration), -most, most));
}

// Gravity and the forces held on the body.
void accelerateByHeld(Motion& m, const BodyTable& bodies, const ForceField& field)
{
    const BodyRow& body = bodies.rows[m.body];
    m.acceleration = {};
    m.spinRate = 0;
    if (!body.isDynamic()) return;
    const Vec2 g = gravityOn(bodies, body, field.gravity);
    const MoverRow& mover = bodies.mover(body);
    const bool isHeld = body.extra != BodyRow::kNone || mover.stepForce != Vec2{} || mover.stepTorque != 0;
    if (!isHeld) {  // mostly
        m.acceleration = {m.invMass.x > 0 ? g.x : real(0), m.invMass.y > 0 ? g.y : real(0)};
        return;
    }
    const Wrench held = heldForces(bodies, body, m);
    const Vec2 force = toVec2(held.force);
    m.acceleration = {(m.invMass.x > 0 ? g.x : real(0)) + m.invMass.x * force.x,
                      (m.invMass.y > 0 ? g.y : real(0)) + m.invMass.y * force.y};
    m.spinRate = m.invInertia * static_cast<real>(held.torque);
}

void limit(Motion& m, const ForceField& field)
{
    m.acceleration = {limited(m.acceleration.x, field.most), limited(m.acceleration.y, field.most)};
    m.spinRate = limited(m.spinRate, field.mostSpinRate);
}

}  // namespace

bool ForceField::varies(const MotionTable& motions, const BodyTable& bodies) const
{
    if (gravitationConstant > 0 || !laws.empty()) return true;
    for (const Motion& m : motions.rows)
        if (!bodies.extra(bodies.rows[m.body]).lasting.empty()) return true;
    return false;
}

bool ForceField::variesFor(const Motion& motion, const BodyTable& bodies) const
{
    if (gravitationConstant > 0 || !bodies.extra(bodies.rows[motion.body]).lasting.empty()) return true;
    const BodyId id = bodies.ids.id(motion.body);
    return std::any_of(laws.begin(), laws.end(),
                       [id](const PlacedLaw& placed) { return placed.body.isNull() || placed.body == id; });
}

std::uint32_t accelerateOne(Motion& m, const BodyTable& bodies, const ForceField& field, double time)
{
    std::uint32_t faults = 0;
    accelerateByHeld(m, bodies, field);
    for (const PlacedLaw& placed : field.laws)
        if (placed.body.isNull() || placed.body == bodies.ids.id(m.body))
            addLaw(placed, m, bodies, time, faults);
    limit(m, field);
    return faults;
}

Wrench wrenchOfLaws(const BodyRow& body, BodyId id, const ForceField& field, double time,
                    std::uint32_t& faults)
{
    Wrench sum;
    if (!body.isDynamic()) return sum;
    const BodyView view = viewOf(body, id, body.center, body.angle, body.velocity, body.spin);
    for (const PlacedLaw& placed : field.laws) {
        if (!placed.body.isNull() && placed.body != id) continue;
        const Wrench one = evaluate(placed.law, view, time, faults);
        sum.force += one.force;
        sum.torque += one.torque;
    }
    return sum;
}

std::uint32_t accelerate(MotionTable& motions, const BodyTable& bodies, const ForceField& field, double time)
{
    std::uint32_t faults = 0;
    for (Motion& m : motions.rows) accelerateByHeld(m, bodies, field);
    if (field.gravitationConstant > 0) addGravitation(motions, bodies, field.gravitationConstant);
    for (const PlacedLaw& placed : field.laws) {
        if (placed.body.isNull()) {
            for (Motion& m : motions.rows) addLaw(placed, m, bodies, time, faults);
        } else if (bodies.ids.owns(placed.body)) {
            const std::uint32_t row = motions.rowFor(placed.body.index);
            if (row != MotionTable::kNone) addLaw(placed, motions.rows[row], bodies, time, faults);
        }
    }
    for (Motion& m : motions.rows) limit(m, field);
    return faults;
}

double potentialEnergy(const BodyTable& bodies, std::uint32_t slot, const ForceField& field, double time)
{
    const BodyRow& body = bodies.rows[slot];
    const BodyId id = bodies.ids.id(slot);
    if (!body.isDynamic()) return 0;
    const Vec2 g = gravityOn(bodies, body, field.gravity);
    const double mass = static_cast<double>(body.mass);
    double sum =
        -mass * (static_cast<double>(g.x) * body.center.x + static_cast<double>(g.y) * body.center.y);
    for (const PlacedLaw& placed : field.laws) {
        if (!placed.law.potential || (!placed.body.isNull() && placed.body != id)) continue;
        const BodyView view = viewOf(body, id, body.center, body.angle, body.velocity, body.spin);
        sum += evaluatePotential(placed.law, view, time);
    }
    return sum;
}

double gravitationEnergy(const BodyTable& bodies, double gravitationConstant)
{
    double sum = 0;
    if (!(gravitationConstant > 0)) return sum;
    for (std::uint32_t i = 0; i < bodies.rows.size(); ++i) {
        if (!bodies.ids.isAlive(i) || !bodies.rows[i].isDynamic() || !bodies.rows[i].enabled) continue;
        for (std::uint32_t k = i + 1; k < bodies.rows.size(); ++k) {
            if (!bodies.ids.isAlive(k) || !bodies.rows[k].isDynamic() || !bodies.rows[k].enabled) continue;
            const double distance = length(bodies.rows[k].center - bodies.rows[i].center);
            const double masses =
                static_cast<double>(bodies.rows[i].mass) * static_cast<double>(bodies.rows[k].mass);
            if (distance > 0) sum -= gravitationConstant * masses / distance;
        }
    }
    return sum;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
