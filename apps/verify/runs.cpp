// SPDX-License-Identifier: MIT
#include "runs.hpp"

#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tamias2d::verify {

// The top is that of the parabola through three successive places, so that neither the length of a step
// nor an engine's own idea of velocity shifts it.
Values peakHeights(const EngineKind& kind, const Scene& scene, double drop, const std::vector<int>& wanted)
{
    Trial trial(kind, scene);
    const double rest = trial.state(1).position.y - drop;
    Values heights;
    int bounces = 0;
    double below = 0, here = trial.state(1).position.y, vy = 0;
    double lastBounce = 0;
    while (heights.size() < wanted.size() && trial.time() - lastBounce < 10) {
        trial.step();
        const State s = trial.state(1);
        const double next = s.position.y;
        if (vy < 0 && s.velocity.y > 0) {
            ++bounces;
            lastBounce = trial.time();
        }
        const bool top = here > below && here >= next && bounces == wanted[heights.size()];
        const double bend = 2 * here - below - next;
        if (top && bend > 0) heights.push_back(here + (next - below) * (next - below) / (8 * bend) - rest);
        below = here;
        here = next;
        vy = s.velocity.y;
    }
    heights.resize(wanted.size(), 0.0);
    return heights;
}

Standing stand(const EngineKind& kind, const Scene& scene, double seconds)
{
    Trial trial(kind, scene);
    const std::vector<State> start = trial.states();
    Standing result;
    while (trial.time() < seconds - 1e-9) {
        trial.step();
        const std::vector<State> now = trial.states();
        for (std::size_t i = 1; i < now.size(); ++i)
            result.sideways = std::max(result.sideways, std::fabs(now[i].position.x - start[i].position.x));
        if (trial.time() > seconds - 1) result.fastest = std::max(result.fastest, fastestBody(scene, now));
    }
    const std::vector<State> end = trial.states();
    result.sag = start.back().position.y - end.back().position.y;
    result.overlap = deepestOverlap(scene, end);
    return result;
}

double energyLeft(const EngineKind& kind, const Scene& scene, double seconds)
{
    Trial trial(kind, scene);
    const double start = kineticEnergy(scene, trial.states());
    trial.run(seconds);
    return 100 * kineticEnergy(scene, trial.states()) / start;
}

int passedHeadOn(const EngineKind& kind, double speed, double rate, int substeps)
{
    Scene scene;
    scene.gravity = {};
    scene.friction = 0;
    scene.rate = rate;
    scene.substeps = substeps;
    for (int i = 0; i < 200; ++i) {
        const double y = 4.0 * i, phase = 0.0137 * i;
        for (int side : {-1, 1}) {
            SceneBody body = disc(0.1, {side * (5 + (side < 0 ? 1 : 0.7) * phase), y}, {-side * speed, 0});
            body.fast = true;
            scene.add(body);
        }
    }
    Trial trial(kind, scene);
    // Box2D moves no body by more than 2 m a step: give it the time it then needs.
    trial.run(9 / std::min(speed, 100.0) + 0.1);
    int passed = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); i += 2)
        passed += trial.state(i).position.x > trial.state(i + 1).position.x;
    return passed;
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace tamias2d::verify
