// SPDX-License-Identifier: MIT
// The rules of every input [R4], in one place.

#include "geometry/validate.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kTiny = std::numeric_limits<float>::min();  // smallest value that divides safely
constexpr double kHuge = 1e30;                               // and largest: products stay finite in float

constexpr int kMostThreads = TAMIAS_HAS_THREADS != 0 ? kMaxThreads : 1;

// The rules that name a bound put it into words for a refused value only: setters allocate nothing.
template <class T>
Complaint checkBound(bool holds, std::string_view field, const T& value, std::string_view rule, double bound,
                     std::string_view end)
{
    if (holds) return std::nullopt;
    return checkThat(false, field, value, std::string(rule) + textOf(bound) + " " + std::string(end));
}

Complaint checkLength(std::string_view field, Vec2 value, double most)
{
    const bool holds = isFiniteValue(value) && length(toDVec2(value)) <= most;
    return checkBound(holds, field, value, "must be finite, its length at most ", most, "m");
}

}  // namespace

bool refuse(const Complaint& complaint)
{
    if (!complaint) return false;
    fail(*complaint);
    return true;
}

Complaint checkPosition(std::string_view field, Position position, real lengthUnit)
{
    const double most = kMaxPosition * static_cast<double>(lengthUnit);
    const bool holds =
        isFiniteValue(position) && absolute(position.x) <= most && absolute(position.y) <= most;
    return checkBound(holds, field, position, "must be finite, each coordinate within +-", most, "m");
}

Complaint checkVelocity(std::string_view field, Vec2 velocity, real lengthUnit)
{
    const double most = kMaxSpeed * static_cast<double>(lengthUnit);
    const double speed = length(toDVec2(velocity));
    return checkBound(isFiniteValue(velocity) && speed <= most, field, velocity,
                      "must be finite, its length at most ", most, "m/s");
}

Complaint checkSpin(std::string_view field, real spin)
{
    return checkRange(field, spin, -kMaxSpin, kMaxSpin, "must be finite and within +-1e6 rad/s");
}

Complaint checkMixingRule(std::string_view field, MixingRule rule, bool worldAllowed)
{
    const auto number = static_cast<int>(rule);
    return checkThat(number >= (worldAllowed ? 0 : 1) && number <= static_cast<int>(MixingRule::Maximum),
                     field, number,
                     worldAllowed ? "must be one of MixingRule" : "must be one of MixingRule, and not World");
}

Complaint checkThreads(std::string_view field, int threads)
{
    return checkThat(threads >= 1 && threads <= kMostThreads, field, threads,
                     TAMIAS_HAS_THREADS != 0 ? "must be in [1, 64]" : "must be 1 in a build without threads");
}

Complaint check(const Tuning& t)
{
    return Checks()
        .range("Tuning.restGap", t.restGap, 1e-6, 0.1, "must be in [1e-6, 0.1]")
        .range("Tuning.touchingFactor", t.touchingFactor, 1, 3, "must be in [1, 3]")
        .range("Tuning.pushRate", t.pushRate, 0, 1, "must be in [0, 1]")
        .range("Tuning.pushSpeed", t.pushSpeed, kTiny, kMaxSpeed, "must be > 0 lengthUnit/s and finite")
        .range("Tuning.pushSlack", t.pushSlack, 0, 1, "must be in [0, 1]")
        .range("Tuning.extraPasses", t.extraPasses, 0, 100, "must be in [0, 100]")
        .range("Tuning.settlingPasses", t.settlingPasses, 0, 100, "must be in [0, 100]")
        .range("Tuning.restless", t.restless, kTiny, kMaxSpeed, "must be > 0 lengthUnit/s and finite")
        .that(t.calmRate >= 0 && t.calmRate < 1, "Tuning.calmRate", t.calmRate, "must be in [0, 1)")
        .range("Tuning.calmSpeed", t.calmSpeed, kTiny, kMaxSpeed, "must be > 0 lengthUnit/s and finite")
        .range("Tuning.quiet", t.quiet, 0, 0.1, "must be in [0, 0.1]")
        .range("Tuning.impactThreshold", t.impactThreshold, 0.1, 10, "must be in [0.1, 10]")
        .range("Tuning.crowd", t.crowd, 1, 1000000, "must be in [1, 1000000]")
        .range("Tuning.impactsPerContact", t.impactsPerContact, 2, 1000, "must be in [2, 1000]")
        .range("Tuning.sleepTime", t.sleepTime, 0, 1e6, "must be in [0, 1e6] s")
        .range("Tuning.sleepSpeed", t.sleepSpeed, kTiny, kMaxSpeed, "must be > 0 lengthUnit/s and finite")
        .first();
}

