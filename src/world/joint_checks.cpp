// SPDX-License-Identifier: MIT
// The rules of what a joint may be [R4].

#include "joints/own.hpp"
#include "world/impl.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kUnbounded = static_cast<double>(kUnlimited);
constexpr double kMaxTurn = 1e6;        // [rad]
constexpr int kMostTurns = 100000;
constexpr double kMaxFrequency = 1e6;   // [Hz]
constexpr double kLeastFactor = 1e-3, kMostFactor = 1e3;   // of ratios and teeth   [1] or [rad]
constexpr double kMaxPhase = 1e9;       // what many turns add up to   [rad] or [m]

// How the numbers of a kind are called and bounded.
struct Units {
    std::string name;         // "RevoluteJoint."
    double most;              // of a place   [m] or [rad]
    double mostSpeed;         // [m/s] or [rad/s]
    std::string_view place, speed, force;
};

Units turning(std::string name)
{
    return {std::move(name), kMaxTurn, kMaxSpin, "rad", "rad/s", "N*m"};
}
Units sliding(std::string name, real lengthUnit)
{
    const double unit = static_cast<double>(lengthUnit);
    return {std::move(name), kMaxSize * unit, kMaxSpeed * unit, "m", "m/s", "N"};
}

std::string within(double most, std::string_view unit)
{
    return "must be finite and within +-" + textOf(most) + " " + std::string(unit);
}

void addAnchor(Checks& checks, const std::string& field, Vec2 anchor, real lengthUnit)
{
    const double most = kMaxSize * static_cast<double>(lengthUnit);
    checks.that(isFiniteValue(anchor) && length(toDVec2(anchor)) <= most, field, anchor,
                "must be finite, its length at most " + textOf(most) + " m");
}

void addAngle(Checks& checks, const std::string& field, double angle)
{
    checks.range(field, angle, -kMaxTurn, kMaxTurn, within(kMaxTurn, "rad"));
}

void addForce(Checks& checks, const std::string& field, real force, std::string_view unit)
{
    checks.range(field, force, 0, kUnbounded, "must be in [0, kUnlimited] " + std::string(unit));
}

void addLimits(Checks& checks, const Units& units, const std::optional<JointLimits>& limits)
{
    if (!limits) return;
    const auto isPlace = [&](real place) {
        return absolute(static_cast<double>(place)) <= units.most || absolute(place) == kUnlimited;
    };
    const std::string rule = within(units.most, units.place) + ", or kUnlimited";
    checks.that(isPlace(limits->lower), units.name + "limits.lower", limits->lower, rule)
        .that(isPlace(limits->upper), units.name + "limits.upper", limits->upper, rule)
        .that(limits->lower <= limits->upper, units.name + "limits.lower", limits->lower,
              "must not exceed limits.upper");
}

void addMotor(Checks& checks, const Units& units, const std::optional<JointMotor>& motor)
{
    if (!motor) return;
    checks.range(units.name + "motor.speed", motor->speed, -units.mostSpeed, units.mostSpeed,
                 within(units.mostSpeed, units.speed));
    addForce(checks, units.name + "motor.maxForce", motor->maxForce, units.force);
}

void addSpring(Checks& checks, const std::string& field, const JointSpring& spring, double most,
               std::string_view unit)
{
    checks.range(field + "frequency", spring.frequency, 0, kMaxFrequency, "must be in [0, 1e6] Hz")
        .range(field + "dampingRatio", spring.dampingRatio, 0, 1e6, "must be in [0, 1e6]")
        .range(field + "rest", spring.rest, -most, most, most > 0 ? within(most, unit) : "must be 0");
}

void addSpring(Checks& checks, const Units& units, const std::optional<JointSpring>& spring)
{
    if (spring) addSpring(checks, units.name + "spring.", *spring, units.most, units.place);
}

