// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "runs.hpp"

#include <algorithm>

namespace tamias2d::verify {
namespace {

constexpr int kShots = 200;

// A body flies at a fixed wall of its own: how many end up behind it.
Values atWall(const EngineKind& kind, SceneBody body, double speed, double thickness)
{
    Scene scene;
    scene.gravity = {};
    scene.friction = 0;
    for (int i = 0; i < kShots; ++i) {
        const double y = 6.0 * i;
        scene.add(fixedBox(thickness, 5, {0, y}));
        body.start = {{-3 - 0.0537 * i / 4, y}, body.outline == Outline::Disc ? 0 : 0.1 * i, {speed, 0}, 0};
        scene.add(body);
    }
    Trial trial(kind, scene);
    trial.run(9 / std::min(speed, 100.0) + 0.1);  // as in passedHeadOn
    double passed = 0;
    for (std::size_t i = 1; i < scene.bodies.size(); i += 2) passed += trial.state(i).position.x > 0;
    return {passed};
}

}  // namespace

void tunnelling(Report& report)
{
    report.group(
        "Fast and thin: does anything pass? (R7, T5)",
        "200 shots each from different distances, C_R = 0; the figure is how many pass through, percent of "
        "200. Box2D's moving bodies are flagged as bullets where they meet each other; it also moves no body "
        "by "
        "more than 2 m a step, so its fastest shots are slower than stated. Chipmunk has no continuous "
        "collision.");
    const std::vector<Quantity> passes = {{"passed of 200", "", 0, kShots}};
    for (double speed : {20.0, 200.0, 2000.0})
        report.measure("Discs r = 0.1 m head on at " + number(speed) + " m/s", passes,
                       [speed](const EngineKind& kind) { return Values{passedHeadOn(kind, speed, 60, 4)}; });
    report.measure("Disc r = 0.1 m at 60 m/s, wall of 5 cm", passes,
                   [](const EngineKind& kind) { return atWall(kind, disc(0.1, {}), 60, 0.05); });
    for (double speed : {20.0, 200.0, 2000.0})
        report.measure(
            "Box 0.2 m at " + number(speed) + " m/s, wall of 1 cm", passes,
            [speed](const EngineKind& kind) { return atWall(kind, box(0.2, 0.2, {}), speed, 0.01); });
}

}  // namespace tamias2d::verify
