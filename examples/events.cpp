// SPDX-License-Identifier: MIT
// What happened in a step: touches that began and ended, and every hit with its figures.
#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    World world;
    Body ground = world.createBody({.type = BodyType::Static, .name = "ground"});
    ground.createShape({.geometry = Segment{.a = {-10, 0}, .b = {10, 0}}});
    Body ball = world.createBody({.position = {0, 1}, .name = "ball"});
    ball.createShape({.geometry = Circle{.radius = 0.25f}, .material = {.restitution = 0.5f}});

    for (int i = 0; i < 180; ++i) {
        world.step();
        const StepEvents events = world.events();
        for (const HitEvent& hit : events.hits) {
            std::printf("%.4f s: %s hits %s at %.3f m/s, impulse %.3f N*s\n", hit.time,
                        world.body(hit.bodyA).name().c_str(), world.body(hit.bodyB).name().c_str(),
                        static_cast<double>(hit.approachSpeed), static_cast<double>(hit.normalImpulse));
        }
        for ([[maybe_unused]] const TouchEvent& touch : events.begins) {
            std::printf("%.4f s: a touch begins\n", world.time());
        }
        for ([[maybe_unused]] const TouchEvent& touch : events.ends) {
            std::printf("%.4f s: a touch ends\n", world.time());
        }
    }
    std::printf("touching now: %s\n", world.touching(ground.id(), ball.id()) ? "yes" : "no");
}
