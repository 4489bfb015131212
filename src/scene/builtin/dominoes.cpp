// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

void prepareDominoes(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double length = p.integer("count") * static_cast<double>(p.number("spacing"));
    info.view = Aabb{{-2, -1.5}, {length + 2, 3}};
}

void buildDominoes(const Parameters& p, World& world)
{
    const int count = p.integer("count");
    const double spacing = static_cast<double>(p.number("spacing"));
    const real width = static_cast<real>(20 + count * spacing);
    addGround(world, count * spacing / 2, width, surface(real(0.6)));
    for (int i = 0; i < count; ++i) {
        const Position at = {i * spacing, 0.5 + restGap(world, 0.2)};
        Body domino = addBody(world, numbered("domino", i + 1).c_str(), BodyType::Dynamic, at,
                              makeBox(real(0.2), 1), surface(real(0.6)));
        // A nudge over its lower right corner.
        if (i == 0) {
            const real push = p.number("push");
            domino.setAngularVelocity(-push);
            domino.setLinearVelocity({push * real(0.5), push * real(0.1)});
        }
    }
}

}  // namespace

Builtin dominoesScene()
{
    using enum BuiltinParameterType;
    return {{"dominoes",
             "Dominoes",
             "A row of dominoes of 0.2 m by 1 m; the first is nudged.",
             {{"count", Integer, "30", 1, 1000, {}, "how many"},
              {"spacing", Number, "0.6", 0.25, 10, {}, "from middle to middle [m]"},
              {"push", Number, "1.5", 0, 10, {}, "how fast the first one turns at the start [rad/s]"}}},
            prepareDominoes,
            buildDominoes};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
