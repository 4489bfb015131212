// SPDX-License-Identifier: MIT
// A game's loop: frames come as they like, the physics steps evenly, the picture is in between.
#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    World world;
    Body ball = world.createBody({.position = {0, 100}});
    ball.createShape({.geometry = Circle{}});

    FixedStepper stepper;                                     // steps of 1/60 s with 4 sub-steps
    const double frames[] = {0.016, 0.040, 0.008, 0.020, 1};  // [s]; the last one is a hiccup
    for (double seconds : frames) {
        const int steps = stepper.advance(world, seconds);
        const double height = ball.interpolated(stepper.alpha()).position.y;
        std::printf("frame of %.0f ms: %d steps, draw the ball at %.3f m\n", 1000 * seconds, steps, height);
    }
    std::printf("the hiccup cost %.2f s of simulated time\n", stepper.dropped());
}
