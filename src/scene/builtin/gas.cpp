// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

/// Bodies start on a grid of 1 m, a box larger than any of them.
int gridSide(const Parameters& p)
{
    const int count = p.integer("discs") + p.integer("boxes");
    int side = 1;
    while (side * side < count) ++side;
    return side;
}

void prepareGas(const Parameters& p, WorldDef& def, SceneInfo& info)
{
    def.gravity = {};
    const double half = gridSide(p) / 2.0;
    info.view = Aabb{{-half - 1, -half - 1}, {half + 1, half + 1}};
    info.seconds = 20;
}

void addWalls(World& world, real side, const Material& material)
{
    const double middle = static_cast<double>(side) / 2 + 1;
    const Polygon flat = makeBox(side + 4, 2);
    const Polygon upright = makeBox(2, side);
    addBody(world, "floor", BodyType::Static, {0, -middle}, flat, material);
    addBody(world, "ceiling", BodyType::Static, {0, middle}, flat, material);
    addBody(world, "left wall", BodyType::Static, {-middle, 0}, upright, material);
    addBody(world, "right wall", BodyType::Static, {middle, 0}, upright, material);
}

void buildGas(const Parameters& p, World& world)
{
    const Material elastic = surface(0, 1);
    const int side = gridSide(p);
    const int discs = p.integer("discs");
    const real speed = p.number("speed");
    addWalls(world, static_cast<real>(side), elastic);

    Draw draw(p.integer("seed"));
    for (int i = 0; i < discs + p.integer("boxes"); ++i) {
        const bool isDisc = i < discs;
        const Position at = {i % side - (side - 1) / 2.0, i / side - (side - 1) / 2.0};
        const Geometry geometry =
            isDisc ? Geometry(Circle{{}, real(0.25)}) : Geometry(makeBox(real(0.6), real(0.4)));
        const std::string name = isDisc ? numbered("disc", i + 1) : numbered("box", i - discs + 1);
        Body body = addBody(world, name.c_str(), BodyType::Dynamic, at, geometry, elastic);
        const real vx = speed * static_cast<real>(draw.next());
        const real vy = speed * static_cast<real>(draw.next());
        const real spin = speed * static_cast<real>(draw.next());
        body.setLinearVelocity({vx, vy});
        if (!isDisc) body.setAngularVelocity(spin);
    }
}

}  // namespace

Builtin gasScene()
{
    using enum BuiltinParameterType;
    return {
        {"gas",
         "A gas in a box",
         "Discs and boxes that bounce without loss or friction, between four walls, without gravity.",
         {{"discs", Integer, "100", 0, 10000, {}, "how many, of radius 0.25 m"},
          {"boxes", Integer, "50", 0, 10000, {}, "how many, of 0.6 m by 0.4 m"},
          {"speed", Number, "3", 0, 1000, {}, "fastest along each axis [m/s]; as a number, of spins [rad/s]"},
          {"seed", Integer, "7", 0, 1e9, {}, "of the velocities"}}},
        prepareGas,
        buildGas};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
