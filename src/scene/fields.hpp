// SPDX-License-Identifier: MIT
// The keys of the scene format and the members they stand for, once for reading and writing.
// docs/scene.schema.json says the same to other programs; tests/scene keeps the two together.
#pragma once

#include <tamias2d/model/defs.hpp>
#include <tamias2d/model/joint_defs.hpp>
#include <tamias2d/scene/scene.hpp>

#include <utility>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// The version of the scene format this reader knows and this writer writes.
inline constexpr int kSceneVersion = 1;

/// Ways in which a body never moves; three members of BodyDef, one key in a scene.
struct Locks {
    bool x = false, y = false, rotation = false;
};

template <class Visit>
void fieldsOf(const Tuning*, Visit visit)
{
    visit("restGap", &Tuning::restGap);
    visit("touchingFactor", &Tuning::touchingFactor);
    visit("pushRate", &Tuning::pushRate);
    visit("pushSpeed", &Tuning::pushSpeed);
    visit("pushSlack", &Tuning::pushSlack);
    visit("extraPasses", &Tuning::extraPasses);
    visit("restless", &Tuning::restless);
    visit("calmRate", &Tuning::calmRate);
    visit("calmSpeed", &Tuning::calmSpeed);
    visit("impactThreshold", &Tuning::impactThreshold);
    visit("crowd", &Tuning::crowd);
    visit("impactsPerContact", &Tuning::impactsPerContact);
    visit("sleepTime", &Tuning::sleepTime);
    visit("sleepSpeed", &Tuning::sleepSpeed);
}

template <class Visit>
void fieldsOf(const WorldDef*, Visit visit)
{
    visit("gravity", &WorldDef::gravity);
    visit("gravitationConstant", &WorldDef::gravitationConstant);
    visit("lengthUnit", &WorldDef::lengthUnit);
    visit("frictionMixing", &WorldDef::frictionMixing);
    visit("restitutionMixing", &WorldDef::restitutionMixing);
    visit("allowSleep", &WorldDef::allowSleep);
    visit("tuning", &WorldDef::tuning);
}

template <class Visit>
void fieldsOf(const MassProperties*, Visit visit)
{
    visit("mass", &MassProperties::mass);
    visit("center", &MassProperties::center);
    visit("inertia", &MassProperties::inertia);
}

template <class Visit>
void fieldsOf(const Locks*, Visit visit)
{
    visit("x", &Locks::x);
    visit("y", &Locks::y);
    visit("rotation", &Locks::rotation);
}

/// All but the locks.
template <class Visit>
void fieldsOf(const BodyDef*, Visit visit)
{
    visit("name", &BodyDef::name);
    visit("type", &BodyDef::type);
    visit("position", &BodyDef::position);
    visit("angle", &BodyDef::angle);
    visit("linearVelocity", &BodyDef::linearVelocity);
    visit("angularVelocity", &BodyDef::angularVelocity);
    visit("mass", &BodyDef::mass);
    visit("linearDamping", &BodyDef::linearDamping);
    visit("angularDamping", &BodyDef::angularDamping);
    visit("gravityScale", &BodyDef::gravityScale);
    visit("gravity", &BodyDef::gravity);
    visit("enabled", &BodyDef::enabled);
    visit("allowSleep", &BodyDef::allowSleep);
    visit("awake", &BodyDef::awake);
    visit("userData", &BodyDef::userData);
}

template <class Visit>
void fieldsOf(const LastingForce*, Visit visit)
{
    visit("force", &LastingForce::force);
    visit("point", &LastingForce::point);
    visit("forceTurns", &LastingForce::forceTurns);
    visit("pointTurns", &LastingForce::pointTurns);
    visit("torque", &LastingForce::torque);
}

template <class Visit>
void fieldsOf(const Material*, Visit visit)
{
    visit("friction", &Material::friction);
    visit("restitution", &Material::restitution);
    visit("rollingResistance", &Material::rollingResistance);
    visit("surfaceSpeed", &Material::surfaceSpeed);
    visit("frictionMixing", &Material::frictionMixing);
    visit("restitutionMixing", &Material::restitutionMixing);
}

template <class Visit>
void fieldsOf(const Filter*, Visit visit)
{
    visit("category", &Filter::category);
    visit("mask", &Filter::mask);
    visit("group", &Filter::group);
}

/// All but the geometry and the material, whose keys stand beside these.
template <class Visit>
void fieldsOf(const ShapeDef*, Visit visit)
{
    visit("offset", &ShapeDef::offset);
    visit("angle", &ShapeDef::angle);
    visit("density", &ShapeDef::density);
    visit("filter", &ShapeDef::filter);
    visit("userData", &ShapeDef::userData);
}

template <class Visit>
void fieldsOf(const Circle*, Visit visit)
{
    visit("center", &Circle::center);
    visit("radius", &Circle::radius);
}

template <class Visit>
void fieldsOf(const Capsule*, Visit visit)
{
    visit("a", &Capsule::a);
    visit("b", &Capsule::b);
    visit("radius", &Capsule::radius);
}

template <class Visit>
void fieldsOf(const Segment*, Visit visit)
{
    visit("a", &Segment::a);
    visit("b", &Segment::b);
    visit("radius", &Segment::radius);
}

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

/// Those of "run"; the rest of a SceneInfo has keys at the top.
template <class Visit>
void fieldsOf(const SceneInfo*, Visit visit)
{
    visit("seconds", &SceneInfo::seconds);
    visit("rate", &SceneInfo::rate);
    visit("substeps", &SceneInfo::substeps);
}

/// Those of "view".
template <class Visit>
void fieldsOf(const Aabb*, Visit visit)
{
    visit("lower", &Aabb::lower);
    visit("upper", &Aabb::upper);
}

/// Types that are objects in a scene.
template <class T>
concept HasFields = requires { fieldsOf(static_cast<const T*>(nullptr), [](const char*, auto) {}); };

inline constexpr std::pair<const char*, MixingRule> kMixingNames[] = {
    {"world", MixingRule::World},
    {"average", MixingRule::Average},
    {"minimum", MixingRule::Minimum},
    {"multiply", MixingRule::Multiply},
    {"geometricMean", MixingRule::GeometricMean},
    {"maximum", MixingRule::Maximum},
};
inline constexpr std::pair<const char*, BodyType> kBodyTypeNames[] = {
    {"static", BodyType::Static},
    {"kinematic", BodyType::Kinematic},
    {"dynamic", BodyType::Dynamic},
};

/// The names of an enumeration's values in a scene.
inline const auto& namesOf(MixingRule)
{
    return kMixingNames;
}
inline const auto& namesOf(BodyType)
{
    return kBodyTypeNames;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