Complaint check(const WorldDef& def)
{
    return Checks()
        .finite("WorldDef.gravity", def.gravity, "must be finite m/s^2")
        .range("WorldDef.gravitationConstant", def.gravitationConstant, 0, kAnyFinite,
               "must be finite and >= 0 m^3/(kg*s^2)")
        .range("WorldDef.lengthUnit", def.lengthUnit, 1e-6, 1e6, "must be in [1e-6, 1e6] m")
        .add(checkMixingRule("WorldDef.frictionMixing", def.frictionMixing, false))
        .add(checkMixingRule("WorldDef.restitutionMixing", def.restitutionMixing, false))
        .add(check(def.tuning))
        .add(checkThat(hasLanes(def.lanes), "WorldDef.lanes", static_cast<int>(def.lanes),
                       "must be one of LaneWidth that this machine has"))
        .add(checkThreads("WorldDef.threads", def.threads))
        .first();
}

Complaint check(const Material& m)
{
    return Checks()
        .range("Material.friction", m.friction, 0, 1e6, "must be in [0, 1e6]")
        .range("Material.restitution", m.restitution, 0, 1, "must be in [0, 1]")
        .range("Material.rollingResistance", m.rollingResistance, 0, 1e6, "must be in [0, 1e6]")
        .range("Material.surfaceSpeed", m.surfaceSpeed, -kMaxSpeed, kMaxSpeed,
               "must be finite and within +-1e6 m/s")
        .add(checkMixingRule("Material.frictionMixing", m.frictionMixing, true))
        .add(checkMixingRule("Material.restitutionMixing", m.restitutionMixing, true))
        .first();
}

Complaint check(const MassProperties& m, real lengthUnit)
{
    const double most = kMaxSize * static_cast<double>(lengthUnit);
    return Checks()
        .range("MassProperties.mass", m.mass, kTiny, kHuge, "must be finite and > 0 kg")
        .add(checkBound(isFiniteValue(m.center) && length(toDVec2(m.center)) <= most, "MassProperties.center",
                        m.center, "must be finite and within ", most, "m of the origin"))
        .that(m.inertia == 0 || (m.inertia >= real(kTiny) && m.inertia <= real(kHuge)),
              "MassProperties.inertia", m.inertia, "must be finite and >= 0 kg*m^2")
        .first();
}

Complaint checkMass(std::string_view field, std::string value, const MassSum& m)
{
    // The inertia of a body as large as the bounds allow is greater than kHuge; its inverse is a number yet.
    const auto within = [](double x, double most) { return x >= kTiny && x <= most; };
    if (m.mass == 0 || (within(m.mass, kHuge) && within(m.inertia, 1 / kTiny))) return std::nullopt;
    return InputError(std::string(field), std::move(value),
                      "must give the body a mass within [1.2e-38, 1e30] kg and an inertia within "
                      "[1.2e-38, 8.5e37] kg*m^2");
}

Complaint check(const BodyDef& def, real lengthUnit)
{
    const auto type = static_cast<int>(def.type);
    Checks checks;
    checks.that(type >= 0 && type <= 2, "BodyDef.type", type, "must be Static, Kinematic or Dynamic")
        .add(checkPosition("BodyDef.position", def.position, lengthUnit))
        .finite("BodyDef.angle", def.angle, "must be finite rad")
        .add(checkVelocity("BodyDef.linearVelocity", def.linearVelocity, lengthUnit))
        .add(checkSpin("BodyDef.angularVelocity", def.angularVelocity))
        .range("BodyDef.linearDamping", def.linearDamping, 0, kHuge, "must be finite and >= 0 1/s")
        .range("BodyDef.angularDamping", def.angularDamping, 0, kHuge, "must be finite and >= 0 1/s")
        .finite("BodyDef.gravityScale", def.gravityScale)
        .finite("BodyDef.gravity", def.gravity.value_or(Vec2{}), "must be finite m/s^2");
    if (def.mass) checks.add(check(*def.mass, lengthUnit));
    const bool still = def.linearVelocity == Vec2{} && def.angularVelocity == 0;
    checks.that(def.awake || def.type != BodyType::Dynamic || (def.allowSleep && still), "BodyDef.awake",
                "false", "must be true for a body that moves or may not sleep");
    return checks.first();
}

Complaint check(const ShapeDef& def, real lengthUnit, bool known)
{
    const double unit = static_cast<double>(lengthUnit);
    return Checks()
        .add(known ? std::nullopt
                   : checkGeometry("ShapeDef.geometry", def.geometry, kMinSize * unit, kMaxSize * unit))
        .add(checkLength("ShapeDef.offset", def.offset, kMaxSize * unit))
        .finite("ShapeDef.angle", def.angle, "must be finite rad")
        .range("ShapeDef.density", def.density, 0, kHuge, "must be finite and >= 0 kg/m^2")
        .add(check(def.material))
        .first();
}

Complaint check(const LastingForce& f, real lengthUnit)
{
    const double most = kMaxPosition * static_cast<double>(lengthUnit);
    return Checks()
        .finite("LastingForce.force", f.force, "must be finite N")
        .add(checkLength("LastingForce.point", f.point, most))
        .finite("LastingForce.torque", f.torque, "must be finite N*m")
        .first();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
