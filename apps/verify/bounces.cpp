// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "runs.hpp"

#include <algorithm>

namespace tamias2d::verify {
namespace {

// A disc of r = 0.5 m sent at a wall, without gravity: its speed when it comes back.
Values wallHit(const EngineKind& kind, double speed)
{
    Scene scene;
    scene.gravity = {};
    scene.restitution = 1;
    scene.add(fixedBox(2, 10, {2, 0}));
    // 0.3 s before the impact, or closer if that is far.
    const double run = std::min(0.3 * speed, 4.0);
    scene.add(disc(0.5, {0.45 - run, 0}, {speed, 0}));
    Trial trial(kind, scene);
    trial.run(std::max(0.7, 0.1 / speed + 0.7));
    return {-trial.state(1).velocity.x};
}

}  // namespace

void bounces(Report& report)
{
    report.group(
        "Bounces (R8, DD12, IM3)",
        "A disc of r = 0.5 m falls 5 m onto a fixed ground. Heights are those of its lowest point above the "
        "place where the engine lets it rest; 0 means that it does not leave the ground. Walls: a disc meets "
        "a fixed wall "
        "head on, no gravity, C_R = 1. Box2D takes impacts below 1 m/s as plastic, by default.");

    report.measure(
        "C_R = 1, from 5 m", {{"peak 1", "m", 5}, {"peak 30", "m", 5}, {"peak 1000", "m", 5}},
        [](const EngineKind& kind) { return peakHeights(kind, dropScene(kind, 5, 1), 5, {1, 30, 1000}); });
    for (int tenth = 1; tenth <= 9; ++tenth) {
        const double e = tenth / 10.0;
        report.measure(
            "C_R = " + number(e) + ", from 5 m", {{"peak 1", "m", 5 * e * e}},
            [e](const EngineKind& kind) { return peakHeights(kind, dropScene(kind, 5, e), 5, {1}); });
    }
    for (double speed : {0.01, 0.1, 0.25, 0.5, 0.9, 2.0, 10.0, 100.0})
        report.measure("Wall at " + number(speed) + " m/s", {{"exit speed", "m/s", speed}},
                       [speed](const EngineKind& kind) { return wallHit(kind, speed); });
}

}  // namespace tamias2d::verify
