// SPDX-License-Identifier: MIT
#include "experiments.hpp"

#include <cstring>

namespace tamias2d::verify {

// Three scenes that Pymunk runs as well: one that stays regular, one at rest, one that is chaotic.
void sharedScenes(Report& report)
{
    const EngineKind* chipmunk = nullptr;
    for (const EngineKind& kind : engines())
        if (std::strcmp(kind.key, "chipmunk") == 0) chipmunk = &kind;
    report.shareScene("Ball, C_R = 1, from 5 m", *chipmunk, dropScene(*chipmunk, 5, 1));
    report.shareScene("Stack of 10 boxes", *chipmunk, stackScene(*chipmunk, 10));
    report.shareScene("Gas of 100 discs", *chipmunk, gasScene(100, 0, 1));
}

}  // namespace tamias2d::verify
