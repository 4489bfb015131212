// SPDX-License-Identifier: MIT
// Our own scenes, and the list of all.

#include "suite_scenes.hpp"

#include <cmath>
#include <numbers>

namespace tamias2d::bench {
namespace {

SceneBody at(Vec position, SceneShape shape)
{
    return {Mobility::Free, {position}, false, {std::move(shape)}};
}

SceneShape regular(int corners, double radius)
{
    std::vector<Vec> points;
    for (int i = 0; i < corners; ++i)
        points.push_back({radius * std::cos(i * 2 * std::numbers::pi / corners),
                          radius * std::sin(i * 2 * std::numbers::pi / corners)});
    return polygon(points);
}

// n bodies that fall a little way into a basin twice as wide as the heap is high.
Scene pile(std::string name, int n, int steps, SceneShape (*shape)(int i))
{
    Scene scene{std::move(name), steps};
    const int columns = static_cast<int>(std::ceil(std::sqrt(2.0 * n)));
    const double half = 0.55 * columns + 0.5, height = 1.2 * columns;
    scene.bodies.push_back({Mobility::Fixed,
                            {},
                            false,
                            {box(half + 2, 1, {0, -1}), box(1, height, {-half - 1, height}),
                             box(1, height, {half + 1, height})}});
    Random random;
    for (int i = 0; i < n; ++i) {
        const double x = (i % columns - (columns - 1) / 2.0) * 1.1, y = (i / columns) * 1.05 + 0.55;
        scene.bodies.push_back(at({x + 0.04 * random.next(), y}, shape(i)));
    }
    return scene;
}

SceneShape circleOf(int)
{
    return disc(0.5);
}
SceneShape capsuleOf(int)
{
    return capsule(0.25, 0.25);
}
SceneShape boxOf(int)
{
    return box(0.48, 0.48);
}
SceneShape polygonOf(int i)
{
    return regular(3 + i % 6, 0.52);
}

// n boxes, in columns of five that do not touch each other.
Scene boxes(std::string name, int n)
{
    Scene scene{std::move(name), 1000};
    scene.bodies.push_back({Mobility::Fixed, {}, false, {box(500, 1, {0, -1})}});
    for (int i = 0; i < n; ++i)
        scene.bodies.push_back(at({(i / 5 - n / 10.0) * 2.0, i % 5 + 0.5}, box(0.5, 0.5)));
    return scene;
}

// A thousand rows of a thousand tiles, and a hundred boxes that glide over the uppermost.
Scene tiles(std::string name, bool asleep)
{
    Scene scene{std::move(name), 200};
    scene.sleep = asleep;
    for (int row = 0; row < 1000; ++row) {
        SceneBody body{Mobility::Fixed, {{0, -1.0 * row}}, false, {}};
        for (int i = -500; i < 500; ++i) body.shapes.push_back(box(0.5, 0.5, {i + 0.5, -0.5}));
        scene.bodies.push_back(std::move(body));
    }
    for (int i = 0; i < 100; ++i) {
        scene.bodies.push_back(at({(i - 50) * 8.0, 0.51}, box(0.5, 0.5)));
        scene.bodies.back().asleep = asleep;
        if (!asleep) scene.bodies.back().start.velocity = {3, 0};
        scene.bodies.back().shapes[0].friction = 0;
    }
    return scene;
}

// 10010 boxes in pyramids, which fall asleep in the first third of the run: the median step is one asleep.
Scene pyramidsAsleep()
{
    Scene scene{"pyramids_asleep", 600};
    scene.sleep = true;
    scene.bodies.push_back({Mobility::Fixed, {}, false, {box(1100, 1, {1000, -1})}});
    for (int pyramid = 0; pyramid < 182; ++pyramid)
        for (int row = 0; row < 10; ++row)
            for (int i = 0; i < 10 - row; ++i)
                scene.bodies.push_back(
                    at({pyramid * 11 + i + 0.5 * row, row * 1.001 + 0.501}, box(0.49, 0.5)));
    return scene;
}

Scene gas()
{
    Scene scene{"gas", 300, {0, 0}};
    scene.bodies.push_back(
        {Mobility::Fixed,
         {},
         false,
         {box(42, 1, {0, -41}), box(42, 1, {0, 41}), box(1, 42, {-41, 0}), box(1, 42, {41, 0})}});
    Random random;
    for (int i = 0; i < 1000; ++i) {
        SceneBody body = at({(i % 32 - 15.5) * 2.4, (i / 32 - 15.5) * 2.4}, disc(0.5));
        body.start.velocity = {5 * random.next(), 5 * random.next()};
        scene.bodies.push_back(body);
    }
    for (SceneBody& body : scene.bodies)
        for (SceneShape& shape : body.shapes) shape.friction = 0, shape.restitution = 1;
    return scene;
}

}  // namespace

const std::vector<SceneEntry>& scenes()
{
    static const std::vector<SceneEntry> all = {
        {"compounds", "suite", compounds},
        {"joint_grid", "suite", jointGrid},
        {"junkyard", "suite", junkyard},
        {"large_pyramid", "suite", largePyramid},
        {"many_pyramids", "suite", manyPyramids},
        {"rain", "suite", rain},
        {"smash", "suite", smash},
        {"spinner", "suite", spinner},
        {"tumbler", "suite", tumbler},
        {"washer", "suite", washer},
        {"circles_1k", "pile", [] { return pile("circles_1k", 1000, 300, circleOf); }},
        {"circles_10k", "pile", [] { return pile("circles_10k", 10000, 100, circleOf); }},
        {"circles_100k", "pile", [] { return pile("circles_100k", 100000, 30, circleOf); }},
        {"capsules_1k", "pile", [] { return pile("capsules_1k", 1000, 300, capsuleOf); }},
        {"capsules_10k", "pile", [] { return pile("capsules_10k", 10000, 100, capsuleOf); }},
        {"capsules_100k", "pile", [] { return pile("capsules_100k", 100000, 30, capsuleOf); }},
        {"boxes_1k", "pile", [] { return pile("boxes_1k", 1000, 300, boxOf); }},
        {"boxes_10k", "pile", [] { return pile("boxes_10k", 10000, 100, boxOf); }},
        {"boxes_100k", "pile", [] { return pile("boxes_100k", 100000, 30, boxOf); }},
        {"polygons_1k", "pile", [] { return pile("polygons_1k", 1000, 300, polygonOf); }},
        {"polygons_10k", "pile", [] { return pile("polygons_10k", 10000, 100, polygonOf); }},
        {"polygons_100k", "pile", [] { return pile("polygons_100k", 100000, 30, polygonOf); }},
        {"awake_1", "small", [] { return boxes("awake_1", 1); }},
        {"awake_10", "small", [] { return boxes("awake_10", 10); }},
        {"awake_30", "small", [] { return boxes("awake_30", 30); }},
        {"awake_100", "small", [] { return boxes("awake_100", 100); }},
        {"awake_300", "small", [] { return boxes("awake_300", 300); }},
        {"awake_1000", "small", [] { return boxes("awake_1000", 1000); }},
        {"tiles", "world", [] { return tiles("tiles", false); }},
        {"tiles_asleep", "world", [] { return tiles("tiles_asleep", true); }},
        {"pyramids_asleep", "world", pyramidsAsleep},
        {"gas", "gas", gas},
    };
    return all;
}

}  // namespace tamias2d::bench
