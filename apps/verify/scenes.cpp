// SPDX-License-Identifier: MIT
#include "experiments.hpp"

namespace tamias2d::verify {

// Discs of r = 0.25 m or boxes of 0.6 x 0.4 m, on a grid in a closed box of 20 m, with random
// velocities up to 3 m/s a component; nothing but elastic collisions acts on them.
Scene gasScene(int discs, int boxes, double restitution)
{
    Scene scene;
    scene.gravity = {};
    scene.friction = 0;
    scene.restitution = restitution;
    constexpr double half = 10, wall = 2;
    scene.add(fixedBox(2 * half + 2 * wall, wall, {0, -half - wall / 2}));
    scene.add(fixedBox(2 * half + 2 * wall, wall, {0, half + wall / 2}));
    scene.add(fixedBox(wall, 2 * half, {-half - wall / 2, 0}));
    scene.add(fixedBox(wall, 2 * half, {half + wall / 2, 0}));
    Random random(7);
    for (int i = 0; i < discs + boxes; ++i) {
        const Vec place = {-half + 1 + 1.4 * (i % 14), -half + 1 + 1.6 * (i / 14)};
        const Vec velocity = {3 * random.next(), 3 * random.next()};
        // Every third one is a box until the boxes are used up.
        const bool isBox = boxes > 0 && (discs == 0 || i % 3 == 2);
        scene.add(isBox ? box(0.6, 0.4, place, 0, velocity, 2 * random.next()) : disc(0.25, place, velocity));
    }
    return scene;
}

// Boxes of 1 m on a ground, each at the engine's own rest gap.
Scene stackScene(const EngineKind& kind, int count, double offset, unsigned seed)
{
    Scene scene;
    const SceneBody ground = fixedBox(100, 1, {0, -0.5});
    scene.add(ground);
    Random random(seed);
    double top = 0;
    for (int i = 0; i < count; ++i) {
        const double x = offset * random.next();
        SceneBody b = box(1, 1, {x, 0});
        const double gap = kind.restGap(i == 0 ? ground : b, b);
        b.start.position.y = top + gap + 0.5;
        top = b.start.position.y + 0.5;
        scene.add(b);
    }
    return scene;
}

// Rows of base, base - 1, ... 1 boxes of 1 m, 5 cm apart, each at the rest gap over the row below.
Scene pyramidScene(const EngineKind& kind, int base)
{
    Scene scene;
    scene.add(fixedBox(4.0 * base, 1, {0, -0.5}));
    const SceneBody unit = box(1, 1, {});
    const double pitch = 1 + kind.restGap(unit, unit);
    for (int row = 0; row < base; ++row)
        for (int i = 0; i < base - row; ++i)
            scene.add(box(1, 1, {(i - (base - row - 1) / 2.0) * 1.05, pitch - 0.5 + row * pitch}));
    return scene;
}

// Boxes of 0.4 to 0.8 m by 70 % of that, dropped with random turns into a bin 10 m wide.
Scene pileScene(int count, unsigned seed)
{
    Scene scene;
    scene.add(fixedBox(16, 2, {0, -1}));
    scene.add(fixedBox(2, 60, {-6, 29}));
    scene.add(fixedBox(2, 60, {6, 29}));
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const double size = 0.6 + 0.2 * random.next();
        const Vec place = {(i % 8 - 3.5) * 1.1 + 0.1 * random.next(), 1 + (i / 8) * 1.2};
        scene.add(box(size, 0.7 * size, place, random.next()));
    }
    return scene;
}

// 100 discs and boxes that fly towards their common center and collide; nothing else acts.
Scene clusterScene(double friction)
{
    Scene scene;
    scene.gravity = {};
    scene.friction = friction;
    scene.restitution = 0.5;
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Vec place = {(i % 10 - 4.5) * 1.5, (i / 10 - 4.5) * 1.5};
        const Vec velocity = -0.4 * place + Vec{random.next(), random.next()};
        const double size = 0.8 + 0.2 * random.next(), spin = 2 * random.next();
        scene.add(i % 2 ? box(size, 0.7 * size, place, random.next(), velocity, spin)
                        : disc(size / 2, place, velocity, spin));
    }
    return scene;
}

// A disc of r = 0.5 m whose lowest point is `height` above where it would rest on the ground.
Scene dropScene(const EngineKind& kind, double height, double restitution)
{
    Scene scene;
    scene.restitution = restitution;
    const SceneBody ground = fixedBox(40, 2, {0, -1});
    SceneBody ball = disc(0.5, {});
    ball.start.position.y = 0.5 + kind.restGap(ground, ball) + height;
    scene.add(ground);
    scene.add(ball);
    return scene;
}

}  // namespace tamias2d::verify
