// SPDX-License-Identifier: MIT
// TRACES("ADR2", "ADR20")
// Lets a ball fall in both precisions within one program and compares the two.

#include <tamias2d/tamias2d.hpp>

#include <cmath>
#include <cstdio>

double heightInDouble(int steps);

int main()
{
    using namespace tamias2d;
    static_assert(sizeof(real) == 4);

    World world;
    Body ball = world.createBody({.position = {0, 100}, .linearVelocity = {0, 0.1f}});
    ball.createShape({.geometry = Circle{.radius = 0.3f}});
    const int steps = 120;
    for (int i = 0; i < steps; ++i) world.step();

    const double inFloat = ball.position().y;
    const double inDouble = heightInDouble(steps);
    const double exact = 100 + 0.1 * 2 - 9.81 * 2 * 2 / 2;  // [m]
    std::printf("float %.9f m, double %.9f m, closed form %.9f m\n", inFloat, inDouble, exact);
    const bool right = std::fabs(inFloat - exact) < 1e-4 && std::fabs(inDouble - exact) < 1e-10;
    const bool different = inFloat != inDouble;
    return right && different ? 0 : 1;
}
