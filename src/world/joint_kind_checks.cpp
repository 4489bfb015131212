// SPDX-License-Identifier: MIT
// The rules of what each kind of joint may be [R4].

#include "world/impl.hpp"
#include "world/joint_part_checks.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kLeastFactor = 1e-3, kMostFactor = 1e3;   // of ratios and teeth   [1] or [rad]
constexpr double kMaxPhase = 1e9;       // what many turns add up to   [rad] or [m]

Complaint checkKind(const RevoluteJoint& k, real lengthUnit)
{
    const JointUnits units = turningUnits("RevoluteJoint.");
    JointChecks checks;
    checks.anchors("RevoluteJoint.", k, lengthUnit);
    checks.angle("RevoluteJoint.referenceAngle", k.referenceAngle);
    checks.freeCoordinate(units, k);
    checks.turns("RevoluteJoint.turns", k.turns);
    return checks.first();
}

Complaint checkKind(const DistanceJoint& k, real lengthUnit)
{
    const JointUnits units = slidingUnits("DistanceJoint.", lengthUnit);
    const double least = kMinSize * static_cast<double>(lengthUnit);
    JointChecks checks;
    checks.anchors("DistanceJoint.", k, lengthUnit);
    checks.range("DistanceJoint.length", k.length, least, units.most,
                 checks.between(least, units.most, " m"));
    checks.limits(units, k.limits);
    if (k.limits)
        checks.that(k.limits->lower >= 0, "DistanceJoint.limits.lower", k.limits->lower, "must be >= 0 m")
            .that(k.limits->upper > 0, "DistanceJoint.limits.upper", k.limits->upper, "must be > 0 m");
    checks.motor(units, k.motor);
    checks.spring(units, k.spring);
    if (k.spring)
        checks.that(k.spring->rest >= 0, "DistanceJoint.spring.rest", k.spring->rest, "must be >= 0 m");
    return checks.first();
}

Complaint checkKind(const PrismaticJoint& k, real lengthUnit)
{
    const JointUnits units = slidingUnits("PrismaticJoint.", lengthUnit);
    JointChecks checks;
    checks.anchors("PrismaticJoint.", k, lengthUnit);
    checks.axis("PrismaticJoint.axis", k.axis);
    checks.angle("PrismaticJoint.referenceAngle", k.referenceAngle);
    checks.freeCoordinate(units, k);
    return checks.first();
}

Complaint checkKind(const WeldJoint& k, real lengthUnit)
{
    JointChecks checks;
    checks.anchors("WeldJoint.", k, lengthUnit);
    checks.angle("WeldJoint.referenceAngle", k.referenceAngle);
    if (k.linear) checks.spring("WeldJoint.linear.", *k.linear, 0, "m");
    if (k.angular) checks.spring("WeldJoint.angular.", *k.angular, 0, "rad");
    return checks.first();
}

Complaint checkKind(const TargetJoint& k, real lengthUnit)
{
    JointChecks checks;
    checks.anchor("TargetJoint.anchor", k.anchor, lengthUnit);
    checks.add(checkPosition("TargetJoint.target", k.target, lengthUnit));
    checks.angle("TargetJoint.angle", k.angle.value_or(0));
    checks
        .that(k.frequency > 0 && static_cast<double>(k.frequency) <= JointChecks::kMaxFrequency,
              "TargetJoint.frequency", k.frequency, "must be > 0 and at most 1e6 Hz")
        .range("TargetJoint.dampingRatio", k.dampingRatio, 0, 1e6, "must be in [0, 1e6]");
    checks.force("TargetJoint.maxForce", k.maxForce, "N");
    checks.force("TargetJoint.maxTorque", k.maxTorque, "N*m");
    return checks.first();
}

Complaint checkKind(const WheelJoint& k, real lengthUnit)
{
    const JointUnits way = slidingUnits("WheelJoint.", lengthUnit);
    JointChecks checks;
    checks.anchors("WheelJoint.", k, lengthUnit);
    checks.axis("WheelJoint.axis", k.axis);
    checks.limits(way, k.limits);
    checks.motor(turningUnits("WheelJoint."), k.motor);
    checks.spring(way, k.spring);
    return checks.first();
}

Complaint checkKind(const GrooveJoint& k, real lengthUnit)
{
    const double least = kMinSize * static_cast<double>(lengthUnit);
    JointChecks checks;
    checks.anchor("GrooveJoint.start", k.start, lengthUnit);
    checks.anchor("GrooveJoint.end", k.end, lengthUnit);
    checks.anchor("GrooveJoint.anchorB", k.anchorB, lengthUnit);
    checks.that(length(toDVec2(k.end) - toDVec2(k.start)) >= least, "GrooveJoint.end", k.end,
                "must be at least " + textOf(least) + " m from start");
    return checks.first();
}

