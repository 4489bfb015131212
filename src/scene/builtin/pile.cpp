// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

constexpr int kColumns = 8;  // of bodies side by side at the start

/// High enough to hold all bodies where they start, twice over.   [m]
double wallHeight(const Parameters& p)
{
    return 10 + 2.4 * (p.integer("count") / kColumns);
}

void preparePile(const Parameters& p, WorldDef&, SceneInfo& info)
{
    info.seconds = 20;
    info.view = Aabb{{-7, -1.5}, {7, minimum(wallHeight(p), 18.0)}};
}

void buildPile(const Parameters& p, World& world)
{
    const Material material = surface(p.number("friction"), p.number("restitution"));
    const std::string kinds = p.choice("shapes");
    const double height = wallHeight(p);
    addBody(world, "floor", BodyType::Static, {0, -1}, makeBox(16, 2), material);
    const Polygon wall = makeBox(2, static_cast<real>(height));
    addBody(world, "left wall", BodyType::Static, {-6, height / 2 - 1}, wall, material);
    addBody(world, "right wall", BodyType::Static, {6, height / 2 - 1}, wall, material);

    Draw draw(p.integer("seed"));
    for (int i = 0; i < p.integer("count"); ++i) {
        const real half = static_cast<real>(0.3 + 0.1 * draw.next());
        const double x = (i % kColumns - (kColumns - 1) / 2.0) * 1.1 + 0.1 * draw.next();
        const Position at = {x, 1 + (i / kColumns) * 1.2};
        const double angle = draw.next();
        const bool isDisc = kinds == "discs" || (kinds == "mixed" && i % 3 == 0);
        const Geometry geometry =
            isDisc ? Geometry(Circle{{}, half}) : Geometry(makeBox(2 * half, real(1.4) * half));
        addBody(world, numbered(isDisc ? "disc" : "box", i + 1).c_str(), BodyType::Dynamic, at, geometry,
                material, angle);
    }
}

}  // namespace

Builtin pileScene()
{
    using enum BuiltinParameterType;
    return {{"pile",
             "A pile in a bin",
             "Bodies of mixed sizes fall into a bin and come to rest.",
             {{"count", Integer, "100", 1, 5000, {}, "how many bodies"},
              {"shapes", Choice, "boxes", 0, 0, {"boxes", "discs", "mixed"}, "what they are"},
              {"restitution", Number, "0", 0, 1, {}, "C_R of everything [1]"},
              {"friction", Number, "0.5", 0, 10, {}, "of everything [1]"},
              {"seed", Integer, "1", 0, 1e9, {}, "of sizes, places and angles"}}},
            preparePile,
            buildPile};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