template <class Kind>
void addAnchors(Checks& checks, const std::string& name, const Kind& k, real lengthUnit)
{
    addAnchor(checks, name + "anchorA", k.anchorA, lengthUnit);
    addAnchor(checks, name + "anchorB", k.anchorB, lengthUnit);
}

// What may stand at a kind's free coordinate.
template <class Kind>
void addFree(Checks& checks, const Units& units, const Kind& k)
{
    addLimits(checks, units, k.limits);
    addMotor(checks, units, k.motor);
    addSpring(checks, units, k.spring);
}

void addTurns(Checks& checks, const std::string& field, int turns)
{
    checks.range(field, turns, -kMostTurns, kMostTurns, "must be within +-" + textOf(kMostTurns));
}

Complaint checkKind(const RevoluteJoint& k, real lengthUnit)
{
    const Units units = turning("RevoluteJoint.");
    Checks checks;
    addAnchors(checks, "RevoluteJoint.", k, lengthUnit);
    addAngle(checks, "RevoluteJoint.referenceAngle", k.referenceAngle);
    addFree(checks, units, k);
    addTurns(checks, "RevoluteJoint.turns", k.turns);
    return checks.first();
}

Complaint checkKind(const DistanceJoint& k, real lengthUnit)
{
    const Units units = sliding("DistanceJoint.", lengthUnit);
    const double least = kMinSize * static_cast<double>(lengthUnit);
    Checks checks;
    addAnchors(checks, "DistanceJoint.", k, lengthUnit);
    checks.range("DistanceJoint.length", k.length, least, units.most,
                 "must be in [" + textOf(least) + ", " + textOf(units.most) + "] m");
    addLimits(checks, units, k.limits);
    if (k.limits)
        checks.that(k.limits->lower >= 0, "DistanceJoint.limits.lower", k.limits->lower, "must be >= 0 m")
            .that(k.limits->upper > 0, "DistanceJoint.limits.upper", k.limits->upper, "must be > 0 m");
    addMotor(checks, units, k.motor);
    addSpring(checks, units, k.spring);
    if (k.spring)
        checks.that(k.spring->rest >= 0, "DistanceJoint.spring.rest", k.spring->rest, "must be >= 0 m");
    return checks.first();
}

void addAxis(Checks& checks, const std::string& field, Vec2 axis)
{
    const double size = length(toDVec2(axis));
    checks.that(isFiniteValue(axis) && size >= 1e-6 && size <= kMaxSize, field, axis,
                "must be finite, its length in [1e-6, 1e6]");
}

Complaint checkKind(const PrismaticJoint& k, real lengthUnit)
{
    const Units units = sliding("PrismaticJoint.", lengthUnit);
    Checks checks;
    addAnchors(checks, "PrismaticJoint.", k, lengthUnit);
    addAxis(checks, "PrismaticJoint.axis", k.axis);
    addAngle(checks, "PrismaticJoint.referenceAngle", k.referenceAngle);
    addFree(checks, units, k);
    return checks.first();
}

// A ratio or step: neither nothing nor beyond measure, either way.
void addFactor(Checks& checks, const std::string& field, real value, double least, double most,
               std::string_view unit)
{
    const double size = absolute(static_cast<double>(value));
    checks.that(size >= least && size <= most, field, value,
                "must be in [" + textOf(least) + ", " + textOf(most) + "]" + std::string(unit) +
                    ", or the same below 0");
}

Complaint checkKind(const WeldJoint& k, real lengthUnit)
{
    Checks checks;
    addAnchors(checks, "WeldJoint.", k, lengthUnit);
    addAngle(checks, "WeldJoint.referenceAngle", k.referenceAngle);
    if (k.linear) addSpring(checks, "WeldJoint.linear.", *k.linear, 0, "m");
    if (k.angular) addSpring(checks, "WeldJoint.angular.", *k.angular, 0, "rad");
    return checks.first();
}

