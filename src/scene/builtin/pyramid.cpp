// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

constexpr double kSpacing = 1.05;  // from center to center along a row   [m]

void preparePyramid(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double base = p.integer("base");
    info.view = Aabb{{-0.55 * base - 2, -1.5}, {0.55 * base + 2, base + 2}};
}

void buildPyramid(const Parameters& p, World& world)
{
    const int base = p.integer("base");
    const double gap = restGap(world, 1);
    addGround(world, 0, 400, surface(real(0.6)));
    int number = 0;
    for (int row = 0; row < base; ++row) {
        for (int i = 0; i < base - row; ++i) {
            const Position at = {(i - (base - row - 1) / 2.0) * kSpacing, 0.5 + gap + row * (1 + gap)};
            addBody(world, numbered("box", ++number).c_str(), BodyType::Dynamic, at, makeBox(1, 1),
                    surface(real(0.6)));
        }
    }
}

}  // namespace

Builtin pyramidScene()
{
    return {{"pyramid",
             "A pyramid of boxes",
             "Rows of boxes, each row one shorter than the one below.",
             {{"base", BuiltinParameterType::Integer, "20", 1, 150, {}, "boxes in the lowest row"}}},
            preparePyramid,
            buildPyramid};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
