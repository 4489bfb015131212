// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

void prepareCradle(const Parameters& p, WorldDef& def, SceneInfo& info)
{
    def.gravity = {};
    const double balls = p.integer("balls");
    info.seconds = 3;
    info.view = Aabb{{-4, -3}, {balls + 4, 3}};
}

void buildCradle(const Parameters& p, World& world)
{
    // An odd distance, so that the impact falls into the midst of a sub-step.
    constexpr double kRunUp = 1.237;  // [m]
    const double pitch = 1 + restGap(world, 1);
    const int strikers = minimum(p.integer("strikers"), p.integer("balls"));
    for (int i = 0; i < p.integer("balls"); ++i) {
        const bool strikes = i < strikers;
        Body ball = addBody(world, numbered("ball", i + 1).c_str(), BodyType::Dynamic,
                            {i * pitch - (strikes ? kRunUp : 0), 0}, Circle{{}, real(0.5)}, surface(0, 1));
        if (strikes) ball.setLinearVelocity({p.number("speed"), 0});
    }
}

}  // namespace

Builtin cradleScene()
{
    using enum BuiltinParameterType;
    return {{"cradle",
             "Newton's cradle",
             "Balls in a row, struck from the left: as many leave on the right, and the rest stay.",
             {{"balls", Integer, "5", 2, 200, {}, "in all, strikers included"},
              {"strikers", Integer, "1", 1, 100, {}, "how many strike"},
              {"speed", Number, "2", 0, 1000, {}, "of the strikers [m/s]"}}},
            prepareCradle,
            buildCradle};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