Complaint checkKind(const TargetJoint& k, real lengthUnit)
{
    Checks checks;
    addAnchor(checks, "TargetJoint.anchor", k.anchor, lengthUnit);
    checks.add(checkPosition("TargetJoint.target", k.target, lengthUnit));
    addAngle(checks, "TargetJoint.angle", k.angle.value_or(0));
    checks
        .that(k.frequency > 0 && static_cast<double>(k.frequency) <= kMaxFrequency, "TargetJoint.frequency",
              k.frequency, "must be > 0 and at most 1e6 Hz")
        .range("TargetJoint.dampingRatio", k.dampingRatio, 0, 1e6, "must be in [0, 1e6]");
    addForce(checks, "TargetJoint.maxForce", k.maxForce, "N");
    addForce(checks, "TargetJoint.maxTorque", k.maxTorque, "N*m");
    return checks.first();
}

Complaint checkKind(const WheelJoint& k, real lengthUnit)
{
    const Units way = sliding("WheelJoint.", lengthUnit);
    Checks checks;
    addAnchors(checks, "WheelJoint.", k, lengthUnit);
    addAxis(checks, "WheelJoint.axis", k.axis);
    addLimits(checks, way, k.limits);
    addMotor(checks, turning("WheelJoint."), k.motor);
    addSpring(checks, way, k.spring);
    return checks.first();
}

Complaint checkKind(const GrooveJoint& k, real lengthUnit)
{
    const double least = kMinSize * static_cast<double>(lengthUnit);
    Checks checks;
    addAnchor(checks, "GrooveJoint.start", k.start, lengthUnit);
    addAnchor(checks, "GrooveJoint.end", k.end, lengthUnit);
    addAnchor(checks, "GrooveJoint.anchorB", k.anchorB, lengthUnit);
    checks.that(length(toDVec2(k.end) - toDVec2(k.start)) >= least, "GrooveJoint.end", k.end,
                "must be at least " + textOf(least) + " m from start");
    return checks.first();
}

Complaint checkKind(const RotaryJoint& k, real)
{
    const Units units = turning("RotaryJoint.");
    Checks checks;
    addAngle(checks, "RotaryJoint.referenceAngle", k.referenceAngle);
    addFree(checks, units, k);
    addTurns(checks, "RotaryJoint.turns", k.turns);
    return checks.first();
}

Complaint checkKind(const RatchetJoint& k, real)
{
    Checks checks;
    addAngle(checks, "RatchetJoint.referenceAngle", k.referenceAngle);
    addFactor(checks, "RatchetJoint.tooth", k.tooth, kLeastFactor, kMostFactor, " rad");
    return checks.first();
}

Complaint checkKind(const GearJoint& k, real)
{
    Checks checks;
    addFactor(checks, "GearJoint.ratio", k.ratio, kLeastFactor, kMostFactor, "");
    checks.range("GearJoint.phase", k.phase, -kMaxPhase, kMaxPhase, within(kMaxPhase, "rad"));
    return checks.first();
}

Complaint checkKind(const RackJoint& k, real lengthUnit)
{
    const double unit = static_cast<double>(lengthUnit);
    Checks checks;
    addAnchors(checks, "RackJoint.", k, lengthUnit);
    addAxis(checks, "RackJoint.axis", k.axis);
    addFactor(checks, "RackJoint.radius", k.radius, kMinSize * unit, kMaxSize * unit, " m");
    checks.range("RackJoint.offset", k.offset, -kMaxPhase * unit, kMaxPhase * unit,
                 within(kMaxPhase * unit, "m"));
    return checks.first();
}

