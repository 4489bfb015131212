// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

namespace tamias2d::bench {

/// How well a scene lies at the end, by the same measure for every engine.
struct Quality {
    double deepest = 0;        ///< overlap of two shapes                       [m]
    double mean = 0;           ///< over the pairs that overlap                 [m]
    double kineticEnergy = 0;  ///< of the free bodies, by their own densities  [J]
    double fastest = 0;        ///< speed of a free body                        [m/s]
    double top = 0;            ///< height of the highest free body             [m]
    double jointError = 0;     ///< greatest distance of two points that should be together  [m]
};

Quality measureQuality(const Scene& scene, const Engine& engine);

}  // namespace tamias2d::bench