Complaint checkKind(const RotaryJoint& k, real)
{
    const JointUnits units = turningUnits("RotaryJoint.");
    JointChecks checks;
    checks.angle("RotaryJoint.referenceAngle", k.referenceAngle);
    checks.freeCoordinate(units, k);
    checks.turns("RotaryJoint.turns", k.turns);
    return checks.first();
}

Complaint checkKind(const RatchetJoint& k, real)
{
    JointChecks checks;
    checks.angle("RatchetJoint.referenceAngle", k.referenceAngle);
    checks.factor("RatchetJoint.tooth", k.tooth, kLeastFactor, kMostFactor, " rad");
    return checks.first();
}

Complaint checkKind(const GearJoint& k, real)
{
    JointChecks checks;
    checks.factor("GearJoint.ratio", k.ratio, kLeastFactor, kMostFactor, "");
    checks.range("GearJoint.phase", k.phase, -kMaxPhase, kMaxPhase, checks.within(kMaxPhase, "rad"));
    return checks.first();
}

Complaint checkKind(const RackJoint& k, real lengthUnit)
{
    const double unit = static_cast<double>(lengthUnit);
    JointChecks checks;
    checks.anchors("RackJoint.", k, lengthUnit);
    checks.axis("RackJoint.axis", k.axis);
    checks.factor("RackJoint.radius", k.radius, kMinSize * unit, kMaxSize * unit, " m");
    checks.range("RackJoint.offset", k.offset, -kMaxPhase * unit, kMaxPhase * unit,
                 checks.within(kMaxPhase * unit, "m"));
    return checks.first();
}

Complaint checkKind(const PulleyJoint& k, real lengthUnit)
{
    const double unit = static_cast<double>(lengthUnit);
    JointChecks checks;
    checks.anchors("PulleyJoint.", k, lengthUnit);
    checks.add(checkPosition("PulleyJoint.wheelA", k.wheelA, lengthUnit))
        .add(checkPosition("PulleyJoint.wheelB", k.wheelB, lengthUnit))
        .range("PulleyJoint.ratio", k.ratio, kLeastFactor, kMostFactor, "must be in [1e-3, 1e3]")
        .range("PulleyJoint.length", k.length, kMinSize * unit, kMaxSize * unit,
               checks.between(kMinSize * unit, kMaxSize * unit, " m"));
    for (const auto& [field, stop] :
         {std::pair{"PulleyJoint.stopA", k.stopA}, {"PulleyJoint.stopB", k.stopB}})
        checks.range(field, stop, kMinSize * unit, kMaxSize * unit,
                     checks.between(kMinSize * unit, kMaxSize * unit, " m"));
    checks.that(static_cast<double>(k.stopA) + static_cast<double>(k.ratio) * static_cast<double>(k.stopB) <=
                    static_cast<double>(k.length),
                "PulleyJoint.length", k.length, "must be at least stopA + ratio * stopB");
    return checks.first();
}

Complaint checkKind(const MotorJoint& k, real lengthUnit)
{
    const JointUnits way = slidingUnits("MotorJoint.", lengthUnit), turn = turningUnits("MotorJoint.");
    JointChecks checks;
    checks.anchors("MotorJoint.", k, lengthUnit);
    checks.angle("MotorJoint.referenceAngle", k.referenceAngle);
    if (k.linear) checks.spring("MotorJoint.linear.", *k.linear, 0, "m");
    if (k.angular) checks.spring("MotorJoint.angular.", *k.angular, 0, "rad");
    checks
        .that(isFiniteValue(k.velocity) && length(toDVec2(k.velocity)) <= way.mostSpeed,
              "MotorJoint.velocity", k.velocity,
              "must be finite, its length at most " + textOf(way.mostSpeed) + " m/s")
        .range("MotorJoint.spin", k.spin, -turn.mostSpeed, turn.mostSpeed,
               checks.within(turn.mostSpeed, turn.speed));
    checks.force("MotorJoint.maxForce", k.maxForce, "N");
    checks.force("MotorJoint.maxTorque", k.maxTorque, "N*m");
    return checks.first();
}

Complaint checkKind(const FrictionJoint& k, real lengthUnit)
{
    JointChecks checks;
    checks.anchor("FrictionJoint.anchor", k.anchor, lengthUnit);
    checks.force("FrictionJoint.maxForce", k.maxForce, "N");
    checks.force("FrictionJoint.maxTorque", k.maxTorque, "N*m");
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

}  // namespace

Complaint check(const JointKind& kind, real lengthUnit)
{
    return std::visit([&](const auto& k) { return checkKind(k, lengthUnit); }, kind);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
