// SPDX-License-Identifier: MIT
#include "scene/laws_text.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

ForceLaw readSpringTo(ObjectReader& in)
{
    Position point;
    double stiffness = 0, damping = 0;
    in.require("point", point);
    in.require("stiffness", stiffness);
    in.read("damping", damping);
    return springTo(point, stiffness, damping);
}

ForceLaw readAttractionTo(ObjectReader& in)
{
    Position point;
    double mu = 0, softening = 0;
    in.require("point", point);
    in.require("mu", mu);
    in.read("softening", softening);
    return attractionTo(point, mu, softening);
}

ForceLaw readDrag(ObjectReader& in)
{
    double linear = 0, quadratic = 0;
    in.require("linear", linear);
    in.read("quadratic", quadratic);
    return drag(linear, quadratic);
}

ForceLaw readTorsionSpring(ObjectReader& in)
{
    double angle = 0, stiffness = 0, damping = 0;
    in.require("angle", angle);
    in.require("stiffness", stiffness);
    in.read("damping", damping);
    return torsionSpring(angle, stiffness, damping);
}

constexpr struct {
    const char* name;
    ForceLaw (*read)(ObjectReader&);
} kLaws[] = {
    {"springTo", readSpringTo},
    {"attractionTo", readAttractionTo},
    {"drag", readDrag},
    {"torsionSpring", readTorsionSpring},
};

}  // namespace

ForceLaw readLaw(ObjectReader& in, const std::vector<ForceLaw>& registry)
{
    std::string name;
    in.require("law", name);
    std::vector<std::string> known;
    for (const auto& law : kLaws) {
        known.emplace_back(law.name);
        if (name != law.name) continue;
        try {
            return law.read(in);
        } catch (const SceneError&) {
            throw;
        } catch (const InputError& error) {
            in.node().refuse(error);
        }
    }
    for (const ForceLaw& law : registry) {
        known.push_back(law.name);
        if (name == law.name) return law;
    }
    in.node().child("law").refuse("no law of this name is built in or was given to the reader" +
                                  suggestion(name, known));
}

OrderedJson lawJson(const ForceLaw& law)
{
    OrderedJson out = {{"law", law.name}};
    if (law.parameters.empty()) return out;
    const OrderedJson parameters = OrderedJson::parse(law.parameters, nullptr, false);
    for (const auto& item : parameters.items()) out[item.key()] = item.value();
    return out;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