Complaint checkKind(const PulleyJoint& k, real lengthUnit)
{
    const double unit = static_cast<double>(lengthUnit);
    Checks checks;
    addAnchors(checks, "PulleyJoint.", k, lengthUnit);
    checks.add(checkPosition("PulleyJoint.wheelA", k.wheelA, lengthUnit))
        .add(checkPosition("PulleyJoint.wheelB", k.wheelB, lengthUnit))
        .range("PulleyJoint.ratio", k.ratio, kLeastFactor, kMostFactor, "must be in [1e-3, 1e3]")
        .range("PulleyJoint.length", k.length, kMinSize * unit, kMaxSize * unit,
               "must be in [" + textOf(kMinSize * unit) + ", " + textOf(kMaxSize * unit) + "] m");
    for (const auto& [field, stop] :
         {std::pair{"PulleyJoint.stopA", k.stopA}, {"PulleyJoint.stopB", k.stopB}})
        checks.range(field, stop, kMinSize * unit, kMaxSize * unit,
                     "must be in [" + textOf(kMinSize * unit) + ", " + textOf(kMaxSize * unit) + "] m");
    checks.that(static_cast<double>(k.stopA) + static_cast<double>(k.ratio) * static_cast<double>(k.stopB) <=
                    static_cast<double>(k.length),
                "PulleyJoint.length", k.length, "must be at least stopA + ratio * stopB");
    return checks.first();
}

Complaint checkKind(const MotorJoint& k, real lengthUnit)
{
    const Units way = sliding("MotorJoint.", lengthUnit), turn = turning("MotorJoint.");
    Checks checks;
    addAnchors(checks, "MotorJoint.", k, lengthUnit);
    addAngle(checks, "MotorJoint.referenceAngle", k.referenceAngle);
    if (k.linear) addSpring(checks, "MotorJoint.linear.", *k.linear, 0, "m");
    if (k.angular) addSpring(checks, "MotorJoint.angular.", *k.angular, 0, "rad");
    checks
        .that(isFiniteValue(k.velocity) && length(toDVec2(k.velocity)) <= way.mostSpeed,
              "MotorJoint.velocity", k.velocity,
              "must be finite, its length at most " + textOf(way.mostSpeed) + " m/s")
        .range("MotorJoint.spin", k.spin, -turn.mostSpeed, turn.mostSpeed,
               within(turn.mostSpeed, turn.speed));
    addForce(checks, "MotorJoint.maxForce", k.maxForce, "N");
    addForce(checks, "MotorJoint.maxTorque", k.maxTorque, "N*m");
    return checks.first();
}

Complaint checkKind(const FrictionJoint& k, real lengthUnit)
{
    Checks checks;
    addAnchor(checks, "FrictionJoint.anchor", k.anchor, lengthUnit);
    addForce(checks, "FrictionJoint.maxForce", k.maxForce, "N");
    addForce(checks, "FrictionJoint.maxTorque", k.maxTorque, "N*m");
    return checks.first();
}

Complaint checkKind(const FilterJoint&, real)
{
    return std::nullopt;
}

Complaint checkKind(const OwnJoint& k, real)
{
    return checkThat(!k.isNull(), "OwnJoint", "", "must be made of a constraint");
}

// Asks a constraint where its bodies are: what it answers now it must not answer later.
Complaint checkAnswer(const OwnJoint& kind, const JointRow& joint, const BodyTable& bodies,
                      std::uint32_t& layout)
{
    const std::string name(kind.name());
    const OwnPose pose = ownPoseOf(joint, bodies);
    ConstraintRows answer(pose.count);
    std::string thrown;
    askConstraint(kind, pose, answer, &thrown);
    layout = layoutOf(answer);
    const ConstraintRows::Problem& wrong = answer.problem();
    if (!wrong.field) return std::nullopt;
    if (std::string_view(wrong.field) == "measure")
        return InputError(name + ".measure", textOf(thrown), wrong.rule);
    const std::string row = wrong.row < 0 ? "position" : "rows[" + textOf(wrong.row) + "]";
    return InputError(name + "." + row + "." + wrong.field, textOf(wrong.value), wrong.rule);
}

}  // namespace

