// SPDX-License-Identifier: MIT
// A floor of separate tiles, flush with each other: the seams must not be felt.
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

constexpr double kStart = 2;  // of the glider's center   [m]

struct Glider {
    Geometry geometry;
    double height;  ///< of the center above its lowest point   [m]
    double width;   ///< smallest                               [m]
    bool rolls = false;
};

Glider gliderOf(const std::string& name)
{
    if (name == "roundedBox") return {makeBox(real(0.8), real(0.8), real(0.1)), 0.5, 1};
    if (name == "capsule") return {Capsule{{real(-0.5), 0}, {real(0.5), 0}, real(0.25)}, 0.25, 0.5};
    if (name == "circle") return {Circle{{}, real(0.5)}, 0.5, 1};
    if (name == "disc") return {Circle{{}, real(0.5)}, 0.5, 1, true};
    if (name == "hexagon") {
        // It lies on a flat side.
        const Polygon hexagon = makeRegularPolygon(6, real(0.5));
        double lowest = 0;
        for (const Vec2 corner : hexagon.points()) lowest = minimum(lowest, static_cast<double>(corner.y));
        return {hexagon, -lowest, -2 * lowest};
    }
    return {makeBox(1, 1), 0.5, 1};
}

void prepareTiles(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double speed = maximum(static_cast<double>(p.number("speed")), 0.1);
    info.seconds = minimum(1.2 * p.integer("count") / speed, 600.0);
    info.view = Aabb{{-1, -3}, {minimum(p.integer("count") + 1.0, 60.0), 6}};
}

/// The tiles, as one body or a body each.
void addTiles(const Parameters& p, World& world, const Material& material)
{
    const double jitter = static_cast<double>(p.number("jitter"));
    const double step = static_cast<double>(p.number("step"));
    const int count = p.integer("count");
    Draw draw(p.integer("seed"));
    BodyDef def;
    def.type = BodyType::Static;
    def.name = "floor";
    Body floor;
    for (int i = 0; i < count; ++i) {
        // Each its own gap, or overlap, and height; the second half lies one step higher.
        const double x = i + jitter * draw.next();
        const double top = jitter * draw.next() + (2 * i >= count ? step : 0);
        ShapeDef shape;
        shape.material = material;
        shape.geometry = makeBox(1, 1);
        if (p.isOn("asSegments"))
            shape.geometry = Segment{{real(-0.5), real(0.5)}, {real(0.5), real(0.5)}, 0};
        if (p.isOn("separateBodies")) {
            def.name = numbered("tile", i + 1);
            def.position = {x, top - 0.5};
            world.createBody(def).createShape(shape);
        } else {
            if (i == 0) floor = world.createBody(def);
            shape.offset = {static_cast<real>(x), static_cast<real>(top - 0.5)};
            floor.createShape(shape);
        }
    }
}

void buildTiles(const Parameters& p, World& world)
{
    const Glider glider = gliderOf(p.choice("body"));
    // What glides meets no friction; what rolls needs it to go on rolling.
    const Material material = surface(glider.rolls ? real(0.6) : 0);
    addTiles(p, world, material);
    if (p.isOn("wall")) {
        addBody(world, "wall", BodyType::Static, {static_cast<double>(p.integer("count")), 2}, makeBox(1, 4),
                material);
    }
    const double gap = restGap(world, minimum(glider.width, 1.0));
    Body body =
        addBody(world, "glider", BodyType::Dynamic, {kStart, glider.height + gap}, glider.geometry, material);
    const real speed = p.number("speed");
    body.setLinearVelocity({speed, 0});
    if (glider.rolls) body.setAngularVelocity(-speed / static_cast<real>(glider.height));
}

}  // namespace

Builtin tilesScene()
{
    using enum BuiltinParameterType;
    return {{"tiles",
             "Over the tiles",
             "A body glides over a floor of separate flush tiles of 1 m to a wall.",
             {{"count", Integer, "200", 4, 10000, {}, "how many tiles"},
              {"body",
               Choice,
               "box",
               0,
               0,
               {"box", "roundedBox", "capsule", "circle", "hexagon", "disc"},
               "what glides; a disc rolls, with friction 0.6"},
              {"speed", Number, "5", -1000, 1000, {}, "at the start [m/s]"},
              {"asSegments", Switch, "false", 0, 0, {}, "tiles are segments, not boxes"},
              {"separateBodies", Switch, "true", 0, 0, {}, "each tile is a body of its own"},
              {"jitter", Number, "0", 0, 0.1, {}, "largest random shift of a tile, both ways [m]"},
              {"step", Number, "0", -0.9, 0.9, {}, "how much higher the second half lies [m]"},
              {"wall", Switch, "true", 0, 0, {}, "a wall stands at the end"},
              {"seed", Integer, "3", 0, 1e9, {}, "of the shifts"}}},
            prepareTiles,
            buildTiles};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
