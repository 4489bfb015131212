// SPDX-License-Identifier: MIT
#include "experiments.hpp"
#include "runs.hpp"

#include <algorithm>

namespace tamias2d::verify {
namespace {

void aligned(Report& report, int count)
{
    report.measure("Stack of " + std::to_string(count) + ", 60 s",
                   {{"stands", "1", 1},
                    {"sag of the top", "mm", 0, 1000.0 * count},
                    {"moved sideways", "mm", 0, 1000},
                    {"fastest body", "m/s", 0, 0}},
                   [count](const EngineKind& kind) {
                       const Standing s = stand(kind, stackScene(kind, count), 60);
                       if (!s.stood()) return Values{0.0};
                       return Values{1.0, 1000 * s.sag, 1000 * s.sideways, s.fastest};
                   });
}

Values withOffsets(const EngineKind& kind)
{
    double standing = 0, worst = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Standing s = stand(kind, stackScene(kind, 20, 0.05, seed), 60);
        standing += s.stood();
        worst = std::max(worst, s.sideways);
    }
    return {standing, 1000 * worst};
}

Values pile(const EngineKind& kind)
{
    double fastest = 0, overlap = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Standing s = stand(kind, pileScene(100, seed), 20);
        fastest = std::max(fastest, s.fastest);
        overlap = std::max(overlap, s.overlap);
    }
    return {fastest, 1000 * overlap};
}

}  // namespace

void stacks(Report& report)
{
    report.group(
        "Stacks and piles (R7, R8)",
        "Boxes of 1 m, friction 0.6, C_R = 0, sleeping off, placed at each engine's own rest gap. A stack "
        "stands if no center ever moves sideways by more than 0.3 m in 60 s; sags are percent of its height. "
        "Fastest body: speed of the center plus spin times the bounding radius, the highest in the last "
        "second. Overlaps are true ones, by separating axes, percent of 1 m (pile: 0.6 m); Box2D and "
        "Tamias2D rest at a gap, which hides as much sinking.");
    for (int count : {10, 20, 50, 100}) aligned(report, count);
    report.measure("Stack of 20, offsets up to 5 cm, 4 seeds, 60 s",
                   {{"stand", "of 4", 4}, {"moved sideways, worst", "mm", 0, 1000}}, withOffsets);
    report.measure("Pyramid of base 40 (820 boxes), 10 s",
                   {{"fastest body", "m/s", 0, 0},
                    {"deepest overlap", "mm", 0, 1000},
                    {"moved sideways", "mm", 0, 1000},
                    {"sag of the top", "mm", 0, 40000}},
                   [](const EngineKind& kind) {
                       const Standing s = stand(kind, pyramidScene(kind, 40), 10);
                       return Values{s.fastest, 1000 * s.overlap, 1000 * s.sideways, 1000 * s.sag};
                   });
    report.measure("Pile of 100 boxes in a bin, 20 s, worst of 3 seeds",
                   {{"fastest body", "m/s", 0, 0}, {"deepest overlap", "mm", 0, 600}}, pile);
}

}  // namespace tamias2d::verify
