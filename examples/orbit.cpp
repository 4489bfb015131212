// SPDX-License-Identifier: MIT
// Universal gravitation in double precision: a planet and its moon, once around. This program links
// tamias2d_f64, so `real` is double.
#include <tamias2d/tamias2d.hpp>

#include <cmath>
#include <cstdio>

int main()
{
    using namespace tamias2d;
    World world({.gravity = {0, 0}, .gravitationConstant = 1});
    Body planet = world.createBody({.mass = MassProperties{.mass = 1000, .inertia = 1}});
    Body moon = world.createBody({.position = {100, 0}, .mass = MassProperties{.mass = 1, .inertia = 1}});

    // A circle about the common center of mass: both turn at sqrt(G (M + m) / d^3).
    const double omega = std::sqrt(1001.0 / 1e6);  // [rad/s]
    moon.setLinearVelocity({0, omega * 100 * 1000 / 1001});
    planet.setLinearVelocity({0, -omega * 100 / 1001});
    const double energy = world.energy().total();

    const int steps = 4000;
    for (int i = 0; i <= steps; ++i) {
        if (i % 1000 == 0) {
            const DVec2 d = moon.centerOfMass() - planet.centerOfMass();
            std::printf("%3.0f %% of a turn: (%.3f, %.3f) m\n", 100.0 * i / steps, d.x, d.y);
        }
        world.step(kTwoPi / omega / steps);
    }
    std::printf("energy changed by %.1e of itself\n", std::fabs(world.energy().total() / energy - 1));
}
