// SPDX-License-Identifier: MIT
// The rules of what joints are made of: anchors, angles, limits, motors, springs [R4].
#pragma once

#include "base/check.hpp"

#include <tamias2d/model/joint_defs.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How the numbers of a kind are called and bounded.
struct JointUnits {
    std::string name;         // "RevoluteJoint."
    double most;              // of a place   [m] or [rad]
    double mostSpeed;         // [m/s] or [rad/s]
    std::string_view place, speed, force;
};

JointUnits turningUnits(std::string name);
JointUnits slidingUnits(std::string name, real lengthUnit);

/// The first complaint of several about the parts of a joint.
class JointChecks : public Checks {
public:
    static constexpr double kMaxFrequency = 1e6;  // [Hz]

    static std::string within(double most, std::string_view unit);
    static std::string between(double least, double most, std::string_view unit);

    void anchor(const std::string& field, Vec2 anchor, real lengthUnit);
    template <class Kind>
    void anchors(const std::string& name, const Kind& k, real lengthUnit)
    {
        anchor(name + "anchorA", k.anchorA, lengthUnit);
        anchor(name + "anchorB", k.anchorB, lengthUnit);
    }
    void angle(const std::string& field, double angle);
    void axis(const std::string& field, Vec2 axis);
    void force(const std::string& field, real force, std::string_view unit);
    /// A ratio or step: neither nothing nor beyond measure, either way.
    void factor(const std::string& field, real value, double least, double most, std::string_view unit);
    void turns(const std::string& field, int turns);

    void limits(const JointUnits& units, const std::optional<JointLimits>& limits);
    void motor(const JointUnits& units, const std::optional<JointMotor>& motor);
    void spring(const JointUnits& units, const std::optional<JointSpring>& of);
    void spring(const std::string& field, const JointSpring& spring, double most, std::string_view unit);
    /// What may stand at a kind's free coordinate.
    template <class Kind>
    void freeCoordinate(const JointUnits& units, const Kind& k)
    {
        limits(units, k.limits);
        motor(units, k.motor);
        spring(units, k.spring);
    }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
