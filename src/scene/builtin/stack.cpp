// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

void prepareStack(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double height = p.integer("boxes") * static_cast<double>(p.number("size"));
    const double x = static_cast<double>(p.number("x"));
    info.view = Aabb{{x - 0.4 * height - 3, -1.5}, {x + 0.4 * height + 3, height + 2}};
}

void buildStack(const Parameters& p, World& world)
{
    const double size = static_cast<double>(p.number("size"));
    const double gap =
        static_cast<double>(p.numberIfGiven("gap").value_or(static_cast<real>(restGap(world, size))));
    const double offset = static_cast<double>(p.number("offset"));
    const double x = static_cast<double>(p.number("x"));

    addGround(world, x, 100, surface(real(0.6)));
    Draw draw(p.integer("seed"));
    for (int i = 0; i < p.integer("boxes"); ++i) {
        const Position at = {x + offset * draw.next(), size / 2 + gap + i * (size + gap)};
        addBody(world, numbered("box", i + 1).c_str(), BodyType::Dynamic, at,
                makeBox(p.number("size"), p.number("size")), surface(real(0.6)));
    }
}

}  // namespace

Builtin stackScene()
{
    using enum BuiltinParameterType;
    return {{"stack",
             "A stack of boxes",
             "Square boxes one upon the other, which should stay so.",
             {{"boxes", Integer, "10", 1, 1000, {}, "how many"},
              {"size", Number, "1", 1e-3, 100, {}, "side of a box [m]"},
              {"gap", Number, "auto", 0, 10, {}, "between neighbours [m]; auto: the rest gap"},
              {"offset", Number, "0", 0, 10, {}, "furthest random shift to a side [m]"},
              {"seed", Integer, "1", 0, 1e9, {}, "of the shifts"},
              {"x", Number, "0", -1e8, 1e8, {}, "where the stack stands [m]"}}},
            prepareStack,
            buildStack};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
