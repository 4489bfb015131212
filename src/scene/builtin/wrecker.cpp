// SPDX-License-Identifier: MIT
#include "scene/builtin/builtins.hpp"
#include "scene/builtin/parts.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

namespace {

constexpr double kLink = 0.8, kThick = 0.15, kBall = 1;  // length and width of a link, radius of the ball [m]
constexpr double kClear = 1.5;  // of the ball from the ground                    [m]

double chainOf(const Parameters& p)
{
    return p.integer("links") * kLink;
}

void prepareWrecker(const Parameters& p, WorldDef&, SceneInfo& info)
{
    const double reach = chainOf(p) + 2 * kBall;
    info.seconds = 10;
    info.view = Aabb{{-reach - 1, -1}, {reach + 3, reach + kClear + 1}};
}

// Level, to the left of its hook.
void hangChain(const Parameters& p, World& world)
{
    const double height = chainOf(p) + kBall + kClear;
    Body last = addBody(world, "hook", BodyType::Static, {0, height}, Circle{{}, real(0.1)}, surface(0));
    last.shapes()[0].setFilter({.group = -1});
    const auto hang = [&](const char* name, double x, const Geometry& geometry, double density, double at) {
        Body body = addBody(world, name, BodyType::Dynamic, {-x, height}, geometry, surface(real(0.5)));
        body.shapes()[0].setFilter({.group = -1});  // they do not touch each other
        body.shapes()[0].setDensity(static_cast<real>(density));
        world.createJoint(revoluteAt(last, body, {-at, height}));
        last = body;
    };
    for (int i = 0; i < p.integer("links"); ++i)
        hang(numbered("link", i + 1).c_str(), (i + 0.5) * kLink,
             makeBox(static_cast<real>(kLink), static_cast<real>(kThick)), 1, i * kLink);
    const double mass = static_cast<double>(p.number("load")) * kLink * kThick;
    hang("ball", chainOf(p) + kBall, Circle{{}, static_cast<real>(kBall)}, mass / (kPi * kBall * kBall),
         chainOf(p));
}

void buildWrecker(const Parameters& p, World& world)
{
    addGround(world, 0, 200, surface(real(0.6)));
    hangChain(p, world);
    const double gap = restGap(world, 1), pitch = 1 + gap;
    for (int column = 0; column < p.integer("columns"); ++column)
        for (int row = 0; row < p.integer("rows"); ++row)
            addBody(world, "brick", BodyType::Dynamic,
                    {kBall + 1.5 + column * pitch, 0.5 + gap + row * pitch}, makeBox(1, 1),
                    surface(real(0.6)));
}

}  // namespace

Builtin wreckerScene()
{
    using enum BuiltinParameterType;
    return {{"wrecker",
             "Wrecking ball",
             "A heavy ball on a chain of light links, released level, swings into a wall.",
             {{"links", Integer, "10", 1, 50, {}, "of the chain"},
              {"load", Number, "500", 1, 10000, {}, "mass of the ball over that of a link [1]"},
              {"rows", Integer, "8", 0, 30, {}, "of the wall"},
              {"columns", Integer, "2", 1, 10, {}, "of the wall"}}},
            prepareWrecker,
            buildWrecker};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
