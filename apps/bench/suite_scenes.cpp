// SPDX-License-Identifier: MIT
// The scenes of Box2D's benchmark suite that need no joints, from their published dimensions
// (github.com/erincatto/box2d, shared/benchmarks.c, 2026): numbers only.

#include "suite_scenes.hpp"

#include "engine.hpp"

#include <cmath>
#include <numbers>

namespace tamias2d::bench {
namespace {

constexpr double kPi = std::numbers::pi;

SceneBody fixed(Vec position, std::vector<SceneShape> shapes)
{
    return {Mobility::Fixed, {position}, false, std::move(shapes)};
}

SceneBody moving(Vec position, SceneShape shape)
{
    return {Mobility::Free, {position}, false, {std::move(shape)}};
}

// A pyramid of squares of half width `a`: row i has base - i of them.
void addPyramid(Scene& scene, int base, double a, double left, double bottom)
{
    for (int i = 0; i < base; ++i)
        for (int j = i; j < base; ++j)
            scene.bodies.push_back(
                moving({left + (i + 1) * a + 2 * (j - i) * a, bottom + (2 * i + 1) * a}, box(a, a)));
}

// A floor and two walls of unit blocks that overlap a little.
SceneBody basin(int halfWidth, int height)
{
    SceneBody body = fixed({}, {});
    for (int i = -halfWidth; i <= halfWidth; ++i)
        body.shapes.push_back(box(0.55, 0.5, {static_cast<double>(i), 0}));
    for (int side : {-1, 1})
        for (int i = 1; i <= height; ++i)
            body.shapes.push_back(
                box(0.5, 0.55, {static_cast<double>(side * halfWidth), static_cast<double>(i)}));
    return body;
}

Vec onCircle(double radius, double angle)
{
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

Scene compounds()
{
    Scene scene{"compounds", 500};
    scene.sleep = true;
    scene.bodies.push_back(basin(40, 100));
    scene.bodies.back().shapes.push_back(line({-800, -80}, {800, -80}));
    SceneShape left = polygon({{-1, 0}, {0.5, 1}, {0, 2}});
    SceneShape right = polygon({{1, 0}, {-0.5, 1}, {0, 2}});
    left.friction = right.friction = 0.5;
    double side = 0.25;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 150; ++j, side = -side) {
            SceneBody body = moving({i * 2.0 - 19 + side, j * 2.25 + 0.575 + 5}, left);
            body.shapes.push_back(right);
            scene.bodies.push_back(body);
        }
    }
    return scene;
}

Scene junkyard()
{
    Scene scene{"junkyard", 800};
    scene.sleep = true;
    scene.bodies.push_back(basin(80, 50));
    std::vector<Vec> points;
    for (int i = 0; i < 5; ++i) points.push_back(onCircle(0.25, kPi * (std::sqrt(5.0) - 1) * i));
    const SceneShape pentagon = polygon(points);
    double side = -0.1;
    for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 40; ++j, side = -side)
            scene.bodies.push_back(moving({1.5 * (2.0 * i - 200) * 0.25 + side, j + 15.0}, pentagon));

    const std::size_t pusher = scene.bodies.size();
    SceneBody body = moving({}, box(2, 4, {0, 4}));
    body.mobility = Mobility::Driven;
    scene.bodies.push_back(body);
    scene.drive = [pusher](Engine& engine, int step) {
        const double target = 60 * std::sin(0.2 * kTimeStep * step);
        engine.setVelocity(pusher, {(target - engine.state(pusher).position.x) / kTimeStep, 0}, 0);
    };
    return scene;
}

Scene largePyramid()
{
    Scene scene{"large_pyramid", 500};
    scene.bodies.push_back(fixed({0, -1}, {box(100, 1)}));
    addPyramid(scene, 100, 0.5, -50, 0);
    return scene;
}

Scene manyPyramids()
{
    Scene scene{"many_pyramids", 200};
    SceneBody ground = fixed({}, {});
    for (int i = 0; i < 20; ++i) ground.shapes.push_back(line({-110, 11.0 * i}, {110, 11.0 * i}));
    scene.bodies.push_back(ground);
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j) addPyramid(scene, 10, 0.5, -110 + 11 * j + 0.5, 11.0 * i);
    return scene;
}

Scene smash()
{
    Scene scene{"smash", 300, {0, 0}};
    scene.sleep = true;
    SceneBody ram = moving({-20, 0}, box(4, 4));
    ram.shapes[0].density = 8;
    ram.start.velocity = {40, 0};
    scene.bodies.push_back(ram);
    for (int i = 0; i < 120; ++i) {
        for (int j = 0; j < 80; ++j) {
            scene.bodies.push_back(moving({i * 0.4 + 30, (j - 40) * 0.4}, box(0.2, 0.2)));
            scene.bodies.back().asleep = true;
        }
    }
    return scene;
}

Scene washer()
{
    Scene scene{"washer", 500};
    scene.sleep = true;
    SceneBody drum;
    drum.mobility = Mobility::Driven;
    drum.start = {{0, 10}, 0, {0.001, -0.002}, kPi / 180 * 25};
    const double angle = kPi / 18, slack = 0.1 * angle;
    for (int i = 0; i < 36; ++i) {
        const double from = i * angle, to = (i + 1) % 36 * angle;
        drum.shapes.push_back(polygon({onCircle(16, from - slack), onCircle(18, from - slack),
                                       onCircle(16, to + slack), onCircle(18, to + slack)}));
        if (i % 9 == 0)
            drum.shapes.push_back(
                polygon({onCircle(14, from), onCircle(16, from), onCircle(14, to), onCircle(16, to)}));
    }
    scene.bodies.push_back(drum);
    for (int i = 0; i < 90; ++i)
        for (int j = 0; j < 90; ++j)
            scene.bodies.push_back(moving({-9.9 + 0.21 * j, 0.1 + 0.21 * i}, box(0.1, 0.1)));
    return scene;
}

}  // namespace tamias2d::bench
