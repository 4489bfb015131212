// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "measure.hpp"

#include <algorithm>
#include <cmath>

namespace tamias2d::verify {
namespace {

Values gas(const EngineKind& kind, int discs, int boxes)
{
    Trial trial(kind, gasScene(discs, boxes, 1));
    const double start = kineticEnergy(trial.scene(), trial.states());
    double after60 = 0, deepest = 0;
    for (int i = 1; i <= 36000; ++i) {
        trial.step();
        if (i % 10 == 0) deepest = std::max(deepest, deepestOverlap(trial.scene(), trial.states()));
        if (i == 3600) after60 = kineticEnergy(trial.scene(), trial.states()) / start;
    }
    const std::vector<State> end = trial.states();
    const auto escaped = std::count_if(end.begin(), end.end(), [](const State& s) {
        return std::fabs(s.position.x) > 11.5 || std::fabs(s.position.y) > 11.5;
    });
    return {100 * after60, 100 * kineticEnergy(trial.scene(), end) / start, 1000 * deepest,
            static_cast<double>(escaped)};
}

// Drifts of what an isolated system keeps, over 10 s; and by how much the energy ever rises.
Values cluster(const EngineKind& kind, double friction)
{
    Trial trial(kind, clusterScene(friction));
    const Momenta start = momenta(trial.scene(), trial.states());
    const double energy = kineticEnergy(trial.scene(), trial.states());
    double before = energy, rises = 0;
    for (int i = 0; i < 600; ++i) {
        trial.step();
        const double now = kineticEnergy(trial.scene(), trial.states());
        rises += std::max(0.0, now - before);
        before = now;
    }
    const Momenta end = momenta(trial.scene(), trial.states());
    return {length(end.linear - start.linear) / start.linearMagnitude,
            std::fabs(end.angular - start.angular) / start.angularMagnitude, rises / energy};
}

}  // namespace

void gases(Report& report)
{
    report.group(
        "Many bodies: energy and momentum (GD1, DD15, 5.2.7)",
        "Gas: bodies of 0.5 m in a closed box of 20 m, C_R = 1, no friction, no gravity; its kinetic energy "
        "must stay; overlaps are looked at every 10 steps, percent of the size of a body, 0.5 m or 0.4 m; "
        "bodies "
        "outside, percent of all. Cluster: 100 discs and boxes fly into each other, C_R = 0.5; drifts are "
        "relative to the sum of the magnitudes, rises of energy are summed over 10 s.");
    report.measure("Gas of 100 discs",
                   {{"energy after 60 s", "%", 100},
                    {"energy after 10 min", "%", 100},
                    {"deepest overlap", "mm", 0, 500},
                    {"bodies outside", "", 0, 100}},
                   [](const EngineKind& kind) { return gas(kind, 100, 0); });
    report.measure("Gas of 100 discs and 50 boxes",
                   {{"energy after 60 s", "%", 100},
                    {"energy after 10 min", "%", 100},
                    {"deepest overlap", "mm", 0, 400},
                    {"bodies outside", "", 0, 150}},
                   [](const EngineKind& kind) { return gas(kind, 100, 50); });
    for (double friction : {0.0, 0.5})
        report.measure(friction == 0 ? "Cluster, no friction" : "Cluster, friction 0.5",
                       {{"linear momentum drift", "1", 0, 1},
                        {"angular momentum drift", "1", 0, 1},
                        {"rises of energy", "1", 0, 1}},
                       [friction](const EngineKind& kind) { return cluster(kind, friction); });
}

}  // namespace tamias2d::verify
