// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

void prepareBounce(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double height = static_cast<double>(p.number("height"));
    info.view = Aabb{{-height / 2 - 2, -1.5}, {height / 2 + 2, height + 2}};
}

void buildBounce(const Parameters& p, World& world)
{
    const Material material = surface(0, p.number("restitution"));
    addGround(world, 0, 100, material);
    // The height is what the ball falls through until it touches.
    const double y = static_cast<double>(p.number("height")) + 0.5 + restGap(world, 1);
    addBody(world, "ball", BodyType::Dynamic, {0, y}, Circle{{}, real(0.5)}, material);
}

}  // namespace

Builtin bounceScene()
{
    using enum BuiltinParameterType;
    return {{"bounce",
             "A bouncing ball",
             "A ball of radius 0.5 m falls and bounces: to C_R^2 of the height, and on.",
             {{"height", Number, "5", 0, 1000, {}, "it falls through [m]"},
              {"restitution", Number, "0.8", 0, 1, {}, "C_R [1]"}}},
            prepareBounce,
            buildBounce};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
