// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "runs.hpp"

namespace tamias2d::verify {
namespace {

constexpr double kRate = 240;  // [steps/s]

Scene fine(Scene scene)
{
    scene.rate = kRate;
    scene.substeps = 1;
    return scene;
}

}  // namespace

void fineSteps(Report& report)
{
    report.group(
        "All engines at 240 Hz",
        "Some of the scenes above once more with 240 steps a second, in Tamias2D with one sub-step each: all "
        "engines then integrate with the same step, and the peers do about four times its work. Percentages "
        "as above.");
    report.measure(
        "C_R = 1, from 5 m, 240 Hz", {{"peak 1", "m", 5}, {"peak 30", "m", 5}},
        [](const EngineKind& kind) { return peakHeights(kind, fine(dropScene(kind, 5, 1)), 5, {1, 30}); });
    report.measure("C_R = 0.5, from 5 m, 240 Hz", {{"peak 1", "m", 1.25}}, [](const EngineKind& kind) {
        return peakHeights(kind, fine(dropScene(kind, 5, 0.5)), 5, {1});
    });
    report.measure("Gas of 100 discs, 240 Hz", {{"energy after 60 s", "%", 100}}, [](const EngineKind& kind) {
        return Values{energyLeft(kind, fine(gasScene(100, 0, 1)), 60)};
    });
    for (double speed : {20.0, 200.0})
        report.measure(
            "Discs r = 0.1 m head on at " + number(speed) + " m/s, 240 Hz", {{"passed of 200", "", 0, 200}},
            [speed](const EngineKind& kind) { return Values{passedHeadOn(kind, speed, kRate, 1)}; });
    for (int count : {10, 20, 50})
        report.measure("Stack of " + std::to_string(count) + ", 60 s, 240 Hz",
                       {{"stands", "1", 1}, {"sag of the top", "mm", 0, 1000.0 * count}},
                       [count](const EngineKind& kind) {
                           const Standing s = stand(kind, fine(stackScene(kind, count)), 60);
                           return s.stood() ? Values{1.0, 1000 * s.sag} : Values{0.0};
                       });
    report.measure("Pyramid of base 40 (820 boxes), 10 s, 240 Hz",
                   {{"fastest body", "m/s", 0, 0}, {"moved sideways", "mm", 0, 1000}},
                   [](const EngineKind& kind) {
                       const Standing s = stand(kind, fine(pyramidScene(kind, 40)), 10);
                       return Values{s.fastest, 1000 * s.sideways};
                   });
}

}  // namespace tamias2d::verify
