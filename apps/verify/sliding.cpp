// SPDX-License-Identifier: MIT
#include "experiments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tamias2d::verify {
namespace {

// Slides without friction at 5 m/s over 200 separate, flush tiles of 1 m: its least speed, and how
// high it ever hops. It starts `drop` above where it rests; it has a second to land.
Values glide(const EngineKind& kind, SceneBody body, double halfHeight, double drop = 0)
{
    if (body.outline == Outline::Polygon && body.radius > 0 && !kind.rounds)
        return {std::nullopt, std::nullopt};
    Scene scene;
    scene.friction = 0;
    for (int i = 0; i < 200; ++i) scene.add(fixedBox(1, 1, {static_cast<double>(i), -0.5}));
    const double rest = halfHeight + kind.restGap(scene.bodies[0], body);
    body.start.position = {2, rest + drop};
    body.start.velocity = {5, 0};
    const std::size_t slider = scene.add(body);
    Trial trial(kind, scene);
    double slowest = 5, highest = 0;
    while (trial.time() < 40 && trial.state(slider).position.x < 190) {
        trial.step();
        slowest = std::min(slowest, trial.state(slider).velocity.x);
        if (drop == 0 || trial.time() > 1) highest = std::max(highest, trial.state(slider).position.y - rest);
        if (slowest < 0.05) break;
    }
    return {slowest, 1000 * highest};
}

constexpr double kSlope = 20 * std::numbers::pi / 180;

// A body at rest on a slope of 20 degrees, aligned with it; `along` is how far down it is later.
struct SlopeTrial {
    Trial trial;
    Vec down = {std::cos(kSlope), -std::sin(kSlope)};
    Vec start;

    SlopeTrial(const EngineKind& kind, SceneBody body, double friction)
        : trial(kind, scene(kind, body, friction))
    {
        start = trial.state(1).position;
    }

    static Scene scene(const EngineKind& kind, SceneBody body, double friction)
    {
        Scene scene;
        scene.friction = friction;
        scene.add(fixedBox(100, 1, {}, -kSlope));
        const Vec up = {std::sin(kSlope), std::cos(kSlope)}, along = {up.y, -up.x};
        const double height = 0.5 + kind.restGap(scene.bodies[0], body) + 0.5;
        body.start.position = height * up - 40.0 * along;
        body.start.angle = -kSlope;
        scene.add(body);
        return scene;
    }

    double along() const { return dot(down, trial.state(1).position - start); }
    double speed() const { return dot(down, trial.state(1).velocity); }
};

Values slideDown(const EngineKind& kind, SceneBody body, double friction)
{
    SlopeTrial slope(kind, std::move(body), friction);
    slope.trial.run(3);
    return {slope.speed(), slope.along()};
}

Values creep(const EngineKind& kind)
{
    SlopeTrial slope(kind, box(1, 1, {}), 0.5);
    slope.trial.run(600);
    return {1000 * slope.along()};
}

}  // namespace

void sliding(Report& report)
{
    report.group(
        "Sliding: tiles and slopes (R5, R8)",
        "Tiles: a body without friction at 5 m/s over 200 separate flush boxes of 1 m must neither slow down "
        "nor hop (percent of 1 m). Slope of 20 degrees: acceleration g (sin - mu cos) for a box with mu = "
        "0.3, "
        "2/3 g sin for a rolling disc with mu = 0.6, none for a box with mu = 0.5. Box2D 2.4 has no "
        "rounded polygons.");
    const std::vector<Quantity> glideRows = {{"least speed", "m/s", 5}, {"highest hop", "mm", 0, 1000}};
    report.measure("Box over tiles", glideRows,
                   [](const EngineKind& k) { return glide(k, box(1, 1, {}), 0.5); });
    report.measure("Disc over tiles", glideRows,
                   [](const EngineKind& k) { return glide(k, disc(0.5, {}), 0.5); });
    report.measure("Rounded box over tiles", glideRows,
                   [](const EngineKind& k) { return glide(k, roundedBox(1, 0.1, {}), 0.5); });
    report.measure("Hexagon over tiles", glideRows, [](const EngineKind& k) {
        return glide(k, hexagon(0.5, {}), 0.25 * std::numbers::sqrt3);
    });
    report.measure("Box landing on tiles from 0.1 m", glideRows,
                   [](const EngineKind& k) { return glide(k, box(1, 1, {}), 0.5, 0.1); });
    report.measure("Disc landing on tiles from 0.1 m", glideRows,
                   [](const EngineKind& k) { return glide(k, disc(0.5, {}), 0.5, 0.1); });
    const double box03 = 9.81 * (std::sin(kSlope) - 0.3 * std::cos(kSlope)),
                 roll = 2.0 / 3 * 9.81 * std::sin(kSlope);
    report.measure("Box sliding down, 3 s", {{"speed", "m/s", 3 * box03}, {"way", "m", 4.5 * box03}},
                   [](const EngineKind& k) { return slideDown(k, box(1, 1, {}), 0.3); });
    report.measure("Disc rolling down, 3 s", {{"speed", "m/s", 3 * roll}, {"way", "m", 4.5 * roll}},
                   [](const EngineKind& k) { return slideDown(k, disc(0.5, {}), 0.6); });
    report.measure("Box sticking, 10 min", {{"creep", "mm", 0, 1000}}, creep);
}

}  // namespace tamias2d::verify
