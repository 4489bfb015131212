// SPDX-License-Identifier: MIT
// The keys of the scene format and the members they stand for, once for reading and writing.
// docs/scene.schema.json says the same to other programs; tests/scene keeps the two together.
#pragma once

#include "scene/joint_fields.hpp"

#include <tamias2d/model/defs.hpp>
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
    visit("settlingPasses", &Tuning::settlingPasses);
    visit("restless", &Tuning::restless);
    visit("calmRate", &Tuning::calmRate);
    visit("calmSpeed", &Tuning::calmSpeed);
    visit("quiet", &Tuning::quiet);
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
