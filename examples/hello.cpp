#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    World world;  // gravity is (0, -9.81) m/s^2

    Body ground = world.createBody({.type = BodyType::Static});
    ground.createShape({.geometry = Segment{.a = {-10, 0}, .b = {10, 0}}});
    Body ball = world.createBody({.position = {0, 5}});
    ball.createShape({.geometry = Circle{.radius = 0.25f}, .material = {.restitution = 0.8f}});
    Body box = world.createBody({.position = {2, 3}});
    box.createShape({.geometry = makeBox(1, 1)});

    for (int step = 0; step <= 240; ++step) {
        if (step % 60 == 0) {
            std::printf("%d s: ball at %.2f m, box at %.2f m\n", step / 60, ball.position().y,
                        box.position().y);
        }
        world.step();  // 1/60 s
    }
}
