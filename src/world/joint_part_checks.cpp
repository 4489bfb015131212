// SPDX-License-Identifier: MIT
// The rules of what joints are made of [R4].

#include "world/joint_part_checks.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/model/defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kMaxTurn = 1e6;  // [rad]
constexpr int kMostTurns = 100000;

}  // namespace

JointUnits turningUnits(std::string name)
{
    return {std::move(name), kMaxTurn, kMaxSpin, "rad", "rad/s", "N*m"};
}

JointUnits slidingUnits(std::string name, real lengthUnit)
{
    const double unit = static_cast<double>(lengthUnit);
    return {std::move(name), kMaxSize * unit, kMaxSpeed * unit, "m", "m/s", "N"};
}

std::string JointChecks::within(double most, std::string_view unit)
{
    return "must be finite and within +-" + textOf(most) + " " + std::string(unit);
}

std::string JointChecks::between(double least, double most, std::string_view unit)
{
    return "must be in [" + textOf(least) + ", " + textOf(most) + "]" + std::string(unit);
}

void JointChecks::anchor(const std::string& field, Vec2 anchor, real lengthUnit)
{
    const double most = kMaxSize * static_cast<double>(lengthUnit);
    that(isFiniteValue(anchor) && length(toDVec2(anchor)) <= most, field, anchor,
         "must be finite, its length at most " + textOf(most) + " m");
}

void JointChecks::angle(const std::string& field, double angle)
{
    range(field, angle, -kMaxTurn, kMaxTurn, within(kMaxTurn, "rad"));
}

void JointChecks::axis(const std::string& field, Vec2 axis)
{
    const double size = length(toDVec2(axis));
    that(isFiniteValue(axis) && size >= 1e-6 && size <= kMaxSize, field, axis,
         "must be finite, its length in [1e-6, 1e6]");
}

void JointChecks::force(const std::string& field, real force, std::string_view unit)
{
    range(field, force, 0, static_cast<double>(kUnlimited),
          "must be in [0, kUnlimited] " + std::string(unit));
}

void JointChecks::factor(const std::string& field, real value, double least, double most,
                         std::string_view unit)
{
    const double size = absolute(static_cast<double>(value));
    that(size >= least && size <= most, field, value, between(least, most, unit) + ", or the same below 0");
}

void JointChecks::turns(const std::string& field, int turns)
{
    range(field, turns, -kMostTurns, kMostTurns, "must be within +-" + textOf(kMostTurns));
}

void JointChecks::limits(const JointUnits& units, const std::optional<JointLimits>& limits)
{
    if (!limits) return;
    const auto isPlace = [&](real place) {
        return absolute(static_cast<double>(place)) <= units.most || absolute(place) == kUnlimited;
    };
    const std::string rule = within(units.most, units.place) + ", or kUnlimited";
    that(isPlace(limits->lower), units.name + "limits.lower", limits->lower, rule)
        .that(isPlace(limits->upper), units.name + "limits.upper", limits->upper, rule)
        .that(limits->lower <= limits->upper, units.name + "limits.lower", limits->lower,
              "must not exceed limits.upper");
}

void JointChecks::motor(const JointUnits& units, const std::optional<JointMotor>& motor)
{
    if (!motor) return;
    range(units.name + "motor.speed", motor->speed, -units.mostSpeed, units.mostSpeed,
          within(units.mostSpeed, units.speed));
    force(units.name + "motor.maxForce", motor->maxForce, units.force);
}

void JointChecks::spring(const std::string& field, const JointSpring& spring, double most,
                         std::string_view unit)
{
    range(field + "frequency", spring.frequency, 0, kMaxFrequency, "must be in [0, 1e6] Hz")
        .range(field + "dampingRatio", spring.dampingRatio, 0, 1e6, "must be in [0, 1e6]")
        .range(field + "rest", spring.rest, -most, most, most > 0 ? within(most, unit) : "must be 0");
}

void JointChecks::spring(const JointUnits& units, const std::optional<JointSpring>& of)
{
    if (of) spring(units.name + "spring.", *of, units.most, units.place);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
