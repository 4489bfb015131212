// SPDX-License-Identifier: MIT
#include <tamias2d/tamias2d.hpp>

double heightInDouble(int steps)
{
    using namespace tamias2d;
    static_assert(sizeof(real) == 8);

    World world;
    Body ball = world.createBody({.position = {0, 100}, .linearVelocity = {0, 0.1}});
    ball.createShape({.geometry = Circle{.radius = 0.3}});
    for (int i = 0; i < steps; ++i) world.step();
    return ball.position().y;
}
