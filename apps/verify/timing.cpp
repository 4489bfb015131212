// SPDX-License-Identifier: MIT
#include "experiments.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>

namespace tamias2d::verify {
namespace {

double millisecondsPerStep(const EngineKind& kind, const Scene& scene, int steps)
{
    Trial trial(kind, scene);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) trial.step();
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(end - start).count() / steps;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

// Engines take turns five times over, so that a busy moment of the machine hits all alike; each
// engine's ratio is taken within a turn, then the median over the turns.
void timing(Report& report)
{
    const struct {
        const char* title;
        int steps;
        Scene (*scene)(const EngineKind&);
    } scenes[] = {
        {"Gas of 100 discs and 50 boxes, 5 s", 300, [](const EngineKind&) { return gasScene(100, 50, 1); }},
        {"Pyramid of base 20 (210 boxes), 3 s", 180, [](const EngineKind& k) { return pyramidScene(k, 20); }},
        {"Pile of 100 boxes, 5 s", 300, [](const EngineKind&) { return pileScene(100, 1); }},
    };
    for (const auto& entry : scenes) {
        std::fprintf(stderr, "  time: %s\n", entry.title);
        nlohmann::json row = {{"scene", entry.title}};
        std::vector<std::vector<double>> times(engines().size()), ratios(engines().size());
        for (int turn = 0; turn < 5; ++turn) {
            for (std::size_t i = 0; i < engines().size(); ++i)
                times[i].push_back(millisecondsPerStep(engines()[i], entry.scene(engines()[i]), entry.steps));
            for (std::size_t i = 0; i < engines().size(); ++i)
                for (std::size_t k = 0; k < engines().size(); ++k)
                    if (std::strcmp(engines()[k].key, "chipmunk") == 0)
                        ratios[i].push_back(times[i].back() / times[k].back());
        }
        for (std::size_t i = 0; i < engines().size(); ++i)
            row["engines"][engines()[i].key] = {{"ms", median(times[i])}, {"ratio", median(ratios[i])}};
        report.json()["timing"].push_back(row);
    }
}

}  // namespace tamias2d::verify
