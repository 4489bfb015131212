// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

double slope(const Parameters& p)
{
    return static_cast<double>(p.number("degrees")) * kPi / 180;
}

void prepareIncline(const Parameters&, WorldDef&, SceneInfo& info)
{
    info.seconds = 5;
    info.view = Aabb{{-30, -20}, {10, 10}};
}

void buildIncline(const Parameters& p, World& world)
{
    const double angle = slope(p);
    const SinCos turn = sinCos(angle);
    const Material material = surface(p.number("friction"));
    const auto uphill = [&](double along, double out) {
        return Position{along * turn.cos - out * turn.sin, along * turn.sin + out * turn.cos};
    };
    addBody(world, "slope", BodyType::Static, uphill(0, -0.5), makeBox(1000, 1), material, angle);
    const bool isDisc = p.choice("body") == "disc";
    const Geometry geometry = isDisc ? Geometry(Circle{{}, real(0.5)}) : Geometry(makeBox(1, 1));
    addBody(world, isDisc ? "disc" : "box", BodyType::Dynamic, uphill(0, 0.5 + restGap(world, 1)), geometry,
            material, angle);
}

}  // namespace

Builtin inclineScene()
{
    using enum BuiltinParameterType;
    return {{"incline",
             "Down a slope",
             "A box that slides or sticks, or a disc that rolls, on a slope that falls to the left.",
             {{"degrees", Number, "30", 0, 80, {}, "of the slope [degrees]"},
              {"friction", Number, "0.3", 0, 10, {}, "of both [1]"},
              {"body", Choice, "box", 0, 0, {"box", "disc"}, "what is on it"}}},
            prepareIncline,
            buildIncline};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
