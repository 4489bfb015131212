// SPDX-License-Identifier: MIT
// Questions to a world: what is at this point, in this box, along this ray?
#include <tamias2d/tamias2d.hpp>

#include <cstdio>
#include <string>

int main()
{
    using namespace tamias2d;
    World world;
    for (int i = 0; i < 5; ++i) {
        Body pillar = world.createBody(
            {.type = BodyType::Static, .position = {3.0 * i, 0}, .name = "pillar " + std::to_string(i)});
        pillar.createShape({.geometry = makeBox(1, 4)});
    }

    for (ShapeId id : world.queryPoint({3.2, 1})) {
        std::printf("at the point: %s\n", world.body(world.shape(id).body()).name().c_str());
    }
    std::printf("in the box: %zu shapes\n", world.queryBox({.lower = {2, -1}, .upper = {9, 1}}).size());

    if (const auto hit = world.castRay({-5, 0}, {20, 0})) {
        std::printf("the ray first meets %s at x = %.2f m\n", world.body(hit->body).name().c_str(),
                    hit->point.x);
    }
    std::printf("and %zu shapes in all\n", world.castRayAll({-5, 0}, {20, 0}).size());
}
