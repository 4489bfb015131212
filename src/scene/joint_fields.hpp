// SPDX-License-Identifier: MIT
// The keys of joints, and the members they stand for: a part of scene/fields.hpp.
#pragma once

#include <tamias2d/model/joint_defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

template <class Visit>
void fieldsOf(const JointLimits*, Visit visit)
{
    visit("lower", &JointLimits::lower);
    visit("upper", &JointLimits::upper);
}

template <class Visit>
void fieldsOf(const JointMotor*, Visit visit)
{
    visit("speed", &JointMotor::speed);
    visit("maxForce", &JointMotor::maxForce);
}

template <class Visit>
void fieldsOf(const JointSpring*, Visit visit)
{
    visit("frequency", &JointSpring::frequency);
    visit("dampingRatio", &JointSpring::dampingRatio);
    visit("rest", &JointSpring::rest);
}

template <class Visit>
void fieldsOf(const RevoluteJoint*, Visit visit)
{
    visit("anchorA", &RevoluteJoint::anchorA);
    visit("anchorB", &RevoluteJoint::anchorB);
    visit("referenceAngle", &RevoluteJoint::referenceAngle);
    visit("limits", &RevoluteJoint::limits);
    visit("motor", &RevoluteJoint::motor);
    visit("spring", &RevoluteJoint::spring);
    visit("turns", &RevoluteJoint::turns);
}

template <class Visit>
void fieldsOf(const DistanceJoint*, Visit visit)
{
    visit("anchorA", &DistanceJoint::anchorA);
    visit("anchorB", &DistanceJoint::anchorB);
    visit("length", &DistanceJoint::length);
    visit("limits", &DistanceJoint::limits);
    visit("motor", &DistanceJoint::motor);
    visit("spring", &DistanceJoint::spring);
}

template <class Visit>
void fieldsOf(const PrismaticJoint*, Visit visit)
{
    visit("anchorA", &PrismaticJoint::anchorA);
    visit("anchorB", &PrismaticJoint::anchorB);
    visit("axis", &PrismaticJoint::axis);
    visit("referenceAngle", &PrismaticJoint::referenceAngle);
    visit("limits", &PrismaticJoint::limits);
    visit("motor", &PrismaticJoint::motor);
    visit("spring", &PrismaticJoint::spring);
}

template <class Visit>
void fieldsOf(const WeldJoint*, Visit visit)
{
    visit("anchorA", &WeldJoint::anchorA);
    visit("anchorB", &WeldJoint::anchorB);
    visit("referenceAngle", &WeldJoint::referenceAngle);
    visit("linear", &WeldJoint::linear);
    visit("angular", &WeldJoint::angular);
}

template <class Visit>
void fieldsOf(const TargetJoint*, Visit visit)
{
    visit("anchor", &TargetJoint::anchor);
    visit("target", &TargetJoint::target);
    visit("angle", &TargetJoint::angle);
    visit("frequency", &TargetJoint::frequency);
    visit("dampingRatio", &TargetJoint::dampingRatio);
    visit("maxForce", &TargetJoint::maxForce);
    visit("maxTorque", &TargetJoint::maxTorque);
}

template <class Visit>
void fieldsOf(const WheelJoint*, Visit visit)
{
    visit("anchorA", &WheelJoint::anchorA);
    visit("anchorB", &WheelJoint::anchorB);
    visit("axis", &WheelJoint::axis);
    visit("limits", &WheelJoint::limits);
    visit("motor", &WheelJoint::motor);
    visit("spring", &WheelJoint::spring);
}

template <class Visit>
void fieldsOf(const GrooveJoint*, Visit visit)
{
    visit("start", &GrooveJoint::start);
    visit("end", &GrooveJoint::end);
    visit("anchorB", &GrooveJoint::anchorB);
}

template <class Visit>
void fieldsOf(const RotaryJoint*, Visit visit)
{
    visit("referenceAngle", &RotaryJoint::referenceAngle);
    visit("limits", &RotaryJoint::limits);
    visit("motor", &RotaryJoint::motor);
    visit("spring", &RotaryJoint::spring);
    visit("turns", &RotaryJoint::turns);
}

template <class Visit>
void fieldsOf(const RatchetJoint*, Visit visit)
{
    visit("referenceAngle", &RatchetJoint::referenceAngle);
    visit("tooth", &RatchetJoint::tooth);
}

template <class Visit>
void fieldsOf(const GearJoint*, Visit visit)
{
    visit("ratio", &GearJoint::ratio);
    visit("phase", &GearJoint::phase);
}

template <class Visit>
void fieldsOf(const RackJoint*, Visit visit)
{
    visit("anchorA", &RackJoint::anchorA);
    visit("anchorB", &RackJoint::anchorB);
    visit("axis", &RackJoint::axis);
    visit("radius", &RackJoint::radius);
    visit("offset", &RackJoint::offset);
}

template <class Visit>
void fieldsOf(const PulleyJoint*, Visit visit)
{
    visit("anchorA", &PulleyJoint::anchorA);
    visit("anchorB", &PulleyJoint::anchorB);
    visit("wheelA", &PulleyJoint::wheelA);
    visit("wheelB", &PulleyJoint::wheelB);
    visit("ratio", &PulleyJoint::ratio);
    visit("length", &PulleyJoint::length);
    visit("taut", &PulleyJoint::taut);
    visit("stopA", &PulleyJoint::stopA);
    visit("stopB", &PulleyJoint::stopB);
}

template <class Visit>
void fieldsOf(const MotorJoint*, Visit visit)
{
    visit("anchorA", &MotorJoint::anchorA);
    visit("anchorB", &MotorJoint::anchorB);
    visit("referenceAngle", &MotorJoint::referenceAngle);
    visit("linear", &MotorJoint::linear);
    visit("angular", &MotorJoint::angular);
    visit("velocity", &MotorJoint::velocity);
    visit("spin", &MotorJoint::spin);
    visit("maxForce", &MotorJoint::maxForce);
    visit("maxTorque", &MotorJoint::maxTorque);
}

template <class Visit>
void fieldsOf(const FrictionJoint*, Visit visit)
{
    visit("anchor", &FrictionJoint::anchor);
    visit("maxForce", &FrictionJoint::maxForce);
    visit("maxTorque", &FrictionJoint::maxTorque);
}

template <class Visit>
void fieldsOf(const FilterJoint*, Visit)
{
}

template <class Visit>
void fieldsOf(const JointBreaking*, Visit visit)
{
    visit("force", &JointBreaking::force);
    visit("torque", &JointBreaking::torque);
    visit("error", &JointBreaking::error);
    visit("window", &JointBreaking::window);
}

/// All but the bodies and the kind.
template <class Visit>
void fieldsOf(const JointDef*, Visit visit)
{
    visit("name", &JointDef::name);
    visit("collideConnected", &JointDef::collideConnected);
    visit("enabled", &JointDef::enabled);
    visit("breaking", &JointDef::breaking);
    visit("userData", &JointDef::userData);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