Complaint check(const JointKind& kind, real lengthUnit)
{
    return std::visit([&](const auto& k) { return checkKind(k, lengthUnit); }, kind);
}

Complaint check(const JointBreaking& b)
{
    const auto isPositive = [](real value) { return value > 0 && value <= kUnlimited; };
    constexpr std::string_view rule = "must be > 0 and at most kUnlimited";
    return Checks()
        .that(isPositive(b.force), "JointBreaking.force", b.force, rule)
        .that(isPositive(b.torque), "JointBreaking.torque", b.torque, rule)
        .that(isPositive(b.error), "JointBreaking.error", b.error, rule)
        .range("JointBreaking.window", b.window, 0, kUnbounded, "must be in [0, kUnlimited] s")
        .first();
}

Complaint World::Impl::checkBodies(const JointDef& def) const
{
    const auto complain = [&](std::string_view field, BodyId body, std::string_view rule) -> Complaint {
        const std::string given = body.isNull()
                                      ? std::string("null")
                                      : textOf(body.index) + " (generation " + textOf(body.generation) + ")";
        return InputError(std::string(field), given, std::string(rule));
    };
    if (!bodies.ids.owns(def.bodyA))
        return complain("JointDef.bodyA", def.bodyA, "must be a live body of this world");
    if (!bodies.ids.owns(def.bodyB))
        return complain("JointDef.bodyB", def.bodyB, "must be a live body of this world");
    const OwnJoint* const own = std::get_if<OwnJoint>(&def.kind);
    const bool isAlone = own && own->bodies() == 1;
    if ((def.bodyA == def.bodyB) != isAlone)
        return complain("JointDef.bodyB", def.bodyB,
                        isAlone ? "must be the same body as bodyA" : "must be another body than bodyA");
    bool isDynamic = row(def.bodyA).isDynamic() || row(def.bodyB).isDynamic();
    for (std::size_t i = 0; i < def.moreBodies.size(); ++i) {
        const BodyId body = def.moreBodies[i];
        if (!bodies.ids.owns(body))
            return complain("JointDef.moreBodies", body, "must be a live body of this world");
        bool isNew = body != def.bodyA && body != def.bodyB;
        for (std::size_t k = 0; k < i; ++k) isNew = isNew && def.moreBodies[k] != body;
        if (!isNew) return complain("JointDef.moreBodies", body, "must be another body than all others");
        isDynamic = isDynamic || row(body).isDynamic();
    }
    if (!isDynamic) return complain("JointDef.bodyB", def.bodyB, "must be dynamic, as bodyA is not");
    return std::nullopt;
}

Complaint World::Impl::checkKind(const JointDef& def, const JointKind& kind, std::uint32_t& layout) const
{
    layout = 0;
    if (Complaint wrong = tamias2d::check(kind, settings.lengthUnit)) return wrong;
    const OwnJoint* const own = std::get_if<OwnJoint>(&kind);
    const std::size_t count = (def.bodyA == def.bodyB ? 1 : 2) + def.moreBodies.size();
    const std::size_t wanted = own ? static_cast<std::size_t>(own->bodies()) : 2;
    if (count != wanted)
        return InputError("JointDef.moreBodies", textOf(def.moreBodies.size()),
                          "must make " + textOf(wanted) + " bodies in all, not " + textOf(count));
    if (!own) return std::nullopt;
    JointRow joint;
    joint.bodyA = def.bodyA.index;
    joint.bodyB = def.bodyB.index;
    for (const BodyId body : def.moreBodies) joint.more.push_back(body.index);
    beginOwnCount(joint, bodies);
    return checkAnswer(*own, joint, bodies, layout);
}

Complaint World::Impl::check(const JointDef& def, std::uint32_t& layout) const
{
    if (Complaint wrong = checkBodies(def)) return wrong;
    Checks checks;
    checks.add(checkKind(def, def.kind, layout)).add(tamias2d::check(def.breaking));
    return checks.first();
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
