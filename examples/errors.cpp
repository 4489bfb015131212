// SPDX-License-Identifier: MIT
// Wrong input is refused with its field, its value and the rule, and nothing has changed.
#include <tamias2d/tamias2d.hpp>

#include <cstdio>
#include <limits>

int main()
{
    using namespace tamias2d;
    World world;
    Body ball = world.createBody();
    ball.createShape({.geometry = Circle{}});
    const auto before = world.stateHash();

    const auto attempt = [](const char* what, auto&& call) {
        try {
            call();
        } catch (const InputError& error) {
            std::printf("%s\n    refused: %s\n", what, error.what());
        }
    };
    attempt("a restitution of 1.1",
            [&] { ball.createShape({.geometry = Circle{}, .material = {.restitution = 1.1f}}); });
    attempt("a velocity that is no number",
            [&] { ball.setLinearVelocity({std::numeric_limits<real>::quiet_NaN(), 0}); });
    attempt("a polygon of three points on one line", [&] {
        const Vec2 line[] = {{0, 0}, {1, 1}, {2, 2}};
        ball.createShape({.geometry = makePolygon(line)});
    });
    attempt("a body that is gone", [&] {
        Body ghost = world.createBody();
        ghost.destroy();
        ghost.applyForceToCenter({1, 0});
    });
    std::printf("the ball is %s\n", before == world.stateHash() ? "as it was" : "changed");
    return before == world.stateHash() ? 0 : 1;
}
