// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

#include <algorithm>
#include <limits>

namespace tamias2d::bench {

/// Limits and motor of a hinge, for the definition of either Box2D: the fields have the same names in both.
template <class Def>
void setLimitsAndMotor(const SceneJoint& joint, Def& def)
{
    if (const auto& l = joint.limits) {
        def.enableLimit = true;
        def.lowerAngle = static_cast<float>(l->lower);
        def.upperAngle = static_cast<float>(l->upper);
    }
    if (const auto& m = joint.motor) {
        def.enableMotor = true;
        def.motorSpeed = static_cast<float>(m->speed);
        def.maxMotorTorque =
            static_cast<float>(std::min<double>(m->maxTorque, std::numeric_limits<float>::max()));
    }
}

}  // namespace tamias2d::bench
