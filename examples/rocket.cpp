// SPDX-License-Identifier: MIT
// Forces: a thrust that turns with the body, drag as a force law, and fuel that runs out.
#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    World world;
    Body rocket = world.createBody({.angularVelocity = 0.02f});
    rocket.createShape({.geometry = makeBox(0.5f, 2)});  // 1 kg/m^2: a rocket of 1 kg

    const std::size_t thrust = rocket.addForce({.force = {0, 30}, .forceTurns = true});
    rocket.addForceLaw(drag(0.05, 0.01));

    for (int second = 1; second <= 6; ++second) {
        if (second == 4) rocket.setForce(thrust, {});  // burnt out
        for (int i = 0; i < 60; ++i) world.step();
        const Position at = rocket.position();
        std::printf("%d s: (%.1f, %.1f) m, %.1f m/s\n", second, at.x, at.y,
                    static_cast<double>(length(rocket.linearVelocity())));
    }
}
