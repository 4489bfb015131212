// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

constexpr double kAxis = 10;             // half the long axis of the relative orbit   [m]
constexpr double kHeavy = 2, kLight = 1;  // masses   [kg]

/// Chosen so that one turn takes `period` (Kepler's third law).   [m^3/(kg*s^2)]
double gravitationFor(double period)
{
    return 4 * kPi * kPi * kAxis * kAxis * kAxis / (period * period * (kHeavy + kLight));
}

void prepareOrbit(const Parameters& p, WorldDef& def, SceneInfo& info)
{
    const double period = static_cast<double>(p.number("period"));
    def.gravity = {};
    def.gravitationConstant = static_cast<real>(gravitationFor(period));
    info.seconds = 3 * period;
    info.view = Aabb{{-15, -10}, {10, 10}};
}

void buildOrbit(const Parameters& p, World& world)
{
    const double eccentricity = static_cast<double>(p.number("eccentricity"));
    const double total = kHeavy + kLight;
    // Both start where they are nearest, at right angles to the line between them (vis-viva).
    const double distance = kAxis * (1 - eccentricity);
    const double g = static_cast<double>(world.definition().gravitationConstant);
    const double speed = std::sqrt(g * total * (1 + eccentricity) / distance);
    const auto add = [&](const char* name, double mass, double share) {
        Body body = addBody(world, name, BodyType::Dynamic, {share * distance, 0}, Circle{{}, real(0.2)},
                            surface(0, 1));
        body.setMass({static_cast<real>(mass), {}, static_cast<real>(mass * 0.02)});
        body.setLinearVelocity({0, static_cast<real>(share * speed)});
    };
    add("heavy", kHeavy, -kLight / total);
    add("light", kLight, kHeavy / total);
}

}  // namespace

Builtin orbitScene()
{
    using enum BuiltinParameterType;
    return {{"orbit",
             "Two bodies in orbit",
             "Two bodies that attract each other by universal gravitation circle their common center.",
             {{"eccentricity", Number, "0.5", 0, 0.9, {}, "0 is a circle [1]"},
              {"period", Number, "5", 0.1, 1e4, {}, "of one turn [s]"}}},
            prepareOrbit,
            buildOrbit};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
