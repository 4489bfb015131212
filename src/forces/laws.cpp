// SPDX-License-Identifier: MIT
// The force laws that come with the library. Each is a formula of its arguments alone, so a scene
// file can write it down and read it back.

#include <tamias2d/forces/force_law.hpp>

#include "base/check.hpp"

#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

struct Parameter {
    std::string_view name;
    std::string json;
};

Parameter number(std::string_view name, double value)
{
    return {name, textOf(value)};
}
Parameter place(std::string_view name, Position p)
{
    return {name, "[" + textOf(p.x) + "," + textOf(p.y) + "]"};
}

// All numbers were checked to be finite, and JSON writes those as C++ does.
std::string jsonOf(std::string_view law, std::initializer_list<Parameter> parameters)
{
    std::string text = "{\"law\":\"" + std::string(law) + '"';
    for (const Parameter& p : parameters) text += ",\"" + std::string(p.name) + "\":" + p.json;
    return text + "}";
}

Complaint checkCoefficient(std::string_view field, double value, std::string_view unit)
{
    if (value >= 0 && value <= kAnyFinite) return std::nullopt;
    return InputError(std::string(field), textOf(value), "must be finite and >= 0 " + std::string(unit));
}

}  // namespace

ForceLaw springTo(Position point, double stiffness, double damping)
{
    if (Checks()
            .finite("springTo.point", point)
            .add(checkCoefficient("springTo.stiffness", stiffness, "N/m"))
            .add(checkCoefficient("springTo.damping", damping, "N*s/m"))
            .refuse())
        return {};
    ForceLaw law;
    law.name = "springTo";
    law.force = [=](const BodyView& body, double) -> Wrench {
        return {-stiffness * (body.center - point) - damping * body.velocity, 0};
    };
    law.potential = [=](const BodyView& body, double) {
        const DVec2 stretch = body.center - point;
        return stiffness / 2 * dot(stretch, stretch);
    };
    law.parameters =
        jsonOf(law.name, {place("point", point), number("stiffness", stiffness), number("damping", damping)});
    return law;
}

ForceLaw attractionTo(Position point, double mu, double softening)
{
    if (Checks()
            .finite("attractionTo.point", point)
            .finite("attractionTo.mu", mu)
            .add(checkCoefficient("attractionTo.softening", softening, "m"))
            .refuse())
        return {};
    // As if the point stood `softening` behind the plane: the distance is never shorter than that.
    const auto distance = [=](const BodyView& body) {
        const DVec2 d = body.center - point;
        return std::sqrt(dot(d, d) + softening * softening);
    };
    ForceLaw law;
    law.name = "attractionTo";
    law.force = [=](const BodyView& body, double) -> Wrench {
        const double r = distance(body);
        if (r == 0) return {};  // right on the point no direction is the right one
        return {(-mu * body.mass / (r * r * r)) * (body.center - point), 0};
    };
    law.potential = [=](const BodyView& body, double) {
        const double r = distance(body);
        return r == 0 ? 0.0 : -mu * body.mass / r;
    };
    law.parameters =
        jsonOf(law.name, {place("point", point), number("mu", mu), number("softening", softening)});
    return law;
}

ForceLaw drag(double linear, double quadratic)
{
    if (Checks()
            .add(checkCoefficient("drag.linear", linear, "N*s/m"))
            .add(checkCoefficient("drag.quadratic", quadratic, "N*s^2/m^2"))
            .refuse())
        return {};
    ForceLaw law;
    law.name = "drag";
    law.force = [=](const BodyView& body, double) -> Wrench {
        return {-(linear + quadratic * length(body.velocity)) * body.velocity, 0};
    };
    law.parameters = jsonOf(law.name, {number("linear", linear), number("quadratic", quadratic)});
    return law;
}

ForceLaw torsionSpring(double angle, double stiffness, double damping)
{
    if (Checks()
            .finite("torsionSpring.angle", angle)
            .add(checkCoefficient("torsionSpring.stiffness", stiffness, "N*m/rad"))
            .add(checkCoefficient("torsionSpring.damping", damping, "N*m*s/rad"))
            .refuse())
        return {};
    // The short way round: in [-pi, pi).
    const double rest = wrapAngle(angle);
    const auto twist = [=](const BodyView& body) { return wrapAngle(body.angle - rest + kPi) - kPi; };
    ForceLaw law;
    law.name = "torsionSpring";
    law.force = [=](const BodyView& body, double) -> Wrench {
        return {{}, -stiffness * twist(body) - damping * body.spin};
    };
    law.potential = [=](const BodyView& body, double) {
        const double phi = twist(body);
        return stiffness / 2 * phi * phi;
    };
    law.parameters = jsonOf(
        law.name, {number("angle", angle), number("stiffness", stiffness), number("damping", damping)});
    return law;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
