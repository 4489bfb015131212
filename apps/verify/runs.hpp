// SPDX-License-Identifier: MIT
#pragma once

#include "report.hpp"

// What several experiments do with a scene.
namespace tamias2d::verify {

/// A ball (body 1) over a ground: the heights above where it rests of its flights number `wanted` [m].
/// `drop` is the height it starts from; a flight that never comes has height 0.
Values peakHeights(const EngineKind& kind, const Scene& scene, double drop, const std::vector<int>& wanted);

struct Standing {
    double sag = 0;       ///< of the last body                                        [m]
    double sideways = 0;  ///< the most that any center moved sideways, at any time    [m]
    double fastest = 0;   ///< in the last second                                      [m/s]
    double overlap = 0;   ///< at the end                                              [m]

    bool stood() const { return sideways <= 0.3; }
};
/// A pile of bodies left alone; body 0 is its ground.
Standing stand(const EngineKind& kind, const Scene& scene, double seconds);

/// Kinetic energy of a scene without forces after some time, in percent of that at the start.
double energyLeft(const EngineKind& kind, const Scene& scene, double seconds);

/// Discs of r = 0.1 m fly at each other, each of 200 pairs from another distance: how many pass through.
int passedHeadOn(const EngineKind& kind, double speed, double rate, int substeps);

/// A number as it is written in the name of an experiment.
std::string number(double value);

}  // namespace tamias2d::verify
